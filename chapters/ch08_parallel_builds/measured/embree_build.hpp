/// @file
/// Builds by Embree, with so many threads. Without the package libembree-dev there are none.
#pragma once

#include "common/geometry.hpp"

#include <span>

namespace space::ch08 {

#ifdef BOOK_HAS_EMBREE
inline constexpr bool has_embree = true;
#else
inline constexpr bool has_embree = false;
#endif

/// With its defaults, all that rays need; the device too, as any program has to make one.
void build_with_embree(std::span<const Triangle> triangles, unsigned threads);

}  // namespace space::ch08
