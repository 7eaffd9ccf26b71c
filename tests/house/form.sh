#!/usr/bin/env bash
# form.sh ROOT CLANG_FORMAT: proves that each C++ file is as clang-format 14 leaves it (the empty string: there is none)
# and that no line is longer than 100 characters, which clang-format cannot promise. What a reader writes into an
# exercise is the reader's. Prints each fault; fails if there are any.
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
if [[ -n $2 ]]; then
    "$2" --dry-run -Werror "${files[@]}" || { echo "run $2 -i on these" && faults=1; }
fi
exit $faults
