#include "chapters/ch03_bsp_trees/exact_corner.hpp"

#include "chapters/ch03_bsp_trees/exact_point.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace space {
namespace {

/// Every float is a whole number of 2^-149.
constexpr int unit_exponent = 149;

mpz_class units(float x) {
    return mpz_class(std::ldexp(static_cast<double>(x), unit_exponent));
}

template <int D>
using Whole = std::array<mpz_class, D>;

template <int D>
Whole<D> units(const Point<D>& p) {
    Whole<D> result;
    for (int axis = 0; axis < D; ++axis) result[axis] = units(p[axis]);
    return result;
}
template <int D>
Whole<D> operator-(const Whole<D>& a, const Whole<D>& b) {
    Whole<D> result;
    for (int axis = 0; axis < D; ++axis) result[axis] = a[axis] - b[axis];
    return result;
}
template <int D>
mpz_class dot(const Whole<D>& a, const Whole<D>& b) {
    mpz_class sum = a[0] * b[0];
    for (int axis = 1; axis < D; ++axis) sum += a[axis] * b[axis];
    return sum;
}
Whole<3> cross(const Whole<3>& a, const Whole<3>& b) {
    return {mpz_class(a[1] * b[2] - a[2] * b[1]), mpz_class(a[2] * b[0] - a[0] * b[2]),
            mpz_class(a[0] * b[1] - a[1] * b[0])};
}

/// normal . p = offset on the plane, positive in front.
template <int D>
struct WholePlane {
    Whole<D> normal;
    mpz_class offset;

    explicit WholePlane(const Simplex<D>& through) {
        const Whole<D> a = units<D>(through[0]), ab = operator-<D>(units<D>(through[1]), a);
        if constexpr (D == 3)
            normal = cross(ab, operator-<D>(units<D>(through[2]), a));
        else
            normal = {mpz_class(-ab[1]), ab[0]};
        offset = dot<D>(normal, a);
    }
    mpz_class distance(const Whole<D>& p) const { return dot<D>(normal, p) - offset; }
};

/// The point numerator / denominator, in units.
template <int D>
struct Homogeneous {
    Whole<D> numerator;
    mpz_class denominator;
};

/// Where the line through p and q meets the plane: weighted by the distances of the two.
template <int D>
Homogeneous<D> meet(const Whole<D>& p, const Whole<D>& q, const WholePlane<D>& plane) {
    const mpz_class of_p = plane.distance(p), of_q = plane.distance(q);
    Homogeneous<D> result;
    for (int axis = 0; axis < D; ++axis) result.numerator[axis] = q[axis] * of_p - p[axis] * of_q;
    result.denominator = of_p - of_q;
    return result;
}

/// Cramer's rule.
Homogeneous<3> meet(const WholePlane<3>& a, const WholePlane<3>& b, const WholePlane<3>& c) {
    const Whole<3> bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal),
                   ab = cross(a.normal, b.normal);
    Homogeneous<3> result;
    for (int axis = 0; axis < 3; ++axis)
        result.numerator[axis] = a.offset * bc[axis] + b.offset * ca[axis] + c.offset * ab[axis];
    result.denominator = dot<3>(a.normal, bc);
    return result;
}

/// The number of the polygon's own corner that the meet is, if it is one: in space the one that two
/// of its edges share.
template <int D>
std::optional<int> own_corner(const Meet<D>& m) {
    const Carrier first = m.carriers.front(), second = m.carriers.back();
    if (!first.is_original() || !second.is_original()) return std::nullopt;
    return (first.edge() + 1) % 3 == second.edge() ? second.edge() : first.edge();
}

