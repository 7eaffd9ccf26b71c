// Scenes by nesting: how many triangles there are, and where.
#include "chapters/ch09_instancing_and_motion/nested_scenes.hpp"

#include "chapters/ch09_instancing_and_motion/forest.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/mesh_places.hpp"
#include "common/limit_error.hpp"
#include "common/program/error.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

using namespace space;

namespace {

std::size_t instances_in(const SceneGraph& graph) {
    std::size_t count = 0;
    for (const GraphObject& object : graph.objects()) count += object.instances.size();
    return count;
}

std::uint64_t power(std::uint64_t base, std::uint32_t exponent) {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

}  // namespace

TEST_CASE("triangles grow as a power of the levels, and a graph by one group a level") {
    for (std::uint32_t levels = 0; levels <= 10; ++levels) {
        const SceneGraph flake = nested_sphereflake(levels), tetra = nested_tetra(levels),
                         jacks = nested_jacks(levels);
        CHECK(flake.triangle_count() == 40 * (power(9, levels + 1) - 1));
        CHECK(tetra.triangle_count() == power(4, levels + 1));
        CHECK(jacks.triangle_count() == 528 * (power(8, levels + 1) - 1) / 7);
        CHECK(instances_in(flake) == 10 * levels);
        CHECK(mesh_place_count(flake) == (power(9, levels + 1) - 1) / 8);
        CHECK(flake.height(flake.root()) == levels);
    }
    CHECK(nested_sphereflake(10).triangle_count() > 1'000'000'000'000);
}

TEST_CASE("nested spheres touch the sphere that carries them, nine of a third of the radius") {
    const SceneGraph graph = nested_sphereflake(2);
    const std::vector<MeshPlace> places = mesh_places(graph, 91);
    REQUIRE(places.size() == 91);
    const auto centre = [](const MeshPlace& p) { return p.to_world.point({0, 0, 0}); };
    const auto radius = [](const MeshPlace& p) {
        return glm::length(p.to_world.vector({0.5, 0, 0}));
    };
    for (std::size_t child = 0; child < 9; ++child) {
        const std::size_t first = 1 + 10 * child;
        CHECK(radius(places[first]) == Approx(0.5 / 3.0));
        CHECK(glm::length(centre(places[first])) == Approx(0.5 + 0.5 / 3.0));
        for (std::size_t i = 1; i < 10; ++i) {
            CHECK(radius(places[first + i]) == Approx(0.5 / 9.0));
            CHECK(glm::length(centre(places[first + i]) - centre(places[first])) ==
                  Approx(0.5 / 3.0 + 0.5 / 9.0));
            CHECK(glm::length(centre(places[first + i])) > 0.5 + 0.5 / 9.0 - 1e-9);
        }
    }
}

TEST_CASE("a nested tetrahedron is the scene's, triangle by triangle, and all is exact in float") {
    const std::vector<Triangle> scene = make_scene("tetra:6").mesh.triangles(),
                                nested = flatten(nested_tetra(5));
    REQUIRE(scene.size() == nested.size());
    CHECK(scene == nested);
    const SceneGraph deep = nested_tetra(20);
    const Located at = deep.locate(deep.triangle_count() - 1);
    for (const Triangle mesh = deep.object(at.mesh).triangles[at.triangle];
         const Point3& corner : {mesh.a, mesh.b, mesh.c})
        for (int axis = 0; axis < 3; ++axis) {
            const double exact = at.to_world.point(Double3(corner))[axis];
            CHECK(exact == double{static_cast<float>(exact)});
        }
}

TEST_CASE("mesh places are the graph's meshes in the order of its triangles, or too many") {
    const SceneGraph graph = make_forest_graph(3);
    std::vector<Triangle> all;
    for (const auto& [mesh, to_world] : mesh_places(graph, 100'000))
        for (const Triangle& triangle : graph.object(mesh).triangles)
            all.push_back(flattened(to_world, triangle));
    CHECK(all == flatten(graph));
    CHECK_THROWS_AS(mesh_places(graph, mesh_place_count(graph) - 1), LimitError);
}

TEST_CASE("groups of groups of nothing have no mesh places, which is known at once") {
    std::vector<GraphObject> objects{{.name = "nothing"}};
    for (std::uint32_t level = 0; level < 60; ++level)
        objects.push_back({.name = "group", .instances = {{{}, level}, {{}, level}}});
    CHECK(mesh_places({std::move(objects), 60}, 10).empty());
}

TEST_CASE("a forest has a tree in each place, which stands on the ground") {
    const SceneGraph graph = make_forest_graph(20);
    const std::vector<Instance>& instances = graph.object(graph.root()).instances;
    REQUIRE(instances.size() == 1 + 20 * 20);
    CHECK(graph.triangle_count() > 400 * 10'000);
    for (std::size_t i = 1; i < instances.size(); ++i) {
        const Double3 foot = instances[i].to_parent.translation();
        CHECK(std::abs(foot.z - forest_ground(foot.x, foot.y)) < 0.2);
        CHECK(std::max(std::abs(foot.x), std::abs(foot.y)) < 40.0);
    }
    CHECK(flatten(make_forest_graph(2, 5)) == flatten(make_forest_graph(2, 5)));
    CHECK(flatten(make_forest_graph(2, 5)) != flatten(make_forest_graph(2, 6)));
}

TEST_CASE("rays through a million million triangles end on one that is there") {
    const SceneGraph graph = nested_sphereflake(10);
    const InstancedTrees trees = InstancedTrees::build(graph);
    CHECK(graph.bytes() + trees.bytes() < 200'000);
    const PixelGrid grid(Camera{.eye = {2.1f, 1.3f, 1.7f},
                                .target = {0.05f, 0.0f, -0.02f},
                                .up = {0, 0, 1},
                                .field_of_view = 38},
                         sized(40, 8), sized(30, 6));
    std::uint64_t hits = 0, beyond_32_bits = 0;
    grid.for_each([&](int x, int y) {
        NoCounts none;
        const Ray ray = grid.ray(x, y);
        const auto hit = closest_placed_hit(trees, ray, none);
        if (!hit) return;
        ++hits;
        REQUIRE(hit->triangle < graph.triangle_count());
        beyond_32_bits += hit->triangle > 0xFFFFFFFF;
        const auto alone = FilteredExact::intersect(ray, graph.triangle(hit->triangle));
        REQUIRE(alone);
        CHECK(alone->t == hit->t);
        CHECK(alone->u == hit->u);
        CHECK(alone->v == hit->v);
    });
    CHECK(hits > std::uint64_t(sized(300, 10)));
    CHECK(beyond_32_bits > hits / 2);
}

TEST_CASE("nested scenes have names and sizes, and others are refused") {
    for (const NestedRecipe& recipe : nested_recipes()) {
        CHECK(make_nested_scene(std::string(recipe.name) + ":2").triangle_count() > 2);
        CHECK(recipe.default_size <= recipe.max_size);
    }
    CHECK(make_nested_scene("sphereflake").triangle_count() > 1'000'000'000);
    CHECK(make_nested_scene("tetra").triangle_count() > 1'000'000'000);
    CHECK(make_nested_scene("jacks").triangle_count() > 1'000'000'000);
    for (const char* wrong : {"", "flake", "tetra:", "tetra:x", "tetra:-1", "tetra:21", "tetra:1 "})
        CHECK_THROWS_AS(make_nested_scene(wrong), Error);
}
