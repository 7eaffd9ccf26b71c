// The only source file that includes CGAL: it is compiled once, for all tests.
#include "tests/oracle/exact.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace space {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
/// An interval first, a rational number when the interval does not decide.
using Exact = Kernel::FT;

template <class Number>
using Vec = std::array<Number, 3>;

/// p - origin, in a number type that converts floats without loss.
template <class Number>
Vec<Number> difference(const Point3& p, const Point3& origin) {
    const auto component = [&](int axis) {
        return Number(double{p[axis]}) - Number(double{origin[axis]});
    };
    return {component(0), component(1), component(2)};
}
template <class Number>
Vec<Number> cross(const Vec<Number>& a, const Vec<Number>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class Number>
Number dot(const Vec<Number>& a, const Vec<Number>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The corners as seen from the ray's origin.
template <class Number>
struct View {
    Vec<Number> a, b, c, direction;

    View(const Ray& ray, const Triangle& triangle)
        : a(difference<Number>(triangle.a, ray.origin)),
          b(difference<Number>(triangle.b, ray.origin)),
          c(difference<Number>(triangle.c, ray.origin)),
          direction(difference<Number>(ray.direction, Point3{0.0f})) {}
};

/// Volumes of the parallelepipeds of the direction and two corners: the weights of a, b and c times
/// the determinant, which is their sum. The fourth, of the three corners, is t times the
/// determinant.
struct Volumes {
    Exact a, b, c, determinant, t;

    Volumes(const Ray& ray, const Triangle& triangle) {
        const View<Exact> view(ray, triangle);
        const Vec<Exact> bc = cross(view.b, view.c);
        a = dot(view.direction, bc);
        b = dot(view.direction, cross(view.c, view.a));
        c = dot(view.direction, cross(view.a, view.b));
        determinant = a + b + c;
        t = dot(view.a, bc);
    }
};

/// The line passes two edges on different sides, beyond doubt. A volume computed in double is a sum
/// of six products of three factors; a difference of coordinates, two products and the sums round
/// at most eight times (2^-53 each), so it is off by less than 6 * 8 * 2^-53 < 2^-47 times the
/// largest product. Doubles of this size neither over- nor underflow.
bool certainly_missed(const Ray& ray, const Triangle& triangle) {
    const View<double> view(ray, triangle);
    const auto largest = [](const Vec<double>& v) {
        return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    };
    const double size = std::max({largest(view.a), largest(view.b), largest(view.c)});
    const double bound = 0x1p-47 * largest(view.direction) * size * size;
    const auto side = [&](const Vec<double>& x, const Vec<double>& y) {
        const double volume = dot(view.direction, cross(x, y));
        return volume > bound ? 1 : volume < -bound ? -1 : 0;
    };
    const int a = side(view.b, view.c), b = side(view.c, view.a), c = side(view.a, view.b);
    return a * b < 0 || b * c < 0 || c * a < 0;
}

Place place(const Volumes& volumes) {
    const CGAL::Sign sign = CGAL::sign(volumes.determinant);
    if (sign == CGAL::ZERO) return Place::miss;
    int zeros = 0;
    for (const Exact* volume : {&volumes.a, &volumes.b, &volumes.c}) {
        const CGAL::Sign side = CGAL::sign(*volume);
        if (side == CGAL::ZERO)
            ++zeros;
        else if (side != sign)
            return Place::miss;
    }
    return zeros == 0 ? Place::interior : zeros == 1 ? Place::edge : Place::vertex;
}

/// The nearest float, ties to even; beyond the largest float by half a unit in the last place:
/// infinity.
float nearest_float(const Exact& value) {
    const auto as_double =
        [](float f) {  // 2^128 stands for infinity: what would follow the largest float
            return std::isinf(f) ? std::copysign(0x1p128, double{f}) : double{f};
        };
    auto guess =
        static_cast<float>(CGAL::to_double(value));  // at most a unit in the last place off
    for (;;) {
        const float below = std::nextafter(guess, -infinity),
                    above = std::nextafter(guess, infinity);
        const Exact low(0.5 *
                        (as_double(below) + as_double(guess)));  // the middles are exact in double
        const Exact high(0.5 * (as_double(guess) + as_double(above)));
        const bool even = (std::bit_cast<std::uint32_t>(guess) & 1u) == 0;
        if (below != guess && (value < low || (value == low && !even)))
            guess = below;
        else if (above != guess && (value > high || (value == high && !even)))
            guess = above;
        else
            return guess;
    }
}

bool in_interval(float t, const Ray& ray) {
    return ray.tmin <= t && t <= ray.tmax;
}

}  // namespace

Place decide(const Ray& ray, const Triangle& triangle) {
    if (!is_valid(ray)) return Place::miss;
    const Volumes volumes(ray, triangle);
    const Place where = place(volumes);
    if (where == Place::miss || !in_interval(nearest_float(volumes.t / volumes.determinant), ray))
        return Place::miss;
    return where;
}

std::optional<Crossing> crossing(const Ray& ray, const Triangle& triangle) {
    const Volumes volumes(ray, triangle);
    if (CGAL::is_zero(volumes.determinant)) return std::nullopt;
    const auto share = [&](const Exact& volume) {
        const Exact quotient = volume / volumes.determinant;
        quotient.exact();  // narrows the interval that to_double takes the middle of
        return CGAL::to_double(quotient);
    };
    volumes.determinant.exact();
    return Crossing{.t = share(volumes.t),
                    .u = share(volumes.b),
                    .v = share(volumes.c),
                    .w = share(volumes.a),
                    .determinant = CGAL::to_double(volumes.determinant)};
}

bool is_degenerate(const Triangle& triangle) {
    const Vec<Exact> normal =
        cross(difference<Exact>(triangle.b, triangle.a), difference<Exact>(triangle.c, triangle.a));
    return CGAL::is_zero(normal[0]) && CGAL::is_zero(normal[1]) && CGAL::is_zero(normal[2]);
}

ExactOracle ExactOracle::build(std::span<const Triangle> triangles) {
    ExactOracle oracle;
    oracle.triangles_.assign(triangles.begin(), triangles.end());
    return oracle;
}

std::vector<ExactHit> ExactOracle::hits(const Ray& ray) const {
    if (!is_valid(ray)) return {};
    struct Found {
        ExactHit hit;
        Exact t;
    };
    std::vector<Found> found;
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        if (certainly_missed(ray, triangles_[i])) continue;
        const Volumes volumes(ray, triangles_[i]);
        const Place where = place(volumes);
        if (where == Place::miss) continue;
        const Exact t = volumes.t / volumes.determinant;
        if (const float rounded = nearest_float(t); in_interval(rounded, ray))
            found.push_back({{.triangle = i, .place = where, .t = rounded}, t});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Found& x, const Found& y) { return x.t < y.t; });

    std::vector<ExactHit> hits;
    for (std::size_t i = 0; i < found.size(); ++i) {
        found[i].hit.rank = i == 0 ? 0 : found[i - 1].hit.rank + (found[i - 1].t < found[i].t);
        hits.push_back(found[i].hit);
    }
    return hits;
}

std::vector<ExactHit> ExactOracle::closest(const Ray& ray) const {
    std::vector<ExactHit> nearest = hits(ray);
    std::erase_if(nearest, [](const ExactHit& hit) { return hit.rank > 0; });
    return nearest;
}

bool cgal_do_intersect(const Ray& ray, const Triangle& triangle) {
    const auto point = [](const Point3& p) { return Kernel::Point_3(p.x, p.y, p.z); };
    const Kernel::Vector_3 direction(ray.direction.x, ray.direction.y, ray.direction.z);
    return CGAL::do_intersect(
        Kernel::Ray_3(point(ray.origin), direction),
        Kernel::Triangle_3(point(triangle.a), point(triangle.b), point(triangle.c)));
}

}  // namespace space
