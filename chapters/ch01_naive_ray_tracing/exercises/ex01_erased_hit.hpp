/// @file
/// Exercise 1.1: The erased hit
/// Difficulty 1 of 3, about 10 minutes.
///
/// Algorithm 1 of Heinonen16 sets the background inside its loop over the polygons. Here is that
/// loop: it forgets a hit as soon as a later triangle is missed. Mend it, so that it returns the
/// nearest hit of the ray with all triangles, or nothing if there is none. Of two hits with the
/// same t the triangle with the smaller index counts: see nearer().
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
        seen = hit;  // TODO: a miss must not erase what was found before, nor a hit that is farther
                     // away
    }
    return seen;
}

}  // namespace space
