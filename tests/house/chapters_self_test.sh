#!/usr/bin/env bash
# Proves that chapters_are_whole.sh finds what is missing, and nothing where nothing is.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0

make_tree() {
    rm -rf "${tree:?}"/*
    mkdir -p "$tree"/{chapters/ch04_a/measured,chapters/ch12_comparison/structures,figures/measured,tests/ch04,docs}
    printf '%s\n' 'add_chapter()' 'add_figure(fig_04_01 drawing' '    "a")' 'add_figure(fig_04_02 chart "b")' \
        >"$tree/chapters/ch04_a/CMakeLists.txt"
    echo '<svg/>' | tee "$tree/figures/fig_04_01.svg" >"$tree/figures/measured/fig_04_02.svg"
    for file in main.cpp README.md chapter.dox measured/expected_small.txt; do echo a >"$tree/chapters/ch04_a/$file"; done
    echo 'add_book_test(ch04.a SOURCES a_test.cpp)' >"$tree/tests/ch04/CMakeLists.txt"
    echo '{"folder": "ch04_a"}' >"$tree/docs/chapters.json"
    echo '[a](chapters/ch04_a)' >"$tree/README.md"
    echo '{}' >"$tree/figures/measured/ch04_numbers.json"
    echo 'add_chapter()' >"$tree/chapters/ch12_comparison/CMakeLists.txt"
    echo a >"$tree/chapters/ch12_comparison/structures/ch04.cpp"
    printf '%s\n' 'std::vector<Structure> ch04_structures();' '    {"chapter 4", ch04_structures()},' \
        >"$tree/chapters/ch12_comparison/structures.cpp"
}
check() { bash "$here/chapters_are_whole.sh" "$tree" >"$tree/said.txt"; }
# finds FAULT COMMAND: after the command, run in the tree, the fault is told
finds() {
    make_tree
    (cd "$tree" && eval "$2")
    if check; then echo "not found: $2" && failures=1
    elif ! grep -qF "$1" "$tree/said.txt"; then echo "not told as '$1': $2" && failures=1
    fi
}
make_tree
check || { echo "a whole chapter is refused" && cat "$tree/said.txt" && failures=1; }
rm "$tree/chapters/ch04_a/main.cpp" "$tree/README.md"
check || { echo "a chapter without a program is refused" && failures=1; }
finds 'not named' 'mkdir chapters/kd'
finds 'without add_chapter' 'rm chapters/ch04_a/CMakeLists.txt'
finds 'chapter.dox: missing' 'rm chapters/ch04_a/chapter.dox'
finds 'expected_small.txt: missing' 'rm chapters/ch04_a/measured/expected_small.txt'
finds 'ch04_numbers.json: missing: ./book run 4 --update' 'rm figures/measured/ch04_numbers.json'
finds 'figures/fig_04_01.svg: missing' 'rm figures/fig_04_01.svg'
finds 'figures/measured/fig_04_02.svg: missing' 'rm figures/measured/fig_04_02.svg'
finds 'no test of' 'echo "add_book_test(ch03.a)" >tests/ch04/CMakeLists.txt'
finds 'no test of' 'sed -i "s/^/# /" tests/ch04/CMakeLists.txt'
finds "not among the lab's structures" 'sed -i /{/d chapters/ch12_comparison/structures.cpp'
finds "not among the lab's structures" 'sed -i "s,{,// {," chapters/ch12_comparison/structures.cpp'
finds 'chapters.json: no' 'echo >docs/chapters.json'
finds 'README.md: no link' 'echo >README.md'
exit $failures
