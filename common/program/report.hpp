/// @file
/// Tables and headings on the terminal.
#pragma once

#include <cstdint>
#include <span>
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

/// A table whose last columns, the times, are there only where times are shown.
class TimedTable {
  public:
    TimedTable(std::vector<std::string> counts, const std::vector<std::string>& times, bool shown)
        : shown_(shown), table_(joined(std::move(counts), times)) {}
    void row(std::vector<std::string> counts, const std::vector<std::string>& times) {
        table_.row(joined(std::move(counts), times));
    }
    const Table& table() const { return table_; }

  private:
    std::vector<std::string> joined(std::vector<std::string> counts,
                                    const std::vector<std::string>& times) const;

    bool shown_;
    Table table_;
};

/// What a mesh's reader had to remark, a line each, to stderr: what is printed may be for a pipe.
void print_remarks(std::string_view program, std::span<const std::string> remarks);

void print_heading(const std::string& text);
/// In lines of at most 100 columns, of which all but the first are indented.
std::string wrapped(std::string_view text, std::size_t indent);
/// 1234567 -> "1,234,567".
std::string with_commas(std::uint64_t number);
/// With so many digits after the point, and never "-0.0".
std::string fixed(double value, int digits);
/// "1 ray", "1,234 rays".
std::string counted(std::uint64_t number, std::string_view noun);

}  // namespace space
