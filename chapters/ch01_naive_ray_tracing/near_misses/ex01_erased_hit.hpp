/// @file
/// Exercise 1.1, a near miss: nothing is erased any more, but the first hit in the list is taken
/// for the nearest.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"

#include <optional>
#include <span>

namespace space {

inline std::optional<Hit> what_the_ray_sees(std::span<const Triangle> triangles, const Ray& ray) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        std::optional<Hit> hit = MollerTrumbore::intersect(ray, triangles[i]);
        if (!hit) continue;
        hit->triangle = i;
        return hit;
    }
    return std::nullopt;
}

}  // namespace space
