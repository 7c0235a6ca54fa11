# ccache is used where it is installed at the first configuration; looked for again, it would have everything compiled anew on
# the day on which it comes.
if(GNEISS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  if(NOT DEFINED GNEISS_COMPILER_LAUNCHER)
    find_program(gneiss_ccache ccache NO_CACHE)
    if(NOT gneiss_ccache)
      set(gneiss_ccache "")
    endif()
    set(GNEISS_COMPILER_LAUNCHER "${gneiss_ccache}" CACHE STRING "What compilers are called by; decided at the first configuration")
  endif()
  set(CMAKE_C_COMPILER_LAUNCHER "${GNEISS_COMPILER_LAUNCHER}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${GNEISS_COMPILER_LAUNCHER}")
endif()

# One interface target carries every flag that our own code is compiled with. The architecture flag belongs here
# and nowhere else: the alignment of Eigen's matrices and the width of packs, and so the ABI, follow from it. That is why
# whoever links an installed gneiss gets it too; all but that is for this build.
add_library(gneiss_options INTERFACE)
add_library(gneiss::options ALIAS gneiss_options)
target_compile_features(gneiss_options INTERFACE cxx_std_20)
target_compile_options(gneiss_options INTERFACE
  -march=${GNEISS_ARCH}
  # sqrt and friends need no errno; -ffast-math would destroy log1p.
  "$<BUILD_INTERFACE:-fno-math-errno;-fno-trapping-math>"
  "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wnon-virtual-dtor;-Woverloaded-virtual;-Wcast-align;-Wunused>"
  # notes that vectors are passed otherwise than in another ABI: everything here is built with one -march
  -Wno-psabi
  # g++ 12 warns of its own AVX-512 headers, which pass undefined registers on purpose
  "$<BUILD_INTERFACE:-Wno-uninitialized;-Wno-maybe-uninitialized>"
  # g++ 12 takes the counted appends inside fmt for writes behind an end
  "$<BUILD_INTERFACE:-Wno-stringop-overflow>")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  # newer ones take a name that is passed as a string for the owner of the reference that is returned
  target_compile_options(gneiss_options INTERFACE "$<BUILD_INTERFACE:-Wno-dangling-reference>")
endif()
if(GNEISS_WERROR)
  target_compile_options(gneiss_options INTERFACE "$<BUILD_INTERFACE:-Werror>")
endif()
if(GNEISS_SANITIZE)
  target_compile_options(gneiss_options INTERFACE
    "$<BUILD_INTERFACE:-fsanitize=address,undefined;-fno-sanitize-recover=undefined;-fno-omit-frame-pointer>")
  target_link_options(gneiss_options INTERFACE "$<BUILD_INTERFACE:-fsanitize=address,undefined>")
endif()
if(GNEISS_ASSERTIONS)
  target_compile_options(gneiss_options INTERFACE "$<BUILD_INTERFACE:-UNDEBUG>")
endif()
# Headers are included by their path from the root: "elements/cst.hpp", "system/state.hpp". Installed ones stand under
# gneiss/, and so do the paths by which they include each other (cmake/Install.cmake).
target_include_directories(gneiss_options INTERFACE
  "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>" "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>")

# gneiss_precompiled(TARGET OWNER HEADERS...): compiles what nearly every file includes once, for OWNER, whose flags TARGET
# has. Files include what they use all the same: preset dev compiles without.
function(gneiss_precompiled target owner)
  if(NOT GNEISS_PRECOMPILED_HEADERS)
    return()
  endif()
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
  target_compile_options(${target} PRIVATE -fpch-preprocess)  # ccache asks for it
endfunction()

# gneiss_unity(TARGET): compiles several of its files at once, in half of the processor time of a clean build. So names in
# unnamed namespaces are met once per library, or executable of tests.
function(gneiss_unity target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${GNEISS_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# gneiss_exported(NAME): installed and exported as gneiss::NAME.
function(gneiss_exported name)
  set_target_properties(gneiss_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY GNEISS_LIBRARIES gneiss_${name})
endfunction()
gneiss_exported(options)

set(gneiss_headers <algorithm> <array> <cmath> <filesystem> <functional> <memory> <optional> <span> <stdexcept> <string> <vector>
  <fmt/format.h> <xsimd/xsimd.hpp>)

# gneiss_library(NAME [BRIEF] sources...): a static library gneiss_NAME with alias gneiss::NAME. BRIEF: of texts and options, whose
# code runs briefly: with -O1, and a precompiled header of -O1, it compiles in two thirds of the time.
function(gneiss_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "BRIEF" "" "")
  add_library(gneiss_${name} STATIC ${arg_UNPARSED_ARGUMENTS})
  add_library(gneiss::${name} ALIAS gneiss_${name})
  target_link_libraries(gneiss_${name} PUBLIC gneiss::options PRIVATE fmt::fmt)  # what puts messages together
  set(owner gneiss_base)
  if(arg_BRIEF)
    target_compile_options(gneiss_${name} PRIVATE -O1)
    set(owner gneiss_report)
  endif()
  gneiss_precompiled(gneiss_${name} ${owner} ${gneiss_headers})
  gneiss_unity(gneiss_${name})
  gneiss_exported(${name})
endfunction()
