#include "common/program/error.hpp"

#include "common/limit_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

namespace space {
namespace {

/// What a body returned, unless not all that it printed could be written.
int printed(int result) {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return result;
    throw output_error(std::string("cannot write to standard output: ") + std::strerror(errno));
}

/// What an error says, in one line that a terminal survives: names come from files, and may hold
/// anything, a million letters of it.
std::string one_line(std::string_view text) {
    constexpr std::size_t longest = 2000;
    std::string line;
    for (const char c : text.substr(0, longest)) {
        const auto code = static_cast<unsigned char>(c);
        line += code < 32 || code == 127 ? fmt::format("\\x{:02x}", code) : std::string(1, c);
    }
    return text.size() > longest ? line + "..." : line;
}

void print_error(std::string_view name, std::string_view what) {
    fmt::print(stderr, "{}: {}\n", name, one_line(what));
}

}  // namespace

int run_program(std::string_view name, int (*body)(int, char**), int argc, char** argv) {
    try {
        return printed(body(argc, argv));
    } catch (const Error& error) {
        print_error(name, error.what());
        return static_cast<int>(error.code());
    } catch (const LimitError& error) {
        print_error(name, error.what());
        return static_cast<int>(ExitCode::usage);
    } catch (const std::system_error& error) {
        const bool printing = std::ferror(stdout) != 0;  // fmt::print throws
        print_error(name, printing ? "cannot write to standard output: " + error.code().message()
                                   : std::string("internal error: ") + error.what());
        if (printing) return static_cast<int>(ExitCode::bad_output);
    } catch (const std::bad_alloc&) {
        print_error(name, "out of memory");
    } catch (const std::exception& error) {
        print_error(name, std::string("internal error: ") + error.what());
    }
    return static_cast<int>(ExitCode::internal);
}

}  // namespace space
