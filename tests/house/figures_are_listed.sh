#!/usr/bin/env bash
# figures_are_listed.sh PROGRAM CHAPTER LIST: proves that the figures a chapter's program can make are those that its
# add_figure lines name (LIST is figures.json), in the same order.
set -euo pipefail
said=$("$1" --figure no_such_figure 2>&1) && { echo "$1 makes a figure that does not exist" && exit 1; }
made=$(tr ' ' '\n' <<<"${said##*there are: }" | grep -vx all)
listed=$(sed -n 's/.*"id": "\([^"]*\)", "chapter": "'"$2"'".*/\1/p' "$3")
diff <(echo "$listed") <(echo "$made") || { echo "differ: add_figure lines (<) and the program's figures (>)" && exit 1; }
