/// @file
/// Corners of fragments as what they are, meets of input planes, and exact answers about them. A
/// new corner is never made from corners that were made before, so numbers stay short however often
/// a polygon is cut (Bernstein & Fussell 2009, "Fast, Exact, Linear Booleans", section 3).
#pragma once

#include "chapters/ch03_bsp_trees/split_plane.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace space {

/// What an edge of a fragment lies on: an edge of its original polygon (edge i from corner i to the
/// next), or a splitting plane by its number. In the plane a fragment has no edges but ends: an end
/// of the original segment, or the line that cut it off.
struct Carrier {
    std::uint32_t id;  ///< a plane's number; an edge's, counted down from the largest

    static Carrier original(int edge) { return {~static_cast<std::uint32_t>(edge)}; }
    static Carrier plane(std::uint32_t number) { return {number}; }
    bool is_original() const { return id >= ~2u; }
    int edge() const { return static_cast<int>(~id); }
    std::uint32_t number() const { return id; }  ///< of the plane
    bool operator==(const Carrier&) const = default;
};

/// An exact corner by its name: where its polygon and D - 1 carriers meet. In space the carriers
/// are those of the edge that comes in and of the edge that goes out; in the plane that of the end.
template <int D>
struct Meet {
    const Simplex<D>& polygon;
    std::array<Carrier, D - 1> carriers;
    std::span<const SplitPlane<D>> planes;  ///< by the carriers' numbers
};

/// A point and how far each of its coordinates may be off.
template <int D>
struct Approximation {
    Double<D> at;
    double error;
};

/// On which side of the plane the point lies, exactly: 1 in front, 0 on it, -1 behind.
template <int D>
int exact_side(const Simplex<D>& plane, const Meet<D>& meet);
template <int D>
int exact_side(const Simplex<D>& plane, const Point<D>& point);

/// The point itself, rounded from the exact one.
template <int D>
Approximation<D> approximate(const Meet<D>& meet);

}  // namespace space
