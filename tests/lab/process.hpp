/// @file
/// Running a program as its user does: a shell line in, exit code and both outputs out.
#pragma once

#include "common/program/file.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace space {

/// A directory of its own for each test, removed at its end.
class Workbench {
  public:
    Workbench() {
        std::string name = (std::filesystem::temp_directory_path() / "lab_XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::runtime_error("cannot make a temporary directory");
        directory_ = name;
    }
    ~Workbench() {
        std::error_code ignored;
        std::filesystem::remove_all(directory_, ignored);
    }
    Workbench(const Workbench&) = delete;
    Workbench& operator=(const Workbench&) = delete;

    std::filesystem::path operator/(std::string_view file) const { return directory_ / file; }

  private:
    std::filesystem::path directory_;
};

struct Ended {
    int code;  ///< exit code; 128 + signal for a program that was killed
    std::string out, err;
};

inline Ended run(const std::string& shell_line) {
    const Workbench bench;
    const std::string errors = (bench / "stderr").string();
    std::FILE* pipe = ::popen(("( " + shell_line + " ) 2>'" + errors + "'").c_str(), "r");
    if (!pipe) throw std::runtime_error("cannot run " + shell_line);
    Ended ended{};
    char buffer[4096];
    for (std::size_t count; (count = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
        ended.out.append(buffer, count);
    const int status = ::pclose(pipe);
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ended.err = read_file(errors);
    return ended;
}

}  // namespace space
