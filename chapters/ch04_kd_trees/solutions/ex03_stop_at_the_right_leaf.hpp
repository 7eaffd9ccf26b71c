/// @file
/// Exercise 4.3, our answer.
#pragma once

#include "common/accelerator.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace space {

/// What the ray passes from t = enter to t = leave, both included.
struct PassedCell {
    double enter, leave;
    std::vector<std::uint32_t> triangles;
};

/// Where the ray hits a triangle.
using HitTest = std::function<std::optional<Hit>(std::uint32_t triangle)>;

inline std::optional<Hit> nearest_hit(std::span<const PassedCell> cells, const HitTest& test) {
    std::optional<Hit> nearest;
    std::set<std::uint32_t> tested;
    for (const PassedCell& cell : cells) {
        if (nearest && double{nearest->t} < cell.enter) break;
        for (const std::uint32_t triangle : cell.triangles) {
            if (!tested.insert(triangle).second) continue;
            const std::optional<Hit> hit = test(triangle);
            if (hit && (!nearest || nearer(*hit, *nearest))) nearest = hit;
        }
    }
    return nearest;
}

}  // namespace space
