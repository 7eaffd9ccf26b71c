/// @file
/// The parallel builder that we propose: all threads at each large node, then a task for each small
/// one, which idle threads steal.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "chapters/ch08_parallel_builds/boxed_by_all.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/parallel_partition.hpp"
#include "chapters/ch08_parallel_builds/stealing_parts.hpp"
#include "chapters/ch08_parallel_builds/work_stealing.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace space {

/// The sequential builder's, what threads share, and how many there are.
struct WorkStealingConfig : BinnedBuilder::Config, StealingSizes {
    unsigned threads = 1;
};

/// The tree of BinnedBuilder, node for node, by any number of threads.
struct WorkStealingBuilder {
    using Config = WorkStealingConfig;

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        WorkStealing threads(build_threads(config.threads));
        const Method<D> method{config, threads};
        const BoxedByAll<D> boxed(polygons, method.chunk, threads);
        return build_by_stealing<D>(boxed.all(), boxed.box(),
                                    {config.max_leaf_size, config.max_depth}, config, threads,
                                    method, observer);
    }

  private:
    /// Cuts as the sequential builder chooses them.
    template <int D>
    struct Method {
        const Config& config;
        WorkStealing& threads;
        std::size_t chunk = config.usable_chunk();

        BinnedBuilder::Choice<D> choice() const { return BinnedBuilder::Choice<D>{config}; }

        // [choose_by_all]
        /// Boxes and counts come out the same however the range is cut into chunks: they are
        /// minima, maxima and whole numbers. Sums of floats would not.
        std::optional<BvhCut<D>> choose_by_all(const BvhTask<D>& task) const {
            BinnedBuilder::Choice<D> choice{config};
            const ChunksOf chunks{task.range.size(), chunk};
            std::vector<BasicAabb<D>> middles(chunks.count());
            threads.for_each(chunks.count(), [&](std::size_t i) {
                middles[i] = box_around_centroids<D>(chunks(task.range, i));
            });
            BasicAabb<D> all;
            for (const BasicAabb<D>& box : middles) all.extend(box);
            choice.bins.lay_out(all, std::min(config.bins, task.range.size()));
            std::vector<BvhBins<D>> bins(chunks.count(), choice.bins);
            threads.for_each(chunks.count(),
                             [&](std::size_t i) { bins[i].add(chunks(task.range, i)); });
            for (const BvhBins<D>& each : bins) choice.bins.add(each);
            return choice.cut(task, [&](const auto& is_first) {
                ParallelPartition(task.range, chunk, threads).run(is_first);
            });
        }
        // [choose_by_all]
    };
};

}  // namespace space
