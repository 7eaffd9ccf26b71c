/// @file
/// The lab: any structure of the book on a mesh and rays of one's own, measured side by side and
/// checked.
#pragma once

#include "chapters/ch12_comparison/structures.hpp"

#include <span>

namespace space {

/// The command line `lab ...`. --check trusts the first structure with its first test. Returns 1
/// where a structure disagrees with it, or gave up.
/// @throws Error
int run_lab(std::span<const Structure> structures, int argc, char** argv);

/// Prints the table of --structure list. @return exit code 0
int list_structures(std::span<const Structure> structures);

}  // namespace space
