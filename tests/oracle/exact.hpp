/// @file
/// What a ray hits, decided in exact arithmetic: the judge of every triangle test and every
/// structure of the book.
///
/// The contract. Coordinates are the floats as they stand, without any rounding. Triangles are
/// closed: their edges and vertices belong to them. A triangle that the ray's direction is parallel
/// to (determinant zero: seen exactly edge-on, also by a ray within its plane) is never hit, and so
/// no triangle of zero area is. t is the float nearest to the exact t (ties to even), and it is
/// this float that must lie in the closed interval [tmin, tmax]: the interval's ends count with
/// half a unit in the last place around them. A ray that is not valid (common/geometry.hpp) hits
/// nothing.
#pragma once

#include "common/geometry.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace space {

/// Where a ray meets a triangle.
enum class Place { miss, interior, edge, vertex };

/// A miss also where t is outside the ray's interval.
Place decide(const Ray& ray, const Triangle& triangle);

/// Where the ray's whole line crosses the triangle's plane: the exact values, rounded once to
/// double.
struct Crossing {
    double t;
    double u, v, w;  ///< weights of b, c and a; their sum is 1, all are >= 0 inside the triangle
    double determinant;  ///< direction . ((b - a) x (c - a))
};
/// Empty where the determinant is zero.
std::optional<Crossing> crossing(const Ray& ray, const Triangle& triangle);

/// The doubled area is zero: the vertices lie on a line.
bool is_degenerate(const Triangle& triangle);

struct ExactHit {
    std::uint32_t triangle = 0;
    Place place = Place::miss;
    float t = infinity;      ///< the exact t, rounded to the nearest float
    std::uint32_t rank = 0;  ///< 0 for the nearest; hits at exactly the same t share a rank
};

/// All triangles against one ray, one after the other: no structure that could be wrong. Most
/// triangles are dismissed in double with a bound on its error; all else is decided by intervals
/// and, where those touch, rationals.
class ExactOracle {
  public:
    /// The triangles must be finite.
    static ExactOracle build(std::span<const Triangle> triangles);

    /// In the order of exact t, equal t by triangle index.
    std::vector<ExactHit> hits(const Ray& ray) const;
    /// All triangles at exactly the smallest t; empty for a miss.
    std::vector<ExactHit> closest(const Ray& ray) const;

    std::span<const Triangle> triangles() const { return triangles_; }

  private:
    std::vector<Triangle> triangles_;
};

/// The same decision by CGAL's own predicate, CGAL::do_intersect(Ray_3, Triangle_3) in its exact
/// kernel: whether the ray with t >= 0 and no upper end meets the triangle, which must not be
/// degenerate. It calls a ray within the plane a hit.
bool cgal_do_intersect(const Ray& ray, const Triangle& triangle);

}  // namespace space
