/// @file
/// Tables and headings on the terminal.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space {

/// A table with right-aligned numbers and left-aligned words; the width of a column fits its
/// entries.
class Table {
  public:
    explicit Table(std::vector<std::string> headings) : headings_(std::move(headings)) {}
    void row(std::vector<std::string> cells);
    std::string text() const;
    std::string markdown() const;
    void print() const;  ///< to stdout

  private:
    bool is_numeric(std::size_t column) const;

    std::vector<std::string> headings_;
    std::vector<std::vector<std::string>> rows_;
};

void print_heading(const std::string& text);
/// 1234567 -> "1,234,567".
std::string with_commas(std::uint64_t number);
/// "1 ray", "1,234 rays".
std::string counted(std::uint64_t number, std::string_view noun);

}  // namespace space
