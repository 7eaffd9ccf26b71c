#!/usr/bin/env bash
# needed_files.sh HEADER [FOLDER]: the book's files without which a program cannot use HEADER (a path from the book's folder),
# and the libraries that it links. Into FOLDER they are copied with their paths, and the licence with them.
set -euo pipefail
from=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
[[ $# == [12] && -f $1 && $1 == *.hpp ]] ||
    { echo 'needed_files.sh: give a header by its path from the book'\''s folder, and perhaps a folder to copy to' >&2; exit 2; }

files=("$1")
add() {
    local file
    for file; do [[ ! -f $file || " ${files[*]} " == *" $file "* ]] || files+=("$file"); done
}
for ((i = 0; i < ${#files[@]}; ++i)); do
    mapfile -t included < <(sed -n 's/^#include "\(.*\)"$/\1/p' "${files[i]}")
    add "${included[@]}"
    case ${files[i]} in
        common/program/*) ;;  # its .cpp are for the book's programs
        */kernels/kernel_table.hpp) add "${files[i]%.hpp}.cpp" "${files[i]%/*}"/kernel_*.cpp ;;
        *.hpp) add "${files[i]%.hpp}.cpp" ;;
    esac
done

includes() { grep -qE "^#include <($1)" "${files[@]}"; }
libraries=()
! includes 'glm/' || libraries+=(GLM)
! includes 'gmpxx' || libraries+=(GMP)
! includes 'tbb/' || libraries+=(oneTBB)
! includes 'thread|mutex|semaphore' || libraries+=(threads)

printf '%s\n' "${files[@]}" | sort
printf 'libraries: %s\n' "${libraries[*]}"
if [[ -n ${2:-} ]]; then
    [[ $2 == /* ]] && to=$2 || to=$from/$2
    mkdir -p "$to"
    cp --parents LICENSE "${files[@]}" "$to"
fi
