#!/usr/bin/env bash
# pipes_are_read.sh ROOT: proves that no script of the book hangs on a reader that ends early. With pipefail, a writer that
# still has lines then dies of SIGPIPE and takes the command with it (exit code 141) on long input or a busy machine only:
# `sort | head` did so once there were some hundred compiles to sort, and `! ... | grep -q` says yes where it should say no.
set -euo pipefail
root=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT

# ends_early FILE...: the lines where a pipe's reader may end before its writer
ends_early() {
    awk '
        FNR == 1 { rest = "" }
        { line = rest $0; rest = "" }
        line !~ /^ *#/ && line ~ /\|[ \t]*$/ { rest = line; next }
        line !~ /^ *#/ && line ~ /[^|]\|[ \t]*(head|grep (-[A-Za-z]+ )*-[A-Za-z]*[qm]|sed [^|]*[0-9]q|awk [^|]*exit)/ {
            printf "%s:%d: %s\n", FILENAME, FNR, line
        }' "$@"
}

printf '%s\n' 'a | head -n 1' 'b | grep -F -q x' 'c |' '    head' "d | sed 3q" 'e | sed -n 1,3p' 'f | grep -c x || true' \
    '# g | head' 'grep -q x <<<h' 'i || grep -q x file' >"$tree/sample.sh"
[[ $(ends_early "$tree/sample.sh" | wc -l) == 4 ]] || { ends_early "$tree/sample.sh" && exit 1; }

cd "$root"
mapfile -t scripts < <(find tests common/scripts .ci -name '*.sh')
found=$(ends_early book .ci/run "${scripts[@]}" | grep -v "^tests/house/pipes_are_read.sh" || true)
[[ -z $found ]] || { printf '%s\n' "$found" 'these readers end before their writers: read all (sed -n 1,10p, grep -c)' && exit 1; }

# What is said after the tests, over a log far longer than a pipe holds.
root=$tree
mkdir -p "$tree/build/some"
awk 'BEGIN { for (i = 1; i <= 20000; i++) printf "0\t%d\t%d\tCMakeFiles/a.dir/file_%d.cpp.o\n", i, i, i }' \
    >"$tree/build/some/.ninja_log"
awk 'BEGIN { for (i = 1; i <= 20000; i++) printf " %d/20000 Test #%d: some.test_%d ....   Passed  %d.00 sec\n", i, i, i, i }' \
    >"$tree/tests.txt"
# shellcheck source=common/scripts/slowest.sh
source "$1/common/scripts/slowest.sh"
said=$(say_slowest some 0 "$tree/tests.txt")
[[ $said == *'20.0 s  file_20000.cpp.o'* && $said == *'20000.0 s  some.test_20000'* ]] || { echo "$said" && exit 1; }
[[ $(grep -c ' s  ' <<<"$said") == 20 ]] || { echo "$said" && exit 1; }
