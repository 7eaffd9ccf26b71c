// The accelerators of instances go through the suite of all structures.
#include "chapters/ch09_instancing_and_motion/instanced_bvh.hpp"

#include "tests/suite/accelerator_suite.hpp"

using namespace space;

TEST_CASE("the suite: instances whose triangles are tested in the world") {
    run_suite<WorldInstances>("instances, world");
}

// Over tests that round, the sign of a zero may differ: in sums of three products -0 becomes 0.
TEST_CASE("the suite: instances whose triangles are tested in their own space, exactly") {
    check_accelerator<LocalInstances<>>(
        "instances, local, filtered-exact",
        [](std::span<const Triangle> triangles) { return LocalInstances<>::build(triangles); });
}

TEST_CASE("triangles in pieces are the same triangles, and most pieces stand in another space") {
    for (const TestScene& scene : some_of(adversarial_scenes()))
        for (const LeafTest leaf : {LeafTest::world, LeafTest::local}) {
            INFO(scene.name);
            const SceneGraph graph = in_pieces(scene.triangles, 24, leaf);
            REQUIRE(graph.triangle_count() == scene.triangles.size());
            const std::vector<Triangle> flat = flatten(graph);
            for (std::size_t i = 0; i < flat.size(); ++i)
                if (!box_if_finite<3>(scene.triangles[i]).is_empty())
                    REQUIRE(flat[i] == scene.triangles[i]);
        }
    const SceneGraph graph = in_pieces(scenes::soup(100, 0.5f, 1), 24, LeafTest::world);
    std::size_t moved = 0;
    for (const Instance& instance : graph.object(graph.root()).instances)
        moved += !(instance.to_parent == Affine{});
    CHECK(moved == 24);
}
