#include "docs/finish.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace space::docs {
namespace {

/// Calls `replace` with the text between each pair of marks, marks included, and puts what it
/// returns in its place.
template <class Replace>
std::string replace_between(std::string_view text, std::string_view open, std::string_view close,
                            const Replace& replace) {
    std::string result;
    for (;;) {
        const std::size_t start = text.find(open);
        const std::size_t end =
            start == text.npos ? text.npos : text.find(close, start + open.size());
        if (end == text.npos) return result.append(text);
        result.append(text.substr(0, start));
        result.append(replace(text.substr(start, end + close.size() - start)));
        text.remove_prefix(end + close.size());
    }
}

std::string attribute(std::string_view element, std::string_view name) {
    const std::string mark = fmt::format(" {}=\"", name);
    const std::size_t start = element.find(mark);
    if (start == element.npos) return {};
    const std::size_t first = start + mark.size();
    return std::string(element.substr(first, element.find('"', first) - first));
}

/// The <svg> element of a file, without the declaration before it.
std::string svg_element(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    const std::size_t start = text.find("<svg");
    if (start == std::string::npos)
        throw input_error(fmt::format("{}: no <svg> in it", file.string()));
    return text.substr(start);
}

/// What the steps of a drawing tell (common/program/svg.hpp), as a list: a reader without scripts
/// has the last step's picture and all of this. Nothing for a drawing without steps.
std::string list_of_steps(std::string_view drawing) {
    constexpr std::string_view step_mark = "<g data-first=\"", open = "<desc>", close = "</desc>";
    std::map<int, std::string> steps;
    for (std::size_t at; (at = drawing.find(step_mark)) != drawing.npos;
         drawing.remove_prefix(at + step_mark.size())) {
        const std::string_view group = drawing.substr(at);
        const std::string_view inside = group.substr(group.find('>') + 2);  // a line ends there
        if (!inside.starts_with(open)) continue;
        const std::string_view text = inside.substr(open.size());
        steps[std::stoi(attribute(group, "data-first"))] = text.substr(0, text.find(close));
    }
    if (steps.empty()) return {};
    std::string list = "<ol class=\"steps\">\n";
    for (const auto& [number, text] : steps) list += fmt::format("<li>{}</li>\n", text);
    return list + "</ol>\n";
}

}  // namespace

std::string whole_drawing(const std::filesystem::path& file) {
    const std::string drawing = svg_element(file);
    return "<div class=\"drawing\">" + drawing + "</div>\n" + list_of_steps(drawing);
}

std::string inline_drawings(const std::string& page, const std::filesystem::path& folder) {
    std::set<std::string> ids;
    return replace_between(
        page, "<object type=\"image/svg+xml\"", "</object>", [&](std::string_view object) {
            const std::filesystem::path file = folder / attribute(object, "data");
            std::string drawing = whole_drawing(file);
            std::string_view rest = drawing;
            for (std::size_t at; (at = rest.find(" id=\"")) != rest.npos;
                 rest.remove_prefix(at + 5))
                if (const std::string id = attribute(rest.substr(at), "id"); !ids.insert(id).second)
                    throw input_error(fmt::format(
                        "{}: the page already has an element with the id {}", file.string(), id));
            return drawing;
        });
}

