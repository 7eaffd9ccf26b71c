/// @file
/// What a chapter's text quotes from its run: numbers, as the text writes them, and tables. The
/// text names them, \\num{ch03.deepest} and \\table{ch03.splitters}; make_site puts them in.
#pragma once

#include "common/program/provenance.hpp"
#include "common/program/report.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace space {

/// Collected by a chapter's measured code, written beside its charts. A name is given once.
class Numbers {
  public:
    /// A count, or what is computed from counts alone: the same on every machine.
    void count(const std::string& name, std::uint64_t value);
    void count(const std::string& name, double value, const std::string& text);
    /// A time, or what is computed from times.
    void time(const std::string& name, double value, const std::string& text);

    void count_table(const std::string& name, const Table& table);
    void time_table(const std::string& name, const Table& table);

    /// Writes numbers.json, and chNN_NAME.md for each table. @throws Error (bad_output)
    void write(const std::filesystem::path& out, const Provenance& run) const;

  private:
    struct Number {
        std::string name, text;
        double value;
        bool count;
    };
    struct MarkdownTable {
        std::string name, text;
        bool count;
    };
    void add(Number number);
    void add(MarkdownTable table);

    std::vector<Number> numbers_;
    std::vector<MarkdownTable> tables_;
};

/// 0.0154 -> "65", as in "one in 65".
std::string one_in(double share);
/// 0.0154 -> "1.5 %"; a whole number from 10 % on. Never "-0 %".
std::string percent(double share);
/// 0.0004 -> "4·10<sup>−4</sup>", with one digit; 0 -> "0".
std::string power_of_ten(double value);

}  // namespace space
