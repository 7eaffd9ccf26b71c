/// @file
/// The triangles of a tree in the order of its leaves.
#pragma once

#include "common/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

// [place]
/// Copies of triangles in the order in which a tree's references first name them: what a ray meets
/// one after the other lies together in memory.
struct PlacedTriangles {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> places;  ///< of the references, in these

    static PlacedTriangles of(std::span<const Triangle> all,
                              std::span<const std::uint32_t> references) {
        constexpr std::uint32_t nowhere = ~0u;
        PlacedTriangles placed;
        std::vector<std::uint32_t> place_of(all.size(), nowhere);
        for (const std::uint32_t triangle : references) {
            if (place_of[triangle] == nowhere) {
                place_of[triangle] = static_cast<std::uint32_t>(placed.triangles.size());
                placed.triangles.push_back(all[triangle]);
            }
            placed.places.push_back(place_of[triangle]);
        }
        return placed;
    }
    std::size_t bytes() const {
        return triangles.size() * sizeof(Triangle) + places.size() * sizeof(std::uint32_t);
    }
};
// [place]

}  // namespace space
