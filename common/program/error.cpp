#include "common/program/error.hpp"

#include "common/limit_error.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace space {
namespace {

/// What a body returned, unless not all that it printed could be written.
int printed(int result) {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return result;
    throw output_error(std::string("cannot write to standard output: ") + std::strerror(errno));
}

/// What an error says, in one line that a terminal survives: names come from files, and may hold
/// anything, a million letters of it. What is wrong with a name stands at the end.
std::string one_line(std::string_view text) {
    constexpr std::size_t first = 1500, last = 500;
    const bool is_long = text.size() > first + last;
    std::string line;
    const auto append = [&](std::string_view part) {
        for (const char c : part) {
            const auto code = static_cast<unsigned char>(c);
            line += code < 32 || code == 127 ? fmt::format("\\x{:02x}", code) : std::string(1, c);
        }
    };
    append(is_long ? text.substr(0, first) : text);
    if (is_long) append("...");
    if (is_long) append(text.substr(text.size() - last));
    return line;
}

void print_error(std::string_view name, std::string_view what) {
    // Where nobody can be told, the exit code stays.
    std::fputs(fmt::format("{}: {}\n", name, one_line(what)).c_str(), stderr);
}

/// A stream that was closed is closed for good: else the next file that is opened would get its
/// number, and what is printed would go there.
void keep_streams_apart() {
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(fd, F_GETFD) < 0)  // opened the wrong way round: to use it is an error
            ::open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// What the system refused, in the user's words, and the exit code.
Error refused(const std::system_error& error) {
    const std::string reason = error.code().message();
    for (const auto& [stream, called] :
         {std::pair(stdout, "standard output"), std::pair(stderr, "standard error")})
        if (std::ferror(stream))  // fmt::print throws
            return output_error(fmt::format("cannot write to {}: {}", called, reason));
    if (error.code() == std::errc::resource_unavailable_try_again)
        return {ExitCode::internal, "no more threads can be had (see --threads): " + reason};
    return {ExitCode::internal, std::string("internal error: ") + error.what()};
}

}  // namespace

int run_program(std::string_view name, int (*body)(int, char**), int argc, char** argv) {
    keep_streams_apart();
    try {
        return printed(body(argc, argv));
    } catch (const Error& error) {
        print_error(name, error.what());
        return static_cast<int>(error.code());
    } catch (const LimitError& error) {
        print_error(name, error.what());
        return static_cast<int>(ExitCode::usage);
    } catch (const std::system_error& error) {
        const Error told = refused(error);
        print_error(name, told.what());
        return static_cast<int>(told.code());
    } catch (const std::bad_alloc&) {
        print_error(name, "out of memory");
    } catch (const std::exception& error) {
        print_error(name, std::string("internal error: ") + error.what());
    }
    return static_cast<int>(ExitCode::internal);
}

}  // namespace space
