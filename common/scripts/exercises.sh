# shellcheck shell=bash
# The exercises: list, check, hint, solution, reset. Sourced by ./book.

# 1.2 -> the stub's path, in `stub`; its chapter's folder, in `folder`; ch01.ex02_name, in `exercise`.
find_exercise() {
    local id=$1 pattern
    [[ $id =~ ^([0-9]{1,2})\.([0-9]{1,2})$ ]] || die 2 "exercise $id: give chapter and number, such as 1.2"
    printf -v pattern 'ch%02d_*/exercises/ex%02d_*.hpp' "$((10#${BASH_REMATCH[1]}))" "$((10#${BASH_REMATCH[2]}))"
    stub=$(cd "$root/chapters" && compgen -G "$pattern") ||
        die 2 "exercise $id: there is none; ./book exercise lists them"
    stub=$root/chapters/${stub%%$'\n'*}
    folder=$(dirname "$(dirname "$stub")")
    exercise=$(basename "$folder")
    exercise=${exercise%%_*}.$(basename "$stub" .hpp)
}

fingerprint() { cksum <"$1" | tr ' ' -; }

# The state that the last check left, in words.
state_of() {
    local file=$root/build/exercises/$1.state result print
    [[ -f $file ]] || { echo 'not checked yet' && return; }
    read -r print result <"$file"
    [[ $print == "$(fingerprint "$2")" ]] && echo "$result" || echo 'changed since its check'
}

list_exercises() {
    local stub head folder='' state
    for stub in "$root"/chapters/ch*/exercises/ex*.hpp; do
        [[ $stub =~ /(ch([0-9]+))_[^/]*/exercises/(ex([0-9]+)_[^/]*)\.hpp$ ]] || continue
        state=$(state_of "${BASH_REMATCH[1]}.${BASH_REMATCH[3]}" "$stub")
        [[ $folder == "${stub%/*}" ]] || printf '%s\n' "${folder:+$'\n'}${stub#"$root"/}" | sed 's|/[^/]*$|/|'
        folder=${stub%/*}
        head=$(sed -n 's|^/// Difficulty \(. of 3\), about \([0-9]*\) minutes.*|\1, \2 min|p' "$stub")
        printf '%-4s %-33s %-14s  %s\n     %s\n' "$((10#${BASH_REMATCH[2]})).$((10#${BASH_REMATCH[4]}))" \
            "$(sed -n 's|^/// Exercise [0-9.]*: ||p' "$stub")" "$head" "$state" "${stub##*/}"
    done
    printf '\n./book exercise check N.M compiles and checks what you made of a file.\n'
}

# What a reader needs of a long output: paths from the project's root, and no more than 60 lines.
shorten() { sed "s|$root/||g; s|^\(\.\./\)\+||" | awk 'NR <= 60 {print} END {if (NR > 60) printf "... and %d lines more\n", NR - 60}'; }

# A check's answer may use 60 seconds, 2 GB of memory and 10 MB of output; its report goes into a file of its own.
run_check() {
    local program=$1 result=0 slow
    local -a arguments
    read -ra arguments <"$root/build/release/catch_arguments.txt"
    { sleep 10 >&- 2>&- && say "      Still running after 10 seconds; it is stopped after 60."; } &
    slow=$!
    # In braces: the shell's own word on a crash is left out.
    {
        (
            ulimit -v 2000000 -f 10000 -c 0
            exec timeout -s KILL 60 "$program" "${arguments[@]}" -x 3 -o "$log/exercise.txt" >"$log/exercise_own.txt" 2>&1
        ) || result=$?
    } 2>/dev/null
    kill "$slow" 2>/dev/null || true
    return "$result"
}

# The failed checks of a report, without Catch2's banner, places of test cases and sums.
failed_checks() {
    { grep -vE -e '^(~+|\.+|=+)$' -e ' is a Catch2? v.* host application\.$|^Run with -\? for options$' \
        -e '^Randomness seeded to: |^Filters: |^(test cases|assertions): |\.cpp:[0-9]+$' "$log/exercise.txt" || true; } | cat -s
}

# The sentence that names the first test case of a report that failed: it stands between two lines of hyphens.
first_failure() {
    awk '/^-+$/ {if (inside) exit; inside = 1; next} inside {sub(/^ +/, ""); printf "%s%s", space, $0; space = " "}' \
        "$log/exercise.txt"
}

# What a program did that ended with this exit code, 128 and the number of a signal.
crash_in_words() {
    case $(($1 - 128)) in
        4) echo 'it came where no code is. Does a function with a result end without return?' ;;
        6) echo 'it was aborted. An assertion or a check of a container failed, or an exception was not caught.' ;;
        8) echo 'it divided a whole number by zero.' ;;
        7 | 11) echo 'it used memory that is not its own. Is an index too large, a pointer null, a recursion without end?' ;;
        *) echo 'the system ended it.' ;;
    esac
}

