#!/usr/bin/env bash
# includes_run_downwards.sh ROOT CHAPTERS: proves that in the tree ROOT
# - a chapter includes common/, itself and the chapters that it builds on (directly or through another), which are
#   earlier ones; CHAPTERS has a line for each chapter: its name, then those named by BUILDS_ON;
# - within a chapter arrows run main -> figures -> measured -> subject: the subject includes neither figures/ nor
#   measured/, measured/ includes no figures/, and those of another chapter are closed; measured/data.hpp includes no
#   subject, so that a change of the structure does not compile what only reads the plain values;
# - common/ includes no chapter; neither includes tests/ or docs/ (checks of exercises may include tests/);
# - our headers are included by their path from the root, but those beside the including file in docs/ and tests/;
# - CGAL is used by the tests, by the one reader of mesh files and by the lab's peers, which nothing else includes.
# Prints each line that breaks a rule, as file:line: fault; fails if there are any.
set -euo pipefail
cd "$1"
# shellcheck disable=SC2016  # the program is awk
find common chapters tests docs -name '*.[hc]pp' -print0 2>/dev/null | sort -z |
    xargs -0 awk -v chapters="$2" '
        function fault(what) { printf "%s:%d: %s\n", FILENAME, FNR, what; faults = 1 }
        # Does chapter `from` build on chapter `to`, directly or through others?
        function reaches(from, to,    i, names, count) {
            if (from == to) return 1
            count = split(builds_on[from], names, " ")
            for (i = 1; i <= count; ++i) if (reaches(names[i], to)) return 1
            return 0
        }
        # The rooms of a chapter, from the subject up.
        function rank(room) { return room == "measured" ? 1 : room == "figures" ? 2 : room ~ /^(main.cpp|peers)$/ ? 3 : 0 }
        function name_of(room) { return rank(room) == 0 ? "the subject" : room }
        BEGIN {
            while ((getline line < chapters) > 0) {
                name = line; sub(/ .*/, "", name)
                rest = line; sub(/^[^ ]* */, "", rest)
                builds_on[name] = rest
                count = split(rest, names, " ")
                for (i = 1; i <= count; ++i)
                    if (names[i] >= name) { print name ": builds on " names[i] ", which is not an earlier chapter"; faults = 1 }
            }
        }
        # A second program of a chapter has a folder of its own, which holds its main.cpp.
        FNR == 1 { split(FILENAME, own, "/"); if (own[4] == "main.cpp") own[3] = "main.cpp" }
        /^[ \t]*#[ \t]*include[ \t]*<CGAL\// && own[1] != "tests" &&
                FILENAME !~ /^(common\/mesh_reader|chapters\/ch[0-9]+_[a-z0-9_]*\/peers)\// {
            fault("CGAL is for tests/, common/mesh_reader/ and peers/")
        }
        /^[ \t]*#[ \t]*include[ \t]*"/ {
            path = $0; sub(/^[^"]*"/, "", path); sub(/".*/, "", path)
            split(path, part, "/")
            if (path ~ /\.\./) fault("included by a relative path: " path)
            if (own[1] != "common" && own[1] != "chapters") next
            if (part[1] == "common") next
            if (part[1] == "chapters") {
                if (own[1] == "common") fault("common/ includes a chapter: " path)
                else if (!(own[2] in builds_on)) fault("the chapter has no add_chapter line")
                else if (!reaches(own[2], part[2])) fault(own[2] " does not build on " part[2])
                else if (rank(part[3]) == 0) {
                    if (FILENAME ~ /\/measured\/data\.hpp$/) fault("measured/data.hpp includes the subject: " path)
                    else next
                }
                else if (own[2] != part[2]) fault("closed to other chapters: " path)
                else if (own[3] == "checks" && part[3] == "measured") next
                else if (rank(own[3]) < rank(part[3])) fault(name_of(own[3]) " includes " part[3] "/: " path)
            } else if (part[1] == "tests" && own[3] == "checks") next
            else if (path ~ /^ex[0-9][0-9]_[a-z0-9_]*\.hpp$/ && own[3] == "checks") next
            else fault("not a path from the root into common/ or a chapter: " path)
        }
        END { exit faults }'
