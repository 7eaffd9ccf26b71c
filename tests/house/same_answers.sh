#!/usr/bin/env bash
# same_answers.sh PROGRAM OTHER: proves that both print the same, and something.
set -euo pipefail
"$1" | { read -r line && echo "$line"; } | grep -q 'hits' || { echo "$1 prints nothing" && exit 1; }
diff <("$1") <("$2") || { echo "differs: $1 (<) and $2 (>)" && exit 1; }
