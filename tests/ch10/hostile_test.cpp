// What once broke kernels: scenes and rays at the ends of what floats can hold.
#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/many_rays.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "tests/catch.hpp"
#include "tests/ch10/every_kernel.hpp"

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

}  // namespace space
