// Scene graphs: what is counted, in which order triangles stand, and what is refused, by name.
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"

#include "common/limit_error.hpp"
#include "tests/catch.hpp"
#include "tests/ch09/graphs.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace space {
namespace {

const std::vector<Triangle> two{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}};

/// What the constructor says of these objects.
std::string refusal(std::vector<GraphObject> objects, std::uint32_t root = 0) {
    try {
        const SceneGraph graph(std::move(objects), root);
    } catch (const GraphError& error) {
        return error.what();
    }
    return "";
}

/// A chain of groups with so many instances each of the one below, a mesh at its end.
SceneGraph chain(std::vector<Triangle> mesh, unsigned levels, int instances) {
    std::vector<GraphObject> objects{{.name = "mesh", .triangles = std::move(mesh)}};
    for (std::uint32_t level = 0; level < levels; ++level)
        objects.push_back({.name = "group", .instances = copies(level, instances, [](int i) {
                                                return moved({i / 2.0, 0, 0}, scaled(Double3(0.5)));
                                            })});
    return {std::move(objects), levels};
}

}  // namespace

TEST_CASE("triangles stand depth first, a group's instances as they are listed") {
    // The root: the pair moved by 10, a mesh moved by 20, nothing, the mesh as it is.
    const SceneGraph graph(
        {{.name = "mesh", .triangles = two},
         {.name = "nothing"},
         {.name = "pair", .instances = {{{}, 0}, {moved({0, 3, 0}), 0}}},
         {.name = "root",
          .instances =
              {{moved({10, 0, 0}), 2}, {moved({20, 0, 0}), 0}, {moved({1, 1, 1}), 1}, {{}, 0}}}},
        3);
    REQUIRE(graph.triangle_count() == 8);
    REQUIRE(graph.triangle_count(2) == 4);
    REQUIRE(graph.height(3) == 2);
    REQUIRE(graph.height(0) == 0);
    const std::vector<Triangle> flat = flatten(graph);
    REQUIRE(flat.size() == 8);
    REQUIRE(flat[0].a == Point3(10, 0, 0));
    REQUIRE(flat[1].a == Point3(10, 0, 1));
    REQUIRE(flat[3].a == Point3(10, 3, 1));
    REQUIRE(flat[4].a == Point3(20, 0, 0));
    REQUIRE(flat[7] == two[1]);
    const Located at = graph.locate(3);
    REQUIRE(at.mesh == 0);
    REQUIRE(at.triangle == 1);
    REQUIRE(at.to_world == moved({10, 3, 0}));
}

TEST_CASE("a triangle of a graph is the one that flattening puts at its index") {
    for (const auto& [name, graph] : test_graphs()) {
        INFO(name);
        const std::vector<Triangle> flat = flatten(graph);
        REQUIRE(flat.size() == graph.triangle_count());
        std::size_t same = 0;
        for (std::size_t i = 0; i < flat.size(); ++i) same += graph.triangle(i) == flat[i];
        REQUIRE(same == flat.size());
    }
}

TEST_CASE("a group that holds itself is refused, by the names on its way") {
    REQUIRE(refusal({{.name = "a", .instances = {{{}, 0}}}}) ==
            "a group holds itself: \"a\" holds \"a\"");
    REQUIRE(refusal({{.name = "root", .instances = {{{}, 1}}},
                     {.name = "b", .instances = {{{}, 3}, {{}, 2}}},
                     {.name = "c", .instances = {{{}, 1}}},
                     {.name = "mesh", .triangles = two}}) ==
            "a group holds itself: \"b\" holds \"c\" holds \"b\"");
    // The same object on two ways is no circle.
    REQUIRE(refusal({{.name = "root", .instances = {{{}, 1}, {{}, 2}}},
                     {.name = "b", .instances = {{{}, 2}}},
                     {.name = "mesh", .triangles = two}}) == "");
}

TEST_CASE("I3: what is wrong with an object or an instance is said with its name") {
    const auto with = [](const Affine& map, std::uint32_t object = 1) {
        return refusal({{.name = "root", .instances = {{{}, 1}, {map, object}}},
                        {.name = "mesh", .triangles = two}});
    };
    REQUIRE(with({}) == "");
    REQUIRE(with({}, 2) == "group \"root\", instance 2: there is no object 2");
    REQUIRE(with(scaled({1, 1, 0})) ==
            "group \"root\", instance 2: its matrix is singular, or too near to it");
    for (const double bad : {double{infinity}, std::nan("")})
        REQUIRE(with(moved({0, bad, 0})) ==
                "group \"root\", instance 2: its matrix has an entry that is not finite");
    for (const double size : {1e-70, 1e70})
        REQUIRE(with(scaled(Double3(size))) ==
                "group \"root\", instance 2: its matrix or the inverse has an entry larger than "
                "2^200");
    REQUIRE(refusal({{.name = "both", .triangles = two, .instances = {{{}, 0}}}}) ==
            "object \"both\" has triangles and instances");
    REQUIRE(refusal({}) == "the root is object 0, and there are 0");
    REQUIRE(refusal({{.name = "mesh"}}, 1) == "the root is object 1, and there are 1");
}

