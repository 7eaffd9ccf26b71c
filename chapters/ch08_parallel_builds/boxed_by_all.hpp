/// @file
/// What a builder begins with, made by all threads.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch08_parallel_builds/parallel_partition.hpp"
#include "chapters/ch08_parallel_builds/untouched.hpp"
#include "chapters/ch08_parallel_builds/work_stealing.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

// [boxed_by_all]
/// The same references in the same order as boxed() gives, and the box around them. Each thread
/// writes what it boxes where it would lie if no polygon were left out. Only where some are, the
/// rest moves up, by one thread: few scenes have any.
template <int D>
class BoxedByAll {
  public:
    BoxedByAll(std::span<const Simplex<D>> polygons, std::size_t chunk, WorkStealing& threads)
        : memory_(checked(polygons.size())) {
        const ChunksOf chunks{polygons.size(), chunk};
        std::vector<std::span<BvhReference<D>>> parts(chunks.count());
        std::vector<BasicAabb<D>> boxes(chunks.count());
        threads.for_each(chunks.count(), [&](std::size_t i) {
            const std::span<BvhReference<D>> part = chunks(memory_.all(), i);
            std::size_t count = 0;
            for (std::size_t k = chunks.begin(i); k < chunks.begin(i + 1); ++k)
                if (const auto box = box_if_finite<D>(polygons[k]); !box.is_empty()) {
                    part[count++] = {box, static_cast<std::uint32_t>(k)};
                    boxes[i].extend(box);
                }
            parts[i] = part.first(count);
        });
        auto end = memory_.all().begin();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            end = end == parts[i].begin() ? parts[i].end() : std::ranges::copy(parts[i], end).out;
            box_.extend(boxes[i]);
        }
        all_ = {memory_.all().begin(), end};
    }

    std::span<BvhReference<D>> all() const { return all_; }
    const BasicAabb<D>& box() const { return box_; }

  private:
    static std::size_t checked(std::size_t count) {
        limit_polygons(count);
        return count;
    }

    Untouched<BvhReference<D>> memory_;
    std::span<BvhReference<D>> all_;
    BasicAabb<D> box_;
};
// [boxed_by_all]

}  // namespace space
