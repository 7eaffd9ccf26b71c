#!/usr/bin/env bash
# changed_since_commit.sh FILE: is the file in the last commit, and different now? Then it is a reader's work.
cd "$(dirname "$1")" && git cat-file -e "HEAD:./$(basename "$1")" 2>/dev/null && ! git diff --quiet HEAD -- "./$(basename "$1")"
