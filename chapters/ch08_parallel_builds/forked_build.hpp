/// @file
/// What the two builders share that start a thread where a node is cut ([BvhThesis13], sections
/// 4.2 and 4.3).
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"

#include <cstddef>
#include <cstdint>
#include <future>
#include <span>
#include <vector>

namespace space {

/// How many threads may still be started below the two sides of a cut.
struct ThreadBudgets {
    unsigned first, second;
    bool operator==(const ThreadBudgets&) const = default;
};

// [forked_build]
/// A thread makes a node; the first side goes to a new thread, the second stays with this one. How
/// many more each side may start, divide(budget, size of the first, size of the second) says. Where
/// the budget is 0, one thread makes all that is below.
template <int D, class Divide, class Observer>
class ForkedBuild {
  public:
    ForkedBuild(const BinnedBuilder::Config& config, const Divide& divide, Observer& observer)
        : config_(config), divide_(divide), observer_(observer) {}

    BvhNodes<D> build(std::span<const Simplex<D>> polygons, unsigned threads) {
        std::vector<BvhReference<D>> all = boxed<D>(polygons);
        return build_in_parts<D>(all, box_around<D>(all), threads,
                                 [&](auto& root, auto names) { make(root, names, threads - 1); });
    }

  private:
    void make(BvhPart<D>& part, std::span<std::uint32_t> names, unsigned budget) {
        BinnedBuilder::Choice<D> choice{config_};  // each thread has bins of its own
        if (budget == 0) part.tree.nodes.reserve(part.task.range.size());
        make_part<D>(
            part, {config_.max_leaf_size, config_.max_depth}, choice,
            [&](const auto&, const auto&) { return budget > 0; }, [](const auto&, const auto&) {},
            observer_, names);
        for (auto& [pair, first, second] : part.handed_out) {
            const ThreadBudgets below =
                divide_(budget, first->task.range.size(), second->task.range.size());
            // The future waits for its thread, also where this one ends by an exception.
            std::future<void> other = std::async(
                std::launch::async, [&, &first = *first] { make(first, names, below.first); });
            make(*second, names, below.second);
            other.get();
        }
    }

    const BinnedBuilder::Config& config_;
    Divide divide_;
    Observer& observer_;
};
// [forked_build]

}  // namespace space
