#!/usr/bin/env bash
# Sets up what is missing, builds everything and runs all tests. Needs nothing but Debian 12 or 13 and this folder.
#
# usage: tests/run.sh [--preset NAME] [--jobs N] [--filter PATTERN] [-- CTEST_OPTIONS...]
#   --preset NAME   a preset of CMakePresets.json: release (default, or $GNEISS_PRESET), release-asserts, dev (sanitizers)
#   --jobs N        compilers and tests at once (default: number of cores)
#   --filter PATTERN  GoogleTests whose names match, and nothing else: tests/run.sh --filter '*Cavity*'
#   -- ...          handed to ctest, to run whole executables: tests/run.sh -- -R mesh
#
# The last line is "N passed, N failed". Exit status: 0 if every test passed and there was at least one, 2 for wrong use,
# 1 otherwise.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() { sed -n '2,/^set/{s/^# \{0,1\}//p}' "$0"; }
wrong_use() { printf 'tests/run.sh: %s\n' "$1" >&2; usage >&2; exit 2; }

preset=${GNEISS_PRESET:-release}
jobs=$(nproc)
filter=''
while [[ $# -gt 0 ]]; do
    case $1 in
        --preset) [[ $# -ge 2 ]] || wrong_use "--preset needs a name"; preset=$2; shift 2 ;;
        --filter) [[ $# -ge 2 ]] || wrong_use "--filter needs a pattern"; filter=$2; shift 2 ;;
        --jobs) [[ ${2-} =~ ^[1-9][0-9]*$ ]] || wrong_use "--jobs needs a number"; jobs=$2; shift 2 ;;
        --help | -h) usage; exit 0 ;;
        --) shift; break ;;
        *) wrong_use "unknown argument $1" ;;
    esac
done
case $preset in
    release | release-asserts | dev | portable) ;;
    *) wrong_use "no preset $preset; there are release, release-asserts, dev, portable" ;;
esac

began=0
step() {
    began=$SECONDS
    printf '\n[%s] %s\n' "$1" "$2"
}
took() { printf '      took %d min %02d s\n' $(((SECONDS - began) / 60)) $(((SECONDS - began) % 60)); }
fail() { printf '\ntests/run.sh: %s\n' "$1" >&2; exit 1; }

step 1/4 "Debian packages: on a bare machine several minutes, otherwise at once"
cmake/install_debian_packages.sh tests
took

step 2/4 "configuring preset $preset in build/$preset: some seconds"
cmake --preset "$preset" || fail "configuring failed; if build/$preset is left over from another place, delete it"
took

step 3/4 "building, $jobs at once: some minutes the first time (ninja counts files below)"
NINJA_STATUS='      [%f/%t, %e s] ' \
    cmake --build --preset "$preset" -j "$jobs" </dev/null || fail "the build failed; the first error is above"
took

step 4/4 "testing, $jobs at once: some minutes"
report=$PWD/build/$preset/tests.xml reports=$PWD/build/$preset/reports
rm -rf "$report" "$reports"
mkdir "$reports"
if [[ -n $filter ]]; then
    export GTEST_FILTER=$filter
    set -- -L googletest "$@"
fi
ctest_status=0
ctest --preset "$preset" -j "$jobs" --output-junit "$report" "$@" </dev/null || ctest_status=$?
took

[[ -s $report ]] || fail "no test ran (ctest's exit status: $ctest_status)"
counts=$(/usr/bin/python3 -B tests/count_tests.py "$report" "$reports")
read -r passed failed skipped <<<"$counts"
sed 1d <<<"$counts"
[[ $skipped -eq 0 ]] || printf '      %d skipped\n' "$skipped"
echo
printf '%d passed, %d failed\n' "$passed" "$failed"
[[ $ctest_status -eq 0 && $failed -eq 0 && $passed -gt 0 ]]
