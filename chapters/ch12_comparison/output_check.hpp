/// @file
/// What is asked of an output file before long work.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace space {

/// The same file, or the same place where there is none yet.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// @throws Error (usage) where what is printed goes into one of the inputs; empty paths are none
void check_inputs_unprinted(std::span<const std::filesystem::path> inputs);

/// @throws Error (usage) for a file that is one of the inputs or that what is printed goes to, too;
/// (bad_output) for one that cannot be written. `option` names it.
void check_output(std::string_view option, const std::filesystem::path& file,
                  std::span<const std::filesystem::path> inputs);

/// What a name of a file lacks, for the parser of options: letters, or the ending, such as ".png",
/// in whatever case. Empty where it lacks nothing.
std::string name_fault(const std::string& name, std::string_view ending = "");

}  // namespace space
