/// @file
/// Rays at the places where tests fail: edges and vertices.
#pragma once

#include "common/random_rays.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// Turns a ray that is aimed at a point along a plane across one of the axes, off it by less than a
/// float's last place: boxes of triangles and of nodes have faces there.
inline void graze(Ray& ray, const Point3& aim, Pcg32& random) {
    const int axis = static_cast<int>(random.below(3));
    ray.origin[axis] = aim[axis];
    ray.direction[axis] = random.uniform(-0x1p-24f, 0x1p-24f) * aim[axis];
}

/// From all around, in turn at points of edges and at vertices, as near as floats come. Every other
/// pair grazes.
inline std::vector<Ray> rays_at_edges(std::span<const Triangle> triangles, std::size_t count,
                                      std::uint64_t seed) {
    std::vector<Ray> rays = rays_from_around(triangles, count, seed);
    Pcg32 random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const Triangle& triangle =
            triangles[random.below(static_cast<std::uint32_t>(triangles.size()))];
        Point3 aim = triangle.a;
        if (i % 2 == 0) aim += random.uniform(0.0f, 1.0f) * (triangle.b - triangle.a);
        rays[i].direction = aim - rays[i].origin;
        if (i % 4 < 2) graze(rays[i], aim, random);
    }
    return rays;
}

}  // namespace space
