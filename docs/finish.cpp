#include "docs/finish.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
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

std::string inline_drawings(const std::string& page, const std::filesystem::path& folder) {
    std::set<std::string> ids;
    return replace_between(
        page, "<object type=\"image/svg+xml\"", "</object>", [&](std::string_view object) {
            const std::filesystem::path file = folder / attribute(object, "data");
            const std::string drawing = svg_element(file);
            std::string_view rest = drawing;
            for (std::size_t at; (at = rest.find(" id=\"")) != rest.npos;
                 rest.remove_prefix(at + 5))
                if (const std::string id = attribute(rest.substr(at), "id"); !ids.insert(id).second)
                    throw input_error(fmt::format(
                        "{}: the page already has an element with the id {}", file.string(), id));
            return drawing + list_of_steps(drawing);
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

std::string without_summary(const std::string& page) {
    return replace_between(page, "<div class=\"summary\">", "</div>",
                           [](std::string_view) { return ""; });
}

void finish_pages(const std::filesystem::path& site) {
    for (const auto& entry : std::filesystem::directory_iterator(site))
        if (entry.path().extension() == ".html")
            write_file(
                entry.path(),
                without_summary(dedent_fragments(inline_drawings(read_file(entry.path()), site))));
}

}  // namespace space::docs
