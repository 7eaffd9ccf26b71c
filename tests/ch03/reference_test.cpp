// Over which triangle test, and in which grade, a tree answers as the naive loop.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/exact.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

namespace space {
namespace {

constexpr int edge_rays = sized(1'000'000, 20'000), rays = sized(14'400, 600);

const Point3 edge_begin(-0.779910982f, -0.434758961f, -0.417577893f),
    edge_end(0.120342858f, -0.920683026f, -0.147806093f);
const std::vector<Triangle> neighbours{
    {edge_begin, edge_end, {-0.487959951f, 0.247673452f, 0.129112288f}},
    {edge_end, edge_begin, {-0.343076348f, 0.329349399f, -0.447615325f}}};

/// Along the edge that both share, from before it.
Ray along_the_edge(Pcg32& random) {
    const Double3 begin(edge_begin), edge = Double3(edge_end) - begin;
    const double before = 1.0 + random.uniform_double(), at = random.uniform_double();
    const Point3 origin(begin - before * edge);
    return {origin, Vector3(begin + at * edge - Double3(origin))};
}

/// Triangles that leave one slanted plane by a few roundings.
std::vector<Triangle> nearly_coplanar() {
    Pcg32 random(2);
    return scenes::mapped(scenes::soup(60, 0.4f, 20), [&](const Point3& p) {
        return Point3(p.x, p.y, 0.3f * p.x + 0.5f + random.uniform(-1e-6f, 1e-6f));
    });
}
/// Layers whose corners lie at three neighbouring floats.
std::vector<Triangle> one_float_apart() {
    Pcg32 random(30);
    std::vector<Triangle> triangles;
    for (int i = 0; i < 40; ++i) {
        Triangle layer{{-1, -1, 1}, {2, -1, 1}, {0.5f, 2, 1}};
        for (Point3* corner : {&layer.a, &layer.b, &layer.c})
            corner->z += 0x1p-23f * static_cast<float>(random.below(3));
        triangles.push_back(layer);
    }
    return triangles;
}
/// Few bits are left for the triangles themselves.
std::vector<Triangle> far_away() {
    return scenes::mapped(scenes::soup(150, 0.3f, 13),
                          [](const Point3& p) { return p + Point3(1e5f, 5e4f, -2.5e4f); });
}
/// Sizes from 10^-30 to 10^30, all around the origin.
std::vector<Triangle> mixed_sizes() {
    Pcg32 random(22);
    std::vector<Triangle> triangles = scenes::soup(60, 0.5f, 23);
    for (Triangle& t : triangles) {
        const auto size = static_cast<float>(std::pow(10.0, 60.0 * random.uniform_double() - 30.0));
        for (Point3* corner : {&t.a, &t.b, &t.c}) *corner = (*corner - Point3(0.5f)) * size;
    }
    return triangles;
}

}  // namespace

TEST_CASE("naive tracing hits outside of a triangle with chapter 1's test, where no tree looks") {
    const Ray ray{{-1.71353447f, 0.0691769645f, -0.69734937f},
                  {1.35015011f, -0.728761733f, 0.40458864f}};
    CHECK(ExactOracle::build(neighbours).hits(ray).empty());
    CHECK(closest_hit(Naive<>::build(neighbours), ray));
    CHECK_FALSE(closest_hit(Bsp<MollerTrumbore>::build(neighbours), ray));
    CHECK_FALSE(closest_hit(Naive<FilteredExact>::build(neighbours), ray));
    CHECK_FALSE(closest_hit(Bsp<>::build(neighbours), ray));
}

TEST_CASE("along a shared edge a tree differs from the naive loop only where that is wrong") {
    const ExactOracle oracle = ExactOracle::build(neighbours);
    const auto naive = Naive<>::build(neighbours);
    const auto bsp = Bsp<MollerTrumbore>::build(neighbours);
    const auto exact_naive = Naive<FilteredExact>::build(neighbours);
    const auto exact_bsp = Bsp<>::build(neighbours);
    Pcg32 random(24);
    int differ = 0, naive_right = 0, exact_differ = 0;
    for (int i = 0; i < edge_rays; ++i) {
        const Ray ray = along_the_edge(random);
        exact_differ += closest_hit(exact_naive, ray) != closest_hit(exact_bsp, ray);
        const auto answer = closest_hit(naive, ray);
        if (answer == closest_hit(bsp, ray)) continue;
        ++differ;
        const std::vector<ExactHit> hits = oracle.closest(ray);
        naive_right +=
            answer
                ? std::any_of(hits.begin(), hits.end(),
                              [&](const ExactHit& hit) { return hit.triangle == answer->triangle; })
                : hits.empty();
    }
    fmt::print(
        "{} rays along a shared edge: {} differ with chapter 1's test, {} of them with a right "
        "naive answer; {} with the exact test\n",
        edge_rays, differ, naive_right, exact_differ);
    CHECK((differ > 0 || is_sanitized));
    CHECK(naive_right == 0);
    CHECK(exact_differ == 0);
}

TEST_CASE("trees of rounded cuts lose hits in hostile scenes, exact ones none") {
    for (const auto& [name, triangles] : {std::pair{"layers one float apart", one_float_apart()},
                                          {"nearly coplanar", nearly_coplanar()},
                                          {"far away", far_away()},
                                          {"mixed sizes", mixed_sizes()}}) {
        const auto naive = Naive<FilteredExact>::build(triangles);
        const auto wrong = [&](Grade grade) {
            const auto bsp = Bsp<>::build(triangles, {.grade = grade});
            RayMaker maker(triangles, 25);
            int count = 0;
            for (int i = 0; i < rays; ++i) {
                const TestRay test = i % 5 == 0   ? maker.random()
                                     : i % 5 == 1 ? maker.at_edge()
                                     : i % 5 == 2 ? maker.at_vertex()
                                     : i % 5 == 3 ? maker.from_face()
                                                  : maker.from_vertex();
                const Ray& ray = test.ray;
                count += closest_hit(bsp, ray) != closest_hit(naive, ray);
            }
            return count;
        };
        const int thick = wrong(Grade::thick_float), ordered = wrong(Grade::ordered_double),
                  exact = wrong(Grade::exact);
        fmt::print("{}: of {} rays {} wrong with thick float, {} with ordered double, {} exact\n",
                   name, rays, thick, ordered, exact);
        CHECK(thick > 0);
        CHECK((ordered > 0) == (name == std::string_view("mixed sizes")));
        CHECK(exact == 0);
    }
}

}  // namespace space
