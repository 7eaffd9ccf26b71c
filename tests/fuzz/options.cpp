// Command lines: taken, or refused in one line.
#include "chapters/ch12_comparison/lab_options.hpp"
#include "chapters/ch12_comparison/render_options.hpp"
#include "common/program/error.hpp"
#include "tests/fuzz/kinds.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace space::fuzz {
namespace {

/// --help and lists end the program.
bool ends_program(std::string_view argument) {
    return argument.starts_with("-h") || argument.starts_with("--help") ||
           argument.ends_with("list");
}

template <class Parse>
void feed(std::string_view bytes, const Parse& parse) {
    std::vector<std::string> arguments{"program"};
    for (std::size_t end; !bytes.empty(); bytes.remove_prefix(std::min(end + 1, bytes.size()))) {
        end = std::min(bytes.find('\n'), bytes.size());
        arguments.emplace_back(bytes.substr(0, std::min(end, bytes.find('\0'))));
    }
    if (std::ranges::any_of(arguments, ends_program)) return;
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    try {
        (void)parse(static_cast<int>(arguments.size()), argv.data());
    } catch (const Error& error) {
        const std::string line = error.what();
        if (error.code() != ExitCode::usage) fail("not a usage error: " + line);
        if (line.empty() || line.find('\n') != line.npos) fail("not one line: " + line);
    }
}

}  // namespace

void feed_lab_options(std::string_view bytes) {
    feed(bytes, parse_lab_options);
}
void feed_render_options(std::string_view bytes) {
    feed(bytes, parse_render_options);
}

}  // namespace space::fuzz
