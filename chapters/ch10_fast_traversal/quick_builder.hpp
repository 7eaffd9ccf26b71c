/// @file
/// Chapter 7's binned builder again, for speed: three axes in one instruction, few bins for few
/// triangles, and the last four by trying all ways. What it counts are blocks of four triangles, as
/// rays do.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "chapters/ch10_fast_traversal/float_box.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// What the builder may choose.
struct QuickConfig {
    std::size_t max_leaf_size = 2;  ///< the collapse makes larger ones
    std::size_t block_size = 4;     ///< triangles that a ray tests at once
    unsigned max_depth = 64;        ///< beyond it ranges are halved
};

/// Makes one tree.
class QuickBuild {
  public:
    QuickBuild(std::span<const Triangle> triangles, const QuickConfig& config) : config_(config) {
        limit_polygons(triangles.size());
        items_.reserve(triangles.size());
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            const Triangle& t = triangles[i];
            if (!is_finite<3>(t.a) || !is_finite<3>(t.b) || !is_finite<3>(t.c)) continue;
            items_.emplace_back(t, i);
        }
    }

    // [quick_run]
    BvhNodes<3> run() {
        if (items_.empty()) return {};
        tree_.nodes.reserve(2 * items_.size());
        tree_.nodes.resize(2);
        tree_.references.resize(items_.size());
        spare_.resize(items_.size());
        std::vector<Task> waiting{{.node = 0, .end = items_.size(), .part = part_of(items_)}};
        scale_ = scale_of(waiting[0].part.box);
        while (!waiting.empty()) {
            const Task task = waiting.back();
            waiting.pop_back();
            tree_.depth = std::max(tree_.depth, task.depth);
            tree_.nodes[task.node].box = task.part.box.aabb();
            const std::span<Item> range(items_.data() + task.begin, task.end - task.begin);
            if (range.size() <= std::max<std::size_t>(config_.max_leaf_size, 1)) {
                make_leaf(task, range);
                continue;
            }
            const Cut cut =
                task.depth < config_.max_depth ? best_cut(task.part, range) : halved(range);
            const auto pair = static_cast<std::uint32_t>(tree_.nodes.size());
            tree_.nodes[task.node].first = pair;
            tree_.nodes.resize(pair + 2);
            const std::size_t middle = task.begin + cut.count;
            waiting.push_back({pair + 1, task.depth + 1, middle, task.end, cut.second});
            waiting.push_back({pair, task.depth + 1, task.begin, middle, cut.first});
        }
        return std::move(tree_);
    }
    // [quick_run]

  private:
    /// A triangle: where it is, and which. The fourth floats hold the index's halves, as small
    /// whole numbers: as bits they could be floats with which no processor likes to reckon.
    struct Item {
        FloatBox box;

        Item() = default;
        Item(const Triangle& t, std::uint32_t index) : box{four_of(t.a), four_of(t.a)} {
            box.extend(four_of(t.b));
            box.extend(four_of(t.c));
            box.low[3] = float(index >> 16);
            box.high[3] = float(index & 0xffff);
        }
        std::uint32_t triangle() const {
            return std::uint32_t(box.low[3]) << 16 | std::uint32_t(box.high[3]);
        }
    };
    /// What is known of a range: the box around all, and that around their middles.
    struct Part {
        FloatBox box, middles;

        void add(const FloatBox& item) {
            box.extend(item);
            middles.extend(item.middle());
        }
    };
    struct Task {
        std::uint32_t node;
        unsigned depth = 0;
        std::size_t begin = 0, end;
        Part part;
    };
    struct Cut {
        std::size_t count;
        Part first, second;
    };
    static constexpr std::size_t most_bins = 16;

    /// A power of two: the longest side of the box times this is from 1 to 2. Without it areas of
    /// small scenes are 0, those of large ones infinite, and one cut is as good as the other.
    static float scale_of(const FloatBox& box) {
        const FourFloats e = 0.5f * box.high - 0.5f * box.low;  // the whole may be infinite
        const float half = std::max({e[0], e[1], e[2]});
        return half > 0.0f ? std::ldexp(0.5f, std::clamp(-std::ilogb(half), -125, 127)) : 1.0f;
    }
    static Part part_of(std::span<const Item> range) {
        Part part;
        for (const Item& item : range) part.add(item.box);
        return part;
    }
    static Cut halved(std::span<Item> range) {
        const std::size_t count = range.size() / 2;
        return {count, part_of(range.first(count)), part_of(range.subspan(count))};
    }

    void make_leaf(const Task& task, std::span<Item> range) {
        tree_.nodes[task.node].first = static_cast<std::uint32_t>(task.begin);
        tree_.nodes[task.node].count = static_cast<std::uint32_t>(range.size());
        for (std::size_t i = 0; i < range.size(); ++i)
            tree_.references[task.begin + i] = range[i].triangle();
    }

    Cut best_cut(const Part& part, std::span<Item> range) {
        if (range.size() <= 4) return best_of_all(range);
        const std::size_t bins = std::min(most_bins, 4 + range.size() / 16);
        const FourFloats extent = part.middles.high - part.middles.low;
        FourFloats scale{0.0f, 0.0f, 0.0f, 0.0f};
        for (int axis = 0; axis < 3; ++axis)
            if (extent[axis] > 0.0f && extent[axis] < infinity)
                scale[axis] = std::min(float(bins) * 0.9999f / extent[axis], 0x1p126f);
        const auto last = float(bins - 1);
        const auto bin_of = [&](const FloatBox& box) {
            const FourFloats place = (box.middle() - part.middles.low) * scale;
            return __builtin_convertvector(smaller_of(place, FourFloats{last, last, last, 0.0f}),
                                           FourInts);
        };
        fill(range, bins, bin_of);
        const Candidate best = cheapest(range.size(), bins, scale);
        if (best.bin == 0) return halved(range);
        return partitioned(range, best, bin_of);
    }

    typedef std::int32_t FourInts __attribute__((vector_size(16)));
    struct Bin {
        FloatBox box;
        std::uint32_t count = 0;
    };

    // [quick_bins]
    template <class BinOf>
    void fill(std::span<const Item> range, std::size_t bins, const BinOf& bin_of) {
        for (auto& axis : bins_) std::fill_n(axis.begin(), bins, Bin{});
        for (const Item& item : range) {
            const FourInts at = bin_of(item.box);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Bin& bin = bins_[axis][static_cast<std::size_t>(at[axis])];
                bin.box.extend(item.box);
                ++bin.count;
            }
        }
    }
    // [quick_bins]

    /// A cut before a bin; none before bin 0.
    struct Candidate {
        int axis = 0;
        std::size_t bin = 0, bins = 0;
        float cost = infinity;
    };
    float blocks(std::size_t count) const {
        return float((count + config_.block_size - 1) / config_.block_size);
    }
    Candidate cheapest(std::size_t size, std::size_t bins, FourFloats scale) const {
        Candidate best;
        for (int axis = 0; axis < 3; ++axis) {
            if (!(scale[axis] > 0.0f)) continue;
            const auto& of = bins_[std::size_t(axis)];
            std::array<float, most_bins> after;  // what is in a bin and in those after it
            FloatBox box;
            std::size_t count = 0;
            for (std::size_t i = bins; i-- > 1;) {
                box.extend(of[i].box);
                count += of[i].count;
                after[i] = count > 0 ? box.half_area(scale_) * blocks(count) : infinity;
            }
            box = {};
            count = 0;
            for (std::size_t i = 1; i < bins; ++i) {
                box.extend(of[i - 1].box);
                count += of[i - 1].count;
                if (of[i - 1].count == 0 || count == size) continue;
                const float cost = box.half_area(scale_) * blocks(count) + after[i];
                if (cost < best.cost) best = {axis, i, bins, cost};
            }
        }
        return best;
    }

    // [quick_partition]
    /// In order and without a branch on what nobody can guess: each item is written to the end of
    /// both parts, of which one grows. The first part stands where the range began, the second in a
    /// spare room until the end. Boxes come from the bins; those around middles are measured here.
    template <class BinOf>
    Cut partitioned(std::span<Item> range, const Candidate& best, const BinOf& bin_of) {
        Cut cut{};
        const auto& of = bins_[std::size_t(best.axis)];
        for (std::size_t i = 0; i < best.bins; ++i)
            (i < best.bin ? cut.first : cut.second).box.extend(of[i].box);
        const FloatBox none;
        FloatBox first, second;
        std::size_t i = 0, j = 0;
        for (const Item item : range) {
            const bool is_second =
                static_cast<std::size_t>(bin_of(item.box)[best.axis]) >= best.bin;
            const FourInts mask = FourInts{} - int(is_second);
            const FourFloats middle = item.box.middle();
            first.low = smaller_of(first.low, mask ? none.low : middle);
            first.high = larger_of(first.high, mask ? none.high : middle);
            second.low = smaller_of(second.low, mask ? middle : none.low);
            second.high = larger_of(second.high, mask ? middle : none.high);
            range[i] = spare_[j] = item;
            i += std::size_t(!is_second);
            j += std::size_t(is_second);
        }
        std::copy_n(spare_.begin(), j, range.begin() + std::ptrdiff_t(i));
        cut.count = i;
        cut.first.middles = first;
        cut.second.middles = second;
        return cut;
    }
    // [quick_partition]

    // [quick_last]
    /// Two to four triangles: every way to part them; bit i of `second` says where triangle i goes.
    Cut best_of_all(std::span<Item> range) const {
        unsigned best = 1;
        float best_cost = infinity;
        for (unsigned second = 1; second < 1u << (range.size() - 1); ++second) {
            std::array<FloatBox, 2> boxes;
            std::array<unsigned, 2> counts{};
            for (std::size_t i = 0; i < range.size(); ++i) {
                boxes[second >> i & 1].extend(range[i].box);
                ++counts[second >> i & 1];
            }
            const float cost = boxes[0].half_area(scale_) * float(counts[0]) +
                               boxes[1].half_area(scale_) * float(counts[1]);
            if (cost < best_cost) best = second, best_cost = cost;
        }
        Cut cut{};
        std::array<Item, 4> parted;
        std::size_t last = range.size();
        for (std::size_t i = 0; i < range.size(); ++i) {
            const bool is_second = best >> i & 1;
            (is_second ? cut.second : cut.first).add(range[i].box);
            parted[is_second ? --last : cut.count++] = range[i];
        }
        std::copy_n(parted.begin(), range.size(), range.begin());
        return cut;
    }
    // [quick_last]

    QuickConfig config_;
    float scale_ = 1.0f;                                         ///< of areas
    std::vector<Item, CacheLineAllocator<Item>> items_, spare_;  ///< in a spare room all find place
    std::array<std::array<Bin, most_bins>, 3> bins_;
    BvhNodes<3> tree_;
};

/// The builder.
struct QuickBuilder {
    using Config = QuickConfig;

    template <int D = 3>
    static BvhNodes<D> build(std::span<const Triangle> triangles, const Config& config = {}) {
        static_assert(D == 3);
        return QuickBuild(triangles, config).run();
    }
};

}  // namespace space
