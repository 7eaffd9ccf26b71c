// The bounds of packets: no box and no triangle that one ray of a packet touches, and no more, is
// left out for it, nor for all of them at once.
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "chapters/ch10_fast_traversal/interleaved.hpp"
#include "chapters/ch10_fast_traversal/packets.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <vector>

namespace space {
namespace {

/// A multiple of 2^-16 above 0, so that differences are exact.
Point3 on_grid(Pcg32& random, std::uint32_t most) {
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = 0x1p-16f * float(1 + random.below(most));
    return p;
}
/// Triangles whose first corner is the lowest one of their box.
std::vector<Triangle> cornered(Pcg32& random, std::size_t count) {
    std::vector<Triangle> triangles(count);
    for (Triangle& t : triangles) {
        t.a = on_grid(random, 20'000);
        t.b = t.a + on_grid(random, 8'000);
        t.c = t.a + on_grid(random, 8'000);
    }
    return triangles;
}
/// Downwards to the first corner of each triangle, where t = 1 exactly is all that counts: the box
/// ends there, and the ray begins. Those that see their triangle edge-on are left out; each comes
/// `times` times.
std::vector<Ray> to_corners(std::span<const Triangle> triangles, const Point3& origin,
                            std::size_t times) {
    std::vector<Ray> rays;
    for (const Triangle& t : triangles) {
        const Ray ray{.origin = origin, .direction = t.a - origin, .tmin = 1.0f, .tmax = 1.0f};
        if (FilteredExact::intersect(ray, t)) rays.insert(rays.end(), times, ray);
    }
    return rays;
}

template <class Tree>
std::size_t lost(const Tree& tree, std::span<const Ray> rays, std::size_t size, ManyQuery query) {
    std::size_t misses = 0;
    trace_in_packets(tree, rays, size, query,
                     [&](std::size_t, const std::optional<Hit>& hit) { misses += !hit; });
    return misses;
}

}  // namespace

// Far planes that were not lengthened would be met before t = 1 by every sixth ray or so. Near ones
// need not be shortened as long as far ones are lengthened by 6 u, u = 2^-24: before the last
// rounding, that of the product, a near t is at most t (1 + u)^2, from a difference and a
// reciprocal, and a far one at least t (1 - u)^3 (1 + 6 u), which is more; and rounding keeps the
// order of the two. The limit of boxes has 8 u of its own. So without the shortening alone no ray
// is lost, and there is no test that could tell.
TEST_CASE("a packet's rays that begin at a box's corner meet it, alone or beside others") {
    Pcg32 random(1);
    const std::vector<Triangle> triangles = cornered(random, 200);
    for (const InstructionSet set : usable_instruction_sets()) {
        const FastBvh<>::Config config{
            .binary = {.max_leaf_size = 1}, .collapse = {.max_leaf = 1}, .instructions = set};
        const FastBvh<> tree = FastBvh<>::build(triangles, config);
        CAPTURE(name_of(set));
        for (int i = 0; i < sized(10, 2); ++i) {
            const Point3 origin = 0.5f + on_grid(random, 60'000);
            for (const std::size_t times : {1u, 4u}) {
                std::vector<Ray> rays = to_corners(triangles, origin, times);
                REQUIRE(rays.size() > 100 * times);
                for (const bool has_one_origin : {true, false}) {
                    if (!has_one_origin)  // from twice as far, at twice the speed
                        for (std::size_t k = 0; k < rays.size(); k += 2 * times)
                            for (std::size_t same = 0; same < times; ++same) {
                                Ray& ray = rays[k + same];
                                ray.origin -= ray.direction;
                                ray.direction *= 2.0f;
                            }
                    for (const std::size_t size : {1u, 4u, 33u, 64u}) {
                        CAPTURE(i, times, has_one_origin, size);
                        CHECK(lost(tree, rays, size, ManyQuery::closest) == 0);
                        CHECK(lost(tree, rays, size, ManyQuery::any) == 0);
                    }
                }
            }
        }
    }
}

namespace {

/// A triangle with its first corner at the end of a ray from the origin. Of u = x z y - x y z there
/// is left what four products are rounded by. Where x z and x y are a little above 1, and y and z a
/// half more, that is up to 0.07 of the bound; det is far larger, and of either sign.
struct Touch {
    Triangle triangle;
    Ray ray;
};
Touch some_touch(Pcg32& random) {
    const float x = random.uniform(0.678f, 0.686f);
    const float y = random.uniform(1.48f, 1.54f);
    const float z = random.uniform(1.48f, 1.54f);
    const float side = random.below(2) == 0 ? 0x1p-11f : -0x1p-11f;
    const Point3 a{0x1p-20f, y, z};
    return {{a, a + Vector3{0, side, -side}, {x, y, z}}, {.origin = {}, .direction = a}};
}

}  // namespace

// A sixteenth of the bound would leave out every hundredth of these triangles.
TEST_CASE("a triangle that a packet's rays touch at a corner is not left out for all of them") {
    Pcg32 random(2);
    for (int i = 0; i < sized(3'000, 300); ++i) {
        const Touch c = some_touch(random);
        const std::optional<Hit> expected = FilteredExact::intersect(c.ray, c.triangle);
        REQUIRE(expected);
        const std::vector<Triangle> one{c.triangle};
        const std::vector<Ray> rays(8, c.ray);
        for (const InstructionSet set : usable_instruction_sets()) {
            const FastBvh<> tree = FastBvh<>::build(one, {.instructions = set});
            CAPTURE(i, name_of(set));
            REQUIRE(lost(tree, rays, 8, ManyQuery::closest) == 0);
        }
    }
}

// A packet has at most 64 rays, and at most 32 are under way: who asks for more gets that many.
TEST_CASE("packets and turns of 31, 32, 33, 64 and 65 rays lose none") {
    Pcg32 random(3);
    const std::vector<Triangle> triangles = cornered(random, 100);
    const std::vector<Ray> rays = to_corners(triangles, Point3(1.25f), 2);
    REQUIRE(rays.size() > 130);
    for (const InstructionSet set : usable_instruction_sets()) {
        const FastBvh<> tree = FastBvh<>::build(triangles, {.instructions = set});
        for (const unsigned many : {31u, 32u, 33u, 64u, 65u}) {
            CAPTURE(name_of(set), many);
            CHECK(lost(tree, rays, many, ManyQuery::closest) == 0);
            std::vector<int> told(rays.size());
            trace_interleaved(
                tree, rays, many, ManyQuery::closest,
                [&](std::size_t i, const std::optional<Hit>& hit) { told[i] += hit.has_value(); });
            CHECK(std::ranges::count(told, 1) == std::ssize(told));
        }
    }
}

}  // namespace space
