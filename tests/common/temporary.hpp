/// @file
/// What tests of files and programs need: a child process, what went to a stream, what is in a
/// directory.
#pragma once

#include "common/program/temporary.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>

namespace space {

/// Files and directories in a directory, at any depth.
inline std::size_t entries(const std::filesystem::path& directory) {
    const std::filesystem::recursive_directory_iterator first(directory);
    return static_cast<std::size_t>(std::distance(begin(first), end(first)));
}

/// What the body writes to the file descriptor (1: stdout, 2: stderr).
template <class Body>
std::string written_to(int descriptor, const Body& body) {
    std::FILE* const file = std::tmpfile();
    if (!file) throw std::runtime_error("cannot make a temporary file");
    std::fflush(nullptr);
    const int saved = ::dup(descriptor);
    ::dup2(::fileno(file), descriptor);
    body();
    std::fflush(nullptr);
    ::dup2(saved, descriptor);
    ::close(saved);
    std::string text(static_cast<std::size_t>(::lseek(::fileno(file), 0, SEEK_END)), '\0');
    std::rewind(file);
    text.resize(std::fread(text.data(), 1, text.size(), file));
    std::fclose(file);
    return text;
}

/// The exit code of the body, run in a child process; -1 where a signal ended it.
template <class Body>
int exit_code_of(const Body& body) {
    std::fflush(nullptr);
    const pid_t child = ::fork();
    if (child == 0) {
        const int code = body();
        std::fflush(nullptr);
        ::_exit(code);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace space
