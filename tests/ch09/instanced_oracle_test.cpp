// Exact instancing against CGAL's exact arithmetic on the flattened mesh: zero differences.
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch09/graphs.hpp"
#include "tests/oracle/exact.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace space {
namespace {

/// Of the hits with the smallest t, rounded, that with the smallest index: t and triangle alone.
std::optional<Hit> judged(const ExactOracle& oracle, const Ray& ray) {
    std::optional<Hit> nearest;
    for (const ExactHit& exact : oracle.hits(ray)) {
        const Hit hit{.t = exact.t, .triangle = exact.triangle};
        if (!nearest || nearer(hit, *nearest)) nearest = hit;
    }
    return nearest;
}

void check_graph(const std::string& name, const SceneGraph& graph, int rays) {
    INFO(name);
    const std::vector<Triangle> flat = flatten(graph);
    const InstancedTrees trees = InstancedTrees::build(graph);
    const ExactOracle oracle = ExactOracle::build(flat);
    RayMaker maker(flat, 23);
    std::size_t hits = 0, differing = 0;
    for (int i = 0; i < rays; ++i) {
        const Ray ray = i % 3 == 0   ? maker.at_vertex().ray
                        : i % 3 == 1 ? maker.at_edge().ray
                                     : maker.random().ray;
        NoCounts none;
        const auto expected = judged(oracle, ray);
        const auto hit = closest_placed_hit(trees, ray, none);
        hits += expected.has_value();
        differing += expected.has_value() != hit.has_value() ||
                     (hit && (hit->t != expected->t || hit->triangle != expected->triangle)) ||
                     any_placed_hit(trees, ray, none) != expected.has_value();
    }
    fmt::print("  {}: {} rays, {} hits, {} differ\n", name, rays, hits, differing);
    CHECK(differing == 0);
    CHECK(hits > std::size_t(rays) / 5);
}

}  // namespace

TEST_CASE("instanced answers are those of exact arithmetic on the flattened mesh") {
    for (const auto& [name, graph] : test_graphs()) check_graph(name, graph, 400);
}

// By hand: ch09.instanced_oracle "[.big]".
TEST_CASE("the same with 100,000 rays a scene", "[.big]") {
    for (const auto& [name, graph] : test_graphs()) check_graph(name, graph, 100'000);
}

TEST_CASE("the same on the bunny, turned, near and far", "[.big]") {
    const std::vector<Triangle> bunny = make_scene("bunny").mesh.triangles();
    for (const double away : {0.0, 1e6}) {
        Pcg32 random(7);
        check_graph(
            "bunny",
            two_levels(bunny,
                       copies(0, 2, [&](int) { return moved(Double3(away), rotated(random)); })),
            1000);
    }
}

}  // namespace space
