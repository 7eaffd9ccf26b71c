#!/usr/bin/env bash
# Proves that exercises_are_whole.sh finds what is missing, and that exercise_verdict.cmake tells a failed check from
# a crash, a hang, an exception and a program that ends by itself.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0
wrong() { printf '%s\n' "$1" && failures=1; }

chapter=$tree/chapters/ch01_a
make_tree() {
    rm -rf "$tree/chapters"
    mkdir -p "$chapter"/{exercises,solutions,near_misses,checks}
    printf '%s\n' '/// Exercise 1.2: Title' '/// Difficulty 2 of 3, about 20 minutes.' '// TODO: this' >"$chapter/exercises/ex02_b.hpp"
    printf '%s\n' one '' two 'two goes on' '' three >"$chapter/exercises/ex02_b.hints"
    echo right >"$chapter/solutions/ex02_b.hpp"
    echo nearly >"$chapter/near_misses/ex02_b.hpp"
    echo check >"$chapter/checks/ex02_b.cpp"
    echo ch01_a/ex02_b >"$tree/exercises.txt"
}
whole() { bash "$here/exercises_are_whole.sh" "$tree" "$tree/exercises.txt" >"$tree/said.txt"; }
# finds FAULT COMMAND...: after the command, run in the chapter's folder, the fault is told
finds() {
    make_tree
    (cd "$chapter" && eval "$2")
    if whole; then wrong "not found: $2"; elif ! grep -qF "$1" "$tree/said.txt"; then wrong "not told as '$1': $2"; fi
}
make_tree
whole || wrong "a whole exercise is refused: $(<"$tree/said.txt")"
for part in exercises/ex02_b.hpp exercises/ex02_b.hints solutions/ex02_b.hpp near_misses/ex02_b.hpp checks/ex02_b.cpp; do
    finds "$part: missing" "rm $part"
done
finds 'no TODO' 'sed -i /TODO/d exercises/ex02_b.hpp'
finds 'no line' 'sed -i s/1.2/1.3/ exercises/ex02_b.hpp'
finds 'no line' 'sed -i s/2.of.3/4.of.3/ exercises/ex02_b.hpp'
finds '2 hints' 'sed -i 5,6d exercises/ex02_b.hints'
finds 'begins with a space' 'sed -i "s/^two goes/ &/" exercises/ex02_b.hints'
finds 'near miss is the solution' 'cp solutions/ex02_b.hpp near_misses'
finds 'no add_exercise' "echo >$tree/exercises.txt"

# verdict WANTED VARIANT SCRIPT: how the verdict on a program that does SCRIPT as VARIANT ends
verdict() {
    printf '#!/bin/sh\n%s\n' "$3" >"$tree/program"
    chmod +x "$tree/program"
    local result=0
    cmake -D PROGRAM="$tree/program" -D VARIANT="$2" -D FILE="$tree/stub.hpp" -D SECONDS=1 \
        -P "$here/exercise_verdict.cmake" >"$tree/said.txt" 2>&1 || result=1
    [[ $result == "$1" ]] || wrong "the verdict on a $2 that does '$3' is wrong: $(<"$tree/said.txt")"
}
failed_check='echo "test cases: 2 | 1 passed | 1 failed"; exit 1'
passed='echo "All tests passed (3 assertions in 2 test cases)"'
verdict 0 solution "$passed"
verdict 1 solution 'exit 0'
verdict 1 solution "$failed_check"
for variant in exercise near_miss; do
    verdict 0 $variant "$failed_check"
    verdict 1 $variant "$passed"
    verdict 1 $variant 'exit 0'
    verdict 1 $variant 'kill -SEGV $$'
    verdict 1 $variant 'sleep 5'
    verdict 1 $variant 'exit 1'
    verdict 1 $variant "echo 'due to unexpected exception with message: x'; $failed_check"
    verdict 1 $variant "echo '==1==ERROR: AddressSanitizer: heap-use-after-free'; $failed_check"
done
exit $failures
