#!/usr/bin/env bash
# same_answers.sh PROGRAM OTHER: proves that both print the same, and something.
set -euo pipefail
one=$("$1")
other=$("$2")
[[ $one == *hits* ]] || { echo "$1 prints nothing" && exit 1; }
diff <(echo "$one") <(echo "$other") || { echo "differs: $1 (<) and $2 (>)" && exit 1; }
