#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace space {
namespace {

/// Characters that a terminal shows: UTF-8 bytes that begin one.
std::size_t shown_width(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

bool looks_like_number(const std::string& cell) {
    return !cell.empty() && cell.find_first_not_of("0123456789.,+-eE%x ") == std::string::npos;
}

}  // namespace

void Table::row(std::vector<std::string> cells) {
    cells.resize(headings_.size());
    rows_.push_back(std::move(cells));
}

bool Table::is_numeric(std::size_t column) const {
    return !rows_.empty() && std::ranges::all_of(rows_, [&](const auto& row) {
        return row[column].empty() || row[column] == "-" || looks_like_number(row[column]);
    });
}

std::string Table::text() const {
    std::vector<std::size_t> widths;
    std::vector<bool> numeric;
    for (std::size_t column = 0; column < headings_.size(); ++column) {
        std::size_t width = shown_width(headings_[column]);
        for (const auto& row : rows_) width = std::max(width, shown_width(row[column]));
        widths.push_back(width);
        numeric.push_back(is_numeric(column));
    }
    const auto line = [&](const std::vector<std::string>& cells) {
        std::string result;
        for (std::size_t column = 0; column < cells.size(); ++column) {
            const std::string padding(widths[column] - shown_width(cells[column]), ' ');
            result += column ? "  " : "";
            result += numeric[column] ? padding + cells[column] : cells[column] + padding;
        }
        result.erase(result.find_last_not_of(' ') + 1);
        return result + '\n';
    };
    std::string result = line(headings_);
    std::vector<std::string> rule;
    for (const std::size_t width : widths) rule.push_back(std::string(width, '-'));
    result += line(rule);
    for (const auto& row : rows_) result += line(row);
    return result;
}

std::string Table::markdown() const {
    const auto line = [](const std::vector<std::string>& cells) {
        return fmt::format("| {} |\n", fmt::join(cells, " | "));
    };
    std::vector<std::string> rule;
    for (std::size_t column = 0; column < headings_.size(); ++column)
        rule.emplace_back(is_numeric(column) ? "--:" : "---");
    std::string result = line(headings_) + line(rule);
    for (const auto& row : rows_) result += line(row);
    return result;
}

void Table::print() const {
    fmt::print("{}", text());
}

std::vector<std::string> TimedTable::joined(std::vector<std::string> counts,
                                            const std::vector<std::string>& times) const {
    if (shown_) counts.insert(counts.end(), times.begin(), times.end());
    return counts;
}

void print_remarks(std::string_view program, std::span<const std::string> remarks) {
    for (const std::string& remark : remarks)
        std::fputs(fmt::format("{}: note: {}\n", program, remark).c_str(), stderr);
}

void print_heading(const std::string& text) {
    fmt::print("\n{}\n{}\n", text, std::string(shown_width(text), '='));
}

std::string wrapped(std::string_view text, std::size_t indent) {
    constexpr std::size_t columns = 100;
    std::string result;
    for (std::size_t width = columns; shown_width(std::string(text)) > width;
         width = columns - indent) {
        const std::size_t blank = text.find_last_of(' ', width);
        if (blank == text.npos) break;
        result += fmt::format("{}\n{}", text.substr(0, blank), std::string(indent, ' '));
        text.remove_prefix(blank + 1);
    }
    return result.append(text);
}

std::string with_commas(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t end = digits.size(); end > 3; end -= 3) digits.insert(end - 3, 1, ',');
    return digits;
}

std::string fixed(double value, int digits) {
    if (std::abs(value) < 0.5 * std::pow(10.0, -digits)) value = 0.0;
    return fmt::format("{:.{}f}", value, digits);
}

std::string counted(std::uint64_t number, std::string_view noun) {
    return fmt::format("{} {}{}", with_commas(number), noun, number == 1 ? "" : "s");
}

}  // namespace space
