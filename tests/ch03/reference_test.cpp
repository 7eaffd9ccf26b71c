// Over which triangle test a tree answers as the naive loop.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/oracle/exact.hpp"

#include <fmt/format.h>

namespace space {
namespace {

#ifdef BOOK_SANITIZED
constexpr int edge_rays = 20'000;
#else
constexpr int edge_rays = 1'000'000;
#endif

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
#ifndef BOOK_SANITIZED
    CHECK(differ > 0);
#endif
    CHECK(naive_right == 0);
    CHECK(exact_differ == 0);
}

}  // namespace space
