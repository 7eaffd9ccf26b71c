/// @file
/// Exercise 4.3: Stop at the right leaf
/// Difficulty 2 of 3, about 30 minutes.
///
/// A ray passes the cells of a k-d tree in the order in which it comes to them; each begins where
/// the one before it ends. `test` says where the ray hits a triangle, if it does. A triangle may be
/// named by several cells, and its hit may lie far beyond the cell in hand, with nearer triangles
/// in between. Return the nearest hit, and do no more work than it needs: open no cell once no hit
/// in it can come before the best so far in the order of `nearer`, which on a common border asks
/// for the smaller index; and test no triangle twice. The check sees what you test. Each call is
/// one ray, and threads may trace rays at the same time.
#pragma once

#include "common/accelerator.hpp"

#include <cstdint>
#include <functional>
#include <optional>
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
    // TODO: this opens all cells, and tests what several of them name again and again
    std::optional<Hit> nearest;
    for (const PassedCell& cell : cells)
        for (const std::uint32_t triangle : cell.triangles) {
            const std::optional<Hit> hit = test(triangle);
            if (hit && (!nearest || nearer(*hit, *nearest))) nearest = hit;
        }
    return nearest;
}

}  // namespace space
