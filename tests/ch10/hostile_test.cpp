// What once broke kernels: scenes and rays at the ends of what floats can hold.
#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/many_rays.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "tests/catch.hpp"
#include "tests/ch10/every_kernel.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace space {
namespace {

/// Triangles across z, one behind the other, which all touch the plane x = 0 from below.
std::vector<Triangle> behind_each_other(int count, float size) {
    std::vector<Triangle> triangles;
    for (int i = 1; i <= count; ++i) {
        const float z = float(i) * size;
        triangles.push_back({{-size, -size, z}, {0, -size, z}, {0, size, z}});
    }
    return triangles;
}

// The kernels for several rays know nodes of eight and the exact test, nothing else: a tree of four
// was walked as if it had eight children a node, and another test was not asked.
static_assert(TracedTogether<FastBvh<>> && TracedTogether<FastHighBvh<>>);
static_assert(!TracedTogether<WideBvh<4, QuickBuilder>>);
static_assert(!TracedTogether<FastBvh<MollerTrumbore>>);

}  // namespace

// Boxes end at the ray's plane x = 0. The shift that keeps them open there was a product that
// underflowed where the tree was 2^63 times smaller than the ray's direction, or more.
TEST_CASE("a ray along the boxes' planes meets them, however small they are beside its direction") {
    for (int exponent = -140; exponent <= 0; exponent += 5) {
        const std::vector<Triangle> triangles = behind_each_other(16, std::ldexp(1.0f, exponent));
        const auto naive = Naive<FilteredExact>::build(triangles);
        for_each_kernel<QuickBuilder>(triangles, [&](const auto& bvh, const std::string& name) {
            for (const float speed : {1.0f, 0x1p-60f, 0x1p29f}) {
                const Ray ray{.origin = {0, 0, 0}, .direction = {0, 0, speed}};
                CAPTURE(name, exponent, speed);
                CHECK(closest_hit(bvh, ray) == closest_hit(naive, ray));
                CHECK(any_hit(bvh, ray) == any_hit(naive, ray));
            }
        });
    }
}

// Areas were products of floats: 0 in small scenes, infinite in large ones.
TEST_CASE("a scene times a power of two gets the same tree from the quick builder") {
    const std::vector<Triangle> triangles = scenes::soup(500, 0.1f, 1);
    const BvhNodes<3> expected = QuickBuilder::build<3>(triangles);
    for (const int exponent : {-95, -70, -40, 40, 70, 100, 126}) {
        const float scale = std::ldexp(1.0f, exponent);
        const BvhNodes<3> tree = QuickBuilder::build<3>(
            scenes::mapped(triangles, [&](const Point3& p) { return p * scale; }));
        CAPTURE(exponent);
        CHECK(tree.depth == expected.depth);
        CHECK(tree.references == expected.references);
    }
}

}  // namespace space
