/// @file
/// A text of the book as one line, and the ways in which texts write numbers: for tests that
/// compute what a text says.
#pragma once

#include "common/program/file.hpp"
#include "tests/catch.hpp"

#include <fmt/format.h>

#include <regex>
#include <string>

namespace space {

/// What a text says, wherever its lines end.
class Text {
  public:
    /// A file by its path from the root.
    explicit Text(const std::string& file)
        : text_(std::regex_replace(read_file(book_root() / file), std::regex(R"(\s+)"), " ")) {}
    void check_says(const std::string& words) const {
        INFO(words);
        CHECK(text_.find(words) != std::string::npos);
    }

  private:
    std::string text_;
};

/// 2.5e-8 as "2.5 \cdot 10^{-8}".
inline std::string power(double value, int digits = 1) {
    const std::string number = fmt::format("{:.{}e}", value, digits);
    const std::size_t e = number.find('e');
    return fmt::format("{} \\cdot 10^{{{}}}", number.substr(0, e), std::stoi(number.substr(e + 1)));
}
inline std::string formula(const std::string& tex) {
    return "\\f$" + tex + "\\f$";
}

}  // namespace space
