/// @file
/// A directory for a while.
#pragma once

#include <filesystem>

namespace space {

/// A new empty directory that nobody else writes to; gone with its content at the end.
class TemporaryDirectory {
  public:
    /// @throws Error (bad_output)
    TemporaryDirectory();
    ~TemporaryDirectory();
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::filesystem::path& file) const {
        return path_ / file;
    }

  private:
    std::filesystem::path path_;
};

}  // namespace space
