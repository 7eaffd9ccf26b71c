/// @file
/// The options that every chapter's program understands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace space {

/// How much a program measures: for tests (--small), for a look (--quick), for the book.
enum class Amount { small, quick, full };

/// What a program's command line says.
struct Options {
    std::string scene = {};  ///< --scene NAME, NAME:SIZE or FILE
    bool small = false;      ///< --small: counts only, in a second or two; what the tests run
    bool quick = false;      ///< --quick: fewer sizes and rounds
    bool counts = false;     ///< --counts: the full run's counts alone; with --quick, most of them
    std::filesystem::path out = ".";  ///< --out DIR: pictures, figures, results
    unsigned threads = 0;           ///< --threads N; parse_options turns 0 into the machine's count
    std::uint64_t seed = 1;         ///< --seed S
    int width = 640, height = 480;  ///< --size WxH
    std::optional<std::string> figure =
        {};  ///< --figure ID (or "all"): draw into --out and do nothing else

    Amount amount() const {
        return small ? Amount::small : quick && !counts ? Amount::quick : Amount::full;
    }
};

/// What a program brings to its command line.
struct ProgramInfo {
    std::string_view name;  ///< "ch01_naive_ray_tracing"
    std::string about;      ///< first line of --help
    Options defaults;
    std::string examples = {};  ///< last lines of --help
};

/// Parses the command line. `more` may add options of the program's own to the parser, by the
/// functions below: the header of CLI11 takes as long to compile as the rest of a program. --help
/// prints and exits 0.
/// @throws Error (usage) with one line for anything absurd
Options parse_options(int argc, char** argv, const ProgramInfo& program,
                      const std::function<void(CLI::App&)>& more = {});

inline constexpr unsigned max_threads = 1024;  ///< more is a slip of the finger

/// An option that takes a whole number from `low` to `high` in decimal: CLI11 by itself takes 010
/// for 8. `set` gets the number. @return the option, for what CLI11 has to add to it
CLI::Option* add_whole_number(CLI::App& app, const std::string& name, std::uint64_t low,
                              std::uint64_t high, std::function<void(std::uint64_t)> set,
                              const std::string& about);

/// The same into `value`, whose default --help shows.
void add_whole_number(CLI::App& app, const std::string& name, std::uint64_t low, std::uint64_t high,
                      std::size_t& value, const std::string& about);

/// An option that takes one of some names, into `value`, whose default --help shows.
void add_choice(CLI::App& app, const std::string& name, const std::vector<std::string>& names,
                std::string& value, const std::string& about);

/// --threads, --seed and --size, for programs that have other options than a chapter's.
void add_common_options(CLI::App& app, Options& options);

/// --scene list prints the scenes and exits 0, as --help does.
void list_scenes_if_asked(const Options& options);

/// Parses; --help prints and exits 0. @throws Error (usage) with one line that says what is wrong
void parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace space
