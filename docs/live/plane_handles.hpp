/// @file
/// Handles on points of a plane that a figure draws.
#pragma once

#include "common/program/plane_view.hpp"
#include "docs/live/live.hpp"

#include <string>
#include <utility>
#include <vector>

namespace space::live {

/// Collects a figure's handles while it asks where they are.
class PlaneHandles {
  public:
    std::vector<Handle> handles = {};

    explicit PlaneHandles(const State& state) : state_(state) {}

    /// Where a point of the view's plane is: from (0, 0) to `most`. Floats are shown by what they
    /// were written as, if that has three decimals at most.
    Point2 at(const PlaneView& view, const Double2& most, std::string name, std::string label,
              const Point2& first) {
        const Double2 zero(view(Double2(0.0))), unit(view.scale, -view.scale),
            written = glm::round(1000.0 * Double2(first)) / 1000.0,
            value = glm::min(state_.point(name, written, 0.0, glm::max(most.x, most.y)), most);
        handles.push_back({std::move(name), std::move(label), value, zero, unit});
        return Point2(value);
    }

  private:
    const State& state_;
};

}  // namespace space::live
