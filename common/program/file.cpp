#include "common/program/file.hpp"

#include "common/program/error.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

namespace space {
namespace {

/// A file descriptor that closes itself.
struct Descriptor {
    int fd;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

std::string fault() {
    return std::strerror(errno);
}

Error cannot_write(const std::filesystem::path& file) {
    return output_error(fmt::format("cannot write {}: {}", file.string(), fault()));
}

/// Where a link to a file leads: the link stays, and what it names is written.
std::filesystem::path target_of(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_symlink(file, error) || !std::filesystem::is_regular_file(file, error))
        return file;
    return std::filesystem::canonical(file);
}

/// What is to take the target's name. Where the file system knows files without a name it has none
/// until it is whole, so that nothing is left of a program that is killed; elsewhere it stands
/// beside the target from the start. What is left of it goes with this object.
class Part {
  public:
    /// Makes the directory if it is not there.
    explicit Part(const std::filesystem::path& file)
        : file_(file), name_(fmt::format("{}.{}.part", file.string(), ::getpid())) {
        std::error_code error;
        const auto directory = file.parent_path();
        if (!directory.empty()) std::filesystem::create_directories(directory, error);
        if (error)
            throw output_error(
                fmt::format("cannot make directory {}: {}", directory.string(), error.message()));
        if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
            throw output_error(fmt::format("cannot write {}: not a regular file",
                                           file.string()));  // renaming would replace it
        if (::access("/proc/self/fd", X_OK) == 0)
            descriptor_.fd = ::open(directory.empty() ? "." : directory.c_str(),
                                    O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
        is_named_ = descriptor_.fd < 0;
        if (is_named_)
            descriptor_.fd = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor_.fd < 0) throw cannot_write(file);
    }
    ~Part() { ::unlink(name_.c_str()); }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;

    int descriptor() const { return descriptor_.fd; }

    /// Makes the name that will be the target's.
    void name() {
        if (std::exchange(is_named_, true)) return;
        ::unlink(name_.c_str());  // of a program that was killed, and had this one's number
        const std::string place = fmt::format("/proc/self/fd/{}", descriptor_.fd);
        if (::linkat(AT_FDCWD, place.c_str(), AT_FDCWD, name_.c_str(), AT_SYMLINK_FOLLOW) != 0)
            throw cannot_write(file_);
    }
    void take_place() {
        name();
        if (::rename(name_.c_str(), file_.c_str()) != 0) throw cannot_write(file_);
    }

  private:
    std::filesystem::path file_;
    std::string name_;
    Descriptor descriptor_{-1};
    bool is_named_ = false;
};

/// The directories above a file that are not there yet: once made they go with this object, if they
/// are empty.
struct MissingDirectories {
    std::vector<std::filesystem::path> paths;  ///< the lowest first

    explicit MissingDirectories(const std::filesystem::path& file) {
        std::error_code error;
        for (auto path = file.parent_path(); !path.empty() && !std::filesystem::exists(path, error);
             path = path.parent_path())
            paths.push_back(path);
    }
    ~MissingDirectories() {
        std::error_code error;
        for (const auto& path : paths) std::filesystem::remove(path, error);
    }
    MissingDirectories(const MissingDirectories&) = delete;
    MissingDirectories& operator=(const MissingDirectories&) = delete;
};

}  // namespace

std::string read_file(const std::filesystem::path& file) {
    const Descriptor descriptor{
        ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};  // a pipe must not wait
    if (descriptor.fd < 0) throw input_error(fmt::format("{}: {}", file.string(), fault()));
    struct stat status {};
    if (::fstat(descriptor.fd, &status) != 0)
        throw input_error(fmt::format("{}: {}", file.string(), fault()));
    if (!S_ISREG(status.st_mode))
        throw input_error(fmt::format("{}: not a regular file", file.string()));
    std::string content(static_cast<std::size_t>(status.st_size), '\0');
    std::size_t size = 0;
    while (size < content.size()) {
        const ssize_t count = ::read(descriptor.fd, content.data() + size, content.size() - size);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw input_error(fmt::format("{}: {}", file.string(), fault()));
        if (count == 0) break;  // the file shrank meanwhile
        size += static_cast<std::size_t>(count);
    }
    content.resize(size);
    return content;
}

void write_file(const std::filesystem::path& link, std::string_view content) {
    const std::filesystem::path file = target_of(link);
    Part part(file);
    std::size_t size = 0;
    while (size < content.size()) {
        const ssize_t count =
            ::write(part.descriptor(), content.data() + size, content.size() - size);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw cannot_write(file);
        size += static_cast<std::size_t>(count);
    }
    if (::fsync(part.descriptor()) != 0)
        throw cannot_write(file);  // a full disk may show only here
    part.take_place();
}

void check_writable(const std::filesystem::path& link) {
    const std::filesystem::path file = target_of(link);
    const MissingDirectories made(file);
    Part part(file);
    part.name();
}

std::filesystem::path book_root() {
    return BOOK_ROOT;
}

}  // namespace space
