#!/usr/bin/env bash
# SUNDIALS 7.1.1 of Debian 13 (built with MPI), found by CMake from a project in C++ alone.
#
# A good guess: project(p LANGUAGES CXX) with find_package(SUNDIALS REQUIRED COMPONENTS arkode nvecserial) and target_link_libraries(p SUNDIALS::arkode
# SUNDIALS::nvecserial) works as with SUNDIALS 6.4.1 of Debian 12: the package finds what its targets need, and says so where it cannot. Nothing in
# this project is written in C or uses MPI.
#
# What happens: find_package succeeds, configuring is "done", and CMake then fails while it generates: the link interface of
# SUNDIALS::core_shared contains MPI::MPI_C, which was not found. From version 7 on every target depends on core, and core on MPI::MPI_C where SUNDIALS
# has MPI. SUNDIALSConfig.cmake calls find_package(MPI), but FindMPI makes targets only for the languages that the project has
# enabled, here MPI::MPI_CXX alone; the configuration file neither asks for the component C nor enables the language. With LANGUAGES C CXX the same
# project generates.
#
# Whom it hurts: C++ projects that move from Debian 12 to 13 (or to any SUNDIALS 7 with MPI): the error names no file of theirs, and not the cure.
# Libraries whose own package configuration calls find_dependency(SUNDIALS) have it strike their users' projects. Cure: enable C before
# find_package(SUNDIALS), or give MPI::MPI_C as an imported interface target that links MPI::MPI_CXX.
#
# Needs cmake, a C and a C++ compiler, and MPI's compiler wrappers on the machine (Debian packages cmake, g++, libopenmpi-dev).
set -euo pipefail

for program in cmake g++ mpicc mpicxx; do
    command -v "$program" >/dev/null || { echo "$program is not installed"; exit 1; }
done
[[ $(dpkg --print-architecture) == amd64 ]] || { echo "the packages are those of amd64"; exit 1; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mirror=$(apt-get indextargets --format '$(ORIGIN)|$(LABEL)|$(COMPONENT)|$(REPO_URI)' | sed -n 's/^Debian|Debian|main|//p' | head -n 1)
mkdir -p state/lists/partial cache/archives/partial
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror trixie main" >sources.list
apt_of_trixie() {
    apt-get -q -o Dir::Etc::SourceList="$PWD/sources.list" -o Dir::Etc::SourceParts=- -o Dir::State::Lists="$PWD/state/lists" \
        -o Dir::Cache="$PWD/cache" -o APT::Sandbox::User=root "$@" >/dev/null 2>&1
}
apt_of_trixie update || { echo "the lists of Debian 13 cannot be fetched"; exit 1; }
for package in dev arkode6 core7 cvode7 cvodes7 ida7 idas6 kinsol7 nvecparallel-hypre7 nvecparallel-mpi7 nvecparallel-openmp7 \
    nvecparallel-petsc7 nvecparallel-pthread7 nvecserial7 sunlinsol5 sunmatrix5; do
    apt_of_trixie download "libsundials-$package=7.1.1+dfsg1-10" \
        || { echo "libsundials-$package 7.1.1+dfsg1-10 cannot be fetched: this is not Debian 13 as it was then"; exit 1; }
done
for file in *.deb; do dpkg -x "$file" root; done

# Prints whether a project with these languages generates, and what CMake misses if not.
outcome() {
    mkdir -p "project $*"
    cat >"project $*/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(p LANGUAGES $*)
find_package(SUNDIALS 7.1 REQUIRED COMPONENTS arkode nvecserial)
message(STATUS "SUNDIALS found")
add_executable(p p.cpp)
target_link_libraries(p PRIVATE SUNDIALS::arkode SUNDIALS::nvecserial)
CMAKE
    echo 'int main() { return 0; }' >"project $*/p.cpp"
    local log="project $*/log" status=0
    cmake -S "project $*" -B "project $*/build" -DSUNDIALS_DIR="$PWD/root/usr/lib/x86_64-linux-gnu/cmake/sundials" >"$log" 2>&1 || status=$?
    printf 'LANGUAGES %-6s cmake ends with %d%s\n' "$*" $status "$(
        grep -q 'SUNDIALS found' "$log" && printf ', SUNDIALS found'
        grep -q 'Configuring done' "$log" && printf ', configured'
        grep -q 'MPI::MPI_C$' "$log" && printf ', MPI::MPI_C missing'
        grep -q 'Generating done' "$log" && ((status == 0)) && printf ', generated')"
}

found=$(outcome CXX; outcome C CXX)
echo "$found"
if [[ $found == "LANGUAGES CXX    cmake ends with 1, SUNDIALS found, configured, MPI::MPI_C missing
LANGUAGES C CXX  cmake ends with 0, SUNDIALS found, configured, generated" ]]; then
    echo "as described"
else
    echo "NOT as described"
    exit 1
fi
