#!/usr/bin/env bash
# form.sh ROOT [CLANG_FORMAT]: proves that each C++ file is as clang-format 14 leaves it (where there is one), that no line
# is longer than 100 characters, which clang-format cannot promise, and no function of the book longer than 60 lines (in
# tests/ it may be: a list of cases). What a reader writes into an exercise is the reader's. Prints each fault; fails if
# there are any.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
cd "$1"
export LC_ALL=C.UTF-8  # characters, not bytes
faults=0
files=()
while IFS= read -r file; do
    if [[ $file != */exercises/* ]] || ! bash "$here/changed_since_commit.sh" "$file"; then files+=("$file"); fi
done < <(find chapters common docs tests -name '*.[ch]pp' | sort)

! grep -HnE '^.{101}' "${files[@]}" || { echo 'longer than 100 characters' && faults=1; }
# In that form a function begins at the margin, or four spaces from it in a class, and ends with a brace in that column.
awk '
    FNR == 1 { first[0] = first[4] = in_class = 0 }
    /^namespace / { next }
    /^[A-Za-z~\[]/ { in_class = /^(struct|class|union|template)/; first[0] = FNR; text[0] = $0 }
    /^    [A-Za-z~\[]/ && in_class && !/[;}]$/ { first[4] = FNR; text[4] = $0 }
    /^}/ || /^    }/ {
        column = /^}/ ? 0 : 4
        lines = FNR - first[column] + 1
        if (first[column] && lines > 60 && FILENAME !~ /^tests\// && text[column] !~ /(^|> )(struct|class|enum|union) /) {
            printf "%s:%d: %d lines: %s\n", FILENAME, first[column], lines, text[column]
            faults = 1
        }
        first[column] = first[4] = 0
    }
    END { exit faults }' "${files[@]}" || { echo 'longer than 60 lines' && faults=1; }
if [[ -n ${2:-} ]]; then
    "$2" --dry-run -Werror "${files[@]}" || { echo "run $2 -i on these" && faults=1; }
fi
exit $faults
