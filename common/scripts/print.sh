# shellcheck shell=bash
# The whole book as one PDF: Chromium prints each page of the site, join_pages.py puts them together. Sourced by ./book.

# The pages in the order of the menu, without those of the code: each a line, file and title with a tab between them.
pages_of_the_book() {
    printf 'index.html\tThe book\n'
    sed -n -e '/^    \[ "Code"/q' -e 's/^    \[ "\(.*\)", "\([^"]*\.html\)", null \],*$/\2\t\1/p' "$1/navtreedata.js"
}

# print_page PAGE PDF NUMBER: one page of the site, whose first sheet has the number
print_page() {
    # Chromium has no sandbox for root, nor on every machine for others; these pages are our own.
    "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --user-data-dir="$work/profile" \
        --virtual-time-budget=60000 --no-pdf-header-footer --generate-pdf-document-outline --print-to-pdf="$2" \
        "file://$out/site/$1?sheet=$3" \
        >"$log/print.txt" 2>&1 || { cat "$log/print.txt" >&2; die 1 "printing $1 failed"; }
    [[ -s $2 ]] || { cat "$log/print.txt" >&2; die 1 "printing $1 failed"; }
    # Formulas are set by a script: was it done before the page was printed?
    [[ $(pdftotext "$2" -) != *'\('* ]] || die 1 "$1 was printed with raw formulas"
}

command_print() {
    local page title browser='' tool sheet=1
    (($# == 0)) || die 2 'print: takes no arguments'
    step_count=5
    set_up build run print
    for tool in chromium chromium-browser google-chrome; do
        [[ -n $browser ]] || browser=$(command -v "$tool") || true
    done
    [[ -n $browser ]] || die 3 'print: needs Chromium, which is not there (Debian: apt-get install chromium)'
    for tool in pdfinfo pdftotext; do
        command -v "$tool" >/dev/null || die 3 "print: needs $tool, which is not there (Debian: apt-get install poppler-utils)"
    done
    /usr/bin/python3 -c 'import pypdf' 2>/dev/null ||
        die 3 'print: needs pypdf, which is not there (Debian: apt-get install python3-pypdf)'
    configure_once release
    [[ -f $root/build/release/Doxyfile ]] || die 3 'print: there are no pages to print: ./book docs says what they need'
    make_pages >/dev/null
    work=$(mktemp -d -p "$root/build")
    trap 'rm -rf "$work"' EXIT
    step 'Printing'
    while IFS=$'\t' read -r page title; do
        print_page "$page" "$work/$page.pdf" "$sheet"
        say "      $sheet: $page"
        sheet=$((sheet + $(pdfinfo "$work/$page.pdf" | sed -n 's/^Pages: *//p')))
        printf '%s\t%s\t%s\n' "$work/$page.pdf" "$page" "$title" >>"$work/parts.txt"
    done < <(pages_of_the_book "$out/site")
    /usr/bin/python3 "$root/common/scripts/join_pages.py" "$work/book.pdf" <"$work/parts.txt" ||
        die 1 'putting the pages together failed'
    mv "$work/book.pdf" "$out/splitting_space.pdf"
    printf '\nThe book, %d pages: %s\n' "$((sheet - 1))" "$out/splitting_space.pdf"
}
