// Volumes around points against CGAL's: the exact smallest sphere, and the convex hull, which no
// volume can be smaller than.
#include "chapters/ch07_bounding_volume_hierarchies/bounding_sphere.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/tight_box.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/volume_points.hpp"

#include <CGAL/Cartesian.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Min_sphere_annulus_d_traits_2.h>
#include <CGAL/Min_sphere_annulus_d_traits_3.h>
#include <CGAL/Min_sphere_d.h>
#include <CGAL/Polyhedron_3.h>

#include <cmath>
#include <cstdio>
#include <type_traits>

namespace space {
namespace {

using Rational = CGAL::Cartesian<CGAL::Exact_rational>;

Rational::Point_3 exact(const Point3& p) {
    return {double{p.x}, double{p.y}, double{p.z}};
}
Rational::Point_2 exact(const Point2& p) {
    return {double{p.x}, double{p.y}};
}

/// Its radius, whose square is exact.
template <int D>
double smallest_radius(const std::vector<Point<D>>& points) {
    using Traits = std::conditional_t<D == 2, CGAL::Min_sphere_annulus_d_traits_2<Rational>,
                                      CGAL::Min_sphere_annulus_d_traits_3<Rational>>;
    std::vector<std::conditional_t<D == 2, Rational::Point_2, Rational::Point_3>> all;
    for (const Point<D>& p : points) all.push_back(exact(p));
    const CGAL::Min_sphere_d<Traits> sphere(all.begin(), all.end());
    return std::sqrt(CGAL::to_double(sphere.squared_radius()));
}

/// How much larger than it must be; at most: the centre is rounded to floats, by half a unit in
/// the last place of each coordinate, the radius up to one more (2^-23), and `excludes` allows
/// 2^-30.
template <int D>
void check_smallest_spheres() {
    double largest = 0.0, ritter = 0.0;
    for (const auto& [name, points] : point_sets<D>(sized(40u, 4u), 40)) {
        const double exact_radius = smallest_radius<D>(points);
        if (!(exact_radius < 3e38)) continue;  // no float is that large
        const BoundingSphere<D> found = smallest_sphere<D>(points);
        double moved = 0.0;
        for (int axis = 0; axis < D; ++axis) {
            const double ulp = std::nextafter(std::abs(found.centre[axis]), infinity) -
                               double{std::abs(found.centre[axis])};
            moved += 0.25 * ulp * ulp;
        }
        const double bound =
            (exact_radius * (1.0 + 0x1p-30) + std::sqrt(moved)) * (1.0 + 0x1p-23) + 0x1p-149;
        CAPTURE(D, name, points.size(), exact_radius);
        CHECK(double{found.radius} >= exact_radius * (1.0 - 4 * 0x1p-53));
        CHECK(double{found.radius} <= bound);
        CHECK(ritter_sphere<D>(points).radius >= found.radius);
        if (exact_radius > 1e-30) {  // below, floats are coarse
            largest = std::max(largest, (found.radius - exact_radius) / (bound - exact_radius));
            ritter = std::max(ritter, ritter_sphere<D>(points).radius / exact_radius);
        }
    }
    std::printf("D = %d: largest excess / bound %.3f; Ritter's radius up to %.3f of the smallest\n",
                D, largest, ritter);
    CHECK(ritter > 1.05);
}

}  // namespace

TEST_CASE("the smallest sphere is CGAL's exact one, but for the roundings of its numbers") {
    check_smallest_spheres<2>();
    check_smallest_spheres<3>();
}

TEST_CASE("the smallest sphere of many points in a ball, a cube and on a sphere is CGAL's") {
    Pcg32 random(81);
    for (const int kind : {0, 1, 2}) {
        std::vector<Point3> points;
        for (int i = 0; i < sized(3'000, 300); ++i) {
            const Double3 direction = random_direction(random);
            const Point3 in_cube = random_vector(random);
            points.push_back(kind == 0   ? Point3(std::cbrt(random.uniform_double()) * direction)
                             : kind == 1 ? in_cube
                                         : Point3(direction));
        }
        CAPTURE(kind);
        CHECK(smallest_sphere<3>(points).radius ==
              Approx(smallest_radius<3>(points)).epsilon(3 * 0x1p-23));
    }
}

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
struct Size {
    double surface = 0.0, content = 0.0;
};
/// Of the convex hull of points that are not flat.
Size hull_of(const std::vector<Point3>& points) {
    std::vector<Kernel::Point_3> all;
    for (const Point3& p : points) all.emplace_back(double{p.x}, double{p.y}, double{p.z});
    CGAL::Polyhedron_3<Kernel> hull;
    CGAL::convex_hull_3(all.begin(), all.end(), hull);
    const auto in_double = [](const Kernel::Point_3& p) {
        return Double3(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
    };
    const Double3 o = in_double(all[0]);
    Size size;
    for (auto facet = hull.facets_begin(); facet != hull.facets_end(); ++facet) {
        const auto edge = facet->halfedge();
        const Double3 a = in_double(edge->vertex()->point()) - o,
                      b = in_double(edge->next()->vertex()->point()) - o,
                      c = in_double(edge->next()->next()->vertex()->point()) - o;
        size.surface += 0.5 * glm::length(glm::cross(b - a, c - a));
        size.content += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return size;
}

}  // namespace

TEST_CASE(
    "no volume is smaller than the convex hull, in surface or content; and k-DOPs are close") {
    Pcg32 random(82);
    for (int i = 0; i < sized(100, 10); ++i) {
        Double3 e;
        const auto points = i % 2 ? points_of_turned_box<3>(random, random.below(60), e)
                                  : drawn_points<3>(random, number_kinds[0], 5 + random.below(60));
        const Size hull = hull_of(points);
        CAPTURE(i, points.size());
        const auto check = [&](const auto& volume) {
            REQUIRE(surface(volume) >= hull.surface * (1.0 - 5 * 0x1p-24));  // axes in float
            REQUIRE(content(volume) >= hull.content * (1.0 - 5 * 0x1p-24));
        };
        check(box_around<3>(points));
        check(ritter_sphere<3>(points));
        check(smallest_sphere<3>(points));
        check(principal_box<3>(points));
        check(tight_box<3>(points));
        check(k_dop_around<14, 3>(points));
        check(k_dop_around<18, 3>(points));
        check(k_dop_around<26, 3>(points));
    }
}

}  // namespace space
