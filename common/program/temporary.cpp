#include "common/program/temporary.hpp"

#include "common/program/error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace space {

TemporaryDirectory::TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "splitting_space_XXXXXX").string();
    if (!::mkdtemp(name.data()))
        throw output_error(
            fmt::format("{}: cannot make a temporary directory: {}", name, std::strerror(errno)));
    path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace space