/// A meet of an original edge and a plane: the edge's ends p and q, and the plane.
template <int D>
struct CutEdge {
    const Point<D>&p, &q;
    const SplitPlane<D>& plane;
};
/// Nothing where both carriers are planes.
template <int D>
std::optional<CutEdge<D>> cut_edge(const Meet<D>& m) {
    if constexpr (D == 2) {
        return CutEdge<2>{m.polygon.a, m.polygon.b, m.planes[m.carriers[0].number()]};
    } else {
        auto [edge, plane] = m.carriers;
        if (!edge.is_original()) std::swap(edge, plane);
        if (!edge.is_original()) return std::nullopt;
        return CutEdge<3>{m.polygon[edge.edge()], m.polygon[(edge.edge() + 1) % 3],
                          m.planes[plane.number()]};
    }
}

/// Of a meet that is none of the polygon's own corners.
template <int D>
Homogeneous<D> point_of(const Meet<D>& m) {
    const auto cut = cut_edge(m);
    if constexpr (D == 3)
        if (!cut)
            return meet(WholePlane<3>(m.polygon),
                        WholePlane<3>(m.planes[m.carriers[0].number()].through),
                        WholePlane<3>(m.planes[m.carriers[1].number()].through));
    return meet<D>(units<D>(cut->p), units<D>(cut->q), WholePlane<D>(cut->plane.through));
}

template <int D>
int side(const Simplex<D>& plane, const Homogeneous<D>& point) {
    const WholePlane<D> exact(plane);
    const mpz_class distance =
        dot<D>(exact.normal, point.numerator) - exact.offset * point.denominator;
    return sgn(distance) * sgn(point.denominator);
}

template <int D>
Approximation<D> rounded(const Homogeneous<D>& point) {
    long denominator_exponent = 0;
    const double denominator = mpz_get_d_2exp(&denominator_exponent, point.denominator.get_mpz_t());
    Approximation<D> result{};
    for (int axis = 0; axis < D; ++axis) {
        long exponent = 0;
        const double numerator = mpz_get_d_2exp(&exponent, point.numerator[axis].get_mpz_t());
        const auto scale = static_cast<int>(exponent - denominator_exponent) - unit_exponent;
        result.at[axis] = std::ldexp(numerator / denominator, scale);
        // Two truncations to 53 bits, of which one makes the quotient smaller and one larger, and
        // its rounding: three half places, and a little. What underflows is below 2^-1000.
        result.error =
            std::max(result.error, 4.0 * double_roundoff * std::abs(result.at[axis]) + 0x1p-1000);
    }
    return result;
}

/// A double answer is good enough where its error is below this part of the distances that it was
/// made from: the filters that use it then still decide all but one corner in a million.
constexpr double good_enough = 0x1p-30;

/// Any order of points, so that polygons on both sides of an edge round the same point.
template <int D>
bool before(const Point<D>& p, const Point<D>& q) {
    for (int axis = 0; axis < D; ++axis)
        if (p[axis] != q[axis]) return p[axis] < q[axis];
    return false;
}

/// Where the line through p and q meets the plane, in double. A third of s_error is spare for the
/// same reasons as in cross_plane, and at least ten roundings of s: they pay for those of s, of the
/// way along the line and of the bound. That of the last sum remains.
template <int D>
std::optional<Approximation<D>> meet_in_double(const Point<D>& p, const Point<D>& q,
                                               const SplitPlane<D>& plane) {
    if (before<D>(q, p)) return meet_in_double<D>(q, p, plane);
    const Double<D> start(p), way = Double<D>(q) - start, anchor(plane.through[0]);
    const Estimate at_p = along_normal(plane, start - anchor),
                   at_q = along_normal(plane, Double<D>(q) - anchor);
    const double difference = at_p.value - at_q.value, difference_error = at_p.error + at_q.error;
    if (!(std::abs(difference) > 2.0 * difference_error)) return std::nullopt;
    const double s = at_p.value / difference,
                 s_error = (at_p.error + std::abs(s) * difference_error) / std::abs(difference);
    if (!(s_error < good_enough)) return std::nullopt;
    return Approximation<D>{start + s * way,
                            s_error * one_norm<D>(way) + sum_roundings * one_norm<D>(start)};
}

