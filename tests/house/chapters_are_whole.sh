#!/usr/bin/env bash
# chapters_are_whole.sh ROOT: proves that each chapter has what its tests hang on, so that none is left out in silence: a
# CMakeLists.txt with add_chapter and, once it has a program, its text, its figures, the expected output of --small, what a
# full run counted, tests, and a line in the lists of chapters; and that the lab offers what has a file among its structures.
# Prints each fault; fails if there are any.
set -euo pipefail
cd "$1"
faults=0
fault() { printf '%s\n' "$1" && faults=1; }

for folder in chapters/*/; do
    folder=${folder%/} chapter=$(basename "$folder")
    [[ $chapter =~ ^ch[0-9]{2}_[a-z0-9_]+$ ]] || fault "$folder: not named chNN_name"
    grep -qs '^add_chapter(' "$folder/CMakeLists.txt" || fault "$folder/CMakeLists.txt: missing, or without add_chapter"
    [[ -f $folder/main.cpp ]] || continue
    for file in README.md chapter.dox measured/expected_small.txt; do
        [[ -s $folder/$file ]] || fault "$folder/$file: missing or empty"
    done
    numbers=figures/measured/${chapter%%_*}_numbers.json
    [[ -s $numbers ]] || fault "$numbers: missing: ./book run $((10#${chapter:2:2})) --update makes it"
    while read -r id kind; do
        file=figures/$id.svg
        [[ $kind != rendering ]] || file=figures/$id.png
        [[ $kind != chart ]] || file=figures/measured/$id.svg
        [[ -s $file ]] || fault "$file: missing: the page says so in its place"
    done < <(sed -n 's/^add_figure(\(fig_[0-9_]*\) \([a-z]*\).*/\1 \2/p' "$folder/CMakeLists.txt" 2>/dev/null)
    # A line that is commented out does not count.
    grep -qsE "^[^#]*\b${chapter%%_*}(\b|_)" tests/*/CMakeLists.txt ||
        fault "tests/${chapter%%_*}/CMakeLists.txt: no test of the chapter"
    grep -qF "\"$chapter\"" docs/chapters.json || fault "docs/chapters.json: no $chapter"
    grep -qF "(chapters/$chapter)" README.md || fault "README.md: no link to chapters/$chapter"
done
for file in chapters/ch12_comparison/structures/ch*.cpp; do
    [[ -f $file ]] || continue
    name=$(basename "$file" .cpp)_structures
    grep -qsE "^[^/]*\{.*\b$name\(\)" chapters/ch12_comparison/structures.cpp ||
        fault "chapters/ch12_comparison/structures.cpp: $name() is not among the lab's structures"
done
exit $faults
