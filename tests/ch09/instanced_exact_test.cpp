// Exact instancing: whatever the graph, each answer is that of the naive loop over the flattened
// mesh, bit for bit.
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/box_rays.hpp"
#include "tests/ch09/graphs.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space {
namespace {

/// Rays at the flattened triangles' vertices, edges and boxes, some from the world's far end, some
/// cut at what they hit.
class GraphRays {
  public:
    GraphRays(std::span<const Triangle> flat, std::uint64_t seed)
        : boxes_(BinnedBuilder::build<3>(flat), flat, seed),
          maker_(flat, seed),
          random_(seed),
          is_large_(flat.size() > 10'000) {}

    TestRay next() {
        switch (random_.below(9)) {
            case 0:
                return maker_.at_vertex();
            case 1:
                return maker_.at_edge();
            case 2:
                return maker_.scaled(maker_.at_edge().ray);
            case 3: {
                Ray ray = maker_.at_vertex().ray;  // from a thousand times as far
                const Point3 origin = ray.at(-1000.0f), target = ray.at(1.0f);
                if (is_finite<3>(origin)) ray = {origin, target - origin};
                return {"from afar", ray};
            }
            case 4: {  // from 10^12 away, where neither floats nor doubles know where it is: a ray
                       // that comes to every triangle there is
                if (is_large_) return maker_.axis_parallel();
                Ray ray = maker_.axis_parallel().ray;
                ray.origin -= 1e12f * ray.direction;
                if (random_.below(2) != 0) ray.tmin = -infinity;
                return {"from the end of the world", ray};
            }
            case 5: {
                Ray ray = maker_.random().ray;
                ray.tmin = -infinity;
                return {"from minus infinity", ray};
            }
            default:
                return boxes_.next();
        }
    }

  private:
    BoxRays boxes_;
    RayMaker maker_;
    Pcg32 random_;
    bool is_large_;
};

/// How many answers differ; of the first it says all. A ray that hits is also asked with an
/// interval that ends or begins there.
template <Accelerator Flat>
std::size_t count_differing(const Flat& reference, const InstancedTrees& trees,
                            std::span<const Triangle> flat, int count, std::size_t& hits) {
    GraphRays maker(flat, 41);
    std::size_t differing = 0;
    const auto ask = [&](std::string_view kind, const Ray& ray) {
        NoCounts none;
        const auto expected = closest_hit(reference, ray);
        const auto placed = closest_placed_hit(trees, ray, none);
        const bool any = any_placed_hit(trees, ray, none);
        if (!is_same(expected, placed) || any != expected.has_value()) {
            ++differing;
            UNSCOPED_INFO(kind << ": flattened " << (expected ? expected->triangle : 0) << " at "
                               << (expected ? expected->t : -1.0f) << ", instanced "
                               << (placed ? placed->triangle : 0) << " at "
                               << (placed ? placed->t : -1.0f) << ", any " << any);
        }
        return expected;
    };
    for (int i = 0; i < count; ++i) {
        const auto [kind, ray] = maker.next();
        const auto hit = ask(kind, ray);
        hits += hit.has_value();
        if (!hit || i % 8 != 0) continue;
        for (const TestRay& cut : RayMaker::cut_at(ray, hit->t)) ask(cut.kind, cut.ray);
    }
    return differing;
}

void check_graph(const std::string& name, const SceneGraph& graph, int rays) {
    INFO(name);
    std::vector<Triangle> flat = flatten(graph);
    for (Triangle& triangle : flat)
        if (box_if_finite<3>(triangle).is_empty()) triangle = {};  // no tree has it, no ray hits it
    const InstancedTrees trees = InstancedTrees::build(graph);
    std::size_t hits = 0, differing = 0;
    if (rays * flat.size() < 100'000'000)
        differing = count_differing(Naive<FilteredExact>::build(flat), trees, flat, rays, hits);
    else
        differing = count_differing(Bvh<BinnedBuilder>::build(flat), trees, flat, rays, hits);
    CHECK(hits > std::size_t(rays) / 20);
    CHECK(differing == 0);
}

}  // namespace

TEST_CASE("instanced answers are the flattened mesh's, bit for bit, however objects are placed") {
    for (const auto& [name, graph] : test_graphs()) check_graph(name, graph, sized(1'500, 150));
}

// By hand, some minutes: ch09.instanced_exact "[.big]".
TEST_CASE("the same for 1,000,000 rays a scene", "[.big]") {
    for (const auto& [name, graph] : test_graphs()) check_graph(name, graph, 1'000'000);
}

TEST_CASE("the same on the bunny and the coarse dragon", "[.big]") {
    Pcg32 random(4);
    for (const char* scene : {"bunny", "dragon_48k"})
        for (const double away : {0.0, 1e6})
            check_graph(scene, nested(make_scene(scene).mesh.triangles(), random, Double3(away)),
                        1'000'000);
}

TEST_CASE("what flattening moves beyond the floats is hit by neither") {
    const Triangle near{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    std::vector<Triangle> mesh{near, {{0, 0, 2e30f}, {1, 0, 2e30f}, {0, 1, 2e30f}}};
    for (int axis = 0; axis < 3; ++axis) {  // one corner far away
        mesh.push_back({{0, 0, 1.5f}, {1, 0, 1.5f}, {0, 1, 1.5f}});
        mesh.back().c[axis] = 2e30f;
    }
    const SceneGraph graph = two_levels(mesh, {{scaled(Double3(1e20)), 0}});
    const std::vector<Triangle> flat = flatten(graph);
    for (std::size_t i = 1; i < flat.size(); ++i) REQUIRE(box_if_finite<3>(flat[i]).is_empty());
    check_graph("beyond", graph, 300);
    // Everything else of the mesh is still there.
    NoCounts none;
    const InstancedTrees trees = InstancedTrees::build(graph);
    const Ray up{{1e19f, 1e19f, 0}, {0, 0, 1}};
    REQUIRE(closest_placed_hit(trees, up, none) == PlacedHit{1e20f, 0.1f, 0.1f, 0});
    REQUIRE_FALSE(any_placed_hit(trees, Ray{{1e19f, 1e19f, 2e20f}, {0, 0, 1}}, none));
}

TEST_CASE("a mesh at the ends of what floats hold, brought to a common size") {
    Pcg32 random(12);
    for (const float size : {1e-40f, 1e-30f, 1e30f, 1e38f}) {
        const auto mesh = scenes::mapped(scenes::soup(60, 0.3f, 5),
                                         [&](const Point3& p) { return (p - 0.5f) * size; });
        check_graph("a mesh of size " + std::to_string(size),
                    two_levels(mesh, copies(0, 3,
                                            [&](int) {
                                                return composed(rotated(random),
                                                                scaled(Double3(1.0 / size)));
                                            })),
                    sized(800, 100));
        check_graph("a scene of size " + std::to_string(size),
                    two_levels(scenes::soup(60, 0.3f, 5),
                               copies(0, 3,
                                      [&](int) {
                                          return composed(rotated(random),
                                                          scaled(Double3(0.5 * double{size})));
                                      })),
                    sized(800, 100));
    }
}

TEST_CASE("a path of matrices along which local rays leave even the doubles loses no hit") {
    // Flat along one axis in the world; in the mesh's space a ray begins beyond 2^1024 there, and
    // of those with a short direction that is a finite number.
    for (int axis = 0; axis < 3; ++axis) {
        Double3 size(1.0);
        size[axis] = 0x1p-147;
        std::vector<GraphObject> objects{{.name = "mesh", .triangles = scenes::soup(60, 0.3f, 5)}};
        for (std::uint32_t level = 0; level < 7; ++level)
            objects.push_back({.name = "group", .instances = {{scaled(size), level}}});
        check_graph("flat along axis " + std::to_string(axis), {std::move(objects), 7},
                    sized(800, 100));
    }
}

TEST_CASE("invalid rays hit nothing") {
    NoCounts none;
    for (const auto& [name, graph] : test_graphs()) {
        const std::vector<Triangle> flat = flatten(graph);
        const InstancedTrees trees = InstancedTrees::build(graph);
        for (const TestRay& ray : RayMaker(flat, 3).invalid()) {
            REQUIRE_FALSE(closest_placed_hit(trees, ray.ray, none));
            REQUIRE_FALSE(any_placed_hit(trees, ray.ray, none));
        }
    }
}

TEST_CASE("of equal hits the smallest index of the flattened mesh wins, on whatever path") {
    const std::vector<Triangle> one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    // The triangle four times in one place: by a group that stands first, twice, and by itself.
    const SceneGraph graph(
        {{.name = "mesh", .triangles = one},
         {.name = "pair", .instances = copies(0, 2, [](int) { return Affine{}; })},
         {.name = "root", .instances = {{moved({5, 0, 0}), 0}, {{}, 1}, {{}, 0}, {{}, 1}}}},
        2);
    REQUIRE(graph.triangle_count() == 6);
    NoCounts none;
    const auto hit =
        closest_placed_hit(InstancedTrees::build(graph), Ray{{0.25f, 0.25f, 1}, {0, 0, -1}}, none);
    REQUIRE(hit == PlacedHit{1.0f, 0.25f, 0.25f, 1});
}

}  // namespace space
