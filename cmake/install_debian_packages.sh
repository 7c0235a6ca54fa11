#!/usr/bin/env bash
# Installs the Debian packages that gneiss is built with. Does nothing, in a fraction of a second, where all of them
# are present, and removes none. studies/run.sh and tests/run.sh call it first.
#
# usage: cmake/install_debian_packages.sh [--list] [SET]
#   SET      build       what the program is built with
#            run         that, and what the studies draw and compute with
#            crosscheck  that, and deal.II, by which the study `locking` and some tests judge
#            tests       that, and what the tests and benchmarks need (default)
#   --list   print the package names, one per line, and stop
#
# exit status: 0 all present, 1 they could not be installed, 2 wrong use
set -euo pipefail

# What a find_package, an include or a script of this repository asks for, and nothing else: a bare machine waits for
# every further one.
build=(
    ca-certificates git python3
    g++ cmake ninja-build                          # compiler with OpenMP, build
    libeigen3-dev libxsimd-dev                     # linear algebra, packs
    libsuitesparse-dev libsundials-dev             # sparse linear systems; nonlinear ones and ODEs
    libopenblas0-serial                            # dense blocks of factors: 3 times faster than with Debian's reference BLAS
    libgmsh-dev                                    # meshes
    zlib1g-dev libhdf5-dev                         # .vtu, checkpoints
    libtomlplusplus-dev libcli11-dev libmuparser-dev nlohmann-json3-dev libspdlog-dev libfmt-dev
)
run=(python3-numpy python3-scipy python3-matplotlib snakemake)  # studies
crosscheck=(libdeal.ii-dev)                        # tests/crosscheck, the largest of all; gneiss itself does without
tests=(libgtest-dev libgmock-dev libbenchmark-dev
    python3-meshio                                 # reads .vtu in tests/readers
    ccache)                                        # presets for development

say() { printf 'packages: %s\n' "$*"; }
fail() { printf 'packages: error: %s\n' "$*" >&2; exit 1; }

list=0
if [[ ${1-} == --list ]]; then
    list=1
    shift
fi
set=${1-tests}
case $set in
    build) packages=("${build[@]}") ;;
    run) packages=("${build[@]}" "${run[@]}") ;;
    crosscheck) packages=("${build[@]}" "${run[@]}" "${crosscheck[@]}") ;;
    tests) packages=("${build[@]}" "${run[@]}" "${crosscheck[@]}" "${tests[@]}") ;;
    *) packages=() ;;
esac
if [[ $# -gt 1 || ${#packages[@]} -eq 0 ]]; then
    echo "usage: ${0##*/} [--list] [build|run|crosscheck|tests]" >&2
    exit 2
fi
if ((list)); then
    printf '%s\n' "${packages[@]}"
    exit 0
fi

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    fail "this system has no apt. gneiss is developed on Debian 12 and 13; elsewhere install what these packages
provide, then configure with CMake yourself (CONTRIBUTING.md): ${packages[*]}"
fi

# Prints the packages of the list that are not installed. dpkg-query fails as soon as it knows nothing of one name,
# which is no error here: what it does print is complete.
missing_packages() {
    local present
    present=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null \
        | sed -n 's/^installed //p' || true)
    comm -23 <(printf '%s\n' "${packages[@]}" | sort -u) <(sort -u <<<"$present")
}

mapfile -t missing < <(missing_packages)
if [[ ${#missing[@]} -eq 0 ]]; then
    say "all ${#packages[@]} are installed"
    exit 0
fi
say "${#missing[@]} of ${#packages[@]} are missing: ${missing[*]}"

as_root=()
if [[ $EUID -ne 0 ]]; then
    as_root=(sudo)
    # Nobody can type a password into a job without a terminal: fail instead of waiting.
    [[ -t 0 ]] || as_root+=(-n)
    if ! command -v sudo >/dev/null || ! "${as_root[@]}" true; then
        fail "neither root nor sudo. As root, run: apt-get update && apt-get install --no-install-recommends ${missing[*]}"
    fi
fi

log=$(mktemp "${TMPDIR:-/tmp}/gneiss-packages-XXXXXX.log")

# Of apt's status lines, "pmstatus:PACKAGE:PERCENT:WHAT" and "dlstatus:...", one in every tenth of the way is shown; those
# of the package lists, which count nothing useful, are not. By the shell, which reads lines as they come: mawk waits for a
# block of them.
show_progress() {
    local quiet=$1 line status percent what tenth
    local -A shown=()
    while IFS= read -r line || [[ -n $line ]]; do
        ((!quiet)) && [[ $line =~ ^(dl|pm)status: ]] || continue
        IFS=: read -r status _ percent _ <<<"$line"
        what=installed
        [[ $status != dlstatus ]] || what=downloaded
        tenth=$((${percent%%.*} / 10))
        if ((tenth > ${shown[$what]:--1})); then
            shown[$what]=$tenth
            printf 'packages:   %s %3d %%\n' "$what" $((tenth * 10))
        fi
    done
}

# All that apt, dpkg and the packages say goes into the log, a file: a pipe that is not emptied fast enough fails their
# scripts on a busy machine ("echo: I/O error"). Status lines have a pipe of their own, opened behind sudo, which hands
# on three descriptors.
apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive sh -c 'exec "$@" 3>&1 1>&2' sh \
        apt-get -q -y -o Acquire::Retries=3 -o DPkg::Lock::Timeout=600 -o APT::Status-Fd=3 "$@" </dev/null 2>>"$log" \
        | show_progress "$([[ $1 == update ]] && echo 1 || echo 0)"
}

apt_failed() {
    tail -n 15 "$log" >&2
    fail "$1; the whole log is in $log"
}

say "fetching the package lists (apt-get update)"
# Not the end: one of many archives of a machine may be out of order, or yesterday's lists may do.
apt update || say "apt-get update failed; going on with the lists at hand"

unknown=()
for package in "${missing[@]}"; do
    apt-cache show --no-all-versions "$package" >/dev/null 2>&1 || unknown+=("$package")
done
[[ ${#unknown[@]} -eq 0 ]] || apt_failed "apt's lists do not have ${unknown[*]}. Is the archive within reach? gneiss is
developed on Debian 12 and 13"

# What apt would do, told without doing it: a package of the user's that would have to go is theirs to give up.
plan=$(LC_ALL=C apt-get -s -o APT::Get::Show-User-Simulation-Note=0 --no-install-recommends install "${missing[@]}" 2>&1) \
    || { printf '%s\n' "$plan" >>"$log"; apt_failed "apt-get cannot install them"; }
removed=$(sed -n 's/^Remv \([^ ]*\).*/\1/p' <<<"$plan" | tr '\n' ' ')
[[ -z $removed ]] || fail "installing ${missing[*]}
would remove ${removed% }: nothing was done. If that is what you want, run
apt-get install --no-install-recommends ${missing[*]}"

new=$(grep -c '^Inst ' <<<"$plan" || true)
say "installing $new packages (apt-get install --no-install-recommends)"
apt install --no-install-recommends "${missing[@]}" || apt_failed "apt-get install failed"

mapfile -t missing < <(missing_packages)
[[ ${#missing[@]} -eq 0 ]] || apt_failed "still missing: ${missing[*]}"
rm -f "$log"
say "done in $((SECONDS / 60)) min $((SECONDS % 60)) s"
