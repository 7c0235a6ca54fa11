#!/usr/bin/env bash
# Runs a study: sets up what is missing, builds the program, runs every case, leaves numbers and figures.
#
# usage: studies/run.sh NAME [--quick] [--jobs N]
#   NAME       a folder of studies/ with a Snakefile: blast, borehole, fracture, integrators, locking
#   --quick    coarse meshes, one to four minutes: what CI runs
#   --jobs N   cores to use (default: number of cores)
#
# Results: results/NAME/summary.json, results/NAME/figures/*.png, the runs in results/NAME/cases/, their logs in
# results/NAME/logs/. Calling it again goes on where it stopped; what is there and up to date is not computed again.
# $GNEISS_PRESET names the preset to build with (default: release). A study that compares with deal.II does so where
# deal.II is installed, and says what it has left out where it is not.
# Exit status: 0 if every run came to its end and every metric keeps its bound, 2 for wrong use, 1 otherwise.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() { sed -n '2,/^set/{s/^# \{0,1\}//p}' "$0"; }
wrong_use() { printf 'studies/run.sh: %s\n' "$1" >&2; usage >&2; exit 2; }

name='' profile=full jobs=$(nproc)
while [[ $# -gt 0 ]]; do
    case $1 in
        --quick) profile=quick; shift ;;
        --jobs) [[ ${2-} =~ ^[1-9][0-9]*$ ]] || wrong_use "--jobs needs a number"; jobs=$2; shift 2 ;;
        --help | -h) usage; exit 0 ;;
        -*) wrong_use "unknown option $1" ;;
        *) [[ -z $name ]] || wrong_use "one study at a time"; name=$1; shift ;;
    esac
done
[[ -n $name ]] || wrong_use "which study?"
[[ -f studies/$name/Snakefile ]] \
    || wrong_use "no study $name; there are: $(cd studies && echo */Snakefile | sed 's,/Snakefile,,g')"

preset=${GNEISS_PRESET:-release}
root=$PWD results=$PWD/results/$name
program=$root/build/$preset/src/app/gneiss crosscheck=$root/build/$preset/tests/crosscheck/gneiss_crosscheck

began=0
step() { began=$SECONDS; printf '\n[%s] %s\n' "$1" "$2"; }
took() { printf '      took %d min %02d s\n' $(((SECONDS - began) / 60)) $(((SECONDS - began) % 60)); }
fail() { printf '\nstudies/run.sh: %s\n' "$1" >&2; exit 1; }

# On a bare machine the compiler need not wait for what draws the figures: those packages come beside it.
set=run first=build
! grep -q crosscheck "studies/$name/Snakefile" || set=crosscheck first=crosscheck
# sudo may have to ask for a password, which nobody can type beside a build
[[ $EUID -eq 0 ]] || sudo -n true 2>/dev/null || first=$set
step 1/4 "Debian packages: on a bare machine one to three minutes, otherwise at once"
cmake/install_debian_packages.sh "$first"
took

step 2/4 "building the program with preset $preset in build/$preset: four to five minutes the first time on two cores"
beside=$(mktemp "${TMPDIR:-/tmp}/gneiss-packages-XXXXXX")
cmake/install_debian_packages.sh "$set" </dev/null >"$beside" 2>&1 &
packages_job=$!
# apt is not left behind half-way
trap '[[ ! -d /proc/$packages_job ]] || echo "waiting until apt has installed the packages that draw the figures"
      wait; rm -f "$beside"' EXIT
cmake --preset "$preset" >/dev/null \
    || fail "configuring failed; if build/$preset is left over from another place, delete it"
targets=(gneiss_app)
if [[ $set == crosscheck ]]; then
    if [[ $(cmake --build --preset "$preset" --target help) == *gneiss_crosscheck_app* ]]; then
        targets+=(gneiss_crosscheck_app)
    else
        echo "      deal.II is not installed (Debian package libdeal.ii-dev): what needs it is skipped"
    fi
fi
# apt first, which needs one core and would be waited for in the end
NINJA_STATUS='      [%f/%t, %e s] ' nice -n 10 cmake --build --preset "$preset" -j "$jobs" --target "${targets[@]}" </dev/null \
    || fail "the build failed; the first error is above"
[[ -x $program ]] || fail "the build left no $program"
[[ ! -d /proc/$packages_job ]] || echo "      waiting for the packages that draw the figures"
packages_status=0
wait "$packages_job" || packages_status=$?
if [[ $packages_status -eq 0 ]]; then
    sed 's/^packages:/      packages, beside the build:/' "$beside"
else
    cmake/install_debian_packages.sh "$set"  # once more, to be seen
fi
took

mkdir -p "$results"
step 3/4 "study $name, $profile, $jobs jobs at once; runs in results/$name/cases"
snakemake=(/usr/bin/snakemake -s "studies/$name/Snakefile" --directory "$results" --cores "$jobs"
           --config "program=$program" "profile=$profile")
[[ ${targets[*]} != *crosscheck* ]] || snakemake+=("crosscheck=$crosscheck")
# A run that was killed leaves a lock behind. Nobody else writes into this folder: take it away.
"${snakemake[@]}" --unlock >/dev/null 2>&1 || true
"${snakemake[@]}" --keep-going --rerun-incomplete --show-failed-logs </dev/null 2>&1 | studies/common/progress.sh \
    || fail "some step failed: its message is above, its log in results/$name/logs"
took

step 4/4 "metrics against what the study has to show"
status=0
PYTHONPATH=$root /usr/bin/python3 "studies/$name/check_metrics.py" "$results/summary.json" || status=1
printf '\nnumbers: results/%s/summary.json   figures: results/%s/figures\n' "$name" "$name"
exit $status
