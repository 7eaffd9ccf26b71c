#include "docs/search_text.hpp"

#include "common/program/file.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <regex>
#include <set>
#include <string_view>
#include <utility>

namespace space::docs {
namespace {

/// What stands between two marks, without them; empty where there is none.
std::string_view between(std::string_view text, std::string_view open, std::string_view close) {
    const std::size_t start = text.find(open);
    if (start == text.npos) return {};
    const std::size_t first = start + open.size();
    return text.substr(first, text.find(close, first) - first);
}

/// A formula as words and signs: what one would say or type for it.
std::string plain_formula(std::string formula) {
    static const std::pair<std::regex, const char*> rules[] = {
        {std::regex(R"(\\(begin|end)\{\w+\**\}|\\(left|right|[bB]ig+[lr]?)(?![a-zA-Z]))"), ""},
        {std::regex(R"(\\(mathit|mathrm|mathbf|text|operatorname|hat|tilde|bar)(?![a-zA-Z]))"), ""},
        {std::regex(R"(\\frac\s*(\w|\{[^{}]*\})\s*(\w|\{[^{}]*\}))"), "$1 / $2"},
        {std::regex(R"(\\cdot(?![a-zA-Z]))"), "·"},
        {std::regex(R"(\\times(?![a-zA-Z]))"), "×"},
        {std::regex(R"(\\(leq?)(?![a-zA-Z]))"), "≤"},
        {std::regex(R"(\\(geq?)(?![a-zA-Z]))"), "≥"},
        {std::regex(R"(\\infty(?![a-zA-Z]))"), "∞"},
        {std::regex(R"(\\(l?dots|cdots)(?![a-zA-Z]))"), "…"},
        {std::regex(R"(\\[,;:! |])"), " "},
        {std::regex(R"(\\\\|&amp;)"), " "},
        {std::regex(R"([{}])"), ""},
        {std::regex(R"(\\(?:var)?([a-zA-Z]+))"), "$1"},
        {std::regex(R"(\s+)"), " "}};
    for (const auto& [tex, plain] : rules) formula = std::regex_replace(formula, tex, plain);
    return formula;
}

/// The text that a reader sees: no tags, no drawings, entities as characters, single spaces.
std::string visible_text(std::string_view markup) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 3> hidden{
        {{"<svg", "</svg>"}, {"<span class=\"permalink\">", "</span>"}, {"<!--", "-->"}}};
    constexpr std::array<std::pair<std::string_view, std::string_view>, 2> formulas{
        {{"\\(", "\\)"}, {"\\[", "\\]"}}};
    constexpr std::array<std::pair<std::string_view, std::string_view>, 8> entities{
        {{"&lt;", "<"},
         {"&gt;", ">"},
         {"&amp;", "&"},
         {"&quot;", "\""},
         {"&#39;", "'"},
         {"&#160;", " "},
         {"&nbsp;", " "},
         {"&ndash;", "–"}}};
    std::string text;
    const auto space = [&] {
        if (!text.empty() && text.back() != ' ') text += ' ';
    };
    const auto skip = [&](const auto& pairs, const auto& found) {
        for (const auto& [from, to] : pairs)
            if (markup.starts_with(from)) return found(from, to), true;
        return false;
    };
    while (!markup.empty()) {
        if (skip(hidden, [&](std::string_view, std::string_view close) {
                const std::size_t end = markup.find(close);
                markup.remove_prefix(end == markup.npos ? markup.size() : end + close.size());
            }))
            continue;
        if (skip(formulas, [&](std::string_view open, std::string_view close) {
                text += visible_text(plain_formula(std::string(between(markup, open, close))));
                markup.remove_prefix(open.size());
                const std::size_t end = markup.find(close);
                markup.remove_prefix(end == markup.npos ? markup.size() : end + close.size());
            }))
            continue;
        if (skip(entities, [&](std::string_view entity, std::string_view character) {
                text += character;
                markup.remove_prefix(entity.size());
            }))
            continue;
        if (markup.front() == '<') {
            const std::string_view tag = markup.substr(1, markup.find_first_of(" >") - 1);
            constexpr std::array inside_words{"b",    "/b",    "em", "/em", "code", "/code",
                                              "span", "/span", "a",  "/a",  "sub",  "sup"};
            if (std::ranges::find(inside_words, tag) == inside_words.end()) space();
            const std::size_t end = markup.find('>');
            markup.remove_prefix(end == markup.npos ? markup.size() : end + 1);
        } else {
            if (markup.front() == ' ' || markup.front() == '\n')
                space();
            else
                text += markup.front();
            markup.remove_prefix(1);
        }
    }
    if (text.ends_with(' ')) text.pop_back();
    return text;
}

}  // namespace

std::vector<SearchEntry> search_entries(const std::string& page, const std::string& file_name) {
    const std::string title = visible_text(between(page, "<div class=\"title\">", "</div></div>"));
    std::string_view rest = between(page, "<div class=\"contents\">", "<!-- contents -->");
    if (const std::size_t toc = rest.find("<div class=\"toc\">"); toc != rest.npos)
        rest = rest.substr(rest.find("</div>", toc));
    static const std::regex heading(R"(<h[1-4][^>]*>)"), anchor(R"re(( id="|href="#)([^"]+)")re");
    std::vector<SearchEntry> entries{{.page = title, .title = title, .url = file_name, .text = {}}};
    for (;;) {
        std::match_results<std::string_view::const_iterator> found;
        const bool more = std::regex_search(rest.begin(), rest.end(), found, heading);
        entries.back().text += visible_text(
            rest.substr(0, more ? static_cast<std::size_t>(found.position()) : rest.npos));
        if (!more) return entries;
        rest.remove_prefix(static_cast<std::size_t>(found.position()));
        const std::string_view element = rest.substr(0, rest.find("</h"));
        rest.remove_prefix(element.size());
        std::match_results<std::string_view::const_iterator> id;
        const bool a_section = element.find("groupheader") == element.npos &&
                               std::regex_search(element.begin(), element.end(), id, anchor);
        if (a_section)
            entries.push_back({.page = title,
                               .title = visible_text(element),
                               .url = file_name + "#" + id[2].str(),
                               .text = {}});
    }
}

void write_search_text(const std::filesystem::path& site) {
    // Lists of everything would be found by every word.
    static const std::regex no_text(
        R"(.*_source|dir_.*|annotated|classes|concepts|files|functions.*|hierarchy|namespaces|)"
        R"(namespacemembers.*|namespacespace.*|globals.*|pages)");
    static const std::regex code(R"((class|struct|concept|namespace|union).*|.*_8[ch]pp)");
    std::set<std::filesystem::path> pages;  // in the order of their names
    for (const auto& entry : std::filesystem::directory_iterator(site))
        if (entry.path().extension() == ".html" &&
            !std::regex_match(entry.path().stem().string(), no_text))
            pages.insert(entry.path());
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const auto& page : pages)
        for (const SearchEntry& entry : search_entries(read_file(page), page.filename().string()))
            if (!entry.text.empty() || entry.title != entry.page)
                all.push_back({{"page", entry.page},
                               {"title", entry.title},
                               {"url", entry.url},
                               {"text", entry.text},
                               {"book", !std::regex_match(page.stem().string(), code)}});
    write_file(site / "search_text.js", "window.bookText = " + all.dump(0) + ";\n");
}

}  // namespace space::docs
