# shellcheck shell=bash
# What took longest, so that whoever adds a slow compile or test sees it. Sourced by ./book.

# slowest_compiles PRESET SINCE: ten of those that ended after SINCE, in nanoseconds as `date +%s%N` tells it
slowest_compiles() {
    # Ninja's log: start and end in ms, the output's time in ns, the output
    awk -F '\t' -v since="$2" '
        $3 + 0 >= since + 0 && $4 ~ /\.(o|gch)$/ {
            name = $4
            sub(/CMakeFiles\/[^\/]*\.dir\//, "", name)
            printf "%8.1f s  %s\n", ($2 - $1) / 1000, name
        }' "$root/build/$1/.ninja_log" | sort -rn | sed -n 1,10p
}

# slowest_tests FILE: ten of those whose ends FILE tells, which is what ctest printed
slowest_tests() {
    sed -nE 's|^ *[0-9]+/[0-9]+ Test +#[0-9]+: ([^ ]+) .* ([0-9.]+) sec.*|\2 \1|p' "$1" | sort -rn | sed -n 1,10p |
        while read -r seconds name; do printf '%8.1f s  %s\n' "$seconds" "$name"; done
}

# say_slowest PRESET SINCE FILE
say_slowest() {
    local compiles
    compiles=$(slowest_compiles "$1" "$2")
    [[ -z $compiles ]] || printf '\nThe slowest compiles of build/%s (from the start of one to its end)\n%s\n' "$1" "$compiles"
    printf '\nThe slowest tests of build/%s\n%s\n' "$1" "$(slowest_tests "$3")"
}
