#!/usr/bin/env bash
# command_test.sh ROOT [check]: tries ./book as readers and clumsy fingers do, in a copy of the project whose path has
# spaces, from another directory. With `check` also the journey of an exercise: check, hint, solution, reset.
set -euo pipefail
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
copy="$tree/a copy of the book"
mkdir "$copy"
(cd "$1" && cp -r book CMakeLists.txt CMakePresets.json common chapters docs tests "$copy")
cd "$tree"
failures=0
wrong() { printf '%s\n' "$1" && failures=1; }

# ends CODE PATTERN ARGUMENT...: ./book with the arguments ends with the code, and its output holds the pattern;
# wrong use is told in one line
ends() {
    local code=$1 pattern=$2 result=0
    shift 2
    "$copy/book" "$@" >"$tree/said.txt" 2>&1 </dev/null || result=$?
    ((result == code)) || wrong "./book $*: exit code $result, not $code: $(<"$tree/said.txt")"
    grep -qE -- "$pattern" "$tree/said.txt" || wrong "./book $*: no '$pattern' in: $(<"$tree/said.txt")"
    ((code != 2)) || (($(wc -l <"$tree/said.txt") == 1)) || wrong "./book $*: more than one line: $(<"$tree/said.txt")"
    ! grep -q $'\033' "$tree/said.txt" || wrong "./book $*: colours in a file"
}

ends 0 'book run' help
ends 0 'book run' --help
ends 0 'book run'
for command in run try test exercise figures bench docs print scenes doctor; do ends 0 "^  ./book $command " $command --help; done
ends 0 '^  --structure ' lab --help
ends 0 '^  --method ' render --help
ends 0 '^  ./book render ' help render
ends 0 '^Splitting Space [0-9]' --version
ends 0 '^  ./book figures ' help figures
ends 2 'help: there is no command nonsense' help nonsense
ends 2 'nonsense: there is no such command' nonsense
ends 2 'chapter 99: there is none; there are: 1' run 99
ends 2 'chapter x: there is none' run x
ends 2 'there is none' run $'\e[31m\n'
ends 2 '^book: .{1990,2000}$' "$(printf 'x%.0s' {1..100000})"
ends 2 'unknown option --fast' run --fast
ends 2 'give a chapter' try
ends 2 'chapter 99: there is none' try 99
ends 2 'wants a full run' run --quick --update
ends 2 'chapter 99: there is none' bench 99
ends 2 'address or thread' test --sanitize
ends 2 'address or thread' test --sanitize memory
ends 2 'unknown argument 1' test 1
ends 2 'exercise 9.99: there is none' exercise check 9.99
ends 2 'such as 1.2' exercise check '1.*'
ends 2 'such as 1.2' exercise hint ''
ends 2 'give one exercise' exercise check
ends 2 'give one exercise' exercise check 1.1 1.2
ends 2 'there is list' exercise solve 1.1
ends 2 'takes --shipped and no more' docs 1
ends 2 'takes --install and no more' doctor 1
ends 2 'unknown option --all' figures --all
ends 2 'figure 9.99: there is none; there are: 1.1 ' figures 3.4 9.99
ends 2 'figure 3_: there is none' figures 3_
ends 2 'not both' figures --dark --light
ends 2 'follow the reader' figures --dark --update
ends 2 'chapter 99: there is none; there are: 1' figures --slides 99
ends 2 'figure 9.99: there is none; there are: 1.1 ' figures 7 --slides 9.99
ends 2 'figure 7: there is none; there are: 1.1 ' figures 7
ends 2 'makes none to --update' figures --slides --update
ends 2 'takes no arguments' print 1
ends 0 'g\+\+ ' doctor

# Nothing is installed, and what is missing is named, with --no-install.
sed -i 's|<fmt/format.h>|<no/such/header.h>|' "$copy/common/scripts/packages.txt"
ends 3 'required and not there: libfmt-dev' run 1 --no-install
ends 3 'something required is missing' doctor
cp "$1/common/scripts/packages.txt" "$copy/common/scripts"