check_exercise() {
    local compiled warnings result=0 state verdict
    find_exercise "$1"
    step_count=3
    set_up build
    configure_once release
    state=$root/build/exercises/$exercise.state
    warnings=$root/build/exercises/$exercise.warnings
    mkdir -p "$root/build/exercises"
    rm -f "$state" "$log/exercise.txt" "$log/exercise_own.txt"
    step "Compiling ${stub#"$root"/}"
    compiled=$(cmake --build "$root/build/release" --target "$exercise.exercise" -- -k 0 2>&1) || result=$?
    # What was compiled before is not compiled again (linked it may be: a file from ccache can be a few milliseconds younger
    # than the start of its link, by two clocks of the system): its warnings are shown again.
    if [[ $compiled == *'Building CXX object '*"/checks/$(basename "$stub" .hpp).cpp.o"* ]]; then
        grep -vE '^ *(\[[0-9]|ninja: |FAILED: |-- |/usr/bin/|/usr/lib/ccache)' <<<"$compiled" >"$warnings" || true
    fi
    [[ ! -f $warnings ]] || shorten <"$warnings"
    if ((result != 0)); then
        echo "$(fingerprint "$stub") does not compile" >"$state"
        printf '\nExercise %s does not compile yet: the first error above says where.\n' "$1"
        return 1
    fi
    run_check "$root/build/release/exercises/$exercise.exercise" || result=$?
    touch "$log/exercise.txt" "$log/exercise_own.txt"
    head -c 2000 "$log/exercise_own.txt" | sed -n 1,20p  # what the answer prints
    if ((result == 0)) && grep -q '^All tests passed (' "$log/exercise.txt"; then
        echo "$(fingerprint "$stub") solved" >"$state"
        printf 'Exercise %s is solved. ./book exercise solution %s shows ours, to compare.\n' "$1" "$1"
        return 0
    fi
    echo "$(fingerprint "$stub") unsolved" >"$state"
    failed_checks | shorten
    if ((result == 137)); then
        verdict='does not end within a minute: is there an endless loop?'
    elif ((result == 153)); then
        verdict='prints more than 10 MB: is there an endless loop?'
    elif grep -q 'bad_alloc' "$log/exercise.txt" "$log/exercise_own.txt"; then
        verdict='needs more than 2 GB of memory: does something grow without end?'
    elif grep -q 'fatal error condition' "$log/exercise.txt" || ((result > 128 && result < 160)); then
        verdict="crashes (exit code $result): $(crash_in_words "$result")"
    elif ((result == 0)) || ! grep -q '^test cases\?: .* failed' "$log/exercise.txt"; then
        verdict='ends the program before the checks are done: does it call exit?'
    else
        verdict="is not solved yet. This must be so, and is not: $(first_failure)."
    fi
    printf 'Exercise %s %s\nThe file is %s; ./book exercise hint %s helps.\n' "$1" "$verdict" "${stub#"$root"/}" "$1"
    return 1
}

# Each call shows one hint more.
hint_exercise() {
    local level=0 file hints
    find_exercise "$1"
    file=${stub%.hpp}.hints
    hints=$root/build/exercises/$exercise.hints
    mkdir -p "$root/build/exercises"
    [[ -f $hints ]] && level=$(<"$hints")
    ((level < 3)) && level=$((level + 1))
    echo "$level" >"$hints"
    awk -v level="$level" 'BEGIN {RS = ""} NR <= level {printf "Hint %d of 3: %s\n\n", NR, $0}' "$file"
}

solution_exercise() {
    find_exercise "$1"
    cat "$folder/solutions/$(basename "$stub")"
}

reset_exercise() {
    local kept number=1
    find_exercise "$1"
    git -C "$root" cat-file -e "HEAD:${stub#"$root"/}" 2>/dev/null ||
        die 3 "reset $1: the original comes from the git history, and there is none here"
    mkdir -p "$root/build/exercises"
    while kept=$root/build/exercises/$exercise.$number.hpp && [[ -e $kept ]]; do number=$((number + 1)); done
    if git -C "$root" diff --quiet HEAD -- "$stub"; then
        printf 'Exercise %s is as it was.\n' "$1"
        return
    fi
    cp "$stub" "$kept"
    git -C "$root" checkout --quiet HEAD -- "$stub"
    printf 'Exercise %s is as it was; your version is kept in %s.\n' "$1" "${kept#"$root"/}"
}

exercise_command() {
    local action=${1:-list}
    case $action in
        list) (($# <= 1)) || die 2 "exercise list: takes no more"; list_exercises ;;
        check | hint | solution | reset)
            (($# == 2)) || die 2 "exercise $action: give one exercise, such as 1.2"
            "${action}_exercise" "$2"
            ;;
        *) die 2 "exercise $action: there is list, check N.M, hint N.M, solution N.M, reset N.M" ;;
    esac
}
