/// @file
/// What counts as a wrong answer to rays at edges and vertices.
#pragma once

#include "chapters/ch10_fast_traversal/measured/traced_scene.hpp"

#include <cstddef>
#include <cstdint>

namespace space::ch10 {

/// Hits where there are none, none where there are hits, and hits behind what is hit: farther by
/// more than a thousandth of the way. (So close together no two surfaces of these scenes lie, and
/// errors of t are far smaller.)
inline std::uint64_t wrong_hits(const Answers& got, const Answers& wanted) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        count += got[i].has_value() != wanted[i].has_value() ||
                 (got[i] && got[i]->t > wanted[i]->t * (1.0f + 0x1p-10f));
    return count;
}

}  // namespace space::ch10
