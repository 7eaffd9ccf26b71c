/// @file
/// Exercise 8.2, a near miss: each thread has its own, as in [BvhThesis13], where a thread ends a
/// sweep before it begins another. No two threads meet in them; but two tasks of one thread do, and
/// so does a task that goes on in another thread.
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
};

/// Finds the cheapest cut of 2 to `most_boxes` boxes, and puts them in its order.
class SweepTask {
  public:
    SweepTask(const SharedBuilder&, std::span<BvhReference<2>> range) : range_(range) {}

    /// Does the next of the task's steps. @return whether there are more
    bool step() {
        const int step = step_++;
        if (step == 8) dimension = best_axis_;
        if (step == 9) sort();
        if (step >= 8) return step < 9;
        if (step % 4 == 0) dimension = step / 4;
        if (step % 4 == 1) sort();
        if (step % 4 == 2) fill_right_bounds();
        if (step % 4 == 3) sweep();
        return true;
    }
    /// When all steps are done.
    const BvhCut<2>& cut() const { return best_; }

  private:
    void sort() {
        std::ranges::sort(range_, {}, [axis = dimension](const BvhReference<2>& box) {
            return std::pair(box.box.centroid()[axis], box.polygon);
        });
    }
    void fill_right_bounds() {
        BasicAabb<2> box;
        for (std::size_t i = range_.size(); i-- > 0;) {
            box.extend(range_[i].box);
            right_bounds[i] = box;
        }
    }
    void sweep() {
        BasicAabb<2> left;
        for (std::size_t i = 1; i < range_.size(); ++i) {
            left.extend(range_[i - 1].box);
            const BasicAabb<2>& right = right_bounds[i];
            const double cost = double(left.half_area()) * double(i) +
                                double(right.half_area()) * double(range_.size() - i);
            if (cost >= best_cost_) continue;
            best_cost_ = cost;
            best_axis_ = dimension;
            best_ = {i, left, right};
        }
    }

    static inline thread_local int dimension = 0;
    static inline thread_local std::array<BasicAabb<2>, SharedBuilder::most_boxes> right_bounds;

    std::span<BvhReference<2>> range_;
    int step_ = 0;
    int best_axis_ = 0;
    double best_cost_ = infinity;
    BvhCut<2> best_ = {};
};

}  // namespace space
