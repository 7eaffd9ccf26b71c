/// @file
/// Points that are hard for a search: ties, near ties in float and in double, far from the origin,
/// at the ends of what floats hold. And answers by a loop in rational numbers.
#pragma once

#include "chapters/ch04_kd_trees/squared_distance.hpp"
#include "common/pcg32.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// How a coordinate is drawn.
struct NumberKind {
    std::string name;
    float (*draw)(Pcg32&);
};

inline float wild_float(Pcg32& random) {
    for (;;)
        if (const auto x = std::bit_cast<float>(random.next()); std::isfinite(x)) return x;
}
inline float whole_float(Pcg32& random, std::uint32_t below) {
    return static_cast<float>(random.below(below));
}

inline const std::vector<NumberKind> number_kinds{
    {"ordinary", [](Pcg32& r) { return r.uniform(-1.0f, 1.0f); }},
    {"a grid, where distances tie", [](Pcg32& r) { return whole_float(r, 6); }},
    {"near ties in float",
     [](Pcg32& r) {
         const float large = whole_float(r, 2) * 4096.0f;
         return large + whole_float(r, 4);
     }},
    {"near ties in double",
     [](Pcg32& r) {
         const float sign = r.below(2) ? 1.0f : -1.0f, large = whole_float(r, 2) + 3.0f;
         const float small = 0x1p-20f + whole_float(r, 4) * 0x1p-43f;
         return sign * (r.below(2) ? large : small);
     }},
    {"far from the origin", [](Pcg32& r) { return 1e6f + r.uniform(-1.0f, 1.0f); }},
    {"clusters far apart",
     [](Pcg32& r) {
         const float cluster = 1e7f * whole_float(r, 3);
         return cluster + r.uniform(-1.0f, 1.0f);
     }},
    {"squares that overflow", [](Pcg32& r) { return 1e38f * r.uniform(-3.0f, 3.0f); }},
    {"squares that underflow", [](Pcg32& r) { return 1e-22f * r.uniform(-1.0f, 1.0f); }},
    {"subnormal", [](Pcg32& r) { return std::ldexp(whole_float(r, 9) - 4.0f, -149); }},
    {"any bits", wild_float},
    {"all equal", [](Pcg32&) { return 0.1f; }},
};

template <int D>
Point<D> drawn_point(Pcg32& random, const NumberKind& kind) {
    Point<D> p;
    for (int axis = 0; axis < D; ++axis) p[axis] = kind.draw(random);
    return p;
}
template <int D>
std::vector<Point<D>> drawn_points(Pcg32& random, const NumberKind& kind, std::size_t count) {
    std::vector<Point<D>> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(drawn_point<D>(random, kind));
    return points;
}

template <int D>
mpq_class rational_distance(const Point<D>& p, const Point<D>& q) {
    mpq_class sum = 0;
    for (int axis = 0; axis < D; ++axis) {
        const mpq_class difference = mpq_class(p[axis]) - mpq_class(q[axis]);
        sum += difference * difference;
    }
    return sum;
}

/// All points, the nearest first; of equally near ones the lower index first.
template <int D>
std::vector<std::pair<mpq_class, std::uint32_t>> all_by_distance(std::span<const Point<D>> points,
                                                                 const Point<D>& query) {
    std::vector<std::pair<mpq_class, std::uint32_t>> all;
    for (std::uint32_t i = 0; i < points.size(); ++i)
        all.emplace_back(rational_distance<D>(points[i], query), i);
    std::sort(all.begin(), all.end());
    return all;
}

}  // namespace space
