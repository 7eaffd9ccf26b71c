/// @file
/// Whole files: read at once; written so that nobody ever sees half of one.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace space {

/// @throws Error (bad_input) where the file is missing, a directory or unreadable
std::string read_file(const std::filesystem::path& file);

/// Writes a file without a name, flushes, and gives it the target's: after a full disk, a crash or
/// a kill the old file stands, or none, and nothing beside it. Makes the directory if it is not
/// there. @throws Error (bad_output)
void write_file(const std::filesystem::path& file, std::string_view content);

/// To be asked before long work: tries to make the file that write_file will write, and leaves
/// everything as it was. Whether the disk has room is not known. @throws Error (bad_output) as
/// write_file would
void check_writable(const std::filesystem::path& file);

/// The book's folder, whose sources this program was compiled from.
std::filesystem::path book_root();

}  // namespace space
