/// @file
/// Running a program as its user does: words in, exit code and both outputs out. No shell takes
/// the words apart, so a path may hold blanks and any letters.
#pragma once

#include "common/program/file.hpp"
#include "common/program/temporary.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

extern "C" char** environ;

namespace space {

/// A temporary directory with a name that careless commands stumble over.
class Workbench {
  public:
    Workbench() { std::filesystem::create_directory(directory_); }
    std::filesystem::path operator/(std::string_view file) const { return directory_ / file; }

  private:
    TemporaryDirectory temporary_;
    std::filesystem::path directory_ = temporary_ / "läb bench";
};

/// The words of a command line. Text is cut at its blanks; a path is one word.
struct Command {
    std::vector<std::string> words;

    Command with(const std::string& text) const {
        Command longer = *this;
        std::istringstream stream(text);
        for (std::string word; stream >> word;) longer.words.push_back(word);
        return longer;
    }
    Command with(const char* text) const { return with(std::string(text)); }
    Command with(const std::filesystem::path& path) const { return with_word(path.string()); }
    Command with(const Command& more) const {
        Command longer = *this;
        longer.words.insert(longer.words.end(), more.words.begin(), more.words.end());
        return longer;
    }
    Command with_word(const std::string& word) const {
        Command longer = *this;
        longer.words.push_back(word);
        return longer;
    }
    /// An option and its file.
    Command with(const std::string& option, const std::filesystem::path& path) const {
        return with_word(option).with(path);
    }
    std::string text() const {
        std::string all;
        for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
        return all;
    }
};

/// The text of a table, however wide its columns are.
inline std::string with_single_blanks(const std::string& text) {
    std::string single;
    for (const char c : text)
        if (c != ' ' || !single.ends_with(' ')) single += c;
    return single;
}

struct Ended {
    int code;  ///< exit code; 128 + signal for a program that was killed
    std::string out, err;
};

/// Runs it with standard output in a file of its own, or in `out_file`.
inline Ended run(const Command& command, const std::filesystem::path& out_file = {}) {
    const Workbench bench;
    const std::filesystem::path out = out_file.empty() ? bench / "out" : out_file,
                                err = bench / "err";
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    for (const auto& [fd, file] : {std::pair(STDOUT_FILENO, &out), std::pair(STDERR_FILENO, &err)})
        ::posix_spawn_file_actions_addopen(&actions, fd, file->c_str(),
                                           O_WRONLY | O_CREAT | O_TRUNC, 0666);
    std::vector<std::string> words = command.words;
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    const int failed =
        ::posix_spawnp(&child, argv.front(), &actions, nullptr, argv.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failed) throw std::runtime_error("cannot run " + command.text());
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
            out_file.empty() ? read_file(out) : std::string(), read_file(err)};
}

}  // namespace space
