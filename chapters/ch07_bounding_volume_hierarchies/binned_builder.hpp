/// @file
/// The surface area heuristic by bins: nearly the sweep's tree in a fraction of its time.
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

namespace space {

// [bvh_bins]
/// Equal slices of the box around the middles, along each axis, with what falls into them (Wald
/// 2007, "On fast construction of SAH-based bounding volume hierarchies").
template <int D>
class BvhBins {
  public:
    static constexpr std::size_t most = 32;

    /// Sorts a range into at most so many bins along each axis.
    void fill(std::span<const BvhReference<D>> range, std::size_t bins) {
        lay_out(box_around_centroids<D>(range), bins);
        add(range);
    }

    /// So many bins, still empty, along each axis of the box around the middles.
    void lay_out(const BasicAabb<D>& middles, std::size_t bins) {
        bins_ = std::clamp<std::size_t>(bins, 2, most);
        for (int axis = 0; axis < D; ++axis) {
            std::fill_n(of_[std::size_t(axis)].begin(), bins_, Bin{});
            low_[axis] = middles.min[axis];
            // A little less than bins / extent: the last middle falls into the last bin, not beyond
            // it. In double, where no difference of floats overflows and no quotient is infinite.
            const double extent = double{middles.max[axis]} - low_[axis];
            scale_[axis] = extent > 0.0 ? double(bins_) * (1.0 - 0x1p-50) / extent : 0.0;
        }
    }
    /// Each reference, into the bin of its middle along each axis.
    void add(std::span<const BvhReference<D>> range) {
        for (const BvhReference<D>& reference : range) {
            const Point<D> middle = reference.box.centroid();
            for (int axis = 0; axis < D; ++axis) {
                Bin& bin = of_[std::size_t(axis)][bin_of(middle, axis)];
                bin.box.extend(reference.box);
                ++bin.count;
            }
        }
    }
    /// What has fallen into others, laid out alike.
    void add(const BvhBins& others) {
        for (std::size_t axis = 0; axis < D; ++axis)
            for (std::size_t i = 0; i < bins_; ++i) {
                of_[axis][i].box.extend(others.of_[axis][i].box);
                of_[axis][i].count += others.of_[axis][i].count;
            }
    }

    /// From 0 on; all in bin 0 where their middles are at one place.
    std::size_t bin_of(const Point<D>& middle, int axis) const {
        return static_cast<std::size_t>((double{middle[axis]} - low_[axis]) * scale_[axis]);
    }

    /// A cut before a bin, what it parts, and the tests that a ray through the node is expected to
    /// make below.
    struct Candidate {
        int axis = 0;
        std::size_t bin = 0;
        BvhCut<D> cut = {};
        double tests = infinity;
    };

    /// The cheapest cut, the first of those that cost the same; none where all are in one place.
    Candidate best(const BasicAabb<D>& box, std::size_t size) {
        const HitChance<D> chance(box);
        Candidate best;
        for (int axis = 0; axis < D; ++axis) {
            if (scale_[axis] == 0.0) continue;
            const auto& bins = of_[std::size_t(axis)];
            second_[bins_ - 1] = bins[bins_ - 1].box;
            for (std::size_t i = bins_ - 1; i-- > 1;) {
                second_[i] = second_[i + 1];
                second_[i].extend(bins[i].box);
            }
            BasicAabb<D> first;
            std::size_t count = 0;
            for (std::size_t i = 1; i < bins_; ++i) {
                first.extend(bins[i - 1].box);
                count += bins[i - 1].count;
                if (bins[i - 1].count == 0) continue;  // the cut before it is the same
                const double tests = chance.weight(first) * double(count) +
                                     chance.weight(second_[i]) * double(size - count);
                if (tests < best.tests) best = {axis, i, {count, first, second_[i]}, tests};
            }
        }
        best.tests /= chance.whole();
        return best;
    }

  private:
    struct Bin {
        BasicAabb<D> box;
        std::uint32_t count = 0;
    };
    std::size_t bins_ = 0;
    std::array<std::array<Bin, most>, D> of_;
    std::array<BasicAabb<D>, most> second_;  ///< around each bin and those after it
    Double<D> low_, scale_;
};
// [bvh_bins]

/// Costs, limits and bins.
struct BinnedConfig {
    BvhCosts costs = {};
    std::size_t max_leaf_size = 8;  ///< larger ranges are cut even where that does not pay
    unsigned max_depth = 64;        ///< beyond it ranges are halved
    std::size_t bins = 16;          ///< along each axis, at most BvhBins::most
};

/// Cuts where that lowers the expected cost of a ray, between the bins where it does so most.
struct BinnedBuilder {
    using Config = BinnedConfig;

    // [binned_build]
    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        return build_top_down<D>(boxed<D>(polygons), config.max_leaf_size, config.max_depth,
                                 Choice<D>{config}, observer);
    }

    /// How a node is cut, with the bins that this takes: threads have one each.
    template <int D>
    struct Choice {
        Config config;
        BvhBins<D> bins = {};

        std::optional<BvhCut<D>> operator()(const BvhTask<D>& task) {
            if (task.range.size() == 1) return {};
            // With more bins than references most would be empty.
            bins.fill(task.range, std::min(config.bins, task.range.size()));
            return cut(task, [&](const auto& is_first) {
                std::partition(task.range.begin(), task.range.end(), is_first);
            });
        }

        /// By the bins as they are filled; partition(is_first) puts the range in order.
        template <class Partition>
        std::optional<BvhCut<D>> cut(const BvhTask<D>& task, const Partition& partition) {
            const std::size_t size = task.range.size();
            const auto best = bins.best(task.box, size);
            if (config.costs.cut_pays(best.tests, size)) {
                partition([&](const BvhReference<D>& reference) {
                    return bins.bin_of(reference.box.centroid(), best.axis) < best.bin;
                });
                return best.cut;
            }
            if (size <= std::max<std::size_t>(config.max_leaf_size, 1)) return {};
            return halved<D>(task.range);
        }
    };
    // [binned_build]
};

}  // namespace space
