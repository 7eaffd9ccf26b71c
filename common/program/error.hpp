/// @file
/// Errors that a user can cause, and the exit codes that tell them apart.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace space {

/// How a program ended, for scripts.
enum class ExitCode : int {
    ok = 0,
    wrong_answer = 1,  ///< the program ran, and found a disagreement or a failed check
    usage = 2,         ///< unknown option, absurd value
    bad_input = 3,     ///< a file that is missing, broken or holds nothing usable
    bad_output = 4,    ///< a file that cannot be written: no directory, no permission, disk full
    internal = 70,     ///< a fault of ours
};

/// Carries one clear line that names the file or option, the place in it and the fault.
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, const std::string& line) : std::runtime_error(line), code_(code) {}
    ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

inline Error usage_error(const std::string& line) {
    return {ExitCode::usage, line};
}
inline Error input_error(const std::string& line) {
    return {ExitCode::bad_input, line};
}
inline Error output_error(const std::string& line) {
    return {ExitCode::bad_output, line};
}

/// Runs a program's body; an Error becomes one line on stderr, "NAME: line", and its exit code; so
/// does a LimitError, whose exit code is that of an absurd value.
int run_program(std::string_view name, int (*body)(int, char**), int argc, char** argv);

}  // namespace space
