// What goes wrong with instances, and what the usual way answers: catalogue I1 and I5.
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "common/random_rays.hpp"
#include "tests/catch.hpp"
#include "tests/ch09/graphs.hpp"
#include "tests/suite/test_rays.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space {
namespace test {
extern std::atomic<std::ptrdiff_t> allocations_left;  // tests/ch05/allocations.cpp
}
namespace {

constexpr InstancedWay local{.leaf = LeafTest::local};

/// A ray as the usual way has it in an object's space: brought there in double, rounded once.
Ray usual_ray(const Ray& ray, const Affine& to_local) {
    return {Point3(to_local.point(Double3(ray.origin))),
            Vector3(to_local.vector(Double3(ray.direction))), ray.tmin, ray.tmax};
}

/// Each mesh asked by itself, with its own ray: two levels alone.
std::optional<PlacedHit> usual_answer(const SceneGraph& graph, const Ray& ray) {
    std::optional<PlacedHit> nearest;
    const GraphObject& root = graph.object(graph.root());
    for (std::size_t i = 0; i < root.instances.size(); ++i) {
        const auto& [to_parent, object] = root.instances[i];
        const auto& triangles = graph.object(object).triangles;
        for (std::uint32_t k = 0; k < triangles.size(); ++k) {
            const auto hit =
                FilteredExact::intersect(usual_ray(ray, *inverse(to_parent)), triangles[k]);
            if (!hit) continue;
            const PlacedHit placed{hit->t, hit->u, hit->v,
                                   graph.first_triangle(graph.root(), i) + k};
            if (!nearest || nearer(placed, *nearest)) nearest = placed;
        }
    }
    return nearest;
}

/// A bumpy ball as large as 1, turned, so far from the origin.
SceneGraph ball_at(double away) {
    Pcg32 random(2);
    return two_levels(scenes::ball(4), {{moved({away, away, away}, rotated(random)), 0}});
}

/// Of rays that are aimed at the ball: how many answers name another triangle than the flattened
/// mesh does, or one where that has none or none where it has one.
struct Differing {
    int of = 0, triangles = 0, hits = 0;
};
template <InstancedWay way>
Differing differing(double away, int rays) {
    const SceneGraph graph = ball_at(away);
    const std::vector<Triangle> flat = flatten(graph);
    const auto reference = Bvh<BinnedBuilder>::build(flat);
    const InstancedTrees trees = InstancedTrees::build(graph);
    Differing differing;
    NoCounts none;
    for (const Ray& ray : rays_from_around(flat, std::size_t(rays), 11)) {
        const auto expected = closest_hit(reference, ray);
        const auto hit = closest_placed_hit<FilteredExact, way>(trees, ray, none);
        ++differing.of;
        differing.hits += expected.has_value() != hit.has_value();
        differing.triangles += expected && hit && expected->triangle != hit->triangle;
    }
    return differing;
}

}  // namespace

TEST_CASE("I1: t is the same in the world and in local space, unless the direction is normalised") {
    // A square at z = 1, twice as large: the world's is at z = 2.
    const SceneGraph graph =
        two_levels({{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}}, {{scaled(Double3(2.0)), 0}});
    const InstancedTrees trees = InstancedTrees::build(graph);
    const Ray ray{{0, 0, -2}, {0, 0, 1}};
    NoCounts none;
    REQUIRE(closest_placed_hit(trees, ray, none)->t == 4.0f);
    REQUIRE(closest_placed_hit<FilteredExact, local>(trees, ray, none)->t == 4.0f);
    constexpr InstancedWay normalised{.leaf = LeafTest::local, .normalised = true};
    REQUIRE(closest_placed_hit<FilteredExact, normalised>(trees, ray, none)->t == 2.0f);
    // So the wrong one of two instances is the nearer: the one that is not half as large.
    const SceneGraph pair = two_levels({{{-1, -1, 1}, {1, -1, 1}, {0, 1, 1}}},
                                       {{scaled(Double3(0.5)), 0}, {moved({0, 0, 0.5}), 0}});
    const InstancedTrees both = InstancedTrees::build(pair);
    REQUIRE(closest_placed_hit<FilteredExact, local>(both, ray, none)->triangle == 0);
    REQUIRE(closest_placed_hit<FilteredExact, normalised>(both, ray, none)->triangle == 1);
}

TEST_CASE("I5: far from the origin the usual way names other triangles; the exact way never does") {
    const int rays = sized(20'000, 400);
    REQUIRE(differing<local>(1e6, rays).triangles > rays / 100);
    REQUIRE(differing<local>(1e3, rays).triangles < rays / 100);
    for (const double away : {0.0, 1e3, 1e5, 1e6}) {
        const Differing exact = differing<InstancedWay{}>(away, rays);
        REQUIRE(exact.triangles + exact.hits == 0);
    }
}

TEST_CASE("without margins far instances lose hits") {
    const int rays = sized(20'000, 400);
    constexpr InstancedWay bare{.margins = BoxMargins::none};
    const Differing lost = differing<bare>(1e6, rays);
    REQUIRE(lost.hits + lost.triangles > rays / 1000);
}

TEST_CASE("the usual way answers as each mesh by itself, asked with the ray in its space") {
    for (const auto& [name, graph] : test_graphs()) {
        if (graph.height(graph.root()) != 1) continue;
        INFO(name);
        const InstancedTrees trees = InstancedTrees::build(graph);
        const std::vector<Triangle> flat = flatten(graph);
        RayMaker maker(flat, 31);
        NoCounts none;
        std::size_t hits = 0;
        for (int i = 0; i < sized(300, 30); ++i) {
            const Ray ray = i % 2 ? maker.at_vertex().ray : maker.random().ray;
            const auto expected = usual_answer(graph, ray);
            const auto hit = closest_placed_hit<FilteredExact, local>(trees, ray, none);
            // World boxes hold the flattened mesh: a local hit beside it may be lost, never moved.
            if (!hit && expected) continue;
            REQUIRE(hit == expected);
            REQUIRE(any_placed_hit<FilteredExact, local>(trees, ray, none) == hit.has_value());
            hits += hit.has_value();
        }
        REQUIRE(hits > sized(50u, 5u));
    }
}

TEST_CASE("a ray's search allocates nothing, however deep the graph") {
    Pcg32 random(3);
    const SceneGraph graph = nested(scenes::ball(2), random, Double3(0.0));
    const InstancedTrees trees = InstancedTrees::build(graph);
    const std::vector<Ray> rays = rays_within(flatten(graph), 300, 8);
    NoCounts none;
    std::size_t hits = 0;
    test::allocations_left = 0;  // the next one throws
    for (const Ray& ray : rays) hits += closest_placed_hit(trees, ray, none).has_value();
    test::allocations_left = -1;
    REQUIRE(hits > 50);
}

}  // namespace space
