/// @file
/// The landscape that chapter 5 measures and draws, and where it is seen from.
#pragma once

#include "chapters/ch05_lazy_kd_trees/heightfield.hpp"
#include "common/camera.hpp"

#include <algorithm>

namespace space::ch05 {

inline Heightfield landscape(std::uint32_t cells) {
    return Heightfield({.cells = cells, .longest_wave = std::min(1'024u, cells / 2), .seed = 12});
}

/// From the highest of some hills in one quarter, over the middle.
inline Camera from_a_hill(const Heightfield& field) {
    const std::uint32_t cells = field.config().cells, step = cells / 64;
    Point3 hill(0.0f);
    for (std::uint32_t z = cells / 2; z < cells; z += step)
        for (std::uint32_t x = step; x < cells / 2; x += step)
            if (field.point(x, z).y > hill.y) hill = field.point(x, z);
    const float far = float(cells);
    return {.eye = hill + Vector3{0.0f, 0.006f * far, 0.0f},
            .target = {0.6f * far, hill.y - 0.06f * far, 0.4f * far},
            .field_of_view = 42};
}

/// From high above onto a few patches.
inline Camera downwards(const Heightfield& field) {
    const float cells = float(field.config().cells);
    return {.eye = {0.6f * cells, 1.5f * cells, 0.6f * cells},
            .target = {0.6f * cells, 0.0f, 0.6f * cells},
            .up = {0.0f, 0.0f, -1.0f},
            .field_of_view = 5};
}

}  // namespace space::ch05
