/// @file
/// Planes that may cut a node and the polygons in it, by bins (Stich, Friedrich & Dietrich 2009,
/// "Spatial Splits in Bounding Volume Hierarchies").
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace space {

/// A plane across an axis, and the tests that a ray through the node is expected to make below.
struct SpatialSplit {
    int axis = 0;
    float position = 0.0f;
    double tests = infinity;
};

// [spatial_bins]
/// A node's box in equal slabs across an axis: the box around what of the references lies in each,
/// and how many of them begin and end there.
template <int D>
class SpatialBins {
  public:
    static constexpr std::size_t most = 32;

    /// So many bins as references, within limits: in a small node more would find no better plane.
    SpatialBins(const BasicAabb<D>& box, int axis, std::size_t references)
        : axis_(axis), bins_(std::clamp<std::size_t>(references, 8, most)) {
        const double low = box.min[axis], length = box.max[axis] - low;
        for (std::size_t i = 1; i < bins_.size(); ++i)
            planes_.push_back(static_cast<float>(low + length * double(i) / double(bins_.size())));
    }

    /// Which bins a reference reaches into, its box held against planes as it will be when one is
    /// taken: what begins on a plane is above it, what ends there is below.
    void add(const Simplex<D>& polygon, const BvhReference<D>& reference) {
        const float low = reference.box.min[axis_], high = reference.box.max[axis_];
        const auto planes_to = [&](auto end) { return std::size_t(end - planes_.begin()); };
        const std::size_t first = planes_to(std::upper_bound(planes_.begin(), planes_.end(), low));
        const std::size_t last =
            std::max(first, planes_to(std::lower_bound(planes_.begin(), planes_.end(), high)));
        ++bins_[first].begun;
        ++bins_[last].ended;
        if (first == last) return bins_[first].box.extend(reference.box);
        for (std::size_t i = first; i <= last; ++i) {
            const double from = i > first ? planes_[i - 1] : -infinity,
                         to = i < last ? planes_[i] : infinity;
            BasicAabb<D> part = box_between(polygon, from, to);
            part.min = glm::max(part.min, reference.box.min);
            part.max = glm::min(part.max, reference.box.max);
            if (!part.is_empty()) bins_[i].box.extend(part);
        }
    }

    /// The cheapest plane between bins that has something on each side, and no more than `spare` on
    /// both.
    SpatialSplit best(std::size_t all, std::size_t spare, const HitChance<D>& chance) const {
        std::array<double, most> above{};  // the weight of the box around a bin and later ones
        BasicAabb<D> box;
        for (std::size_t i = bins_.size(); i-- > 1;) {
            box.extend(bins_[i].box);
            above[i] = box.is_empty() ? infinity : chance.weight(box);
        }
        SpatialSplit best;
        std::size_t low = 0, high = all;
        box = {};
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            box.extend(bins_[i].box);
            low += bins_[i].begun;
            high -= bins_[i].ended;
            if (box.is_empty() || low + high > all + spare) continue;
            const double tests = chance.weight(box) * double(low) + above[i + 1] * double(high);
            if (tests < best.tests) best = {axis_, planes_[i], tests};
        }
        best.tests /= chance.whole();
        return best;
    }

  private:
    struct Bin {
        BasicAabb<D> box;
        std::size_t begun = 0, ended = 0;
    };

    /// Of what a polygon has between two planes, by its edges. Nothing but the choice of a plane
    /// depends on it, so roundings do no harm.
    BasicAabb<D> box_between(const Simplex<D>& polygon, double from, double to) const {
        BasicAabb<D> box;
        for (int edge = 0; edge < (D == 2 ? 1 : D); ++edge) {
            Double<D> a(polygon[edge]), b(polygon[(edge + 1) % D]);
            if (a[axis_] > b[axis_]) std::swap(a, b);
            if (b[axis_] < from || a[axis_] > to) continue;
            const auto at = [&](double position) {
                return Point<D>(a + (position - a[axis_]) / (b[axis_] - a[axis_]) * (b - a));
            };
            box.extend(from <= a[axis_] ? Point<D>(a) : at(from));
            box.extend(to >= b[axis_] ? Point<D>(b) : at(to));
        }
        return box;
    }

    int axis_;
    std::vector<Bin> bins_;
    std::vector<float> planes_;  ///< between bins
};
// [spatial_bins]

}  // namespace space
