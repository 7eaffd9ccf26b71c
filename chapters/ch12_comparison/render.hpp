/// @file
/// Pictures over any structure of the lab: ./book render.
#pragma once

#include "chapters/ch12_comparison/structures.hpp"

#include <span>

namespace space {

/// The command line `render ...`. Returns 128 + the signal where SIGINT or SIGTERM ended it.
/// @throws Error
int run_render(std::span<const Structure> structures, int argc, char** argv);

}  // namespace space