/// Where three planes meet, by Cramer's rule about a point nearby, in double. A term of the
/// determinant carries at most 17 roundings (four in each normal, two products, three sums), one of
/// a numerator 20; with that of the quotient and of the sum they are 22. 1.5 sum_roundings are 24,
/// and pay for the bound's own, too.
std::optional<Approximation<3>> meet_in_double(const SplitPlane<3>& a, const SplitPlane<3>& b,
                                               const SplitPlane<3>& c) {
    const Double3 near(a.through[0]);
    const Double3 bc = glm::cross(b.normal, c.normal), ca = glm::cross(c.normal, a.normal),
                  ab = glm::cross(a.normal, b.normal);
    const Double3 from_b = Double3(b.through[0]) - near,
                  from_c = Double3(c.through[0]) - near;  // a's offset is 0
    const Double3 numerator = glm::dot(b.normal, from_b) * ca + glm::dot(c.normal, from_c) * ab;
    const double denominator = glm::dot(a.normal, bc);
    const double part = 1.5 * sum_roundings * a.size * b.size * c.size / std::abs(denominator);
    if (!(part < good_enough)) return std::nullopt;
    const Double3 from_near = numerator / denominator;
    const double reach = one_norm<3>(from_b) + one_norm<3>(from_c) + one_norm<3>(from_near);
    return Approximation<3>{near + from_near, part * reach + sum_roundings * one_norm<3>(near)};
}

template <int D>
std::optional<Approximation<D>> in_double(const Meet<D>& m) {
    const auto cut = cut_edge(m);
    if constexpr (D == 3)
        if (!cut)
            return meet_in_double(SplitPlane<3>(m.polygon), m.planes[m.carriers[0].number()],
                                  m.planes[m.carriers[1].number()]);
    return meet_in_double<D>(cut->p, cut->q, cut->plane);
}

}  // namespace

template <int D>
int exact_side(const Simplex<D>& plane, const Meet<D>& meet) {
    if (const auto corner = own_corner(meet)) return exact_side<D>(plane, meet.polygon[*corner]);
    return side<D>(plane, point_of(meet));
}

template <int D>
int exact_side(const Simplex<D>& plane, const Point<D>& point) {
    // Most corners that the filter leaves open are the plane's own: neighbours in a mesh share
    // them.
    for (int i = 0; i < D; ++i)
        if (plane[i] == point) return 0;
    return sgn(WholePlane<D>(plane).distance(units<D>(point)));
}

std::array<mpq_class, 3> exact_point(const Meet<3>& meet) {
    std::array<mpq_class, 3> result;
    if (const auto corner = own_corner(meet)) {
        for (int axis = 0; axis < 3; ++axis) result[axis] = double{meet.polygon[*corner][axis]};
        return result;
    }
    const Homogeneous<3> point = point_of(meet);
    for (int axis = 0; axis < 3; ++axis) {
        result[axis] = mpq_class(point.numerator[axis], point.denominator);
        result[axis].canonicalize();
        mpq_div_2exp(result[axis].get_mpq_t(), result[axis].get_mpq_t(), unit_exponent);
    }
    return result;
}

template <int D>
Approximation<D> approximate(const Meet<D>& meet) {
    if (const auto corner = own_corner(meet)) return {Double<D>(meet.polygon[*corner]), 0.0};
    const auto quick = in_double(meet);
    return quick ? *quick : rounded<D>(point_of(meet));
}

template int exact_side<2>(const Segment&, const Meet<2>&);
template int exact_side<3>(const Triangle&, const Meet<3>&);
template int exact_side<2>(const Segment&, const Point2&);
template int exact_side<3>(const Triangle&, const Point3&);
template Approximation<2> approximate<2>(const Meet<2>&);
template Approximation<3> approximate<3>(const Meet<3>&);

}  // namespace space
