/// @file
/// Points and vectors of rational numbers (GMP): the truth that tests hold floating-point numbers
/// against.
#pragma once

#include "common/geometry.hpp"

#include <gmpxx.h>

#include <array>
#include <cstddef>

namespace space {

/// Exact coordinates.
template <int D>
struct ExactVector {
    std::array<mpq_class, D> at;

    mpq_class& operator[](int axis) { return at[static_cast<std::size_t>(axis)]; }
    const mpq_class& operator[](int axis) const { return at[static_cast<std::size_t>(axis)]; }
};

template <int D, class Number>
ExactVector<D> exact(const glm::vec<D, Number>& v) {
    ExactVector<D> result;
    for (int axis = 0; axis < D; ++axis) result[axis] = double{v[axis]};
    return result;
}

template <int D>
ExactVector<D> operator-(const ExactVector<D>& a, const ExactVector<D>& b) {
    ExactVector<D> result;
    for (int axis = 0; axis < D; ++axis) result[axis] = a[axis] - b[axis];
    return result;
}
template <int D>
mpq_class dot(const ExactVector<D>& a, const ExactVector<D>& b) {
    mpq_class sum = a[0] * b[0];
    for (int axis = 1; axis < D; ++axis) sum += a[axis] * b[axis];
    return sum;
}
inline ExactVector<3> cross(const ExactVector<3>& a, const ExactVector<3>& b) {
    return {{mpq_class(a[1] * b[2] - a[2] * b[1]), mpq_class(a[2] * b[0] - a[0] * b[2]),
             mpq_class(a[0] * b[1] - a[1] * b[0])}};
}

/// Of the plane through three points, or of the line through two.
inline ExactVector<3> exact_normal(const Triangle& t) {
    return cross(exact(t.b) - exact(t.a), exact(t.c) - exact(t.a));
}
inline ExactVector<2> exact_normal(const Segment& s) {
    const ExactVector<2> along = exact(s.b) - exact(s.a);
    return {{mpq_class(-along[1]), along[0]}};
}

}  // namespace space
