#!/usr/bin/env bash
# every_test_is_built.sh ROOT: proves that no source of a test lies about unused: each is named in its folder's
# CMakeLists.txt, not only in a comment.
set -euo pipefail
cd "$1/tests"
faults=0
for source in */*.cpp; do
    sed 's/#.*//' "$(dirname "$source")/CMakeLists.txt" 2>/dev/null | grep -wF "$(basename "$source")" >/dev/null ||
        { echo "tests/$source: not in a CMakeLists.txt beside it" && faults=1; }
done
exit $faults