TEST_CASE("counts go beyond 32 bits, and beyond 63 they are refused") {
    REQUIRE(chain(two, 20, 4).triangle_count() == std::uint64_t{2} << 40);
    REQUIRE(chain(two, 62, 2).triangle_count() == std::uint64_t{1} << 63);
    REQUIRE_THROWS_AS(chain(two, 63, 2), GraphError);
    REQUIRE_THROWS_AS(chain({}, max_graph_height + 1, 1), GraphError);
    const SceneGraph graph = chain(two, 40, 2);
    REQUIRE(graph.locate((std::uint64_t{2} << 40) - 1).triangle == 1);
    REQUIRE(graph.triangle(0).b == Point3(std::ldexp(1.0f, -40), 0, 0));
    REQUIRE_THROWS_AS(flatten(graph), LimitError);
    REQUIRE_THROWS_AS(flatten(graph, 100), LimitError);
}

TEST_CASE("groups of groups of nothing are flattened at once, and hit by nothing") {
    const SceneGraph graph = chain({}, 60, 8);
    REQUIRE(graph.triangle_count() == 0);
    REQUIRE(flatten(graph).empty());
    const InstancedTrees trees = InstancedTrees::build(graph);
    NoCounts none;
    REQUIRE_FALSE(any_placed_hit(trees, Ray{{0, 0, 0}, {1, 0, 0}}, none));
    const Triangle broken{{std::nanf(""), 0, 0}, {1, 0, 0}, {0, 1, 0}};
    REQUIRE_FALSE(any_placed_hit(InstancedTrees::build(two_levels({broken}, {{{}, 0}})),
                                 Ray{{0.1f, 0.1f, 1}, {0, 0, -1}}, none));
}

TEST_CASE("a million instances, and a million in one place") {
    const int side = sized(1000, 30);
    const SceneGraph meadow = two_levels(two, copies(0, side * side, [&](int i) {
                                             return moved({2.0 * (i % side), 2.0 * (i / side), 0});
                                         }));
    const InstancedTrees trees = InstancedTrees::build(meadow);
    REQUIRE(trees.root().nodes.size() == std::size_t(2 * side * side - 1));
    NoCounts none;
    for (int i = 0; i < side * side; i += 997) {
        const Point3 at(2.0f * float(i % side) + 0.25f, 2.0f * float(i / side) + 0.25f, 3);
        const auto hit = closest_placed_hit(trees, Ray{at, {0, 0, -1}}, none);
        REQUIRE(hit == PlacedHit{2.0f, 0.25f, 0.25f, 2 * std::uint64_t(i) + 1});
    }
    const InstancedTrees heap = InstancedTrees::build(
        two_levels(two, copies(0, side * side, [](int) { return Affine{}; })));
    REQUIRE(closest_placed_hit(heap, Ray{{0.25f, 0.25f, 3}, {0, 0, -1}}, none) ==
            PlacedHit{2.0f, 0.25f, 0.25f, 1});
}

TEST_CASE(
    "a moved group's trees answer as those that are built anew; what is refused moves nothing") {
    Pcg32 random(6);
    SceneGraph graph = nested(scenes::ball(1), random, Double3(0.0));
    InstancedTrees trees = InstancedTrees::build(graph);
    graph.move(2, copies(1, 4, [&](int) { return moved(Double3(random_vector(random))); }));
    trees.rebuild_groups(graph);
    const InstancedTrees anew = InstancedTrees::build(graph);
    const std::vector<Triangle> flat = flatten(graph);
    REQUIRE(graph.triangle_count() == flat.size());
    NoCounts none;
    for (int i = 0; i < 500; ++i) {
        Ray ray{.origin = random_point(random, -9.0f, 9.0f)};
        ray.direction = random_point(random, -3.0f, 3.0f) - ray.origin;
        REQUIRE(closest_placed_hit(trees, ray, none) == closest_placed_hit(anew, ray, none));
    }
    REQUIRE_THROWS_AS(graph.move(2, {{scaled({1, 0, 1}), 1}}), GraphError);
    REQUIRE_THROWS_AS(graph.move(1, {{{}, 2}}), GraphError);
    REQUIRE(flatten(graph) == flat);
}

TEST_CASE("a group may be emptied, and filled with what the root did not hold before") {
    SceneGraph graph({{.name = "mesh", .triangles = two},
                      {.name = "spare", .triangles = two},
                      {.name = "group", .instances = {{{}, 0}}},
                      {.name = "root", .instances = {{{}, 2}}}},
                     3);
    InstancedTrees trees = InstancedTrees::build(graph);
    NoCounts none;
    const Ray down{{0.25f, 0.25f, 3}, {0, 0, -1}};
    REQUIRE(any_placed_hit(trees, down, none));
    graph.move(2, {});
    trees.rebuild_groups(graph);
    REQUIRE_FALSE(any_placed_hit(trees, down, none));
    graph.move(2, {{moved({0, 0, 1}), 1}});
    trees.rebuild_groups(graph);
    REQUIRE(closest_placed_hit(trees, down, none) == PlacedHit{1.0f, 0.25f, 0.25f, 1});
}

TEST_CASE("a group within another whose box is beyond the floats is refused; a root's is cut") {
    const std::vector<Instance> huge{{scaled(Double3(1e39)), 0}};
    REQUIRE_NOTHROW(InstancedTrees::build(two_levels(two, huge)));
    const SceneGraph graph({{.name = "mesh", .triangles = two},
                            {.name = "huge", .instances = huge},
                            {.name = "root", .instances = {{scaled(Double3(1e-39)), 1}}}},
                           2);
    REQUIRE_THROWS_AS(InstancedTrees::build(graph), GraphError);
}

}  // namespace space
