# shellcheck shell=bash
# The exercises: list, check, hint, solution, reset. Sourced by ./book.

# 1.2 -> the stub's path, in `stub`; its chapter's folder, in `folder`; ch01.ex02_name, in `exercise`.
find_exercise() {
    local id=$1 pattern
    [[ $id =~ ^([0-9]{1,2})\.([0-9]{1,2})$ ]] || die 2 "exercise $id: give chapter and number, such as 1.2"
    printf -v pattern 'ch%02d_*/exercises/ex%02d_*.hpp' "$((10#${BASH_REMATCH[1]}))" "$((10#${BASH_REMATCH[2]}))"
    stub=$(cd "$root/chapters" && compgen -G "$pattern" | head -n 1) ||
        die 2 "exercise $id: there is none; ./book exercise lists them"
    stub=$root/chapters/$stub
    folder=$(dirname "$(dirname "$stub")")
    exercise=$(basename "$folder")
    exercise=${exercise%%_*}.$(basename "$stub" .hpp)
}

fingerprint() { cksum <"$1" | tr ' ' -; }

# The state that the last check left, in words.
state_of() {
    local file=$root/build/exercises/$1.state result print
    [[ -f $file ]] || { echo 'not checked yet' && return; }
    read -r result print <"$file"
    [[ $print == "$(fingerprint "$2")" ]] && echo "$result" || echo 'changed since its check'
}

list_exercises() {
    local stub state
    printf '%-5s %-44s %-11s %-8s %s\n' '' exercise difficulty minutes state
    for stub in "$root"/chapters/ch*/exercises/ex*.hpp; do
        [[ $stub =~ /(ch([0-9]+))_[^/]*/exercises/(ex([0-9]+)_[^/]*)\.hpp$ ]] || continue
        state=$(state_of "${BASH_REMATCH[1]}.${BASH_REMATCH[3]}" "$stub")
        printf '%-5s %-44s %-11s %-8s %s\n' "$((10#${BASH_REMATCH[2]})).$((10#${BASH_REMATCH[4]}))" \
            "$(sed -n 's|^/// Exercise [0-9.]*: ||p' "$stub")" \
            "$(sed -n 's|^/// Difficulty \(. of 3\), about .*|\1|p' "$stub")" \
            "$(sed -n 's|^/// Difficulty . of 3, about \([0-9]*\) minutes.*|\1|p' "$stub")" "$state"
    done
    printf '\nOpen the file that ./book exercise check N.M names, change it, check it again.\n'
}

check_exercise() {
    local program output result=0 state
    local -a arguments
    find_exercise "$1"
    step_count=3
    set_up build
    configure_once release
    program=$root/build/release/exercises/$exercise.exercise
    state=$root/build/exercises/$exercise.state
    mkdir -p "$root/build/exercises"
    rm -f "$state"
    step "Compiling ${stub#"$root"/}"
    if ! output=$(cmake --build "$root/build/release" --target "$exercise.exercise" -- -k 0 2>&1); then
        grep -vE '^(\[[0-9]|ninja: |FAILED: |/usr/bin/|/usr/lib/ccache)' <<<"$output" || true
        printf '\nExercise %s does not compile yet: the first error above says where.\n' "$1"
        return 1
    fi
    read -ra arguments <"$root/build/release/catch_arguments.txt"
    # In braces: the shell's own word on a crash is left out.
    { timeout 60 "$program" "${arguments[@]}" >"$log/exercise.txt" 2>&1 || result=$?; } 2>/dev/null
    cat "$log/exercise.txt"
    if ((result == 0)); then
        echo "solved $(fingerprint "$stub")" >"$state"
        printf 'Exercise %s is solved. ./book exercise solution %s shows ours, to compare.\n' "$1" "$1"
        return 0
    fi
    echo "unsolved $(fingerprint "$stub")" >"$state"
    if ((result == 124)); then
        printf 'Exercise %s does not end within a minute: is there an endless loop?\n' "$1"
    elif grep -q 'fatal error condition' "$log/exercise.txt" || ((result > 128 && result < 160)); then
        printf 'Exercise %s crashes (exit code %d).\n' "$1" "$result"
    else
        printf 'Exercise %s is not solved yet; the checks above that FAILED say why.\n' "$1"
    fi
    printf 'The file is %s; ./book exercise hint %s helps.\n' "${stub#"$root"/}" "$1"
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
    local kept
    find_exercise "$1"
    git -C "$root" cat-file -e "HEAD:${stub#"$root"/}" 2>/dev/null ||
        die 3 "reset $1: the original comes from the git history, and there is none here"
    mkdir -p "$root/build/exercises"
    kept=$root/build/exercises/$(basename "$stub")
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
