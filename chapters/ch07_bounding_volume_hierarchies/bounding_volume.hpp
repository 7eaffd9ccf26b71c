/// @file
/// What may stand around a part of a scene, and the axis-aligned box as the first of its kind.
#pragma once

#include "chapters/ch02_intersection_tests/boxes.hpp"
#include "common/geometry.hpp"

#include <concepts>
#include <span>
#include <vector>

namespace space {

// [bounding_volume]
/// A closed set that holds what it was made around, every point of it, in exact arithmetic. What a
/// ray is held against is made of the ray once, for many volumes of the kind.
///
/// A ray that has a point in common with the volume in exact arithmetic `meets` it. Of rays that
/// pass by, only some within a few roundings do: such a yes costs a step, a wrong no a triangle.
/// Coordinates are at most 2^126: beyond it planes and sizes may be infinite.
template <class Volume>
concept BoundingVolume = requires(const Volume& volume, const Ray& ray) {
    { volume.is_empty() } -> std::same_as<bool>;
    { surface(volume) } -> std::same_as<double>;  // what chances of random rays are made of
    { content(volume) } -> std::same_as<double>;
    { merged(volume, volume) } -> std::same_as<Volume>;  // a volume around both
    { meets(prepared_for(ray, volume), volume) } -> std::same_as<bool>;
};
// [bounding_volume]

/// The corners of all polygons: what volumes are made around, for they are convex. A polygon with a
/// corner that is not finite is left out, as trees leave it out.
template <int D>
std::vector<Point<D>> corners_of(std::span<const Simplex<D>> polygons) {
    std::vector<Point<D>> corners;
    corners.reserve(polygons.size() * D);
    for (const Simplex<D>& polygon : polygons) {
        bool finite = true;
        for (int i = 0; i < D; ++i) finite = finite && is_finite<D>(polygon[i]);
        for (int i = 0; i < D && finite; ++i) corners.push_back(polygon[i]);
    }
    return corners;
}

/// The area of a box with these edges; in the plane, the length of its boundary.
template <int D>
double surface_of_edges(const Double<D>& e) {
    if constexpr (D == 2)
        return 2.0 * (e.x + e.y);
    else
        return 2.0 * (e.x * e.y + (e.x + e.y) * e.z);
}
/// The volume; in the plane, the area.
template <int D>
double content_of_edges(const Double<D>& e) {
    double product = e[0];
    for (int axis = 1; axis < D; ++axis) product *= e[axis];
    return product;
}

// ---- the axis-aligned box ---------------------------------------------------------------------

/// Exact: its sides are coordinates of points.
template <int D>
BasicAabb<D> box_around(std::span<const Point<D>> points) {
    BasicAabb<D> box;
    for (const Point<D>& p : points) box.extend(p);
    return box;
}
template <int D>
BasicAabb<D> merged(BasicAabb<D> a, const BasicAabb<D>& b) {
    a.extend(b);
    return a;
}
/// In double from the start, where extents of floats don't overflow.
template <int D>
Double<D> edges(const BasicAabb<D>& box) {
    return box.is_empty() ? Double<D>(0.0) : Double<D>(box.max) - Double<D>(box.min);
}
template <int D>
double surface(const BasicAabb<D>& box) {
    return surface_of_edges<D>(edges(box));
}
template <int D>
double content(const BasicAabb<D>& box) {
    return content_of_edges<D>(edges(box));
}
inline SlabConservative::Prepared prepared_for(const Ray& ray, const Aabb&) {
    return SlabConservative::prepare(ray);
}
inline bool meets(const SlabConservative::Prepared& ray, const Aabb& box) {
    return SlabConservative::intersect(ray, box).has_value();
}

}  // namespace space
