#!/usr/bin/env bash
# Proves that includes_run_downwards.sh finds each fault that it is there for, and none where there is none.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{common/mesh_reader,docs,tests} "$tree"/chapters/{ch01_a/{checks,measured,figures,peers},ch02_b,ch03_c}
printf '%s\n' 'ch01_a ' 'ch02_b ch01_a' 'ch03_c ch02_b' >"$tree/chapters.txt"

put() { printf '%s\n' "${@:2}" >"$tree/$1"; }
check() { bash "$here/includes_run_downwards.sh" "$tree" "$tree/chapters.txt"; }

put common/mesh_reader/mesh_reader.cpp '#include <CGAL/IO/OBJ.h>' '#include "common/mesh.hpp"'
put tests/oracle.cpp '#include <CGAL/Kernel.h>' '#include "chapters/ch03_c/c.hpp"' '#include "oracle.hpp"'
put chapters/ch01_a/checks/ex01_a.cpp '#include "ex01_a.hpp"' '#include "tests/catch.hpp"'
put chapters/ch03_c/c.hpp '#include "chapters/ch03_c/other.hpp"' '#include "chapters/ch01_a/a.hpp"' '#include <vector>'
put chapters/ch01_a/figures/f.cpp '#include "chapters/ch01_a/measured/m.hpp"' '#include "chapters/ch01_a/a.hpp"'
put chapters/ch01_a/main.cpp '#include "chapters/ch01_a/figures/f.hpp"' '#include "chapters/ch01_a/measured/m.hpp"'
put chapters/ch01_a/peers/p.cpp '#include <CGAL/AABB_tree.h>' '#include "chapters/ch01_a/a.hpp"'
check || { echo "a tree without faults is refused" && exit 1; }

failures=0
# finds FAULT FILE LINE: with LINE in FILE, and without it no more
finds() {
    put "$2" '' "$3"
    if check >"$tree/said.txt"; then
        echo "not found: $3 in $2" && failures=1
    elif ! grep -qF "$2:2: $1" "$tree/said.txt"; then
        echo "found, but not named '$1': $3 in $2" && cat "$tree/said.txt" && failures=1
    fi
    rm "$tree/$2"
}
finds 'ch01_a does not build on ch02_b' chapters/ch01_a/up.hpp '#include "chapters/ch02_b/b.hpp"'
finds 'ch02_b does not build on ch03_c' chapters/ch02_b/up.hpp '  #  include "chapters/ch03_c/c.hpp"'
finds 'the subject includes measured/' chapters/ch01_a/low.hpp '#include "chapters/ch01_a/measured/m.hpp"'
finds 'the subject includes figures/' chapters/ch01_a/low.hpp '#include "chapters/ch01_a/figures/f.hpp"'
finds 'measured includes figures/' chapters/ch01_a/measured/m.hpp '#include "chapters/ch01_a/figures/f.hpp"'
finds 'measured/data.hpp includes the subject' chapters/ch01_a/measured/data.hpp '#include "chapters/ch01_a/a.hpp"'
finds 'the subject includes peers/' chapters/ch01_a/low.hpp '#include "chapters/ch01_a/peers/p.hpp"'
finds 'closed to other chapters' chapters/ch02_b/closed.cpp '#include "chapters/ch01_a/measured/m.hpp"'
finds 'common/ includes a chapter' common/up.hpp '#include "chapters/ch01_a/a.hpp"'
finds 'CGAL is for' common/other.cpp '#include <CGAL/Kernel.h>'
finds 'CGAL is for' chapters/ch01_a/main.cpp '#include <CGAL/Kernel.h>'
finds 'included by a relative path' chapters/ch02_b/relative.hpp '#include "../ch03_c/c.hpp"'
finds 'not a path from the root' chapters/ch02_b/local.hpp '#include "b.hpp"'
finds 'not a path from the root' chapters/ch02_b/main.cpp '#include "tests/catch.hpp"'
printf '%s\n' 'ch01_a ch02_b' 'ch02_b ' 'ch03_c ' >"$tree/chapters.txt"
if check >"$tree/said.txt" || ! grep -q 'ch01_a: builds on ch02_b, which is not an earlier' "$tree/said.txt"; then
    echo "not found: a chapter that builds on a later one" && failures=1
fi
exit $failures
