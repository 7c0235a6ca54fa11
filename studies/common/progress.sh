#!/usr/bin/env bash
# Of snakemake's talk, line by line as it comes: what begins, how far it is, and everything from the first error on.
#
# usage: snakemake … 2>&1 | studies/common/progress.sh
#
# The shell reads lines as they are written. mawk, Debian's awk, waits for a block of 4 kB: minutes.
set -euo pipefail

failed=''
while IFS= read -r line || [[ -n $line ]]; do
    [[ $line =~ [Ee]rror|Exception|Traceback ]] && failed=yes
    [[ -n $failed || $line =~ ^Job\ [0-9]+:\  || $line =~ steps\ \(.*done$ ]] && printf '      %s\n' "$line"
done
exit 0
