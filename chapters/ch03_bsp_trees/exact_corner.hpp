/// @file
/// Corners of fragments as what they are, meets of input planes, and exact answers about them. A
/// new corner is never made from corners that were made before, so numbers stay short however often
/// a polygon is cut (Bernstein & Fussell 2009, "Fast, Exact, Linear Booleans", section 3).
#pragma once

#include "chapters/ch03_bsp_trees/split_plane.hpp"

#include <cstdint>

namespace space {

/// What an edge of a fragment lies on: an edge of its original polygon, or a splitting plane by its
/// number. In the plane a fragment has no edges but ends: an end of the original segment, or the
/// line that cut it off.
struct Carrier {
    std::int32_t id;

    static Carrier original(int edge) { return {-1 - edge}; }
    static Carrier plane(std::uint32_t number) { return {static_cast<std::int32_t>(number)}; }
    bool is_original() const { return id < 0; }
    int edge() const { return -1 - id; }
    std::size_t number() const { return static_cast<std::size_t>(id); }  ///< of the plane
    bool operator==(const Carrier&) const = default;
};

/// A point and how far each of its coordinates may be off.
template <int D>
struct Approximation {
    DoublePoint<D> at;
    double error;
};

/// In space: where the plane of `polygon` and the carriers of two neighbouring edges meet. Carriers
/// are numbers of original edges (edge i from corner i to the next) or pointers to the planes.
struct Meet3 {
    const Corners<3>* polygon;
    int first_edge, second_edge;  ///< original edges; -1: the plane instead
    const Corners<3>*first_plane, *second_plane;
};
/// In the plane: where the line of `polygon` and a splitting line meet.
struct Meet2 {
    const Corners<2>* polygon;
    const Corners<2>* line;
};

/// On which side of the plane the point lies, exactly: 1 in front, 0 on it, -1 behind.
int exact_side(const Corners<3>& plane, const Meet3& meet);
int exact_side(const Corners<2>& line, const Meet2& meet);
template <int D>
int exact_side(const Corners<D>& plane, const Point<D>& point);

/// Whether the three points lie on one line, exactly.
bool is_on_a_line(const Corners<3>& polygon);

/// The point itself, rounded from the exact one.
Approximation<3> approximate(const Meet3& meet);
Approximation<2> approximate(const Meet2& meet);

}  // namespace space
