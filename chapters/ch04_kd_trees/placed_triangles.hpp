/// @file
/// The triangles of a tree in the order of its leaves.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch04_kd_trees/mailbox.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

// [place_triangles]
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
// [place_triangles]

// [tests]
/// One ray's tests of the triangles that a tree names where the ray passes.
template <TriangleTest Test, class Counts, class Found>
struct PlacedTests {
    const PlacedTriangles& placed;
    std::span<const std::uint32_t> references;  ///< the tree's
    const Ray& ray;
    Counts& counts;
    const Found& found;  ///< found(hit) returns the t beyond which nothing matters any more
    Mailbox mailbox;
    double limit = infinity;  ///< what it has returned last

    /// Tests those of `count` references from `first` on that the mailbox does not remember.
    double in(std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t i = first; i < first + count; ++i) {
            const std::uint32_t place = placed.places[i];
            if (mailbox.remembers(place)) continue;
            counts.test_triangle();
            if (auto hit = Test::intersect(ray, placed.triangles[place])) {
                hit->triangle = references[i];
                limit = found(*hit);
            }
        }
        return limit;
    }
};
// [tests]

}  // namespace space
