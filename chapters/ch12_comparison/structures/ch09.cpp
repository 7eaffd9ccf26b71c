/// @file
/// Chapter 9's structures: instances, exactly and as is usual. They take a scene graph
/// (--instances); plain triangles stand as instances of pieces of them.
#include "chapters/ch09_instancing_and_motion/instanced_bvh.hpp"
#include "chapters/ch12_comparison/structures/offer.hpp"

namespace space {
namespace {

/// Adds what makes each variant from a scene graph.
template <LeafTest leaf>
Structure with_graphs(Structure structure) {
    auto variant = structure.variants.begin();
    std::apply(
        [&](const auto&... tests) {
            ((variant++->build_from_graph =
                  [](const SceneGraph& graph, const BuildOptions&) {
                      return erased(InstancedBvh<TestOf<decltype(tests)>, leaf>::build(graph));
                  }),
             ...);
        },
        offered_tests);
    return structure;
}

}  // namespace

std::vector<Structure> ch09_structures() {
    return {
        with_graphs<LeafTest::world>(offer<WorldInstances>(
            "bvh-instanced", "trees of trees; answers are the flattened mesh's (chapter 9)")),
        with_graphs<LeafTest::local>(offer<LocalInstances>(
            "bvh-instanced-local", "the same; triangles tested in their own space, as is usual")),
    };
}

}  // namespace space
