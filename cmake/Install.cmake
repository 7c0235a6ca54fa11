# Installation and packages: the program, and the libraries with what find_package(gneiss) reads.
#
#   cmake --install build/portable --prefix DIR                          everything
#   cmake --install build/portable --prefix DIR --component program      the program alone
#   cpack --config build/portable/CPackConfig.cmake                      gneiss_*.deb and libgneiss-dev_*.deb
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

install(TARGETS gneiss_app RUNTIME COMPONENT program)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright COMPONENT program)
install(FILES "${PROJECT_SOURCE_DIR}/CHANGELOG.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(FILES "${PROJECT_SOURCE_DIR}/docs/deck.md" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)

# gneiss_exported() keeps the list. The judge of the cross-check is no library for others.
get_property(gneiss_libraries GLOBAL PROPERTY GNEISS_LIBRARIES)
set_target_properties(gneiss_sundials PROPERTIES EXPORT_NAME sundials)
set_target_properties(gneiss_xsimd PROPERTIES EXPORT_NAME xsimd)
install(TARGETS ${gneiss_libraries} gneiss_sundials gneiss_xsimd EXPORT gneissTargets ARCHIVE COMPONENT development
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
set(gneiss_cmake_dir "${CMAKE_INSTALL_LIBDIR}/cmake/gneiss")
install(EXPORT gneissTargets NAMESPACE gneiss:: DESTINATION "${gneiss_cmake_dir}" COMPONENT development)

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/gneissConfig.cmake.in" "${PROJECT_BINARY_DIR}/gneissConfig.cmake"
  INSTALL_DESTINATION "${gneiss_cmake_dir}" NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/gneissConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/gneissConfig.cmake" "${PROJECT_BINARY_DIR}/gneissConfigVersion.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindGmsh.cmake" "${CMAKE_CURRENT_LIST_DIR}/FindSuiteSparse.cmake"
  DESTINATION "${gneiss_cmake_dir}" COMPONENT development)

# Headers go below include/gneiss/. Here they include each other as "system/state.hpp"; there as "gneiss/system/state.hpp",
# so that no folder of another project is taken for one of ours.
set(gneiss_header_folders base contact fracture io linear mesh model system app elements materials integrators)
list(JOIN gneiss_header_folders "|" folders)
foreach(folder IN LISTS gneiss_header_folders)
  set(root "${PROJECT_SOURCE_DIR}/src")
  if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}")
    set(root "${PROJECT_SOURCE_DIR}")
  endif()
  install(CODE "
    file(GLOB_RECURSE headers RELATIVE \"${root}\" \"${root}/${folder}/*.hpp\")
    foreach(header IN LISTS headers)
      set(to \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/gneiss/\${header}\")
      file(READ \"${root}/\${header}\" text)
      string(REGEX REPLACE \"#include \\\"(${folders})/\" \"#include \\\"gneiss/\\\\1/\" text \"\${text}\")
      file(WRITE \"\${to}\" \"\${text}\")
    endforeach()
    message(STATUS \"Installed headers of ${folder}\")
  " COMPONENT development)
endforeach()

# --- packages: a program that needs shared libraries alone, and what is needed to compile against it
set(CPACK_PACKAGE_NAME gneiss)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "The gneiss developers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Plane dynamics, fracture and contact of anisotropic solids, under any time integration scheme")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME gneiss)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libgneiss-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# Packages with headers and libraries that gneiss' own headers and archives ask for.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "g++, cmake, libeigen3-dev, libxsimd-dev, libfmt-dev, libgmsh-dev, libmuparser-dev, libsuitesparse-dev, libsundials-dev, libspdlog-dev, nlohmann-json3-dev, libtomlplusplus-dev, libhdf5-dev, zlib1g-dev")
include(CPack)
