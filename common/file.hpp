/// @file
/// Whole files: read at once; written so that nobody ever sees half of one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace space {

/// @throws Error (bad_input) where the file is missing, a directory or unreadable
std::string read_file(const std::filesystem::path& file);

/// Writes beside the target, flushes and renames: after a full disk or a crash the old file stands, or none.
/// Makes the directory if it is not there. @throws Error (bad_output)
void write_file(const std::filesystem::path& file, std::string_view content);

}  // namespace space
