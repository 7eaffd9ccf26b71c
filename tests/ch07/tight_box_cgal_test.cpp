// The tight oriented box beside CGAL's optimal one, which has the least volume that an evolution of
// boxes finds (Chang, Gorissen & Melchior 2011). Ours goes for the least surface.
#include "chapters/ch07_bounding_volume_hierarchies/tight_box.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/volume_points.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/optimal_bounding_box.h>

#include <array>
#include <cmath>
#include <cstdio>

namespace space {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Its edges.
Double3 optimal_edges(const std::vector<Point3>& points) {
    std::vector<Kernel::Point_3> all;
    for (const Point3& p : points) all.emplace_back(double{p.x}, double{p.y}, double{p.z});
    std::array<Kernel::Point_3, 8> corners;
    CGAL::oriented_bounding_box(all, corners, CGAL::parameters::random_seed(1));
    const auto length = [&](std::size_t to) {
        return std::sqrt(CGAL::to_double(CGAL::squared_distance(corners[0], corners[to])));
    };
    return {length(1), length(3), length(5)};
}

/// Ours beside CGAL's: the largest ratios, and the means.
struct Ratios {
    int sets = 0;
    double surface = 0.0, content = 0.0, mean_surface = 0.0, mean_content = 0.0;

    void add(const std::vector<Point3>& points) {
        const Double3 best = optimal_edges(points);
        const OrientedBounds<3> ours = tight_box<3>(points);
        const double s = space::surface(ours) / surface_of_edges<3>(best),
                     c = space::content(ours) / content_of_edges<3>(best);
        surface = std::max(surface, s);
        content = std::max(content, c);
        mean_surface = (sets * mean_surface + s) / (sets + 1);
        mean_content = (sets * mean_content + c) / (sets + 1);
        ++sets;
    }
    void print(const char* name) const {
        std::printf("%s: surface %.4f, at most %.4f; volume %.4f, at most %.4f\n", name,
                    mean_surface, surface, mean_content, content);
    }
};

constexpr int sets = 60;

}  // namespace

TEST_CASE("around turned boxes both find the box") {
    Pcg32 random(83);
    Ratios ratios;
    for (int i = 0; i < sets; ++i) {
        Double3 e;
        ratios.add(points_of_turned_box<3>(random, random.below(100), e));
    }
    ratios.print("turned boxes");
    CHECK(ratios.surface < 1.0 + 3'000 * 0x1p-24);
    CHECK(ratios.content < 1.0 + 3'000 * 0x1p-24);
}

TEST_CASE("around random points our surface is hardly ever larger, and never by a tenth") {
    Pcg32 random(84);
    for (const std::uint32_t most : {4u, 12u, 100u}) {
        Ratios ratios;
        for (int i = 0; i < sets; ++i)
            ratios.add(drawn_points<3>(random, number_kinds[0], 4 + random.below(most)));
        ratios.print("random points");
        CAPTURE(most);
        CHECK(ratios.surface < 1.1);
        CHECK(ratios.mean_surface < 1.005);
    }
}

}  // namespace space
