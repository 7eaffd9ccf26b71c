#include "common/program/error.hpp"

#include "common/limit_error.hpp"

#include <cstdio>
#include <new>

namespace space {

int run_program(const char* name, int (*body)(int, char**), int argc, char** argv) {
    try {
        return body(argc, argv);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return static_cast<int>(error.code());
    } catch (const LimitError& error) {
        std::fprintf(stderr, "%s: %s\n", name, error.what());
        return static_cast<int>(ExitCode::usage);
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: out of memory\n", name);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: internal error: %s\n", name, error.what());
    }
    return static_cast<int>(ExitCode::internal);
}

}  // namespace space
