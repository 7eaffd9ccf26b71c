#!/usr/bin/env bash
# names_are_declared_once.sh ROOT: no name of namespace space is declared by two chapters.
#
# Every header on a chapter's doorstep declares its subject in `namespace space`, where later chapters see it. So a
# chapter that needs a word which another has taken gives its own a narrower name, or nests it (BspConfig::Straddlers).
# Formatted code begins its declarations in the first column; what is nested does not, and apparatus has a namespace of
# its own (space::chNN).
set -euo pipefail
cd "$1"

names() { # HEADER...: "name chapter header:line" for each declaration in namespace space
    awk '
        FNR == 1 { inside = 0; split(FILENAME, part, "/") }
        /^namespace space \{/ { inside = 1; next }
        /^namespace / { inside = 0; next }
        /^}  \/\/ namespace/ { inside = 0; next }
        !inside || !/^[A-Za-z]/ { next }
        { line = $0; sub(/ *\/\/.*/, "", line) }
        # A template head may stand before the declaration on its line; a specialisation declares no name.
        line ~ /^template <>/ { next }
        line ~ /^(template|requires)/ && line !~ />  *(struct|class|concept|using) / { next }
        { sub(/^template <[^;]*>  */, "", line) }
        line ~ /^(struct|class|enum|union|concept|using) / {
            sub(/^(enum class|enum struct|[a-z]+) /, "", line)
            if (match(line, /^[A-Za-z_0-9]+/)) name = substr(line, 1, RLENGTH); else next
            if (substr(line, RLENGTH + 1, 1) == "<" || line ~ /^namespace/) next
            print name, part[2], FILENAME ":" FNR
            next
        }
        line ~ /^[^=({]*[ *&][A-Za-z_0-9]+ *(\(|=|\{|;)/ {
            match(line, /[A-Za-z_0-9]+ *(\(|=|\{|;)/)
            name = substr(line, RSTART, RLENGTH)
            sub(/ *[({=;]$/, "", name)
            if (name !~ /^(operator|static_assert|if|for|return)$/) print name, part[2], FILENAME ":" FNR
        }' "$@"
}

shopt -s nullglob
headers=(chapters/ch*/*.hpp)
((${#headers[@]})) || { echo "names_are_declared_once: no headers in $PWD/chapters"; exit 2; }
declared=$(names "${headers[@]}")
[ -n "$declared" ] || { echo "names_are_declared_once: no declaration found"; exit 2; }
twice=$(awk '{ if (!(($1, $2) in seen)) { seen[$1, $2]; ++chapters[$1] } where[$1] = where[$1] " " $3 }
             END { for (name in chapters) if (chapters[name] > 1) print name ":" where[name] }' <<<"$declared" | sort)
[ -z "$twice" ] || { echo "declared by two chapters:"; echo "$twice"; exit 1; }
