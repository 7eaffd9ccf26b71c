/// @file
/// Exercise 6.3, our answer.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace space {

/// A middle plane: where the ray crosses it, and the bit that flips there.
struct MiddlePlane {
    double t;
    std::uint32_t bit;
};

inline std::vector<std::uint32_t> children_along(const OrthtreeBox<3>& root, const Ray& ray) {
    double enter = ray.tmin, leave = ray.tmax;
    std::uint32_t child = 0;
    std::vector<MiddlePlane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = ray.origin[axis], direction = ray.direction[axis];
        const double low = root.min[axis], middle = root.centre()[axis], high = root.max[axis];
        const std::uint32_t bit = 1u << axis;
        if (direction == 0.0) {
            if (origin < low || origin > high) return {};
            if (origin >= middle) child |= bit;
            continue;
        }
        planes.push_back({(middle - origin) / direction, bit});
        const bool up = direction > 0.0;
        enter = std::max(enter, ((up ? low : high) - origin) / direction);
        leave = std::min(leave, ((up ? high : low) - origin) / direction);
        if (!up) child |= bit;
    }
    if (!(enter < leave)) return {};
    std::ranges::sort(planes, {}, &MiddlePlane::t);
    std::vector<std::uint32_t> children;
    double since = enter;  // the ray has been in `child`
    for (const auto& [t, bit] : planes) {
        if (t >= leave) break;
        if (t > since) {
            children.push_back(child);
            since = t;
        }
        child ^= bit;
    }
    children.push_back(child);
    return children;
}

}  // namespace space