stub=$(cd "$copy" && find chapters -path '*/ch01_*/exercises/ex01_*.hpp' -print -quit)
if [[ -n $stub ]]; then
    ends 0 '^1\.1 .* of 3, .*not checked yet' exercise
    ends 0 "${stub##*/}" exercise
    (($(wc -L <"$tree/said.txt") <= 80)) || wrong "the list is wider than 80 columns: $(<"$tree/said.txt")"
    ends 0 'Hint 1 of 3' exercise hint 1.1
    ! grep -q 'Hint 2' "$tree/said.txt" || wrong 'the first hint tells the second'
    ends 0 'Hint 2 of 3' exercise hint 1.01
    ends 0 'Hint 3 of 3' exercise hint 01.1
    ends 0 'Hint 3 of 3' exercise hint 1.1
    ends 0 'Exercise 1.1, solution' exercise solution 1.1
    ends 3 'git history, and there is none' exercise reset 1.1
    (cd "$copy" && git init -q . && git add chapters && git -c user.name=a -c user.email=b commit -qm copy)
    for version in 1 2; do
        echo "// changed $version" >>"$copy/$stub"
        ends 0 "your version is kept in build/exercises/ch01.ex01.*\\.$version\\.hpp" exercise reset 1.1
    done
    grep -q 'changed 1' "$copy"/build/exercises/ch01.ex01*.1.hpp || wrong 'the second reset overwrites the first kept version'
    cmp -s "$1/$stub" "$copy/$stub" || cmp -s <(git -C "$copy" show "HEAD:$stub") "$copy/$stub" || wrong 'reset did not restore the stub'
    ends 0 'is as it was' exercise reset 1.1
fi

if [[ ${2:-} == check && -n $stub ]]; then
    # The check links nothing of these, which would be compiled with it, for minutes; one is named by a test.
    find "$copy"/common/{program,scenes,mesh_reader} -name '*.cpp' ! -name image.cpp -delete
    cp "$1/$stub" "$copy/$stub"
    if git -C "$1" show "HEAD:$stub" >"$tree/stub" 2>/dev/null; then cp "$tree/stub" "$copy/$stub"; fi
    cp "$copy/$stub" "$tree/original"
    ends 1 'is not solved yet\. This must be so, and is not: ' exercise check 1.1 --no-install
    # beside the list of what is configured, once
    (($(grep -vcE '^ +[+-] ' "$tree/said.txt") <= 45)) || wrong "a failed check is long: $(<"$tree/said.txt")"
    ! grep -qE '\{\?\}|host application' "$tree/said.txt" || wrong "a failed check is not readable: $(<"$tree/said.txt")"
    ends 0 '^1\.1 .*unsolved' exercise
    echo 'this is no C++' >>"$copy/$stub"
    ends 1 'does not compile yet' exercise check 1.1
    ends 0 '^1\.1 .*does not compile' exercise
    # also_does CODE: the stub does this as well, before the checks run
    also_does() {
        {
            cat "$tree/original"
            printf '#include <cstdio>\n#include <cstdlib>\n#include <string>\n'
            printf '[[maybe_unused]] static const int also = [] { %s return 0; }();\n' "$1"
        } >"$copy/$stub"
    }
    # Five in one, which is compiled once.
    also_does '
        const char* const asked = std::getenv("ALSO");
        const std::string what = asked ? asked : "";
        if (what == "abort") std::abort();
        if (what == "write") const_cast<volatile char*>(asked)[1L << 40] = 0;
        if (what == "exit") std::exit(0);
        if (what == "grow") for (std::string s = "x";;) s += s;
        if (what == "print") for (;;) std::puts("much");'
    ends 1 'is not solved yet' exercise check 1.1
    ALSO=abort ends 1 'crashes \(exit code 134\): it was aborted' exercise check 1.1
    ! grep -q 'exercises\.sh' "$tree/said.txt" || wrong "the shell speaks too: $(<"$tree/said.txt")"
    ALSO='write' ends 1 'crashes \(exit code 139\): it used memory that is not its own' exercise check 1.1
    ALSO='exit' ends 1 'before the checks are done' exercise check 1.1
    ALSO=grow ends 1 'more than 2 GB' exercise check 1.1
    ALSO=print ends 1 'more than 10 MB' exercise check 1.1
    (($(wc -l <"$tree/said.txt") <= 70)) || wrong "what an answer prints is long: $(wc -l <"$tree/said.txt") lines"
    also_does 'int signed_one = 1; if (signed_one < std::string("xy").size()) std::puts("spoken");'
    ends 1 'warning: comparison' exercise check 1.1
    grep -q spoken "$tree/said.txt" || wrong "a warning keeps an answer from running: $(<"$tree/said.txt")"
    ends 1 'warning: comparison' exercise check 1.1
    { head -n 3 "$1/$stub" && cat "$copy"/chapters/ch01_*/solutions/ex01_*.hpp; } >"$copy/$stub"
    ends 0 'is solved' exercise check 1.1
    ends 0 '^1\.1 .*  solved' exercise
    echo '// one more idea' >>"$copy/$stub"
    ends 0 '^1\.1 .*changed since its check' exercise
fi
exit $failures
