#!/usr/bin/env bash
# clang_same_bytes.sh [BUILD_DIRECTORY]: builds the book's programs with clang++ and compares every drawing, every
# rendering and every --small output with what g++ made, byte for byte. For maintainers: takes some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=${1:-build/clang}
cmake --preset release -B "$build" -D CMAKE_CXX_COMPILER=clang++ >/dev/null
cmake --build "$build" --target programs
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" -R '^ch[0-9]+\.(small|fig_.*)$'
