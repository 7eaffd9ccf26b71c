/// @file
/// The surface area heuristic over all cuts of a range: in each node the best that a plane can do
/// with whole triangles.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// Along each axis the references stand in the order of their boxes' middles, and every cut of that
/// order is a candidate: T - 1 of them for T triangles. So are then the 6 T planes where boxes
/// begin or end, of which BvhThesis13 writes: a plane parts the middles as one of these cuts does.
///
/// Sorted once. A cut keeps the order on both sides, so a level of the tree takes O(T), all of them
/// O(T log T) where the tree is not a chain (Wald & Havran 2006 have this for k-d trees).
template <int D>
class SahSweep {
  public:
    SahSweep(std::vector<BvhReference<D>>& references, std::size_t polygons)
        : is_first_(polygons), weights_(references.size()) {
        for (std::size_t axis = 1; axis < D; ++axis) {
            others_[axis] = references;
            sort(others_[axis], int(axis));
        }
        sort(references, 0);
    }

    /// A cut of the order along an axis, and the tests that a ray through the node is expected to
    /// make below.
    struct Candidate {
        int axis = 0;
        std::size_t count = 0;
        double tests = infinity;
    };

    // [sweep_best]
    /// The cheapest cut, the first of those that cost the same; none of a range of one.
    Candidate best(const BvhTask<D>& task) {
        const HitChance<D> chance(task.box);
        const std::size_t size = task.range.size();
        Candidate best;
        for (int axis = 0; axis < D; ++axis) {
            const std::span<BvhReference<D>> order = range(task, axis);
            BasicAabb<D> second;
            for (std::size_t i = size; i-- > 1;) {
                second.extend(order[i].box);
                weights_[i] = chance.weight(second);
            }
            BasicAabb<D> first;
            for (std::size_t i = 1; i < size; ++i) {
                first.extend(order[i - 1].box);
                const double tests =
                    chance.weight(first) * double(i) + weights_[i] * double(size - i);
                if (tests < best.tests) best = {axis, i, tests};
            }
        }
        best.tests /= chance.whole();
        return best;
    }
    // [sweep_best]

    // [sweep_cut]
    /// Cuts the orders along all axes as that along one is cut.
    BvhCut<D> cut(const BvhTask<D>& task, const Candidate& at) {
        const std::span<BvhReference<D>> order = range(task, at.axis);
        const BvhCut<D> result = cut_after<D>(at.count, order);
        for (std::size_t i = 0; i < order.size(); ++i) is_first_[order[i].polygon] = i < at.count;
        part(task);
        return result;
    }
    /// Half of the references to each side, whatever it costs.
    BvhCut<D> halve(const BvhTask<D>& task) {
        const int axis = box_around_centroids<D>(task.range).longest_axis();
        return cut(task, {axis, task.range.size() / 2});
    }
    // [sweep_cut]

  private:
    static void sort(std::vector<BvhReference<D>>& references, int axis) {
        std::sort(references.begin(), references.end(), [&](const auto& a, const auto& b) {
            return std::pair(a.box.centroid()[axis], a.polygon) <
                   std::pair(b.box.centroid()[axis], b.polygon);
        });
    }
    std::span<BvhReference<D>> range(const BvhTask<D>& task, int axis) {
        if (axis == 0) return task.range;
        return std::span(others_[std::size_t(axis)]).subspan(task.begin, task.range.size());
    }
    /// On each axis the marked ones first, otherwise in the order that they had.
    void part(const BvhTask<D>& task) {
        for (int axis = 0; axis < D; ++axis) {
            const std::span<BvhReference<D>> order = range(task, axis);
            second_.clear();
            std::size_t count = 0;
            for (const BvhReference<D> reference : order) {
                if (is_first_[reference.polygon])
                    order[count++] = reference;
                else
                    second_.push_back(reference);
            }
            std::copy(second_.begin(), second_.end(),
                      order.begin() + static_cast<std::ptrdiff_t>(count));
        }
    }

    std::array<std::vector<BvhReference<D>>, D> others_;  ///< but the first: that is the tasks' own
    std::vector<std::uint8_t> is_first_;                  ///< by polygon: to which side it goes
    std::vector<double> weights_;          ///< of the second part, for each cut along an axis
    std::vector<BvhReference<D>> second_;  ///< while ranges are parted
};

/// Costs and limits.
struct SweepConfig {
    BvhCosts costs = {};
    std::size_t max_leaf_size = 8;  ///< larger ranges are cut even where that does not pay
    unsigned max_depth = 64;        ///< beyond it ranges are halved
};

/// Cuts where that lowers the expected cost of a ray, at the place where it does so most.
struct SweepBuilder {
    using Config = SweepConfig;

    // [sweep_build]
    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        std::vector<BvhReference<D>> references = boxed<D>(polygons);
        SahSweep<D> sweep(references, polygons.size());
        const auto choose = [&](const BvhTask<D>& task) -> std::optional<BvhCut<D>> {
            const std::size_t size = task.range.size();
            const auto best = sweep.best(task);
            if (config.costs.cut_pays(best.tests, size)) return sweep.cut(task, best);
            if (size <= std::max<std::size_t>(config.max_leaf_size, 1)) return {};
            return sweep.halve(task);
        };
        return build_top_down<D>(std::move(references), config.max_leaf_size, config.max_depth,
                                 choose, observer);
    }
    // [sweep_build]
};

}  // namespace space
