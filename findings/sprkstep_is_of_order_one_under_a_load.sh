#!/usr/bin/env bash
# SUNDIALS 7.1.1 (Debian 13), ARKODE's SPRKStep: symplectic partitioned Runge-Kutta methods under a load that varies in time.
#
# A good guess: SPRKStep integrates p' = f1(t, q), q' = f2(t, p), says its guide, with tables of order 1 to 10. Both right-hand sides
# get a t, so a load may be an explicit function of time, and every table keeps its order, as it does when t is taken for one
# more coordinate whose momentum nobody asks for (Hairer, Lubich and Wanner, Geometric Numerical Integration, II.1).
#
# What happens: a stage calls f1 with the time that the momenta have reached, t_n + (sum of the coefficients of f1 so far) h. The
# coordinates that it gets are those of the time of the drifts, t_n + (sum of the coefficients of f2 so far) h. Where the two
# differ f1(t, q) mixes two instants: the tables of orders 2, 4, 6 and 8 that run here are of order 1. Without a load
# orders are as the tables say; with the load taken at the time of the last f2, which the caller can keep, they are as well.
# (q'' = -q + sin 2t, two seconds, exact solution known; the order is the ratio of the errors of n and 2n steps.)
#
# Whom it hurts: who drives anything by SPRKStep, a base that shakes, a pressure that rises: an order of 8 becomes 1, and nothing says
# so; comparisons of symplectic with other methods under loads are no comparison then.
#
# Run it on Debian 13; SUNDIALS is pinned, the libraries of MPI to which it is linked are that system's.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
version=7.1.1+dfsg1-10
sundials=(libsundials-dev libsundials-arkode6 libsundials-core7 libsundials-nvecserial7 libsundials-sunmatrix5 libsundials-sunlinsol5)
mpi=(libopenmpi-dev libopenmpi40 libpsm2-2 libfabric1 libucx0 libevent-core-2.1-7t64 libevent-pthreads-2.1-7t64 libhwloc15 libpmix2t64
     libnuma1 librdmacm1t64 libibverbs1 libnl-3-200 libnl-route-3-200 libmunge2)  # what Debian's SUNDIALS is linked to
for package in "${sundials[@]/%/=$version}" "${mpi[@]}"; do
    apt-get download -q "$package" >/dev/null 2>&1 || { echo "$package cannot be fetched: this is not Debian 13"; exit 1; }
done
for file in *.deb; do dpkg -x "$file" root; done

cat >order.cpp <<'CPP'
#include <arkode/arkode.h>
#include <arkode/arkode_sprkstep.h>
#include <nvector/nvector_serial.h>

#include <cmath>
#include <cstdio>
#include <initializer_list>

static double amplitude = 0, time_of_q = 0;
static bool at_time_of_q = false;

static int kick(sunrealtype t, N_Vector y, N_Vector rate, void*) {
    NV_Ith_S(rate, 1) = -NV_Ith_S(y, 0) + amplitude * std::sin(2 * (at_time_of_q ? time_of_q : t));
    return 0;
}

static int drift(sunrealtype t, N_Vector y, N_Vector rate, void*) {
    time_of_q = t;
    NV_Ith_S(rate, 0) = NV_Ith_S(y, 1);
    return 0;
}

static double error(const char* method, int n) {
    SUNContext context;
    SUNContext_Create(SUN_COMM_NULL, &context);
    N_Vector y = N_VNew_Serial(2, context);
    NV_Ith_S(y, 0) = 1;
    NV_Ith_S(y, 1) = 0.3;
    time_of_q = 0;
    void* arkode = SPRKStepCreate(kick, drift, 0, y, context);
    SPRKStepSetMethodName(arkode, method);
    ARKodeSetFixedStep(arkode, 2.0 / n);
    sunrealtype t = 0;
    for (int k = 0; k < n; ++k) ARKodeEvolve(arkode, 2.0, y, &t, ARK_ONE_STEP);
    const double c = -amplitude / 3, b = 0.3 - 2 * c;  // q = cos t + b sin t + c sin 2t
    const double q = std::cos(2) + b * std::sin(2) + c * std::sin(4);
    const double p = -std::sin(2) + b * std::cos(2) + 2 * c * std::cos(4);
    const double found = std::hypot(NV_Ith_S(y, 0) - q, NV_Ith_S(y, 1) - p);
    ARKodeFree(&arkode);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return found;
}

static double order(const char* method, int n) { return std::log2(error(method, n) / error(method, 2 * n)); }

int main() {
    struct Table {
        const char* name;
        int order, n;
    };
    bool as_described = true;
    for (const Table table : {Table{"ARKODE_SPRK_LEAPFROG_2_2", 2, 40}, {"ARKODE_SPRK_MCLACHLAN_4_4", 4, 40},
                              {"ARKODE_SPRK_YOSHIDA_6_8", 6, 10}, {"ARKODE_SPRK_SUZUKI_UMENO_8_16", 8, 10}}) {
        amplitude = 0;
        const double without = order(table.name, table.n);
        amplitude = 1;
        const double loaded = order(table.name, table.n);
        at_time_of_q = true;
        const double at_q = order(table.name, table.n);
        at_time_of_q = false;
        std::printf("%-32s no load %5.2f   load %5.2f   load at the time of q %5.2f\n", table.name, without, loaded, at_q);
        as_described = as_described && std::abs(without - table.order) < 0.15 && std::abs(loaded - 1) < 0.15 &&
                       std::abs(at_q - table.order) < 0.15;
    }
    return as_described ? 0 : 1;
}
CPP
libraries=$PWD/root/usr/lib/x86_64-linux-gnu
g++ -std=c++17 -I root/usr/include -I "$libraries/openmpi/include" order.cpp -L "$libraries" -L "$libraries/openmpi/lib" \
    -Wl,-rpath-link,"$libraries" -lsundials_arkode -lsundials_nvecserial -lsundials_core -lmpi -o order
if LD_LIBRARY_PATH=$libraries ./order; then echo "as described"; else echo "NOT as described"; exit 1; fi
