# KLU, CHOLMOD and UMFPACK of SuiteSparse, which ships CMake files in Debian 13 and none in 12: one target SuiteSparse::all.
find_path(SuiteSparse_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
set(SuiteSparse_required SuiteSparse_INCLUDE_DIR)
set(SuiteSparse_LIBRARIES)
foreach(name klu cholmod umfpack)
  find_library(SuiteSparse_${name}_LIBRARY ${name})
  list(APPEND SuiteSparse_required SuiteSparse_${name}_LIBRARY)
  list(APPEND SuiteSparse_LIBRARIES "${SuiteSparse_${name}_LIBRARY}")
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS ${SuiteSparse_required})

if(SuiteSparse_FOUND AND NOT TARGET SuiteSparse::all)
  add_library(SuiteSparse::all INTERFACE IMPORTED)
  set_target_properties(SuiteSparse::all PROPERTIES
    INTERFACE_SYSTEM_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}"
    INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${SuiteSparse_LIBRARIES}")
endif()
mark_as_advanced(${SuiteSparse_required})
