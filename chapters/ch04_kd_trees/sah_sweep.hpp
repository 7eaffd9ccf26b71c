/// @file
/// The surface area heuristic in O(n log n) (Wald & Havran 2006, "On building fast kd-Trees for Ray
/// Tracing, and on doing that in O(N log N)", section 4.2): the starts and ends of all boxes are
/// sorted once, one sweep a node finds the cheapest plane, and the children inherit the order.
#pragma once

#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace space {

/// What rays cost: MacDonald & Booth 1990, "Heuristics for ray tracing using space subdivision". A
/// test is worth two nodes or so by the clock, but smaller trees spare memory and the time to fetch
/// it: at 1 to 1 rays are no slower, in half the nodes.
struct SahCosts {
    double traversal = 1.0;     ///< of an inner node
    double intersection = 1.0;  ///< of a ray-triangle test
    double empty_bonus = 0.05;  ///< the part of the cost that a plane saves which cuts off nothing
    bool straddlers_stay = false;  ///< in the inner node, where every ray tests them
};

// [split_event]
/// Where a box begins or ends on an axis. Ends come first of those at one place: a box that ends
/// there does not reach beyond, one that begins there is not yet below.
class SplitEvent {
  public:
    enum Kind : std::uint32_t { end, flat, start };

    SplitEvent() = default;
    SplitEvent(float position, Kind kind, std::uint32_t box)
        : position_(position), box_and_kind_(box << 2 | kind) {}

    float position() const { return position_; }
    Kind kind() const { return Kind(box_and_kind_ & 3u); }
    std::uint32_t box() const { return box_and_kind_ >> 2; }

    bool operator<(const SplitEvent& other) const {
        return position_ < other.position_ ||
               (position_ == other.position_ && kind() < other.kind());
    }

    /// A whole number, which grows as operator< has it: a float's bits do, but for the sign. -0 is
    /// 0.
    std::uint64_t key() const {
        const auto bits = std::bit_cast<std::uint32_t>(position_ + 0.0f);
        const std::uint32_t in_order = (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
        return std::uint64_t{in_order} << 2 | kind();
    }

  private:
    float position_ = 0.0f;
    std::uint32_t box_and_kind_ = 0;
};
// [split_event]

/// The events of a node's boxes, for each axis in their order.
template <int D>
using SplitEvents = std::array<std::vector<SplitEvent>, D>;

template <int D>
void add_events(SplitEvents<D>& events, const BasicAabb<D>& box, std::uint32_t index) {
    for (int axis = 0; axis < D; ++axis) {
        auto& list = events[static_cast<std::size_t>(axis)];
        if (box.min[axis] == box.max[axis]) {
            list.push_back({box.min[axis], SplitEvent::flat, index});
        } else {
            list.push_back({box.min[axis], SplitEvent::start, index});
            list.push_back({box.max[axis], SplitEvent::end, index});
        }
    }
}

// [sort_events]
/// In the order of operator<, by digits (radix sort): the lowest 11 bits of position and kind
/// first, then the next 11, then 12. Of a million events that is several times as fast as comparing
/// them.
inline void sort_events(std::vector<SplitEvent>& events) {
    std::vector<SplitEvent> sorted(events.size());
    for (const auto& [shift, bits] : {std::pair{0, 11}, {11, 11}, {22, 12}}) {
        const auto digit = [shift = shift, mask = (1u << bits) - 1](const SplitEvent& event) {
            return (event.key() >> shift) & mask;
        };
        std::vector<std::uint32_t> place((std::size_t{1} << bits) + 1);
        for (const SplitEvent& event : events) ++place[digit(event) + 1];
        std::partial_sum(place.begin(), place.end(), place.begin());
        for (const SplitEvent& event : events) sorted[place[digit(event)]++] = event;
        events.swap(sorted);
    }
}
// [sort_events]

/// A plane that the sweep has tried, as an event for an observer too.
struct SahCandidate {
    KdSplit split;
    double cost;
    std::size_t below, above;  ///< boxes that reach into each half; straddlers count in both
};

/// The cost of planes across one axis of a cell: the chance that a ray through the cell meets a
/// half is linear in the half's length.
template <int D>
class SahCost {
  public:
    SahCost(const BasicAabb<D>& cell, int axis, const SahCosts& costs)
        : costs_(costs), low_(cell.min[axis]), length_(cell.max[axis] - double{low_}) {
        Double<D> extent = Double<D>(cell.max) - Double<D>(cell.min);
        extent[axis] = 0.0;
        double sum = 0.0, product = 0.0;
        for (int other = 0; other < D; ++other) {
            if constexpr (D == 3) product += extent[other] * extent[(other + 1) % 3];
            sum += extent[other];
        }
        cap_ = D == 3 ? product : sum;
        // Of a cell that is a line the length decides: areas would be 0 / 0.
        rim_ = D == 3 && sum > 0.0 ? sum : 1.0;
        whole_ = cap_ + rim_ * length_;
    }
    /// No plane across this axis parts the cell.
    bool is_flat() const { return !(length_ > 0.0); }

