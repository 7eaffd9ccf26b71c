#include "common/mesh_reader/source.hpp"

#include "common/program/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace space::mesh_reader {

void Source::fail(const std::string& fault) const {
    throw input_error(fmt::format("{}: {}", name, fault));
}

std::ptrdiff_t Source::line_of(const char* where) const {
    return 1 + std::count(content.data(), where, '\n');
}

void Source::fail_at(const char* where, const std::string& fault) const {
    throw input_error(fmt::format("{}:{}: {}", name, line_of(where), fault));
}

void normalise_text(Source& source, std::size_t first, std::size_t last) {
    std::string& text = source.content;
    last = std::min(last, text.size());
    if (first == 0) {
        if (text.starts_with("\xEF\xBB\xBF")) std::fill_n(text.begin(), 3, ' ');
        if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
            source.fail("UTF-16 text is not read: save it as UTF-8");
    }
    for (std::size_t i = first; (i = text.find('\r', i)) < last; ++i)
        text[i] = text.compare(i + 1, 1, "\n") == 0 ? ' ' : '\n';
}

std::string_view take_word(std::string_view& text) {
    std::size_t first = 0;
    while (first < text.size() && is_blank(text[first])) ++first;
    std::size_t last = first;
    while (last < text.size() && !is_blank(text[last])) ++last;
    const std::string_view word = text.substr(first, last - first);
    text.remove_prefix(last);
    return word;
}

std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = char(c | 0x20);
    return lower;
}

std::string quote(std::string_view word) {
    constexpr std::size_t longest = 24;
    std::string text(word.substr(0, longest));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7F) c = '?';
    return fmt::format("'{}{}'", text, word.size() > longest ? "..." : "");
}

bool parse_integer(std::string_view word, std::int64_t& number) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc{} && end == word.data() + word.size();
}

bool parse_number(std::string_view word, double& number) {
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error == std::errc::result_out_of_range)
        number = std::strtod(std::string(word).c_str(), nullptr);
    else if (error != std::errc{})
        return false;
    return end == word.data() + word.size();
}

double parse_coordinate(const Source& source, std::string_view word, const char* where) {
    double number = 0.0;
    if (word.empty()) source.fail_at(where, "a vertex needs three coordinates");
    if (!parse_number(word, number))
        source.fail_at(where, fmt::format("{} is not a number", quote(word)));
    if (!std::isfinite(static_cast<float>(number)))
        source.fail_at(where, fmt::format("the coordinate {} is not a finite float", quote(word)));
    return number;
}

}  // namespace space::mesh_reader
