/// @file
/// Rays at the places where tests fail: edges and vertices.
#pragma once

#include "chapters/ch10_fast_traversal/measured/traced_scene.hpp"
#include "common/pcg32.hpp"
#include "common/random_rays.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace space::ch10 {

/// From all around, in turn at points of edges and at vertices, as near as floats come. Every other
/// pair grazes a plane across an axis, by less than a float's last place: boxes have faces there.
inline std::vector<Ray> rays_at_edges(const std::vector<Triangle>& triangles, std::size_t count,
                                      std::uint64_t seed) {
    std::vector<Ray> rays = rays_from_around(triangles, count, seed);
    Pcg32 random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const Triangle& triangle =
            triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
        Point3 aim = triangle.a;
        if (i % 2 == 0) aim += random.uniform(0.0f, 1.0f) * (triangle.b - triangle.a);
        rays[i].direction = aim - rays[i].origin;
        if (i % 4 < 2) {
            const int axis = static_cast<int>(random.below(3));
            rays[i].origin[axis] = aim[axis];
            rays[i].direction[axis] = random.uniform(-0x1p-24f, 0x1p-24f) * aim[axis];
        }
    }
    return rays;
}

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
