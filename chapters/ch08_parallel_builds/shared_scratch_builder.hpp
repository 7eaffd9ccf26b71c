/// @file
/// Two threads, and one scratch for both: the fault of [BvhThesis13], section 4.3, kept to be
/// looked at. In the thesis the axis of a cut and the boxes on its right were members of the
/// builder.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/locks.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <future>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

// [cut_scratch]
/// What choosing a cut writes down and reads again. Each access is under a lock, so there is no
/// data race in it, and nothing undefined: with two threads it is wrong all the same. (With NoLock
/// both are there, and ThreadSanitizer has something to report.)
template <int D, Lock L>
class CutScratch {
  public:
    explicit CutScratch(std::size_t size) : right_bounds_(size) {}

    int dimension() {
        const std::lock_guard guard(lock_);
        return dimension_;
    }
    void set_dimension(int axis) {
        const std::lock_guard guard(lock_);
        dimension_ = axis;
    }
    BasicAabb<D> right_bounds(std::size_t i) {
        const std::lock_guard guard(lock_);
        return right_bounds_[i];
    }
    void set_right_bounds(std::size_t i, const BasicAabb<D>& box) {
        const std::lock_guard guard(lock_);
        right_bounds_[i] = box;
    }

  private:
    L lock_;
    int dimension_ = 0;
    std::vector<BasicAabb<D>> right_bounds_;  ///< from the i-th reference of a range on
};
// [cut_scratch]

/// What is written to be read again.
enum class ScratchPart { right_bounds, dimension };
/// Event: it is written, and not yet read.
template <int D>
struct ScratchWritten {
    const BvhTask<D>& task;
    ScratchPart part;
};

// [choose_by_scratch]
/// The cheapest of all cuts, as in the thesis: sorted along each axis in turn, boxes from the right
/// first, then costs from the left.
template <int D, class Scratch, class Observer>
std::optional<BvhCut<D>> choose_by_scratch(const BvhTask<D>& task, const BvhCosts& costs,
                                           Scratch& scratch, Observer& observer) {
    const auto sort = [&](int axis) {
        std::ranges::sort(task.range, {}, [axis](const BvhReference<D>& reference) {
            return std::pair(reference.box.centroid()[axis], reference.polygon);
        });
    };
    const HitChance<D> chance(task.box);
    const std::size_t size = task.range.size();
    double tests = infinity;
    std::optional<BvhCut<D>> best;
    for (int axis = 0; axis < D; ++axis) {
        sort(axis);
        BasicAabb<D> first, second;
        for (std::size_t i = size; i-- > 1;) {
            second.extend(task.range[i].box);
            scratch.set_right_bounds(i, second);
        }
        observer.observe(ScratchWritten<D>{task, ScratchPart::right_bounds});
        for (std::size_t i = 1; i < size; ++i) {
            first.extend(task.range[i - 1].box);
            second = scratch.right_bounds(i);
            const double sum =
                chance.weight(first) * double(i) + chance.weight(second) * double(size - i);
            if (sum >= tests) continue;
            tests = sum;
            best = {i, first, second};
            scratch.set_dimension(axis);
        }
    }
    if (!best || !costs.cut_pays(tests / chance.whole(), size)) return {};
    observer.observe(ScratchWritten<D>{task, ScratchPart::dimension});
    sort(scratch.dimension());
    return best;
}
// [choose_by_scratch]

/// The root by one thread, each side by one of two.
template <Lock L = std::mutex>
struct SharedScratchBuilder {
    /// Costs, and the cure.
    struct Config {
        BvhCosts costs = {};
        bool is_shared = true;  ///< else each of the two threads has a scratch of its own
    };

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        std::vector<BvhReference<D>> all = boxed<D>(polygons);
        CutScratch<D, L> ours(all.size()), others(all.size());
        return build_in_parts<D>(all, box_around<D>(all), 2, [&](auto& root, auto names) {
            const auto make = [&](auto& part, auto& scratch, bool gives) {
                const auto choose = [&](const BvhTask<D>& task) {
                    return choose_by_scratch<D>(task, config.costs, scratch, observer);
                };
                make_part<D>(
                    part, {8, 64}, choose, [&](const auto&, const auto&) { return gives; },
                    [](const auto&, const auto&) {}, observer, names);
            };
            make(root, ours, true);
            for (auto& [pair, first, second] : root.handed_out) {
                auto other = std::async(std::launch::async, [&, &part = *first] {
                    make(part, config.is_shared ? ours : others, false);
                });
                make(*second, ours, false);
                other.get();
            }
        });
    }
};

// [held_cut]
/// An observer that forces one order of two threads. The first side's waits until the second's has
/// written what is to be read again, for its first node. Then that one waits until the other has
/// made all of its side.
class HeldCut : public NoObserver {
  public:
    explicit HeldCut(ScratchPart part) : part_(part) {}

    using NoObserver::observe;
    template <int D>
    void observe(const BvhPartBegun<D>& event) {
        if (is_first_side(event.task)) second_has_written_.get_future().wait();
    }
    template <int D>
    void observe(const ScratchWritten<D>& event) {
        if (event.task.depth == 0 || event.part != part_ || is_held_.exchange(true)) return;
        second_has_written_.set_value();
        first_is_made_.get_future().wait();
    }
    template <int D>
    void observe(const BvhPartEnded<D>& event) {
        if (is_first_side(event.task))
            first_is_made_.set_value();
        else if (event.task.depth == 1 && !is_held_.exchange(true))
            second_has_written_.set_value();
    }

  private:
    template <int D>
    static bool is_first_side(const BvhTask<D>& task) {
        return task.depth == 1 && task.begin == 0;
    }

    ScratchPart part_;
    std::atomic<bool> is_held_{false};  ///< the second side's thread; once
    std::promise<void> second_has_written_, first_is_made_;
};
// [held_cut]

// [lost_polygons]
/// The polygons that a box above them does not hold: a ray that hits them may pass the box by, and
/// then the walk does not come to them. By their numbers, in order.
template <int D>
std::vector<std::uint32_t> lost_polygons(const BvhNodes<D>& tree,
                                         std::span<const Simplex<D>> polygons) {
    /// A node, and what all boxes down to it have in common.
    struct Reached {
        std::uint32_t node;
        BasicAabb<D> common;
    };
    std::vector<std::uint32_t> lost;
    std::vector<Reached> waiting;
    if (!tree.empty()) waiting.push_back({0, tree.nodes[0].box});
    while (!waiting.empty()) {
        const auto [index, common] = waiting.back();
        waiting.pop_back();
        const BvhNode<D>& node = tree.nodes[index];
        for (const std::uint32_t polygon : tree.own(index))
            if (!common.contains(box_if_finite<D>(polygons[polygon]))) lost.push_back(polygon);
        if (node.is_leaf()) continue;
        for (const std::uint32_t child : {node.first, node.first + 1}) {
            const BasicAabb<D>& box = tree.nodes[child].box;
            waiting.push_back(
                {child, {glm::max(common.min, box.min), glm::min(common.max, box.max)}});
        }
    }
    std::ranges::sort(lost);
    return lost;
}
// [lost_polygons]

}  // namespace space
