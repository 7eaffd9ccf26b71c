/// @file
/// Exercise 8.2: The lost triangle
/// Difficulty 2 of 3, about 30 minutes.
///
/// A builder cuts a node by a sweep: for each axis it sorts the node's boxes, makes the bounds of
/// all that is at the right of each cut, and sweeps from the left; then it sorts by the best axis
/// once more. [BvhThesis13] (section 4.3) had a builder like this one, and made threads of it. Some
/// of the scene was missing, and sometimes the program crashed.
///
/// Here a `SweepTask` cuts one node, in small steps. Anybody may do the next step: the check plays
/// several tasks on one thread or more, in every order, and moves tasks between their steps.
/// Whatever the order, each task is to find the cut that it finds alone. What all tasks share must
/// not change, so a task is to be made from a `const SharedBuilder&`. No locks: a task may wait for
/// ever between two of its steps. A task keeps no more than the bounds of its own boxes.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace space {

/// What all tasks of one build have in common.
struct SharedBuilder {
    static constexpr std::size_t most_boxes = 64;

    int dimension = 0;                                       ///< the axis in hand
    std::array<BasicAabb<2>, most_boxes> right_bounds = {};  ///< around box i and all after it
};

/// Finds the cheapest cut of 2 to `most_boxes` boxes, and puts them in its order.
class SweepTask {
  public:
    // TODO: whose are the axis in hand and the right bounds?
    SweepTask(SharedBuilder& builder, std::span<BvhReference<2>> range)
        : builder_(builder), range_(range) {}

    /// Does the next of the task's steps. @return whether there are more
    bool step() {
        const int step = step_++;
        if (step == 8) builder_.dimension = best_axis_;
        if (step == 9) sort();
        if (step >= 8) return step < 9;
        if (step % 4 == 0) builder_.dimension = step / 4;
        if (step % 4 == 1) sort();
        if (step % 4 == 2) fill_right_bounds();
        if (step % 4 == 3) sweep();
        return true;
    }
    /// When all steps are done.
    const BvhCut<2>& cut() const { return best_; }

  private:
    void sort() {
        std::ranges::sort(range_, {}, [axis = builder_.dimension](const BvhReference<2>& box) {
            return std::pair(box.box.centroid()[axis], box.polygon);
        });
    }
    void fill_right_bounds() {
        BasicAabb<2> box;
        for (std::size_t i = range_.size(); i-- > 0;) {
            box.extend(range_[i].box);
            builder_.right_bounds[i] = box;
        }
    }
    void sweep() {
        BasicAabb<2> left;
        for (std::size_t i = 1; i < range_.size(); ++i) {
            left.extend(range_[i - 1].box);
            const BasicAabb<2>& right = builder_.right_bounds[i];
            const double cost = double(left.half_area()) * double(i) +
                                double(right.half_area()) * double(range_.size() - i);
            if (cost >= best_cost_) continue;
            best_cost_ = cost;
            best_axis_ = builder_.dimension;
            best_ = {i, left, right};
        }
    }

    SharedBuilder& builder_;
    std::span<BvhReference<2>> range_;
    int step_ = 0;
    int best_axis_ = 0;
    double best_cost_ = infinity;
    BvhCut<2> best_ = {};
};

}  // namespace space