std::string dedent_fragments(const std::string& page) {
    constexpr std::string_view line_mark = "<div class=\"line\">",
                               comment = "<span class=\"comment\">";
    return replace_between(
        page, "<div class=\"fragment\">", "</div><!-- fragment -->", [&](std::string_view quoted) {
            // Doxygen marks empty comments before a line, and a comment's indentation as part of
            // it: neither is of use.
            const std::string bare =
                replace_between(quoted, comment, "</span>", [&](std::string_view span) {
                    return span.size() == comment.size() + 7 ? std::string() : std::string(span);
                });
            const std::string even = replace_between(
                bare, fmt::format("{}{}", line_mark, comment), "/", [&](std::string_view start) {
                    const std::string_view spaces =
                        start.substr(line_mark.size() + comment.size(),
                                     start.size() - line_mark.size() - comment.size() - 1);
                    return spaces.find_first_not_of(' ') == spaces.npos
                               ? fmt::format("{}{}{}/", line_mark, spaces, comment)
                               : std::string(start);
                });
            std::string_view fragment = even;
            std::size_t indent = std::string_view::npos;
            for (std::size_t at = 0; (at = fragment.find(line_mark, at)) != fragment.npos;) {
                at += line_mark.size();
                const std::size_t text = fragment.find_first_not_of(' ', at);
                if (!fragment.substr(text).starts_with("</div>"))
                    indent = std::min(indent, text - at);  // an empty line has none
            }
            std::string result;
            for (std::size_t at; (at = fragment.find(line_mark)) != fragment.npos;) {
                result.append(fragment.substr(0, at + line_mark.size()));
                fragment.remove_prefix(at + line_mark.size());
                fragment.remove_prefix(
                    std::min({indent, fragment.find_first_not_of(' '), fragment.size()}));
            }
            return result.append(fragment);
        });
}

/// What Doxygen knows of a word in code is its spelling. So a link is kept where that is enough:
/// for types, files, constants, functions that are called and enumerators after their type's name.
/// A local variable may be spelled as a member of anything.
std::string without_guesses(const std::string& page) {
    constexpr std::string_view open = "<a class=\"code hl_", close = "</a>";
    std::string result;
    std::string_view rest = page;
    for (std::size_t at; (at = rest.find(open)) != rest.npos;) {
        result.append(rest.substr(0, at));
        rest.remove_prefix(at);
        const std::size_t end = rest.find(close);
        if (end == rest.npos) break;
        const std::string_view link = rest.substr(0, end + close.size());
        const std::string_view word = link.substr(link.find('>') + 1, end - link.find('>') - 1);
        rest.remove_prefix(link.size());
        const std::string kind = attribute(link, "class"), there = attribute(link, "href");
        const bool of_a_type = there.starts_with("struct") || there.starts_with("class");
        const bool sure =
            kind == "code hl_function"    ? rest.starts_with('(') || rest.starts_with("&lt;")
            : kind == "code hl_variable"  ? !of_a_type
            : kind == "code hl_enumvalue" ? word.find("::") != word.npos || result.ends_with("::")
                                          : true;
        result.append(sure ? link : word);
    }
    return result.append(rest);
}

namespace {

/// Words with hyphens and folders of a path in inline code, each as one.
std::string whole_words(std::string_view code) {
    constexpr std::size_t longest = 32;  // it must fit into a phone's line
    std::string result;
    while (!code.empty()) {
        const std::size_t end = std::min(code.find_first_of(" /"), code.size() - 1) + 1;
        const std::string_view piece = code.substr(0, end);
        const bool breaks = piece.find_first_of("-/") != piece.npos && piece.size() <= longest;
        result +=
            breaks ? fmt::format("<span class=\"word\">{}</span>", piece) : std::string(piece);
        code.remove_prefix(end);
    }
    return result;
}

/// A formula that is not long keeps what is written against it: "(" before, "." or "-gon" after.
std::string with_punctuation(std::string_view page) {
    constexpr std::string_view open = "\\(", close = "\\)";
    constexpr std::size_t longest = 60;
    std::string result;
    for (std::size_t at; (at = page.find(open)) != page.npos;) {
        const std::size_t end = page.find(close, at);
        if (end == page.npos) break;
        std::size_t first = at, last = end + close.size();
        const bool is_short = last - first <= longest;
        while (is_short && first > 0 && page[first - 1] == '(') --first;
        while (is_short && last < page.size() &&
               std::string_view(" \n<").find(page[last]) == std::string_view::npos)
            ++last;
        const bool is_alone = first == at && last == end + close.size();
        result.append(page.substr(0, first));
        const std::string_view formula = page.substr(first, last - first);
        result += is_alone ? std::string(formula)
                           : fmt::format("<span class=\"word\">{}</span>", formula);
        page.remove_prefix(last);
    }
    return result.append(page);
}

}  // namespace

