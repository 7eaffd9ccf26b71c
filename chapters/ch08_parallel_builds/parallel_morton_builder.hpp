/// @file
/// Chapter 7's tree by Morton order, made by all threads: boxes, codes, sort, then the nodes.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "chapters/ch08_parallel_builds/boxed_by_all.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/parallel_partition.hpp"
#include "chapters/ch08_parallel_builds/parallel_radix_sort.hpp"
#include "chapters/ch08_parallel_builds/stealing_parts.hpp"
#include "chapters/ch08_parallel_builds/untouched.hpp"
#include "chapters/ch08_parallel_builds/work_stealing.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace space {

/// The sequential builder's, what threads share, and how many there are.
struct ParallelMortonConfig : MortonBuilder::Config, StealingSizes {
    unsigned threads = 1;
};

/// The tree of MortonBuilder, node for node, by any number of threads.
struct ParallelMortonBuilder {
    using Config = ParallelMortonConfig;

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        WorkStealing threads(build_threads(config.threads));
        const std::size_t chunk = config.usable_chunk();
        const BoxedByAll<D> boxed(polygons, chunk, threads);
        Untouched<BvhReference<D>> sorted(boxed.all().size());
        Untouched<std::uint64_t> codes(boxed.all().size());
        sort<D>(boxed.all(), chunk, threads, sorted.all(), codes.all());
        const Method<D> method{config, MortonKeys{codes.all()}, chunk, threads};
        return build_by_stealing<D>(sorted.all(), boxed.box(),
                                    {config.max_leaf_size, max_bvh_depth}, config, threads, method,
                                    observer);
    }

  private:
    // [parallel_morton_sort]
    /// References by the codes of their middles, and these codes.
    template <int D>
    static void sort(std::span<const BvhReference<D>> references, std::size_t chunk,
                     WorkStealing& threads, std::span<BvhReference<D>> sorted,
                     std::span<std::uint64_t> codes) {
        const ChunksOf chunks{references.size(), chunk};
        std::vector<BasicAabb<D>> middles(chunks.count());
        threads.for_each(chunks.count(), [&](std::size_t i) {
            middles[i] = box_around_centroids<D>(chunks(references, i));
        });
        BasicAabb<D> all;
        for (const BasicAabb<D>& box : middles) all.extend(box);
        const auto frame = OrthtreeFrame<D>::around(all);
        Untouched<CodedIndex> items(references.size()), scratch(references.size());
        threads.for_each(chunks.count(), [&](std::size_t i) {
            for (std::size_t k = chunks.begin(i); k < chunks.begin(i + 1); ++k)
                items.all()[k] = {morton_code(frame, references[k].box.centroid()),
                                  static_cast<std::uint32_t>(k)};
        });
        const std::span<const CodedIndex> order =
            parallel_radix_sort(items.all(), scratch.all(), 16 * chunk, threads);
        threads.for_each(chunks.count(), [&](std::size_t i) {
            for (std::size_t k = chunks.begin(i); k < chunks.begin(i + 1); ++k) {
                codes[k] = order[k].code;
                sorted[k] = references[order[k].index];
            }
        });
    }
    // [parallel_morton_sort]

    /// Where nodes are cut: ranges stay in order, so all that takes time is the boxes.
    template <int D>
    struct Method {
        const Config& config;
        MortonKeys keys;
        std::size_t chunk;
        WorkStealing& threads;

        auto choice() const {
            return [this](const BvhTask<D>& task) -> std::optional<BvhCut<D>> {
                if (is_leaf(task)) return {};
                return cut_after<D>(first_count(task), task.range);
            };
        }
        std::optional<BvhCut<D>> choose_by_all(const BvhTask<D>& task) const {
            if (is_leaf(task)) return {};
            const std::size_t count = first_count(task);
            return BvhCut<D>{count, box_by_all(task.range.first(count)),
                             box_by_all(task.range.subspan(count))};
        }

      private:
        bool is_leaf(const BvhTask<D>& task) const {
            return task.range.size() <= std::max<std::size_t>(config.max_leaf_size, 1);
        }
        std::size_t first_count(const BvhTask<D>& task) const {
            const auto first = static_cast<std::uint32_t>(task.begin);
            const auto last = static_cast<std::uint32_t>(first + task.range.size());
            return prefix_split(first, last,
                                [&](auto i, auto j) { return keys.common_prefix(i, j); }) -
                   first;
        }
        BasicAabb<D> box_by_all(std::span<const BvhReference<D>> range) const {
            const ChunksOf chunks{range.size(), chunk};
            std::vector<BasicAabb<D>> boxes(chunks.count());
            threads.for_each(chunks.count(),
                             [&](std::size_t i) { boxes[i] = box_around<D>(chunks(range, i)); });
            BasicAabb<D> box;
            for (const BasicAabb<D>& each : boxes) box.extend(each);
            return box;
        }
    };
};

}  // namespace space
