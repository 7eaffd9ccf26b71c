#!/usr/bin/env bash
# same_answers.sh PROGRAM OTHER ...: proves that all print the same, and something.
set -euo pipefail
program=$1
one=$("$program")
[[ $one == *hits* ]] || { echo "$program prints nothing" && exit 1; }
for other in "${@:2}"; do
    said=$("$other")
    diff <(echo "$one") <(echo "$said") || { echo "differs: $program (<) and $other (>)" && exit 1; }
done
