// What is true of all scene graphs: properties, on random examples that shrink.
#include "tests/catch.hpp"
#include "tests/ch09/graphs.hpp"

#include <rapidcheck.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

namespace space {
namespace {

/// The same examples on every run; RC_PARAMS in the environment asks for others.
const int seeded = ::setenv("RC_PARAMS", "seed=1 max_success=2000", 0);

/// Coordinates that often tie, some as large or as small as floats get.
Point3 some_point() {
    static constexpr float odd[] = {1e30f, -3e38f, 1e-42f, -0.0f, 1e-20f};
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const int kind = *rc::gen::inRange(0, 60);
        p[axis] = kind < 5 ? odd[kind] : float(*rc::gen::inRange(0, 9));
    }
    return p;
}

/// Small whole numbers, thirds and powers of ten: some maps keep ties, some break all.
Affine some_map() {
    static constexpr double entries[] = {0, 1, -1, 2, 1.0 / 3, 0.7, -5, 1e-3, 1e3, 1e6};
    for (;;) {
        Affine map;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                map.rows[i][j] = entries[*rc::gen::inRange(0, i == j ? 10 : 6)];
        if (inverse(map)) return map;
    }
}

/// Each object holds those before it; the last is the root.
SceneGraph some_graph() {
    std::vector<GraphObject> objects(*rc::gen::inRange<std::size_t>(2, 6));
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        objects[i].name = std::to_string(i);
        if (i == 0 || (i + 1 < objects.size() && *rc::gen::inRange(0, 3) == 0)) {
            objects[i].triangles.resize(*rc::gen::inRange<std::size_t>(0, 8));
            for (Triangle& t : objects[i].triangles) t = {some_point(), some_point(), some_point()};
        } else {
            objects[i].instances.resize(*rc::gen::inRange<std::size_t>(0, 4));
            for (Instance& one : objects[i].instances)
                one = {some_map(), *rc::gen::inRange<std::uint32_t>(0, i)};
        }
    }
    const auto root = std::uint32_t(objects.size() - 1);
    return {std::move(objects), root};
}

}  // namespace

TEST_CASE(
    "property: whatever the graph, the answers are the naive loop's over its flattened mesh") {
    CHECK(rc::check([] {
        const SceneGraph graph = some_graph();
        std::vector<Triangle> flat = flatten(graph);
        RC_ASSERT(flat.size() == graph.triangle_count());
        for (std::size_t i = 0; i < flat.size(); ++i) {
            RC_ASSERT(graph.triangle(i) == flat[i] || flat[i] != flat[i]);
            if (box_if_finite<3>(flat[i]).is_empty()) flat[i] = {};  // hit by neither
        }
        std::optional<InstancedTrees> trees;
        try {
            trees = InstancedTrees::build(graph);
        } catch (const GraphError&) {
            RC_DISCARD("a group's box is beyond the floats");
        }
        const auto naive = Naive<FilteredExact>::build(flat);
        for (std::size_t i = 0; i < 12; ++i) {
            Ray ray{.origin = some_point(), .direction = some_point() - some_point()};
            if (!flat.empty() && i % 2 == 0)  // at a corner
                ray.direction = flat[i * 7 % flat.size()].b - ray.origin;
            if (i % 3 == 0) ray.tmin = -infinity;
            if (i % 4 == 0) ray.tmax = 1.0f;
            NoCounts none;
            const auto expected = closest_hit(naive, ray);
            RC_ASSERT(is_same(expected, closest_placed_hit(*trees, ray, none)));
            RC_ASSERT(any_placed_hit(*trees, ray, none) == expected.has_value());
        }
    }));
}

}  // namespace space
