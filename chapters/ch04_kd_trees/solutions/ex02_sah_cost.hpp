/// @file
/// Exercise 4.2, our answer.
#pragma once

#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
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
    enum Kind { end, flat, start };
    struct Event {
        Place place;
        Kind kind;
    };
    std::vector<Event> events;
    for (const Extent<Place>& box : boxes) {
        if (box.low == box.high) {
            events.push_back({box.low, flat});
        } else {
            events.push_back({box.low, start});
            events.push_back({box.high, end});
        }
    }
    std::ranges::sort(events, [](const Event& a, const Event& b) { return a.place < b.place; });

    std::optional<Tried<Place>> best;
    const auto consider = [&](Place position, bool flat_below, std::size_t below,
                              std::size_t above) {
        const Tried<Place> tried{position, flat_below, cost(position, below, above)};
        if (!best || tried.cost < best->cost) best = tried;
    };
    std::size_t below = 0, above = boxes.size();
    for (std::size_t i = 0; i < events.size();) {
        const Place place = events[i].place;
        std::array<std::size_t, 3> here{};
        for (; i < events.size() && events[i].place == place; ++i) ++here[events[i].kind];
        above -= here[end] + here[flat];
        consider(place, true, below + here[flat], above);
        if (here[flat] > 0) consider(place, false, below, above + here[flat]);
        below += here[start] + here[flat];
    }
    return best;
}

}  // namespace space