    // [sah_cost]
    /// K_T + K_I (P(below) below + P(above) above), P by areas.
    double operator()(float position, std::size_t below, std::size_t above, std::size_t all) const {
        const double share_below = (cap_ + rim_ * (double{position} - low_)) / whole_;
        const double share_above = (cap_ + rim_ * (low_ + length_ - double{position})) / whole_;
        const std::size_t stay = costs_.straddlers_stay ? below + above - all : 0;
        const double tests =
            share_below * double(below - stay) + share_above * double(above - stay) + double(stay);
        const double cost = costs_.traversal + costs_.intersection * tests;
        return below == 0 || above == 0 ? cost * (1.0 - costs_.empty_bonus) : cost;
    }
    // [sah_cost]

  private:
    SahCosts costs_;
    double low_, length_, cap_, rim_, whole_;
};

// [best_split]
/// The cheapest plane for `all` boxes with these events, if there is one that is cheaper than a
/// leaf. Tells the observer every candidate (SahCandidate).
template <int D, class Observer = NoObserver>
std::optional<KdSplit> best_split(const SplitEvents<D>& events, const BasicAabb<D>& cell,
                                  std::size_t all, const SahCosts& costs,
                                  Observer&& observer = {}) {
    std::optional<KdSplit> best;
    double best_cost = costs.intersection * double(all);
    for (int axis = 0; axis < D; ++axis) {
        const SahCost<D> cost(cell, axis, costs);
        if (cost.is_flat()) continue;
        const auto consider = [&](KdSplit split, std::size_t below, std::size_t above) {
            const SahCandidate candidate{split, cost(split.position, below, above, all), below,
                                         above};
            observer.observe(candidate);
            if (!(candidate.cost < best_cost)) return;  // also where it is not a number
            best_cost = candidate.cost;
            best = split;
        };
        const auto& list = events[static_cast<std::size_t>(axis)];
        std::size_t below = 0, above = all;
        for (std::size_t i = 0; i < list.size();) {
            const float position = list[i].position();
            std::array<std::size_t, 3> of_kind{};
            for (; i < list.size() && list[i].position() == position; ++i)
                ++of_kind[list[i].kind()];
            const std::size_t flat = of_kind[SplitEvent::flat];
            above -= of_kind[SplitEvent::end] + flat;
            // At the cell's own ends a plane can only give what is flat a flat cell.
            if (position < cell.max[axis] && (position > cell.min[axis] || flat > 0))
                consider({axis, position, true}, below + flat, above);
            if (position > cell.min[axis] && flat > 0)
                consider({axis, position, false}, below, above + flat);
            below += of_kind[SplitEvent::start] + flat;
        }
    }
    return best;
}
// [best_split]

}  // namespace space
