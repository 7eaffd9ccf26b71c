#include "common/file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "common/error.hpp"

namespace space {
namespace {

/// A file descriptor that closes itself.
struct Descriptor {
    int fd;
    ~Descriptor() {
        if (fd >= 0) ::close(fd);
    }
};

std::string fault() { return std::strerror(errno); }

}  // namespace

std::string read_file(const std::filesystem::path& file) {
    const Descriptor descriptor{::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};  // a pipe must not wait
    if (descriptor.fd < 0) throw input_error(fmt::format("{}: {}", file.string(), fault()));
    struct stat status {};
    if (::fstat(descriptor.fd, &status) != 0) throw input_error(fmt::format("{}: {}", file.string(), fault()));
    if (!S_ISREG(status.st_mode)) throw input_error(fmt::format("{}: not a regular file", file.string()));
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

void write_file(const std::filesystem::path& file, std::string_view content) {
    const auto fail = [&] { return output_error(fmt::format("cannot write {}: {}", file.string(), fault())); };
    std::error_code error;
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), error);
    if (error) throw output_error(fmt::format("cannot make directory {}: {}", file.parent_path().string(), error.message()));
    if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
        throw output_error(fmt::format("cannot write {}: not a regular file", file.string()));  // renaming would replace it

    const std::string temporary = fmt::format("{}.{}.part", file.string(), ::getpid());
    bool written = false;
    {
        const Descriptor descriptor{::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
        if (descriptor.fd < 0) throw fail();
        std::size_t size = 0;
        while (size < content.size()) {
            const ssize_t count = ::write(descriptor.fd, content.data() + size, content.size() - size);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) break;
            size += static_cast<std::size_t>(count);
        }
        written = size == content.size() && ::fsync(descriptor.fd) == 0;  // a full disk may show only here
    }
    if (!written || ::rename(temporary.c_str(), file.c_str()) != 0) {
        const int reason = errno;
        ::unlink(temporary.c_str());
        errno = reason;
        throw fail();
    }
}

}  // namespace space
