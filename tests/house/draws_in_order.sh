#!/usr/bin/env bash
# draws_in_order.sh PYTHON ROOT: no expression of the tree draws two random numbers in an order that the compiler chooses.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$2"
find common chapters docs tests -name '*.[hc]pp' -print0 | sort -z |
    xargs -0 "$1" "$here/draws_in_order.py"
