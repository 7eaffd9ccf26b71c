#include "common/program/options.hpp"

#include "common/program/error.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string_view>
#include <thread>

namespace space {
namespace {

constexpr int max_side = 16384;  // pixels; a larger picture is a slip of the finger

/// Digits and nothing else.
std::optional<std::uint64_t> whole_number(std::string_view text) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

/// "640x480" -> width and height.
void parse_size(std::string_view text, Options& options) {
    const std::size_t cross = std::min(text.find('x'), text.size());
    const auto width = whole_number(text.substr(0, cross));
    const auto height = whole_number(text.substr(std::min(cross + 1, text.size())));
    const auto fits = [](const std::optional<std::uint64_t>& side) {
        return side && *side >= 1 && *side <= max_side;
    };
    if (!fits(width) || !fits(height))
        throw usage_error(
            fmt::format("--size {}: give WIDTHxHEIGHT, each from 1 to {}", text, max_side));
    options.width = static_cast<int>(*width);
    options.height = static_cast<int>(*height);
}

/// What was asked for stands on standard output, whole; else that is told.
[[noreturn]] void end_having_told() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw output_error(
            fmt::format("cannot write to standard output: {}", std::strerror(errno)));
    std::exit(static_cast<int>(ExitCode::ok));
}

}  // namespace

CLI::Option* add_whole_number(CLI::App& app, const std::string& name, std::uint64_t low,
                              std::uint64_t high, std::function<void(std::uint64_t)> set,
                              const std::string& about) {
    const auto parse = [=](const std::string& text) {
        const auto number = whole_number(text);
        if (!number || *number < low || *number > high)
            throw usage_error(
                fmt::format("{} {}: give a whole number from {} to {}", name, text, low, high));
        set(*number);
    };
    const bool bounded = high < std::numeric_limits<std::uint64_t>::max();
    return app.add_option_function<std::string>(name, parse, about)
        ->type_name(bounded ? fmt::format("{}..{}", low, high) : "N");
}

void add_whole_number(CLI::App& app, const std::string& name, std::uint64_t low, std::uint64_t high,
                      std::size_t& value, const std::string& about) {
    add_whole_number(
        app, name, low, high, [&value](std::uint64_t n) { value = n; }, about)
        ->default_str(fmt::format("{}", value));
}

void add_choice(CLI::App& app, const std::string& name, const std::vector<std::string>& names,
                std::string& value, const std::string& about) {
    app.add_option(name, value, about)
        ->check(CLI::IsMember(names))
        ->capture_default_str()
        ->type_name("NAME");
}

void add_common_options(CLI::App& app, Options& options) {
    add_whole_number(
        app, "--threads", 1, max_threads,
        [&](std::uint64_t n) { options.threads = static_cast<unsigned>(n); },
        "worker threads; default: as many as the machine has");
    add_whole_number(
        app, "--seed", 0, std::numeric_limits<std::uint64_t>::max(),
        [&](std::uint64_t n) { options.seed = n; }, "seed of everything random")
        ->default_str(fmt::format("{}", options.seed));
    app.add_option_function<std::string>(
           "--size", [&](const std::string& text) { parse_size(text, options); },
           "picture size in pixels")
        ->type_name("WxH")
        ->default_str(fmt::format("{}x{}", options.width, options.height));
}

void parse_command_line(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        app.exit(help);
        end_having_told();
    } catch (const CLI::ExtrasError&) {
        const std::vector<std::string> unknown = app.remaining();
        throw usage_error(
            fmt::format("{}: there is no such option (see --help)", fmt::join(unknown, " ")));
    } catch (const CLI::ArgumentMismatch& error) {
        const std::string what = error.what(), option = what.substr(0, what.find(':'));
        const bool twice = what.find("At Most 1") != std::string::npos;
        throw usage_error(fmt::format("{}: {} (see --help)", option,
                                      twice ? "give it once" : "its value is missing"));
    } catch (const CLI::ParseError& error) {
        throw usage_error(fmt::format("{} (see --help)", error.what()));
    }
}

void list_scenes_if_asked(const Options& options) {
    if (options.scene != "list") return;
    Table table({"scene", "size", "largest", "what it is"});
    for (const SceneRecipe& recipe : scene_recipes())
        table.row({std::string(recipe.name),
                   recipe.default_size ? with_commas(recipe.default_size) : "",
                   recipe.max_size ? with_commas(recipe.max_size) : "", std::string(recipe.about)});
    table.print();
    end_having_told();
}

Options parse_options(int argc, char** argv, const ProgramInfo& program,
                      const std::function<void(CLI::App&)>& more) {
    Options options = program.defaults;
    // From the book's folder, where the pages' commands are typed, nothing is left outside of
    // build.
    if (options.out == ".") options.out = fmt::format("build/out/{}", program.name.substr(0, 4));
    CLI::App app(program.about, std::string(program.name));
    app.add_option("--scene", options.scene,
                   "a scene by name (NAME or NAME:SIZE), a mesh file, or 'list'")
        ->capture_default_str();
    app.add_flag("--small", options.small,
                 "a small run that prints counts only: the same on every machine");
    app.add_flag("--quick", options.quick,
                 "fewer sizes and rounds: minutes instead of a quarter of an hour");
    app.add_flag("--counts", options.counts,
                 "the full run's counts, without its times: numbers.json and tables; with --quick "
                 "those that take seconds")
        ->excludes("--small");
    app.add_option("--out", options.out,
                   "directory for pictures, charts, tables, numbers and results")
        ->check([](const std::string& text) {
            return text.empty() ? "give the name of a directory" : std::string();
        })
        ->capture_default_str();
    app.add_option("--figure", options.figure, "make one figure, or 'all', into --out and end");
    add_common_options(app, options);
    if (more) more(app);
    if (!program.examples.empty()) app.footer("Examples:\n" + program.examples);
    parse_command_line(app, argc, argv);
    list_scenes_if_asked(options);
    if (options.threads == 0) options.threads = std::max(1u, std::thread::hardware_concurrency());
    return options;
}

}  // namespace space
