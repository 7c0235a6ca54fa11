#pragma once
// Functions into which everything that they call is to be inlined.

// Inlines all that a function calls. Not under sanitizers: what they add to it takes minutes to compile.
#ifdef __SANITIZE_ADDRESS__
#define GNEISS_FLATTEN
#else
#define GNEISS_FLATTEN [[gnu::flatten]]
#endif
