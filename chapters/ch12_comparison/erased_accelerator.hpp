/// @file
/// Any structure of the lab, asked one ray at a time: a program over it is compiled once for all.
#pragma once

#include "chapters/ch12_comparison/rays.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/accelerator.hpp"

#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

namespace space {

/// An Accelerator whose type is not known: a ray pays for an indirect call, where the lab's batches
/// pay once for many. Its triangles are those of a mesh, not of instances.
class ErasedAccelerator {
  public:
    explicit ErasedAccelerator(BuiltStructure structure) : structure_(std::move(structure)) {}

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        const HitRecord hit = answer(ray, Query::closest, counts);
        if (!hit.is_hit()) return std::nullopt;
        return Hit{hit.t, static_cast<std::uint32_t>(hit.triangle), hit.u, hit.v};
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        return answer(ray, Query::any, counts).is_hit();
    }
    TreeShape shape() const { return structure_.shape(); }

  private:
    /// A batch of one ray. A peer does not count.
    template <class Counts>
    HitRecord answer(const Ray& ray, Query query, Counts& counts) const {
        HitRecord hit;
        const Batch batch{{&ray, 1}, {&hit, 1}, query};
        if constexpr (std::is_same_v<Counts, TraversalCounts>)
            if (structure_.count) {
                counts += structure_.count(batch);
                return hit;
            }
        structure_.trace(batch);
        return hit;
    }

    BuiltStructure structure_;
};

}  // namespace space
