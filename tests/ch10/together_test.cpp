// Several rays at once, by every instruction set: each gets the answer that it gets alone, which is
// the naive loop's, whatever its neighbours.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch10_fast_traversal/interleaved.hpp"
#include "chapters/ch10_fast_traversal/packets.hpp"
#include "chapters/ch10_fast_traversal/sorted_stream.hpp"
#include "common/accelerator.hpp"
#include "common/camera.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/box_rays.hpp"
#include "tests/ch10/every_kernel.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space {
namespace {

using Answers = std::vector<std::optional<Hit>>;

Answers naive_answers(const std::vector<Triangle>& triangles, const std::vector<Ray>& rays) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    Answers answers;
    for (const Ray& ray : rays) answers.push_back(closest_hit(naive, ray));
    return answers;
}

/// Neighbours on a picture, tile by tile: what packets are for. The camera looks at the unit cube.
std::vector<Ray> picture(int side) {
    const Camera camera{.eye = {0.3f, 0.4f, 3.0f}, .target = {0.5f, 0.5f, 0.5f}};
    const PixelGrid grid(camera, side, side);
    std::vector<Ray> rays;
    for (const std::uint32_t pixel : tiled_order(side, side, 8))
        rays.push_back(grid.ray(int(pixel) % side, int(pixel) / side));
    return rays;
}
/// Aimed at boxes, edges and vertices, and some that no kernel takes; in no order.
std::vector<Ray> a_mixture(const std::vector<Triangle>& triangles, int count) {
    BoxRays maker(BinnedBuilder::build<3>(triangles), triangles, 4);
    RayMaker invalid(triangles, 5);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        rays.push_back(maker.next().ray);
        if (i % 11 == 0) rays.back().tmin = -infinity;
        if (i % 13 == 0) rays.back().direction *= 0x1p-100f;
        if (i % 17 == 0) rays.back().tmax = 0.5f;
        if (i % 97 == 0)
            for (const TestRay& none : invalid.invalid()) rays.push_back(none.ray);
    }
    return rays;
}
/// Rays from one point in all directions: signs change, the origin does not.
std::vector<Ray> from_one_point(const std::vector<Triangle>& triangles, int count) {
    Pcg32 random(6);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Triangle& t = triangles[random.below(std::uint32_t(triangles.size()))];
        rays.push_back({.origin = Point3(0.5f), .direction = t[int(i % 3)] - Point3(0.5f)});
    }
    return rays;
}

/// Tells of each ray once, and what the naive loop says.
void check(const Answers& expected, ManyQuery query, const auto& trace) {
    std::vector<int> told(expected.size());
    std::size_t wrong = 0;
    trace([&](std::size_t i, const std::optional<Hit>& hit) {
        ++told.at(i);
        wrong += query == ManyQuery::closest ? hit != expected[i]
                                             : hit.has_value() != expected[i].has_value();
    });
    REQUIRE(wrong == 0);
    REQUIRE(std::ranges::count(told, 1) == std::ptrdiff_t(told.size()));
}

template <class Tree>
void check_all_ways(const Tree& tree, const std::vector<Ray>& rays, const Answers& expected) {
    for (const ManyQuery query : {ManyQuery::closest, ManyQuery::any}) {
        CAPTURE(query == ManyQuery::any);
        for (const unsigned together : {1u, 2u, 7u, 16u, 32u}) {
            CAPTURE(together);
            check(expected, query, [&](const auto& answer) {
                trace_interleaved(tree, rays, together, query, answer);
            });
        }
        for (const std::size_t size : {1u, 2u, 7u, 16u, 33u, 64u}) {
            CAPTURE(size);
            check(expected, query,
                  [&](const auto& answer) { trace_in_packets(tree, rays, size, query, answer); });
            check(expected, query, [&](const auto& answer) {
                trace_sorted(
                    rays, tree.tree().box,
                    [&](std::span<const Ray> sorted, const auto& each) {
                        trace_in_packets(tree, sorted, size, query, each);
                    },
                    answer);
            });
        }
    }
}

void check_scene(const std::vector<Triangle>& triangles, const std::vector<Ray>& rays) {
    const Answers expected = naive_answers(triangles, rays);
    for_each_kernel_of<8>(triangles, [&](const auto& tree, const std::string&) {
        check_all_ways(tree, rays, expected);
    });
}

}  // namespace

TEST_CASE("a picture's rays, in tiles") {
    check_scene(scenes::soup(400, 0.2f, 1), picture(sized(48, 16)));
}

TEST_CASE("rays aimed at boxes, edges and vertices, and rays for no kernel, in no order") {
    const auto triangles = scenes::soup(400, 0.2f, 2);
    check_scene(triangles, a_mixture(triangles, sized(1'500, 150)));
}

TEST_CASE("rays from one point to vertices all around") {
    const auto triangles = scenes::soup(400, 0.2f, 3);
    check_scene(triangles, from_one_point(triangles, sized(1'500, 150)));
}

TEST_CASE("rays from one point to edges and vertices that are seen almost from the side") {
    Pcg32 random(8);
    std::vector<Triangle> triangles(300);
    std::vector<Ray> rays;
    const Point3 eye{3, 2.5f, 1e-5f};
    for (Triangle& t : triangles) {
        for (Point3* corner : {&t.a, &t.b, &t.c}) {
            const Point3 p = random_vector(random);
            *corner = {p.x, p.y, 1e-6f * p.z};
        }
        const float share = random.uniform();
        for (const Point3& target : {t.a, t.b + share * (t.c - t.b), t.a + share * (t.b - t.a)})
            rays.push_back({.origin = eye, .direction = target - eye});
    }
    check_scene(triangles, rays);
}

TEST_CASE("no triangles, one, and a thousand in one place") {
    const Triangle one{{0, 0, 0}, {1, 0.1f, 0.3f}, {0.2f, 1, 1}};
    for (const std::size_t count : {0u, 1u, 1'000u})
        check_scene(std::vector<Triangle>(count, one), picture(16));
    check_scene(scenes::soup(400, 0.2f, 4), {});
}

TEST_CASE("far from the origin, and at the ends of what floats can hold") {
    for (const float scale : {1e-30f, 1e-3f, 1e5f, 0x1p29f, 1e30f}) {
        const auto triangles = scenes::mapped(scenes::soup(100, 0.3f, 5), [&](const Point3& p) {
            return Point3(p.x + 7.0f, p.y, p.z) * scale;
        });
        CAPTURE(scale);
        check_scene(triangles, a_mixture(triangles, sized(400, 50)));
    }
}

}  // namespace space
