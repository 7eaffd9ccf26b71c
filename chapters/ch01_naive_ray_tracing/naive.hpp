/// @file
/// No structure at all: every ray is tested against every triangle. Slow, simple, and the answer
/// that every structure of the book must give.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "common/accelerator.hpp"

#include <span>
#include <vector>

namespace space {

/// The plain list of triangles as an accelerator, with any ray-triangle test.
template <TriangleTest Test = MollerTrumbore>
class Naive {
  public:
    struct Config {};

    static Naive build(std::span<const Triangle> triangles, const Config& = {}) {
        Naive naive;
        naive.triangles_.assign(triangles.begin(), triangles.end());
        return naive;
    }

    // [closest_hit]
    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        std::optional<Hit> nearest;
        if (!is_valid(ray)) return nearest;
        for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
            counts.test_triangle();
            if (std::optional<Hit> hit = Test::intersect(ray, triangles_[i])) {
                hit->triangle = i;
                if (!nearest || nearer(*hit, *nearest)) nearest = hit;
            }
        }
        return nearest;
    }
    // [closest_hit]

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        if (!is_valid(ray)) return false;
        for (const Triangle& triangle : triangles_) {
            counts.test_triangle();
            if (Test::intersect(ray, triangle)) return true;
        }
        return false;
    }

    TreeShape shape() const {
        return {.references = triangles_.size(),
                .bytes = sizeof *this + triangles_.capacity() * sizeof(Triangle)};
    }

  private:
    std::vector<Triangle> triangles_;
};

}  // namespace space
