#include "common/options.hpp"

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/error.hpp"

namespace space {
namespace {

constexpr unsigned max_threads = 1024;
constexpr int max_side = 16384;  // pixels; a larger picture is a slip of the finger

/// "640x480" -> width and height.
std::string parse_size(const std::string& text, Options& options) {
    int width = 0, height = 0, end = 0;
    if (std::sscanf(text.c_str(), "%5dx%5d%n", &width, &height, &end) != 2 || std::size_t(end) != text.size() ||
        width < 1 || height < 1 || width > max_side || height > max_side)
        return fmt::format("--size {}: give WIDTHxHEIGHT, each from 1 to {}", text, max_side);
    options.width = width;
    options.height = height;
    return {};
}

/// CLI11 would take -1 and 10^20 for some other number of 64 bits.
std::string check_seed(const std::string& text) {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
    if (error == std::errc() && end == text.data() + text.size()) return {};
    return fmt::format("give a whole number from 0 to 2^64 - 1, not {}", text);
}

}  // namespace

void add_common_options(CLI::App& app, Options& options) {
    app.add_option("--threads", options.threads, "worker threads; default: as many as the machine has")
        ->check(CLI::Range(1u, max_threads));
    app.add_option("--seed", options.seed, "seed of everything random")->check(check_seed)->capture_default_str();
    app.add_option_function<std::string>(
           "--size",
           [&options](const std::string& text) {
               if (const std::string fault = parse_size(text, options); !fault.empty()) throw usage_error(fault);
           },
           "picture size in pixels")
        ->type_name("WxH")
        ->default_str(fmt::format("{}x{}", options.width, options.height));
}

void parse_command_line(CLI::App& app, int argc, const char* const* argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp& help) {
        std::exit(app.exit(help));
    } catch (const CLI::ParseError& error) {
        throw usage_error(fmt::format("{} (see --help)", error.what()));
    }
}

Options parse_options(int argc, char** argv, const ProgramInfo& program, const std::function<void(CLI::App&)>& more) {
    Options options = program.defaults;
    CLI::App app(program.about, program.name);
    app.add_option("--scene", options.scene, "a scene by name (NAME or NAME:SIZE) or a mesh file")->capture_default_str();
    app.add_flag("--small", options.small, "a small run that prints counts only: the same on every machine");
    app.add_flag("--quick", options.quick, "fewer sizes and rounds: minutes instead of a quarter of an hour");
    app.add_option("--out", options.out, "directory for pictures, charts and results.json")->capture_default_str();
    app.add_option("--figure", options.figure, "make one figure, or 'all', into --out and end");
    add_common_options(app, options);
    if (more) more(app);
    parse_command_line(app, argc, argv);
    if (options.threads == 0) options.threads = std::max(1u, std::thread::hardware_concurrency());
    return options;
}

}  // namespace space
