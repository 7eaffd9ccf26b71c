#include "common/program/file.hpp"

#include "common/program/error.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
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

/// The file beside the target that is to take its name; what is left of it goes with this object.
struct Part {
    std::string name;
    Descriptor descriptor{-1};

    /// Makes the directory if it is not there.
    explicit Part(const std::filesystem::path& file)
        : name(fmt::format("{}.{}.part", file.string(), ::getpid())) {
        std::error_code error;
        const auto directory = file.parent_path();
        if (!directory.empty()) std::filesystem::create_directories(directory, error);
        if (error)
            throw output_error(
                fmt::format("cannot make directory {}: {}", directory.string(), error.message()));
        if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
            throw output_error(fmt::format("cannot write {}: not a regular file",
                                           file.string()));  // renaming would replace it
        descriptor.fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        if (descriptor.fd < 0) throw cannot_write(file);
    }
    ~Part() { ::unlink(name.c_str()); }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
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
    const Part part(file);
    std::size_t size = 0;
    while (size < content.size()) {
        const ssize_t count =
            ::write(part.descriptor.fd, content.data() + size, content.size() - size);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw cannot_write(file);
        size += static_cast<std::size_t>(count);
    }
    if (::fsync(part.descriptor.fd) != 0)
        throw cannot_write(file);  // a full disk may show only here
    if (::rename(part.name.c_str(), file.c_str()) != 0) throw cannot_write(file);
}

void check_writable(const std::filesystem::path& link) {
    const std::filesystem::path file = target_of(link);
    const MissingDirectories made(file);
    const Part part(file);
}

std::filesystem::path book_root() {
    return BOOK_ROOT;
}

}  // namespace space
