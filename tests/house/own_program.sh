#!/usr/bin/env bash
# own_program.sh ROOT COMPILER: proves that
# - docs/own_program, copied out of the book, builds and prints what it should, that the floating-point options come with
#   it, and nothing but the structures: no test, no program, no warning; and that both ways that its CMakeLists.txt knows
#   are the same commands to compiler and linker;
# - for each header of the page's table needed_files.sh copies all that is included, and names the libraries that the table
#   names; the table has every chapter's structures, and the target every .cpp file that they need;
# - such a copy, of a structure with .cpp files, compiles and runs.
set -euo pipefail
root=$1 compiler=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fault() { echo "own_program.sh: $1" && exit 1; }

cp -r "$root/docs/own_program" "$folder/one"
cp -r "$root/docs/own_program" "$folder/other"
# commands WAY: all that building runs, whatever the folders are called
commands() {
    ninja -C "$folder/$1/build" -t commands | sed "s|$folder/$1/|/|g; s|_deps/splitting_space-build|splitting_space|g"
}
for way in one other; do
    fetch=OFF
    [[ $way == one ]] || fetch=ON
    # Without optimisation it takes half a minute less.
    launcher=$(command -v ccache || true)
    cmake -G Ninja -S "$folder/$way" -B "$folder/$way/build" -D SPLITTING_SPACE="$root" -D BY_FETCH_CONTENT=$fetch \
        -D CMAKE_CXX_COMPILER="$compiler" ${launcher:+-D CMAKE_CXX_COMPILER_LAUNCHER="$launcher"} \
        -D CMAKE_EXPORT_COMPILE_COMMANDS=ON -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_FLAGS_DEBUG='-Wall -Wextra -Werror' >"$folder/log" 2>&1 ||
        { cat "$folder/log" && fault "configuring failed"; }
    ! grep -i warning "$folder/log" || fault "configuring warns"
    [[ $(ctest --test-dir "$folder/$way/build" -N) == *'Total Tests: 0'* ]] || fault 'the book'\''s tests come with it'
done
[[ $(commands one) == *own_program.cpp* ]] || fault 'ninja tells no commands'
diff <(commands one) <(commands other) || fault 'the two ways compile or link otherwise'
build=$folder/one/build
cmake --build "$build" >"$folder/log" 2>&1 || { cat "$folder/log" && fault "building failed"; }
! grep 'warning:' "$folder/log" || fault "compiling warns"
grep -- 'own_program.cpp' "$build/compile_commands.json" | grep -- '-fno-fast-math -ffp-contract=off' >/dev/null ||
    fault 'options that answers depend on do not travel with the target'
"$build/own_program" >"$folder/printed"
diff "$folder/printed" "$root/tests/house/own_program.txt" || fault "it printed (<) what it should not (>)"
programs=$(find "$build" -type f -executable -not -path '*/CMakeFiles/*' -printf '%f ')
[[ $programs == 'own_program ' ]] || fault "more than one program: $programs"

needed() { bash "$root/common/scripts/needed_files.sh" "$@"; }
page=$root/chapters/ch12_comparison/own_program.dox
rows=0
while IFS='|' read -r _ _ header libraries _; do
    header=${header//[\` ]/}
    rm -rf "$folder/copy"
    list=$(needed "$header" "$folder/copy")
    while read -r included; do
        [[ -f $folder/copy/$included ]] || fault "$header: $included is needed, too"
    done < <(grep -rhoP '^#include "\K[^"]+' "$folder/copy" | sort -u)
    told=$(sed 's/^ *//; s/ *$//; s/, / /g; s/^GLM alone$/GLM/' <<<"$libraries")
    [[ $list == *"libraries: $told" ]] || fault "$header: the page says $told: ${list##*$'\n'}"
    for source in $(grep '\.cpp$' <<<"$list" || true); do
        [[ $source == */kernels/* ]] || grep -qF "${source#chapters/}" "$root/common/cmake/Structures.cmake" ||
            fault "$source is missing in Structures.cmake"
    done
    rows=$((rows + 1))
done < <(grep '^| .*| `chapters/' "$page")
((rows > 0)) || fault 'the page has no table'
while read -r header; do
    grep -qF "\`$header\`" "$page" || fault "$header is missing on the page"
done < <(sed -n 's/^#include "\(chapters\/ch\(0[13-9]\|10\).*\)"$/\1/p' "$root"/chapters/ch12_comparison/structures/ch*.cpp)

rm -rf "$folder/copy"
needed chapters/ch03_bsp_trees/bsp.hpp "$folder/copy" >/dev/null
cat >"$folder/copy/main.cpp" <<'END'
#include "chapters/ch03_bsp_trees/bsp.hpp"
int main() {
    const std::vector<space::Triangle> triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    return any_hit(space::Bsp<>::build(triangles), {.origin = {0.1f, 0.1f, 1}, .direction = {0, 0, -1}}) ? 0 : 1;
}
END
mapfile -t sources < <(find "$folder/copy" -name '*.cpp')
"$compiler" -std=c++20 -ffp-contract=off -I"$folder/copy" "${sources[@]}" -lgmpxx -lgmp -o "$folder/main" || fault 'a copy does not compile'
"$folder/main" || fault 'a copy of chapter 3'\''s tree misses its triangle'