std::string kept_together(const std::string& page) {
    constexpr std::string_view open = "<code>", close = "</code>";
    const std::string coded = replace_between(page, open, close, [&](std::string_view element) {
        const std::string_view code =
            element.substr(open.size(), element.size() - open.size() - close.size());
        return code.find('<') == code.npos ? fmt::format("{}{}{}", open, whole_words(code), close)
                                           : std::string(element);
    });
    return with_punctuation(coded);
}

std::string with_alternatives(const std::string& page) {
    return replace_between(page, "<img src=\"fig_", "</div></div>", [](std::string_view image) {
        constexpr std::string_view none = "alt=\"\"", caption = "<div class=\"caption\">\n";
        const std::size_t alt = image.find(none), text = image.find(caption);
        if (alt == image.npos || text == image.npos) return std::string(image);
        const std::string_view words = image.substr(text + caption.size());
        return fmt::format("{}alt=\"{}\"{}", image.substr(0, alt),
                           words.substr(0, words.find("</div>")), image.substr(alt + none.size()));
    });
}

std::string with_table_heads(const std::string& page) {
    return replace_between(page, "<table class=\"markdownTable\">", "</table>", [](auto table) {
        constexpr std::string_view head = "<tr class=\"markdownTableHead\">", end = "</tr>",
                                   close = "</table>";
        const std::size_t at = table.find(head), after = table.find(end, at);
        if (after == table.npos) return std::string(table);
        const std::size_t rows = after + end.size();
        return fmt::format("{}<thead>{}</thead><tbody>{}</tbody>{}", table.substr(0, at),
                           table.substr(at, rows - at),
                           table.substr(rows, table.size() - rows - close.size()), close);
    });
}

std::string menu_without_scripts(const std::string& navigation) {
    static const std::regex entry("\\n    \\[ \"([^\"]*)\", \"([^\"]*\\.html)\", null \\]");
    std::string menu = "<noscript><nav class=\"plain-menu\"><a href=\"index.html\">The book</a>";
    for (std::sregex_iterator at(navigation.begin(), navigation.end(), entry), end; at != end; ++at)
        menu += fmt::format(" <a href=\"{}\">{}</a>", at->str(2), at->str(1));
    return menu + " <a href=\"files.html\">Code</a></nav></noscript>\n";
}

std::string without_summary(const std::string& page) {
    return replace_between(page, "<div class=\"summary\">", "</div>",
                           [](std::string_view) { return ""; });
}

std::string with_live_figures(std::string page, std::span<const std::string> live) {
    constexpr std::string_view box = "<div class=\"drawing\"", head_ends = "</head>";
    for (const std::string& id : live) {
        const std::string mark =
            fmt::format("{}><svg xmlns=\"http://www.w3.org/2000/svg\" id=\"{}\"", box, id);
        if (const std::size_t at = page.find(mark); at != page.npos)
            page.insert(at + box.size(), fmt::format(" data-live=\"{}\"", id));
    }
    const bool has_any = !live.empty() && page.find(" data-live=") != page.npos;
    if (const std::size_t at = page.find(head_ends); has_any && at != page.npos)
        page.insert(
            at,
            "<link href=\"live.css\" rel=\"stylesheet\"/>\n<script src=\"live.js\"></script>\n");
    return page;
}

void finish_pages(const std::filesystem::path& site, std::span<const std::string> live) {
    const std::string menu = menu_without_scripts(read_file(site / "navtreedata.js"));
    for (const auto& entry : std::filesystem::directory_iterator(site)) {
        if (entry.path().extension() != ".html") continue;
        std::string page = read_file(entry.path());
        page = kept_together(without_guesses(dedent_fragments(without_summary(page))));
        page = inline_drawings(with_table_heads(with_alternatives(page)), site);
        page = with_live_figures(std::move(page), live);
        constexpr std::string_view content = "<div id=\"doc-content\">\n";
        if (const std::size_t at = page.find(content); at != page.npos)
            page.insert(at + content.size(), menu);
        write_file(entry.path(), page);
    }
}

}  // namespace space::docs
