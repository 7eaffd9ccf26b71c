// A crowd that walks: its trees over instances built anew in each frame.
#include "chapters/ch09_instancing_and_motion/crowd.hpp"

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "common/random_rays.hpp"
#include "tests/catch.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <cmath>
#include <vector>

namespace space {

TEST_CASE("crowd: walkers stay on their square, go as fast as they did, and look ahead") {
    const double side = 7.0;
    const Crowd crowd(60, side, 2.0, 4);
    double slowest = infinity, fastest = 0.0;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
        CAPTURE(i);
        double own = -1.0;
        for (int step = 0; step < 60; ++step) {
            const double time = 0.37 * step, tick = 1e-5;
            const ObjectPlacement now = crowd.placement(i, time),
                                  next = crowd.placement(i, time + tick);
            for (const int axis : {0, 2}) {
                REQUIRE(now.translation[axis] >= 0.0);
                REQUIRE(now.translation[axis] <= side);
            }
            REQUIRE(now.translation.y == 0.0);
            if (now.rotation != next.rotation) continue;  // at a wall
            const Double3 way = (next.translation - now.translation) / tick;
            const double speed = glm::length(way);
            if (own < 0.0) own = speed;
            REQUIRE(std::abs(speed - own) < 1e-6);
            REQUIRE(glm::length(way / speed - now.rotation[0]) < 1e-6);
            REQUIRE(std::abs(glm::determinant(now.rotation) - 1.0) < 1e-12);
        }
        slowest = std::min(slowest, own);
        fastest = std::max(fastest, own);
    }
    CHECK(slowest >= 0.99);
    CHECK(fastest <= 3.01);
    CHECK(slowest < 1.3);
    CHECK(fastest > 2.7);
}

TEST_CASE("crowd: the flattened mesh's answers in each frame, and nothing of the mesh is built") {
    const auto walker = scenes::ball(2);
    const Crowd crowd(30, 12.0, 1.5, 5);
    SceneGraph graph({{.name = "walker", .triangles = walker},
                      {.name = "crowd", .instances = crowd.instances(0, 0.0)}},
                     1);
    auto trees = InstancedTrees::build(graph);
    const auto mesh_nodes = trees.tree(0).nodes.nodes;
    const BvhNode<3>* const place = trees.tree(0).nodes.nodes.data();
    auto follows = RefittedBvh<>::build(flatten(graph)), turns = follows;
    std::size_t hits = 0;
    for (int frame = 1; frame <= 6; ++frame) {
        CAPTURE(frame);
        graph.move(1, crowd.instances(0, 0.9 * frame));
        trees.rebuild_groups(graph);
        CHECK(trees.tree(0).nodes.nodes.data() == place);
        CHECK(trees.tree(0).nodes.nodes == mesh_nodes);
        const std::vector<Triangle> world = flatten(graph);
        follows.refit(world);
        turns.refit_and_rotate(world);
        const auto anew = RefittedBvh<>::build(world);
        NoCounts none;
        for (const Ray& ray : rays_from_around(world, sized(1'000, 60), std::uint64_t(frame))) {
            const auto expected = closest_hit(anew, ray);
            REQUIRE(closest_hit(follows, ray) == expected);
            REQUIRE(closest_hit(turns, ray) == expected);
            const auto hit = closest_placed_hit<FilteredExact, InstancedWay{}>(trees, ray, none);
            REQUIRE(hit.has_value() == expected.has_value());
            if (!hit) continue;
            ++hits;
            REQUIRE(*hit == PlacedHit{expected->t, expected->u, expected->v, expected->triangle});
        }
    }
    CHECK(hits > 0);
}

}  // namespace space
