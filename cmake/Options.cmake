# One interface target carries every flag that our own code is compiled with. The architecture flag belongs here
# and nowhere else: Eigen's alignment, and so the ABI, follows from it.
add_library(gneiss_options INTERFACE)
add_library(gneiss::options ALIAS gneiss_options)
target_compile_features(gneiss_options INTERFACE cxx_std_20)
target_compile_options(gneiss_options INTERFACE
  -march=${GNEISS_ARCH}
  # sqrt and friends need no errno; -ffast-math would destroy log1p.
  -fno-math-errno -fno-trapping-math
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align -Wunused
  # notes that vectors are passed otherwise than in another ABI: everything here is built with one -march
  -Wno-psabi
  # g++ 12 warns of its own AVX-512 headers, which pass undefined registers on purpose
  -Wno-uninitialized -Wno-maybe-uninitialized
  # g++ 12 takes the counted appends inside fmt for writes behind an end
  -Wno-stringop-overflow)
if(GNEISS_WERROR)
  target_compile_options(gneiss_options INTERFACE -Werror)
endif()
if(GNEISS_SANITIZE)
  target_compile_options(gneiss_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_link_options(gneiss_options INTERFACE -fsanitize=address,undefined)
endif()
if(GNEISS_ASSERTIONS)
  target_compile_options(gneiss_options INTERFACE -UNDEBUG)
endif()
# Headers are included by their path from the root: "elements/cst.hpp", "system/state.hpp".
target_include_directories(gneiss_options INTERFACE "${PROJECT_SOURCE_DIR}" "${PROJECT_SOURCE_DIR}/src")

# gneiss_library(NAME sources...): a static library gneiss_NAME with alias gneiss::NAME.
function(gneiss_library name)
  add_library(gneiss_${name} STATIC ${ARGN})
  add_library(gneiss::${name} ALIAS gneiss_${name})
  target_link_libraries(gneiss_${name} PUBLIC gneiss::options)
endfunction()
