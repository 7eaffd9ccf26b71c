/// @file
/// Random rays for measurements.
#pragma once

#include "common/random.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// The box of all triangles.
inline Aabb bounds(std::span<const Triangle> triangles) {
    Aabb box;
    for (const Triangle& triangle : triangles) box.extend(bounds(triangle));
    return box;
}

/// From all around, at points of the triangles' box.
inline std::vector<Ray> rays_from_around(std::span<const Triangle> triangles, std::size_t count,
                                         std::uint64_t seed) {
    const Aabb box = bounds(triangles);
    const Double3 centre(box.centroid()), half = 0.5 * Double3(box.extent());
    Pcg32 random(seed);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Double3 away = random_direction(random);
        const Point3 origin(centre + 2.0 * glm::length(half) * away);
        const Point3 aim(centre + half * Double3(random_vector(random)));
        rays.push_back({.origin = origin, .direction = aim - origin});
    }
    return rays;
}

/// From points of the triangles' box at others: closed rooms are seen from inside, too.
inline std::vector<Ray> rays_within(std::span<const Triangle> triangles, std::size_t count,
                                    std::uint64_t seed) {
    const Aabb box = bounds(triangles);
    Pcg32 random(seed);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const Point3 origin = random_point(random, box);
        rays.push_back({.origin = origin, .direction = random_point(random, box) - origin});
    }
    return rays;
}

}  // namespace space
