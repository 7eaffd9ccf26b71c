/// @file
/// Points that volumes are made around: of every size, many on one boundary, few, flat, or one.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bounding_volume.hpp"
#include "common/random.hpp"
#include "tests/ch04/point_sets.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace space {

template <int D>
struct PointSet {
    std::string name;
    std::vector<Point<D>> points;
};

/// Beyond it planes may be infinite.
inline constexpr double largest_proved = 0x1p126;

template <int D>
double largest_coordinate(std::span<const Point<D>> points) {
    double largest = 0.0;
    for (const Point<D>& p : points)
        for (int axis = 0; axis < D; ++axis) largest = std::max(largest, std::abs(double{p[axis]}));
    return largest;
}

/// A box with edges from 1 to 8, turned at random, and points in it: its corners first.
template <int D>
std::vector<Point<D>> points_of_turned_box(Pcg32& random, std::size_t inside, Double<D>& edges) {
    glm::mat<D, D, double> turn(1.0);
    for (int i = 0; i < D; ++i)
        for (int j = i + 1; j < D; ++j) {
            const double tangent = 4.0 * random.uniform_double() - 2.0;
            const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
            const Double<D> u = turn[i], v = turn[j];
            turn[i] = cosine * (u - tangent * v);
            turn[j] = cosine * (v + tangent * u);
        }
    for (int axis = 0; axis < D; ++axis) edges[axis] = 1.0 + 7.0 * random.uniform_double();
    std::vector<Point<D>> points;
    for (std::size_t k = 0; k < (std::size_t{1} << D) + inside; ++k) {
        Double<D> local(0.0);
        for (int axis = 0; axis < D; ++axis)
            local[axis] = edges[axis] * (k >> D ? random.uniform_double() : double(k >> axis & 1));
        points.push_back(Point<D>(turn * local));
    }
    return points;
}

/// Whole coordinates, all at one distance from the origin: exact tangents and ties.
template <int D>
std::vector<Point<D>> points_on_sphere() {
    std::vector<Point<D>> points;
    const int r = D == 2 ? 25 : 9;
    for (int x = -r; x <= r; ++x)
        for (int y = -r; y <= r; ++y)
            for (int z = D == 2 ? 0 : -r; z <= (D == 2 ? 0 : r); ++z)
                if (x * x + y * y + z * z == r * r) {
                    Point<D> p(0.0f);
                    const int coordinates[] = {x, y, z};
                    for (int axis = 0; axis < D; ++axis) p[axis] = float(coordinates[axis]);
                    points.push_back(p);
                }
    return points;
}

/// Of all kinds of numbers, `each` sets of up to `most` points; and the special ones.
template <int D>
std::vector<PointSet<D>> point_sets(std::size_t each, std::uint32_t most) {
    std::vector<PointSet<D>> sets;
    Pcg32 random(70 + D);
    for (const NumberKind& kind : number_kinds)
        for (std::size_t i = 0; i < each; ++i) {
            const std::size_t count = 1 + random.below(most);
            sets.push_back({kind.name, drawn_points<D>(random, kind, count)});
            std::vector<Point<D>>& points = sets.back().points;
            const std::uint32_t shape = random.below(6);
            const Point<D> from = points[0],
                           by = random_point<D>(random, {Point<D>(-1), Point<D>(1)});
            for (Point<D>& p : points) {
                if (shape == 0) p[D - 1] = from[D - 1];  // flat
                if (shape == 1)
                    p = from + float(random.below(9)) * by;  // on a line, but for roundings
                if (shape == 2)
                    p = points[random.below(std::uint32_t(std::min<std::size_t>(count, 3)))];
            }
            for (Point<D>& p : points)
                if (!is_finite<D>(p)) p = from;
        }
    Double<D> edges;
    sets.push_back({"a turned box", points_of_turned_box<D>(random, 30, edges)});
    sets.push_back({"on a sphere", points_on_sphere<D>()});
    sets.push_back({"one point", {Point<D>(0.1f)}});
    sets.push_back({"one point, huge", {Point<D>(1e30f)}});
    sets.push_back({"two, at the ends of the floats",
                    {Point<D>(-3.4e38f), Point<D>(3.4e38f), Point<D>(0.0f)}});
    sets.push_back({"huge", {Point<D>(-1e30f), Point<D>(1e30f), Point<D>(3.0f), Point<D>(-2e29f)}});
    return sets;
}

}  // namespace space
