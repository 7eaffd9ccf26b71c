#!/usr/bin/env bash
# exercises_are_whole.sh ROOT EXERCISES: proves that each exercise has all its parts. EXERCISES has a line
# CHAPTER/NAME for each add_exercise. Prints each fault; fails if there are any.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$1"
faults=0
fault() { printf '%s\n' "$1" && faults=1; }

while read -r line; do
    [[ -n $line ]] || continue
    chapter=chapters/${line%%/*} name=${line##*/}
    stub=$chapter/exercises/$name.hpp
    for file in "$stub" "$chapter/exercises/$name.hints" "$chapter/solutions/$name.hpp" "$chapter/near_misses/$name.hpp" \
        "$chapter/checks/$name.cpp"; do
        [[ -s $file ]] || fault "$file: missing or empty"
    done
    [[ -f $stub ]] || continue
    [[ $stub =~ /ch([0-9]+)_.*/ex([0-9]+)_ ]] || { fault "$stub: not named exNN_..." && continue; }
    number=$((10#${BASH_REMATCH[1]})).$((10#${BASH_REMATCH[2]}))
    grep -qE "^/// Exercise $number: .+" "$stub" || fault "$stub: no line '/// Exercise $number: TITLE'"
    grep -qE '^/// Difficulty [1-3] of 3, about [0-9]+ minutes\.' "$stub" ||
        fault "$stub: no line '/// Difficulty D of 3, about M minutes.'"
    # What is solved in a reader's tree need not say TODO any more.
    grep -q 'TODO' "$stub" || bash "$here/changed_since_commit.sh" "$stub" || fault "$stub: no TODO"
    if [[ -f ${stub%.hpp}.hints ]]; then
        hints=$(awk 'BEGIN {RS = ""} END {print NR}' "${stub%.hpp}.hints")
        [[ $hints == 3 ]] || fault "${stub%.hpp}.hints: $hints hints, not 3 paragraphs"
        # They are prose: who formats them as code leaves such lines.
        ! grep -q '^ ' "${stub%.hpp}.hints" || fault "${stub%.hpp}.hints: a line begins with a space"
    fi
    ! cmp -s "$chapter/solutions/$name.hpp" "$chapter/near_misses/$name.hpp" || fault "$name: the near miss is the solution"
    grep -q 'TODO' "$chapter/solutions/$name.hpp" 2>/dev/null && fault "$chapter/solutions/$name.hpp: has a TODO"
done <"$2"

for stub in chapters/ch*/exercises/*.hpp chapters/ch*/checks/*.cpp; do
    [[ -e $stub ]] || continue
    chapter=$(basename "$(dirname "$(dirname "$stub")")") name=$(basename "${stub%.*}")
    grep -qxF "$chapter/$name" "$2" || fault "$stub: no add_exercise line for it"
done
exit $faults
