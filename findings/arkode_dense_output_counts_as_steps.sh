#!/usr/bin/env bash
# SUNDIALS 6.4.1 (Debian 12), ARKODE's ARKStep with explicit tables and fixed steps: evaluations of f that are no stages.
#
# A good guess: an explicit Runge-Kutta scheme of s stages evaluates f s times a step, s - 1 where its last stage is the first of the
# next step (Dormand and Prince), and ARKStepGetNumRhsEvals over steps says so. A row of dense output (ARKStepGetDky within the step
# just taken) uses what the step has, and a stop time at which the step ends anyway costs nothing.
#
# What happens, with the default interpolant (Hermite):
# - tables whose last node is not 1 take s + 1 evaluations (the end of the step, for the interpolant);
# - Dormand and Prince's seven stages are seven evaluations;
# - each row costs one evaluation more for tables of order 5 and four for those of order 6 and more, in the counter as if they were
#   stages;
# - a step that ends at a stop time has its own end interpolated, for the same one or four.
#
# Whom it hurts: who compares schemes by evaluations of f. A row in each step makes Fehlberg's 7(8) with 13 stages cost 17 and
# leaves Heun's 2 alone: tables of high order look a third worse than they are.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
version=6.4.1+dfsg1-3
for package in libsundials-dev libsundials-arkode5 libsundials-nvecserial6 libsundials-sunmatrix4 libsundials-sunlinsol3; do
    apt-get download -q "$package=$version" >/dev/null
done
for file in *.deb; do dpkg -x "$file" root; done

cat >count.cpp <<'CPP'
#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>

#include <cstdio>

// y' = -y + t
static int f(realtype t, N_Vector y, N_Vector derivative, void*) {
    NV_Ith_S(derivative, 0) = -NV_Ith_S(y, 0) + t;
    return 0;
}

struct Counts {
    long first_step, later_steps;
};

constexpr int n_steps = 64;

static Counts evaluations(SUNContext context, ARKODE_ERKTableID table, bool rows, bool stop_time) {
    const double step = 1.0 / n_steps;  // a power of two: ends of steps are exact
    N_Vector y = N_VNew_Serial(1, context), row = N_VNew_Serial(1, context);
    NV_Ith_S(y, 0) = 1;
    void* arkode = ARKStepCreate(f, nullptr, 0, y, context);
    ARKStepSetTableNum(arkode, ARKODE_DIRK_NONE, table);
    ARKStepSetFixedStep(arkode, step);
    if (stop_time) ARKStepSetStopTime(arkode, step);
    realtype t = 0;
    long first = 0, all = 0, implicit = 0;
    ARKStepEvolve(arkode, 2, y, &t, ARK_ONE_STEP);
    ARKStepGetNumRhsEvals(arkode, &first, &implicit);
    for (int i = 0; i < n_steps && !stop_time; ++i) {
        ARKStepEvolve(arkode, 2, y, &t, ARK_ONE_STEP);
        if (rows) ARKStepGetDky(arkode, t - step / 2, 0, row);
    }
    ARKStepGetNumRhsEvals(arkode, &all, &implicit);
    N_VDestroy(y);
    N_VDestroy(row);
    ARKStepFree(&arkode);
    return {first, all - first};
}

int main() {
    SUNContext context;
    SUNContext_Create(nullptr, &context);
    const struct { const char* name; ARKODE_ERKTableID table; } tables[] = {
        {"heun_euler_2_1_2", ARKODE_HEUN_EULER_2_1_2},
        {"zonneveld_5_3_4", ARKODE_ZONNEVELD_5_3_4},
        {"cash_karp_6_4_5", ARKODE_CASH_KARP_6_4_5},
        {"dormand_prince_7_4_5", ARKODE_DORMAND_PRINCE_7_4_5},
        {"verner_8_5_6", ARKODE_VERNER_8_5_6},
        {"fehlberg_13_7_8", ARKODE_FEHLBERG_13_7_8}};
    for (const auto& [name, table] : tables) {
        const Counts plain = evaluations(context, table, false, false), with_rows = evaluations(context, table, true, false),
                     stopped = evaluations(context, table, false, true);
        std::printf("%s %g %g %ld\n", name, static_cast<double>(plain.later_steps) / n_steps,
                    static_cast<double>(with_rows.later_steps - plain.later_steps) / n_steps,
                    stopped.first_step - plain.first_step);
    }
    SUNContext_Free(&context);
}
CPP
library=$(dirname "$(find "$PWD/root" -name 'libsundials_arkode.so' | head -1)")
g++ -std=c++20 -I root/usr/include count.cpp -o count -L "$library" -lsundials_arkode -lsundials_nvecserial
export LD_LIBRARY_PATH=$library
./count >seen

# table, evaluations per step, more for a row in the step, more for a step that ends at a stop time
cat >expected <<'TABLE'
heun_euler_2_1_2 2 0 0
zonneveld_5_3_4 6 0 0
cash_karp_6_4_5 7 1 1
dormand_prince_7_4_5 7 1 1
verner_8_5_6 8 4 4
fehlberg_13_7_8 13 4 4
TABLE
column -t seen
diff expected seen && echo "as the header says"
