/// @file
/// The surface area heuristic as Optim25 tells it, by "the sum of the children's surface areas":
/// without the counts. With them, for comparison, all else is the same.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space::ch07 {

/// Tries every cut of the boxes' middles in order along each axis. A sum of areas says nothing of
/// when to stop, so both stop by the number of triangles.
struct AreaSumBuilder {
    /// Whether areas are weighed by counts.
    struct Config {
        BvhCosts costs = {};
        bool has_counts = false;
        std::size_t max_leaf_size = 4;
        unsigned max_depth = 64;
    };

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const auto choose = [&](const BvhTask<D>& task) -> std::optional<BvhCut<D>> {
            if (task.range.size() <= config.max_leaf_size) return {};
            const Candidate best = best_of<D>(task, config.has_counts);
            sort<D>(task.range, best.axis);
            return cut_after<D>(best.count, task.range);
        };
        return build_top_down<D>(boxed<D>(polygons), config.max_leaf_size, config.max_depth, choose,
                                 observer);
    }

  private:
    struct Candidate {
        int axis = 0;
        std::size_t count = 1;
        double sum = infinity;
    };

    template <int D>
    static Candidate best_of(const BvhTask<D>& task, bool has_counts) {
        const HitChance<D> chance(task.box);
        const std::size_t size = task.range.size();
        std::vector<double> second(size);
        Candidate best;
        for (int axis = 0; axis < D; ++axis) {
            sort<D>(task.range, axis);
            BasicAabb<D> box;
            for (std::size_t i = size; i-- > 1;) {
                box.extend(task.range[i].box);
                second[i] = chance.weight(box);
            }
            box = {};
            for (std::size_t i = 1; i < size; ++i) {
                box.extend(task.range[i - 1].box);
                const double first = chance.weight(box);
                const double sum = has_counts ? first * double(i) + second[i] * double(size - i)
                                              : first + second[i];
                if (sum < best.sum) best = {axis, i, sum};
            }
        }
        return best;
    }

    template <int D>
    static void sort(std::span<BvhReference<D>> range, int axis) {
        std::sort(range.begin(), range.end(), [axis](const auto& a, const auto& b) {
            return std::pair(a.box.centroid()[axis], a.polygon) <
                   std::pair(b.box.centroid()[axis], b.polygon);
        });
    }
};

}  // namespace space::ch07
