#include "common/program/error.hpp"

#include "common/limit_error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>

namespace space {
namespace {

/// What a body returned, unless not all that it printed could be written.
int printed(int result) {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return result;
    throw output_error(std::string("cannot write to standard output: ") + std::strerror(errno));
}

}  // namespace

int run_program(std::string_view name, int (*body)(int, char**), int argc, char** argv) {
    const int length = static_cast<int>(name.size());
    try {
        return printed(body(argc, argv));
    } catch (const Error& error) {
        std::fprintf(stderr, "%.*s: %s\n", length, name.data(), error.what());
        return static_cast<int>(error.code());
    } catch (const LimitError& error) {
        std::fprintf(stderr, "%.*s: %s\n", length, name.data(), error.what());
        return static_cast<int>(ExitCode::usage);
    } catch (const std::system_error& error) {
        const bool printing = std::ferror(stdout) != 0;  // fmt::print throws
        std::fprintf(stderr, "%.*s: %s%s\n", length, name.data(),
                     printing ? "cannot write to standard output: " : "internal error: ",
                     printing ? error.code().message().c_str() : error.what());
        if (printing) return static_cast<int>(ExitCode::bad_output);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%.*s: out of memory\n", length, name.data());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%.*s: internal error: %s\n", length, name.data(), error.what());
    }
    return static_cast<int>(ExitCode::internal);
}

}  // namespace space
