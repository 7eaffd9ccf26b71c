/// @file
/// Exercise 1.1, solution.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"

#include <optional>
#include <span>

namespace space {

inline std::optional<Hit> what_the_ray_sees(std::span<const Triangle> triangles, const Ray& ray) {
    std::optional<Hit> seen;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        std::optional<Hit> hit = MollerTrumbore::intersect(ray, triangles[i]);
        if (hit) hit->triangle = i;
        if (hit && (!seen || nearer(*hit, *seen))) seen = hit;
    }
    return seen;
}

}  // namespace space
