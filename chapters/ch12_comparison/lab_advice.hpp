/// @file
/// What ./book lab --advise says about a mesh.
#pragma once

#include "chapters/ch12_comparison/advice.hpp"
#include "common/geometry.hpp"

#include <cstdio>
#include <span>
#include <string>

namespace space {

/// Times the machine for a tenth of a second, looks at the triangles and says which structure to
/// take, why, and what it will cost. @throws Error (usage) where none fits in the memory
void print_advice(const std::string& mesh, std::span<const Triangle> triangles,
                  const AdviceRequest& request, unsigned threads, std::FILE* out);

}  // namespace space
