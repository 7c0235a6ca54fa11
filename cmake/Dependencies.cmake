# Everything comes from packages that Debian 12 and 13 have (see cmake/install_debian_packages.sh); nothing is vendored. What
# differs between their SUNDIALS: docs/decisions/041.
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(spdlog REQUIRED)
find_package(fmt REQUIRED)
find_package(muparser REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(CLI11 REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(ZLIB REQUIRED)
find_package(Gmsh REQUIRED)
find_package(SuiteSparse REQUIRED)
find_package(SUNDIALS 6.4 REQUIRED COMPONENTS arkode cvode ida kinsol nvecserial sunlinsolpcg sunlinsolspgmr sunnonlinsolfixedpoint
  sunnonlinsolnewton)
include(SundialsFeatures)
# Another python3 may come first on PATH; the figures need Debian's, with numpy and matplotlib.
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python with numpy and matplotlib")
find_package(Python3 COMPONENTS Interpreter)

# xsimd's own CMake target links a library that Debian does not ship: use the header alone.
find_path(XSIMD_INCLUDE_DIR xsimd/xsimd.hpp REQUIRED)
add_library(gneiss_xsimd INTERFACE)
add_library(gneiss::xsimd ALIAS gneiss_xsimd)
target_include_directories(gneiss_xsimd SYSTEM INTERFACE "$<BUILD_INTERFACE:${XSIMD_INCLUDE_DIR}>")
