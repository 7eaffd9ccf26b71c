#include "chapters/ch09_instancing_and_motion/measured/nesting_run.hpp"

#ifdef BOOK_HAS_EMBREE
#include "chapters/ch09_instancing_and_motion/mesh_places.hpp"
#include "common/accelerator.hpp"
#include "common/embree_instances.hpp"
#include "common/embree_tree.hpp"
#endif

namespace space::ch09 {

#ifdef BOOK_HAS_EMBREE

namespace {

std::unique_ptr<const EmbreeInstances> embree_of(const SceneGraph& graph,
                                                 std::uint64_t most_places) {
    std::vector<std::span<const Triangle>> meshes;
    for (const GraphObject& object : graph.objects()) meshes.emplace_back(object.triangles);
    std::vector<EmbreePlaced> placed;
    for (const auto& [mesh, to_world] : mesh_places(graph, most_places))
        placed.push_back({mesh, to_world.rows});
    return std::make_unique<const EmbreeInstances>(meshes, placed, 1);
}

}  // namespace

std::vector<NestingRun> embree_nesting_runs(const SceneGraph& graph,
                                            std::span<const Triangle> flattened,
                                            std::uint64_t most_places) {
    std::vector<NestingRun> runs;
    const auto add = [&](std::string_view way, const auto& build) {
        std::size_t bytes = 0;
        runs.push_back(nesting_run<DenormalsAreZero>(
            way,
            [&] {
                auto tree = build();
                bytes = tree->shape().bytes;
                return tree;
            },
            [](const auto& tree, const Ray& ray) -> std::optional<PlacedHit> {
                NoCounts none;
                const auto hit = tree->closest_hit(ray, none);
                if (!hit) return std::nullopt;
                return PlacedHit{hit->t, hit->u, hit->v, hit->triangle};
            }));
        runs.back().trace.bytes = bytes;
    };
    if (mesh_place_count(graph) <= most_places)
        add(nesting_way::embree, [&] { return embree_of(graph, most_places); });
    if (!flattened.empty())
        add(nesting_way::embree_flattened,
            [&] { return std::make_unique<const EmbreeTree>(flattened, 1, EmbreeFlavour{}); });
    return runs;
}

#else

std::vector<NestingRun> embree_nesting_runs(const SceneGraph&, std::span<const Triangle>,
                                            std::uint64_t) {
    return {};
}

#endif

}  // namespace space::ch09
