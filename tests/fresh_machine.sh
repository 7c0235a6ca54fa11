#!/usr/bin/env bash
# The commands of README.md on a bare Debian: makes one in a folder, clones this tree into it, runs them there, and says
# how long each took and how many packages it brought. Takes half an hour or more, as root; no part of CI.
#
# usage: tests/fresh_machine.sh bookworm|trixie [--keep] [--folder DIR] [COMMAND...]
#   --keep         leave the system where it is made, and say how to enter it
#   --folder DIR   make it in DIR/gneiss-SUITE (default: $TMPDIR or /tmp); about 8 GB
#   COMMAND...     what to run in the tree instead of README's two, one argument each: 'tests/run.sh --filter Deck*'
#
# The mirror, its keys and a proxy are those of this machine's own apt. The system shares nothing with this machine but
# its processors and its network (/etc/hosts, /etc/resolv.conf): ccache there is empty. What is not committed is not
# cloned. Mounts live in a namespace of their own and end with this script, however it ends.
#
# Exit status: 0 if every command succeeded, 2 for wrong use, 1 otherwise.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."

usage() { sed -n '2,/^set/{s/^# \{0,1\}//;/^set/!p}' "$0"; }
wrong_use() { printf 'tests/fresh_machine.sh: %s\n\n' "$1" >&2; usage >&2; exit 2; }
fail() { printf 'tests/fresh_machine.sh: %s\n' "$1" >&2; exit 1; }
say() { printf '[%s, %3d min %02d s] %s\n' "$suite" $((SECONDS / 60)) $((SECONDS % 60)) "$*"; }

arguments=("$@") suite='' folder=${TMPDIR:-/tmp} keep=0 commands=()
while [[ $# -gt 0 ]]; do
    case $1 in
        bookworm | trixie) [[ -z $suite ]] || wrong_use "one suite at a time"; suite=$1; shift ;;
        --keep) keep=1; shift ;;
        --folder) [[ -d ${2-} ]] || wrong_use "--folder needs a folder that is there"; folder=$2; shift 2 ;;
        --help | -h) usage; exit 0 ;;
        -*) wrong_use "unknown option $1" ;;
        *) [[ -n $suite ]] || wrong_use "given $1, the suite must be bookworm or trixie"; commands+=("$1"); shift ;;
    esac
done
[[ -n $suite ]] || wrong_use "which suite?"
[[ $EUID -eq 0 ]] || fail "has to be run as root: it makes a system in a folder and enters it"
command -v mmdebstrap >/dev/null || fail "mmdebstrap is not installed (Debian package mmdebstrap)"
if [[ ${GNEISS_FRESH_NAMESPACE-} != "$PPID" ]]; then
    GNEISS_FRESH_NAMESPACE=$$ unshare --mount --propagation private "$0" "${arguments[@]}" && exit 0 || exit $?
fi

if [[ ${#commands[@]} -eq 0 ]]; then
    for script in studies/run.sh tests/run.sh; do
        line=$(sed -n "s,^    \(${script}[^#]*\).*,\1,p" README.md | head -n 1)
        [[ -n $line ]] || fail "README.md shows no command $script"
        commands+=("${line%"${line##*[! ]}"}")
    done
fi
mirror=$(apt-get indextargets --format '$(ORIGIN)|$(LABEL)|$(COMPONENT)|$(REPO_URI)' 2>/dev/null \
    | sed -n 's/^Debian|Debian|main|//p' | head -n 1)
[[ -n $mirror ]] || fail "this machine's apt knows no archive of Debian; run apt-get update"
mapfile -t proxies < <(apt-config dump | grep -i '^Acquire::.*proxy' || true)

root=$(realpath "$folder")/gneiss-$suite
[[ ! -e $root ]] || fail "$root is there already; delete it first"

clean_up() {
    local status=$?
    trap - EXIT
    local mounted
    for mounted in "$root/dev/pts" "$root/proc"; do
        if mountpoint -q "$mounted" && ! umount -R "$mounted"; then
            say "$mounted cannot be unmounted: $root is left as it is"
            exit 1
        fi
    done
    if ((keep)); then
        say "left in $root: mount -t proc proc $root/proc && chroot $root; unmount before you delete it"
    else
        rm -rf --one-file-system "$root"
        say "$root is deleted"
    fi
    exit "$status"
}
trap clean_up EXIT
trap 'exit 130' INT
trap 'exit 143' TERM HUP

inside() { chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 TERM=dumb "$@"; }
packages() { inside dpkg-query -W -f '${binary:Package}=${Version}\n' | sort; }
# Bytes of the archives of packages that a command has brought, from the lists that it fetched.
fetched() {
    inside apt-cache show --no-all-versions "$@" 2>/dev/null | awk '/^Size:/ { bytes += $2 } END { printf "%.0f", bytes / 1e6 }'
}

say "making a bare Debian $suite in $root: some minutes (mmdebstrap counts below)"
mmdebstrap --variant=minbase --mode=root "${proxies[@]/#/--aptopt=}" "$suite" "$root" "$mirror" 2>&1 \
    | grep --line-buffered '^[IE]:' | sed -u 's/^/      /' || fail "mmdebstrap failed"
cp --dereference /etc/hosts /etc/resolv.conf "$root/etc/"
mount -t proc proc "$root/proc"
mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"  # tests of progress open a terminal
git clone --quiet --no-hardlinks "file://$PWD" "$root/root/gneiss" || fail "the tree cannot be cloned"
say "bare: $(packages | wc -l) packages, $(nproc) processors; tree at $(git rev-parse --short HEAD)"

table=() failed=0
for command in "${commands[@]}"; do
    mapfile -t before < <(packages)
    began=$SECONDS
    say "running $command"
    status=0
    inside bash -c "cd /root/gneiss && $command" </dev/null 2>&1 | sed -u 's/^/      /' || status=$?
    took=$((SECONDS - began))
    mapfile -t brought < <(comm -13 <(printf '%s\n' "${before[@]}") <(packages))
    megabytes=0
    [[ ${#brought[@]} -eq 0 ]] || megabytes=$(fetched "${brought[@]%%=*}")
    outcome=succeeded
    [[ $status -eq 0 ]] || outcome="FAILED ($status)" failed=1
    table+=("$(printf '%-40s %-12s %3d min %02d s  %4d packages  %4d MB' \
        "$command" "$outcome" $((took / 60)) $((took % 60)) ${#brought[@]} "$megabytes")")
done

say "done; $(packages | wc -l) packages in the end"
printf '      %s\n' "${table[@]}"
exit $failed
