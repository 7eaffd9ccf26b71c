#include "common/program/file.hpp"

#include "common/program/error.hpp"
#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace space {
namespace {

/// The one line and the exit code of the error that the body throws.
template <class Body>
std::string error_of(ExitCode code, const Body& body) {
    try {
        body();
    } catch (const Error& error) {
        CHECK(error.code() == code);
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
        return error.what();
    }
    FAIL_CHECK("no error");
    return {};
}

/// For its lifetime no file may grow beyond so many bytes: a full disk, for whoever may run the
/// tests.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        rlimit limit = before_;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, signal_);
    }

  private:
    rlimit before_{};
    void (*signal_)(int);
};

}  // namespace

TEST_CASE("what is written is read back, byte for byte, empty files too") {
    const TemporaryDirectory directory;
    std::string content("a\0b\r\n\xff", 6);
    content += std::string(1 << 20, 'x');
    for (const std::string& text : {content, std::string()}) {
        write_file(directory.path() / "file", text);
        CHECK(read_file(directory.path() / "file") == text);
    }
    CHECK(entries(directory.path()) == 1);
}

TEST_CASE("a missing directory is made, an old file replaced") {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "one" / "two" / "file";
    write_file(file, "old and longer");
    write_file(file, "new");
    CHECK(read_file(file) == "new");
    CHECK(entries(directory.path()) == 3);
}

TEST_CASE("what a link names is written, and the link stays") {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "file", link = directory.path() / "link";
    write_file(file, "old");
    std::filesystem::create_symlink("file", link);
    check_writable(link);
    write_file(link, "new");
    CHECK(std::filesystem::is_symlink(link));
    CHECK(read_file(file) == "new");
    CHECK(entries(directory.path()) == 2);
}

TEST_CASE("reading what cannot be read names the file and the fault") {
    const TemporaryDirectory directory;
    const std::string missing = (directory.path() / "none").string();
    CHECK(error_of(ExitCode::bad_input, [&] { read_file(missing); }) ==
          missing + ": No such file or directory");
    CHECK(error_of(ExitCode::bad_input, [&] { read_file(directory.path()); }) ==
          directory.path().string() + ": not a regular file");
    CHECK(error_of(ExitCode::bad_input, [] { read_file("/dev/zero"); }) ==
          "/dev/zero: not a regular file");
    CHECK(error_of(ExitCode::bad_input, [] { read_file(""); }).find("No such file") !=
          std::string::npos);
}

TEST_CASE(
    "on a full disk the error says so, the old file stands, and no part of the new one is left") {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "file";
    const std::string large(1 << 16, 'x');
    std::string line;
    {
        const FullDisk full(1 << 12);
        line = error_of(ExitCode::bad_output, [&] { write_file(file, large); });
    }
    CHECK(line == "cannot write " + file.string() + ": File too large");
    CHECK(entries(directory.path()) == 0);

    write_file(file, "old");
    {
        const FullDisk full(1 << 12);
        line = error_of(ExitCode::bad_output, [&] { write_file(file, large); });
    }
    CHECK(read_file(file) == "old");
    CHECK(entries(directory.path()) == 1);
}

TEST_CASE(
    "a program that is killed in the middle of writing leaves the old file, and no part of the "
    "new") {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "file";
    write_file(file, "old");
    const pid_t child = ::fork();
    if (child == 0) {
        const rlimit no_core{}, small{1 << 12, RLIM_INFINITY};
        ::setrlimit(RLIMIT_CORE, &no_core);
        ::setrlimit(RLIMIT_FSIZE, &small);  // whose signal ends the program
        std::signal(SIGXFSZ, SIG_DFL);
        write_file(file, std::string(1 << 16, 'x'));
        ::_exit(0);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    CHECK(read_file(file) == "old");
    const int nameless = ::open(directory.path().c_str(), O_WRONLY | O_TMPFILE, 0600);
    if (nameless < 0) return;  // this file system has no files without names
    ::close(nameless);
    CHECK(entries(directory.path()) == 1);
}

TEST_CASE("what is no regular file is not written over") {
    const TemporaryDirectory directory;
    CHECK(error_of(ExitCode::bad_output, [&] {
              write_file(directory.path(), "x");
          }).find("not a regular file") != std::string::npos);
    CHECK(error_of(ExitCode::bad_output, [] { write_file("/dev/full", "x"); }) ==
          "cannot write /dev/full: not a regular file");
    struct stat status {};
    REQUIRE(::stat("/dev/full", &status) == 0);
    CHECK(S_ISCHR(status.st_mode));
}

TEST_CASE("a directory that cannot be made is an error that names it") {
    const TemporaryDirectory directory;
    write_file(directory.path() / "file", "x");
    const auto below = directory.path() / "file" / "below";
    const std::string line =
        error_of(ExitCode::bad_output, [&] { write_file(below / "new", "x"); });
    CHECK(line == "cannot make directory " + below.string() + ": Not a directory");
    CHECK(error_of(ExitCode::bad_output, [] {
              write_file("/proc/none/file", "x");
          }).find("/proc/none") != std::string::npos);
    CHECK(entries(directory.path()) == 1);
}

TEST_CASE(
    "what will not be writable is refused beforehand as it would be later, and what will be leaves "
    "no trace") {
    const TemporaryDirectory directory;
    const auto old = directory.path() / "old";
    write_file(old, "old");
    for (const auto& file :
         {old, directory.path() / "new", directory.path() / "one" / "two" / "new"})
        check_writable(file);
    CHECK(entries(directory.path()) == 1);
    CHECK(read_file(old) == "old");

    for (const std::filesystem::path& file :
         {directory.path(), old / "new", old / "below" / "new",
          directory.path() / "one" / std::string(300, 'x'), std::filesystem::path("/dev/full"),
          std::filesystem::path("/proc/none/file")}) {
        const std::string line = error_of(ExitCode::bad_output, [&] { check_writable(file); });
        CHECK(entries(directory.path()) == 1);  // no "one"
        CHECK(line == error_of(ExitCode::bad_output, [&] { write_file(file, "x"); }));
        std::filesystem::remove(directory.path() / "one");
    }
}

}  // namespace space
