/// @file
/// Exercise 4.2, a near miss: a flat box begins and ends at one place like any other box. When the
/// plane at this place is tried it has ended already and has not yet begun: neither half pays for
/// it. So planes through walls look cheaper than they are.
#pragma once

#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace space {

inline constexpr double node_cost = 1.0;  ///< of a step down the tree
inline constexpr double test_cost = 2.0;  ///< of a ray-triangle test

/// `below` and `above` are numbers of triangles in the halves.
inline double sah_cost(const Aabb& cell, int axis, float position, std::size_t below,
                       std::size_t above) {
    if (!(cell.min[axis] < cell.max[axis])) return infinity;
    const bool is_line = cell.half_area() == 0.0;
    const auto size = [&](const Aabb& box) {
        return is_line ? static_cast<double>(box.extent()[axis]) : box.half_area();
    };
    const auto [low, high] = halves(cell, {axis, position});
    const double tests =
        (size(low) * static_cast<double>(below) + size(high) * static_cast<double>(above)) /
        size(cell);
    return node_cost + test_cost * tests;
}

/// What a box covers of the axis; in a flat box low == high.
template <class Place>
struct Extent {
    Place low, high;
};

/// A plane that has been tried.
template <class Place>
struct Tried {
    Place position;
    bool flat_below;  ///< where flat boxes in the plane go; true where there are none
    double cost;
};

/// The cheapest of the planes where boxes begin or end; of equally cheap ones the lowest, and there
/// the one with flat boxes below. Nothing where there are no boxes. cost(position, below, above)
/// says what a plane costs.
template <class Place, class Cost>
std::optional<Tried<Place>> cheapest_plane(std::span<const Extent<Place>> boxes, const Cost& cost) {
    struct Event {
        Place place;
        bool is_start;
    };
    std::vector<Event> events;
    for (const Extent<Place>& box : boxes) {
        events.push_back({box.low, true});
        events.push_back({box.high, false});
    }
    std::ranges::sort(events, [](const Event& a, const Event& b) { return a.place < b.place; });

    std::optional<Tried<Place>> best;
    std::size_t below = 0, above = boxes.size();
    for (std::size_t i = 0; i < events.size();) {
        const Place place = events[i].place;
        std::size_t starts = 0, ends = 0;
        for (; i < events.size() && events[i].place == place; ++i)
            ++(events[i].is_start ? starts : ends);
        above -= ends;
        const Tried<Place> tried{place, true, cost(place, below, above)};
        if (!best || tried.cost < best->cost) best = tried;
        below += starts;
    }
    return best;
}

}  // namespace space
