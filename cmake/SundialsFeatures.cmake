# gneiss::sundials: vectors of SUNDIALS, and what its headers have as definitions for src/linear/sundials_api.hpp. Asked of
# the headers, not of a version.
include(CheckCXXSourceCompiles)
include(CheckCXXSymbolExists)
include(CMakePushCheckState)

find_path(GNEISS_SUNDIALS_HEADERS arkode/arkode.h HINTS "${SUNDIALS_DIR}/../../../../include" REQUIRED)
mark_as_advanced(GNEISS_SUNDIALS_HEADERS)

cmake_push_check_state(RESET)
set(CMAKE_REQUIRED_QUIET ON)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # compiled, not linked
# Debian builds version 7 with MPI, whose types then stand in every header; SUNDIALS' own configuration looks for it.
set(CMAKE_REQUIRED_INCLUDES "${GNEISS_SUNDIALS_HEADERS}" ${MPI_C_INCLUDE_DIRS})
check_cxx_symbol_exists(KINSetErrFile "cstdio;kinsol/kinsol.h" GNEISS_SUNDIALS_HAS_SET_ERR_FILE)
check_cxx_symbol_exists(SUNContext_ClearErrHandlers "cstdio;sundials/sundials_context.h" GNEISS_SUNDIALS_HAS_ERR_HANDLERS)
check_cxx_symbol_exists(ARKodeEvolve "cstdio;arkode/arkode.h" GNEISS_SUNDIALS_HAS_COMMON_ARKODE)
foreach(tables "6_7;erk;ARKODE_VERNER_16_8_9" "7_1;dirk;ARKODE_IMPLICIT_MIDPOINT_1_2")
  list(GET tables 0 since)
  list(GET tables 1 kind)
  list(GET tables 2 last)
  check_cxx_source_compiles("#include <cstdio>\n#include <arkode/arkode_butcher_${kind}.h>\nint last() { return ${last}; }"
    GNEISS_SUNDIALS_HAS_TABLES_OF_${since})
endforeach()
# whether ARKODE evaluates rates at the ends of steps when somebody wants them, or always
check_cxx_symbol_exists(ARKodeButcherTable_IsStifflyAccurate "cstdio;arkode/arkode_butcher.h" GNEISS_SUNDIALS_HAS_LAZY_RATES)
unset(CMAKE_TRY_COMPILE_TARGET_TYPE)
cmake_pop_check_state()
if(NOT GNEISS_SUNDIALS_HAS_SET_ERR_FILE AND NOT GNEISS_SUNDIALS_HAS_ERR_HANDLERS)
  message(FATAL_ERROR "SUNDIALS' headers in ${GNEISS_SUNDIALS_HEADERS} do not compile, or are those of an unknown version: "
    "CMakeFiles/CMakeConfigureLog.yaml or CMakeFiles/CMakeError.log has the compiler's words")
endif()

add_library(gneiss_sundials INTERFACE)
add_library(gneiss::sundials ALIAS gneiss_sundials)
target_link_libraries(gneiss_sundials INTERFACE SUNDIALS::nvecserial)
foreach(feature SET_ERR_FILE ERR_HANDLERS COMMON_ARKODE LAZY_RATES TABLES_OF_6_7 TABLES_OF_7_1)
  target_compile_definitions(gneiss_sundials INTERFACE
    GNEISS_SUNDIALS_HAS_${feature}=$<BOOL:${GNEISS_SUNDIALS_HAS_${feature}}>)
endforeach()
