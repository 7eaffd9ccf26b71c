/// @file
/// Exercise 4.2: The cost of a plane
/// Difficulty 2 of 3, about 40 minutes.
///
/// What does a ray through a cell cost once a plane has cut it in two? One step down the tree, and
/// a test for each triangle of every half that the ray meets. It meets a half with the chance
/// (surface of the half) / (surface of the cell): write that down in `sah_cost`. A flat cell has
/// the surface of its two faces. A cell that has shrunk to a line has none; then lengths take the
/// place of surfaces. A cell without extent along the axis cannot be cut across it: infinity.
///
/// Then make `cheapest_plane` fast. It is right already and says what is wanted, but compares each
/// plane with each box. Sort the ends of the boxes once, and sweep over them. The check takes all
/// away from a `Place` but its comparisons, and counts them: for n boxes at most 16 n log2(2 n),
/// and 4 n calls of `cost`. `cost` may be any function: try all the planes, and no others.
#pragma once

#include "common/geometry.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace space {

inline constexpr double node_cost = 1.0;  ///< of a step down the tree
inline constexpr double test_cost = 2.0;  ///< of a ray-triangle test

/// `below` and `above` are numbers of triangles in the halves.
inline double sah_cost(const Aabb& cell, int axis, float position, std::size_t below,
                       std::size_t above) {
    // TODO: the halves are seldom met by every second ray each
    static_cast<void>(cell);
    static_cast<void>(axis);
    static_cast<void>(position);
    return node_cost + test_cost * 0.5 * static_cast<double>(below + above);
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
    // TODO: n boxes have 2 n ends, and each is compared with n boxes
    std::optional<Tried<Place>> best;
    const auto consider = [&](Place position, bool flat_below, std::size_t below,
                              std::size_t above) {
        const Tried<Place> tried{position, flat_below, cost(position, below, above)};
        if (!best || tried.cost < best->cost ||
            (tried.cost == best->cost && tried.position < best->position))
            best = tried;
    };
    for (const Extent<Place>& candidate : boxes)
        for (const Place position : {candidate.low, candidate.high}) {
            std::size_t below = 0, above = 0, flat = 0;
            for (const Extent<Place>& box : boxes) {
                below += box.low < position;
                above += box.high > position;
                flat += box.low == position && box.high == position;
            }
            consider(position, true, below + flat, above);
            if (flat > 0) consider(position, false, below, above + flat);
        }
    return best;
}

}  // namespace space
