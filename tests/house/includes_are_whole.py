#!/usr/bin/env python3
"""includes_are_whole.py ROOT: proves that each file includes what it uses of the precompiled headers.

They are there unasked (BOOK_HEADERS in common/cmake/Book.cmake), and a standard library includes some of its headers in
others, each in its own way: a file that compiles here may not compile with another compiler. A file includes a header
by itself or by headers of the book. What readers write into exercises is theirs.

The files of figures/ with main.cpp, and those of measured/, are compiled in batches, in which one's includes are there
for the next: of these files each includes, too, the headers of the book whose types and functions it uses. A function
is known by a name with an underscore: shorter ones are words that files use for their own. Prints each fault; fails if
there are any.
"""
import os
import re
import sys

NAMES = {
    "algorithm": r"std::(?:ranges::\w+|all_of|any_of|none_of|binary_search|clamp|copy|copy_if|count|count_if|equal|"
                 r"equal_range|fill|fill_n|find|find_if|for_each|generate|is_sorted|lower_bound|max|max_element|min|"
                 r"min_element|minmax|minmax_element|mismatch|move_backward|nth_element|partition|remove|remove_if|"
                 r"replace|reverse|rotate|search|shuffle|sort|stable_partition|stable_sort|transform|unique|"
                 r"upper_bound)\b(?=[(])",
    "array": r"std::(?:array|to_array)\b",
    "chrono": r"std::chrono\b",
    "cmath": r"std::(?:abs|acos|asin|atan|atan2|cbrt|ceil|copysign|cos|exp|floor|fma|frexp|hypot|ilogb|isfinite|isinf|"
             r"isnan|ldexp|llround|log|log10|log2|lround|nextafter|pow|remainder|round|scalbn|signbit|sin|sqrt|tan|"
             r"trunc)\b(?=[(])",
    "cstdint": r"std::u?int(?:8|16|32|64)_t\b",
    "filesystem": r"std::filesystem\b",
    "fmt/format.h": r"fmt::(?:format|format_to|print|memory_buffer)\b",
    "fmt/ranges.h": r"fmt::join\b",
    "functional": r"std::(?:function|greater|hash|invoke|less|plus|reference_wrapper)\b",
    "limits": r"std::numeric_limits\b",
    "map": r"std::(?:multi)?map\b",
    "memory": r"std::(?:make_shared|make_unique|shared_ptr|unique_ptr)\b",
    "optional": r"std::(?:make_optional|nullopt|optional)\b",
    "set": r"std::(?:multi)?set\b",
    "span": r"std::span\b",
    "string": r"std::(?:string|to_string|stoi|stoul|stod|stof|getline)\b",
    "thread": r"std::(?:thread|jthread|this_thread)\b",
    "utility": r"std::(?:as_const|exchange|pair|swap)\b",
    "vector": r"std::vector\b",
}
QUOTES_AND_COMMENTS = re.compile(r'//[^\n]*|R"re\((?:.|\n)*?\)re"|R"\((?:.|\n)*?\)"|"(?:\\.|[^"\\\n])*"')
IN_BATCHES = re.compile(r"chapters/[^/]+/((figures|measured)/[^/]+|main)\.cpp$")
# Formatted code begins what a header declares in the first column; what is nested does not.
DECLARED = re.compile(r"^(?:template <[^;{]*?>\s*)?(?:struct|class|enum class|enum|concept|using) ([A-Z]\w+)\b(?!\s*;)|"
                      r"^(?:template <[^;{]*?>\s*)?[A-Za-z][\w:<>,&* ]*[ &*]([a-z]\w*_\w+)\(", re.M)
INCLUDE = re.compile(r'^#include [<"]([^>"]+)[>"]', re.M)


def all_included(file, includes, found):
    """What the file includes, by itself and by headers of the book."""
    for header in includes.get(file, ()):
        if header not in found:
            found.add(header)
            all_included(header, includes, found)
    return found


def declared_where(text):
    """The headers of each name that the book's headers declare."""
    headers = {}
    for path, code in text.items():
        if path.endswith(".hpp") and not re.search("/(solutions|near_misses|checks)/|^tests/", path):
            for names in DECLARED.findall(QUOTES_AND_COMMENTS.sub("", code)):
                headers.setdefault(names[0] or names[1], set()).add(path)
    return headers


def own_faults(code, included, headers):
    """Names of the book's headers that the code uses without one of them; and where."""
    words = {match.group(): match for match in re.finditer(r"(?<![\w.>:])(?:[A-Z]\w+|[a-z]\w*_\w+(?=[(<]))", code)}
    for name, match in words.items():
        declares = rf"(?:struct|class|enum|using|concept|typename|[A-Z]\w+|auto) &?{name}\b|[\w>&*] [&*]?{name}\("
        if not headers.get(name, included) & included and not re.search(declares, code):
            yield match, sorted(headers[name])[0]


def main():
    os.chdir(sys.argv[1])
    text, includes = {}, {}
    for top in ("common", "chapters", "docs", "tests"):
        for folder, _, names in os.walk(top):
            for name in names if os.path.basename(folder) != "exercises" else ():
                if name.endswith((".cpp", ".hpp")):
                    path = os.path.join(folder, name)
                    with open(path, encoding="utf-8") as file:
                        text[path] = file.read()
                    includes[path] = INCLUDE.findall(text[path])
    figure_register = {f"chapters/{name}/figures.hpp": ["common/program/figure.hpp"] for name in os.listdir("chapters")}
    includes.update(figure_register)  # made by CMake
    headers = declared_where(text)
    faults = 0
    for path in sorted(text):
        code = QUOTES_AND_COMMENTS.sub(lambda match: "\n" * match.group().count("\n"), text[path])
        included = all_included(path, includes, set())
        for header, names in NAMES.items():
            used = None if header in included else re.search(names, code)
            if used:
                print(f"{path}:{code.count(chr(10), 0, used.start()) + 1}: {used.group()} without <{header}>")
                faults += 1
        for used, header in own_faults(code, included, headers) if IN_BATCHES.match(path) else ():
            print(f"{path}:{code.count(chr(10), 0, used.start()) + 1}: {used.group()} without \"{header}\"")
            faults += 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
