#!/usr/bin/env bash
# Proves that names_are_declared_once.sh finds each kind of name that two chapters declare, and no other.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/chapters/{ch01_a/measured,ch02_b}

put() { printf '%s\n' 'namespace space {' '' "${@:2}" '' '}  // namespace space' >"$tree/$1"; }
check() { bash "$here/names_are_declared_once.sh" "$tree"; }

put chapters/ch01_a/a.hpp 'struct Tree {' '    enum class Side { front, back };' '    int depth() const;' '};' \
    'enum class Cell { inside, outside };' 'template <int D>' 'struct Node {' '};' 'using Names = int;' \
    'inline constexpr double margin = 2.0;' 'template <int D>' 'Node<D> first(const Tree& tree) {' '    return {};' '}' \
    'inline int last(int a,' '                int b) {' '    return a + b;' '}' 'template <class T>' \
    'concept Test = true;' 'class Far;' 'int overloaded(int);' 'int overloaded(float);'
put chapters/ch02_b/b.hpp 'struct Other {' '    enum class Side { left, right };' '    int depth() const;' '};' \
    '// struct Tree' 'Tree make(const Node<2>& node, double margin = 1.0);' 'template <>' 'struct Node<7> {' '};'
# Apparatus has a namespace of its own.
printf '%s\n' 'namespace space::ch01 {' 'struct Results {' '};' '}  // namespace space::ch01' >"$tree/chapters/ch01_a/c.hpp"
printf '%s\n' 'namespace space::ch02 {' 'struct Results {' '};' '}  // namespace space::ch02' >"$tree/chapters/ch02_b/c.hpp"
check || { echo "a tree without faults is refused" && exit 1; }

failures=0
# finds NAME LINE...: with the LINEs in another chapter
finds() {
    put chapters/ch02_b/again.hpp "${@:2}"
    if check >"$tree/said.txt"; then
        echo "not found: ${*:2}" && failures=1
    elif ! grep -q "^$1: .*ch01_a/a.hpp:.*ch02_b/again.hpp:" "$tree/said.txt"; then
        echo "found, but not named $1: ${*:2}" && cat "$tree/said.txt" && failures=1
    fi
    rm "$tree/chapters/ch02_b/again.hpp"
}
finds Tree 'struct Tree {' '};'
finds Tree 'class Tree;'
finds Cell 'enum class Cell : char { a, b };'
finds Node 'template <class T>' 'class Node {' '};'
finds Node 'template <class T> struct Node {' '};'
finds Names 'template <class T>' 'using Names = T;'
finds margin 'constexpr float margin{1};'
finds first 'const Tree* first(int);'
finds last 'inline std::vector<int> last() {' '    return {};' '}'
finds Test 'template <class T>' 'concept Test = false;'
finds Far 'struct Far : Tree {' '};'
finds overloaded 'int overloaded(double);'
exit $failures
