# Writes the header OUTPUT with the commit of SOURCE_DIR. Run at every build: configuring happens too rarely to know.
# The header is touched only when the commit has changed, so that nothing is compiled in vain.
cmake_minimum_required(VERSION 3.25)

execute_process(
  COMMAND git rev-parse --short HEAD
  WORKING_DIRECTORY "${SOURCE_DIR}"
  OUTPUT_VARIABLE revision OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
# Without optional locks: a build must not be in the way of a commit made at the same time.
execute_process(
  COMMAND git --no-optional-locks status --porcelain --untracked-files=no
  WORKING_DIRECTORY "${SOURCE_DIR}"
  OUTPUT_VARIABLE changes OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(revision STREQUAL "")
  set(revision "unknown")
elseif(NOT changes STREQUAL "")
  string(APPEND revision "-dirty")
endif()
file(CONFIGURE OUTPUT "${OUTPUT}" CONTENT "#pragma once\n#define GNEISS_GIT_REVISION \"@revision@\"\n" @ONLY)
