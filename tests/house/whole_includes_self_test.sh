#!/usr/bin/env bash
# whole_includes_self_test.sh PYTHON: proves that includes_are_whole.py finds what is not included, and no more.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
python=$1
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{common,docs,tests,chapters/ch01_a/exercises}
failures=0

printf '%s\n' '#include <vector>' '#include <fmt/format.h>' 'std::vector<int> numbers;' >"$tree/common/a.hpp"
printf '%s\n' '#include "common/a.hpp"' >"$tree/common/b.hpp"
# finds HEADER LINE...: in a file that includes b.hpp, after its first line
finds() {
    printf '%s\n' '#include "common/b.hpp"' "${@:2}" >"$tree/tests/a.cpp"
    if "$python" "$here/includes_are_whole.py" "$tree" >"$tree/said.txt"; then
        echo "not found: ${*:2}" && failures=1
    elif ! grep -q "^tests/a.cpp:2: .* without <$1>$" "$tree/said.txt" || (($(wc -l <"$tree/said.txt") != 1)); then
        echo "found, but not <$1> alone: ${*:2}" && cat "$tree/said.txt" && failures=1
    fi
    rm "$tree/tests/a.cpp"
}
# passes FILE LINE...
passes() {
    printf '%s\n' '#include "common/b.hpp"' "${@:2}" >"$tree/$1"
    "$python" "$here/includes_are_whole.py" "$tree" || { echo "refused: ${*:2}" && failures=1; }
    rm "$tree/$1"
}

finds cstdint 'std::uint32_t number;'
finds algorithm 'const int two = std::max(1, 2);'
finds algorithm 'std::ranges::sort(numbers);'
finds utility 'std::pair<int, int> two;'
finds string 'const auto text = std::to_string(3);'
finds fmt/ranges.h 'const auto text = fmt::format("{}", fmt::join(numbers, ", "));'
finds cmath 'const double two = std::sqrt(4.0);  // std::optional<int>'
passes docs/a.cpp 'std::vector<int> more;'
passes docs/a.cpp '#include <optional>' 'std::optional<int> one;'
passes docs/a.cpp '// std::optional<int> one;' 'const char* text = "std::optional<int>";'
passes docs/a.cpp 'const auto text = fmt::format("std::span");'
passes chapters/ch01_a/exercises/ex01_a.hpp 'std::optional<int> one;'

# The book's own headers, which a file of a batch includes for itself.
mkdir -p "$tree/chapters/ch01_a/measured"
printf '%s\n' 'struct Box;' 'struct Tree {' 'int depth;' '};' 'int size_of(const Tree& tree);' >"$tree/common/tree.hpp"
batched=chapters/ch01_a/measured/a.cpp
refuses() { # NAME LINE...: in a file of a batch, for that name alone
    printf '%s\n' '#include "common/b.hpp"' "${@:2}" >"$tree/$batched"
    "$python" "$here/includes_are_whole.py" "$tree" >"$tree/said.txt" && echo "not found: ${*:2}" && failures=1
    [[ $(<"$tree/said.txt") == "$batched:2: $1 without \"common/tree.hpp\"" ]] || { cat "$tree/said.txt" && failures=1; }
    rm "$tree/$batched"
}
refuses Tree 'const Tree tree;'
refuses size_of 'const int size = size_of(numbers);'
passes "$batched" '#include "common/tree.hpp"' 'const int size = size_of(Tree{});'
passes "$batched" 'struct Tree {};' 'int size_of(const Tree& tree) { return 0; }' 'const int size = size_of(Tree{});'
passes "$batched" 'const int size = scene.size_of(1) + Kind::Tree + Box;  // Tree'
passes docs/a.cpp 'const Tree tree;'
exit $failures
