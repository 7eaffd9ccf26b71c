// Rays aimed at edges, at vertices and at faces of boxes: the nearest hit of each width and
// instruction set is what CGAL's exact arithmetic says, triangle for triangle.
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "common/accelerator.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/box_rays.hpp"
#include "tests/ch10/every_kernel.hpp"
#include "tests/oracle/exact.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace space {
namespace {

/// A ray and its nearest hit, of equal t the triangle with the smallest index.
struct JudgedRay {
    std::string_view kind;
    Ray ray;
    std::optional<Hit> nearest;
};

/// The oracle for one scene, which is asked only about triangles whose boxes the line may meet:
/// seen along the ray, does the box cover the origin? No division, and a slack far above all
/// roundings.
class Judge {
  public:
    explicit Judge(std::span<const Triangle> triangles) : triangles_(triangles) {
        for (const Triangle& triangle : triangles) {
            const Aabb box = bounds(triangle);
            const Double3 low(box.min), high(box.max);
            middle_.push_back(0.5 * (low + high));
            half_.push_back(0.5 * (high - low));
        }
    }

    std::optional<Hit> nearest(const Ray& ray) const {
        std::vector<Triangle> near;
        std::vector<std::uint32_t> names;
        for (std::uint32_t i = 0; i < triangles_.size(); ++i)
            if (may_meet(ray, i)) near.push_back(triangles_[i]), names.push_back(i);
        std::optional<Hit> best;
        for (const ExactHit& exact : ExactOracle::build(near).hits(ray)) {
            const Hit hit{.t = exact.t, .triangle = names[exact.triangle]};
            if (best && exact.t > best->t) break;
            if (!best || nearer(hit, *best)) best = hit;
        }
        return best;
    }

  private:
    bool may_meet(const Ray& ray, std::uint32_t triangle) const {
        const Double3 d(ray.direction), o(ray.origin), middle = middle_[triangle] - o,
                                                       half = half_[triangle];
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            const double left = d[i] * middle[j], right = d[j] * middle[i];
            const double reach = std::abs(d[i]) * half[j] + std::abs(d[j]) * half[i];
            const double slack = 0x1p-40 * (std::abs(left) + std::abs(right) + reach +
                                            std::abs(d[i] * o[j]) + std::abs(d[j] * o[i]));
            if (std::abs(left - right) > reach + slack) return false;
        }
        return true;
    }

    std::span<const Triangle> triangles_;
    std::vector<Double3> middle_, half_;
};

/// Most are aimed at edges and vertices; some end, or begin, at their hit.
std::vector<JudgedRay> judged_rays(std::span<const Triangle> triangles, std::size_t count) {
    const Judge judge(triangles);
    RayMaker aimed(triangles, 31);
    BoxRays at_boxes(BinnedBuilder::build<3>(triangles), triangles, 32);
    std::vector<JudgedRay> rays;
    while (rays.size() < count) {
        const std::size_t i = rays.size();
        auto [kind, ray] = i % 5 < 2   ? aimed.at_edge()
                           : i % 5 < 4 ? aimed.at_vertex()
                                       : at_boxes.next();
        if (!is_valid(ray)) continue;
        auto nearest = judge.nearest(ray);
        if (nearest && i % 8 == 0) {
            (i % 16 == 0 ? ray.tmax : ray.tmin) = nearest->t;
            nearest = judge.nearest(ray);
        }
        rays.push_back({kind, ray, nearest});
    }
    return rays;
}

template <class Structure>
void check(const Structure& bvh, std::span<const JudgedRay> rays) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto& [kind, ray, expected] = rays[i];
        const auto got = closest_hit(bvh, ray);
        const bool is_right =
            got.has_value() == expected.has_value() &&
            (!got || (got->t == expected->t && got->triangle == expected->triangle)) &&
            any_hit(bvh, ray) == expected.has_value();
        if (is_right) continue;
        CAPTURE(i, kind, got.has_value(), expected.has_value());
        FAIL("another answer than exact arithmetic's");
    }
}

void check_scene(const std::string& scene, const std::vector<Triangle>& triangles,
                 std::size_t count) {
    INFO(scene);
    const std::vector<JudgedRay> rays = judged_rays(triangles, count);
    for_each_kernel(triangles, [&](const auto& bvh, const std::string&) { check(bvh, rays); });
    const WideBvhConfig<SpatialSplitBuilder> cut{.binary = {.min_overlap = 0.0, .max_growth = 2.0}};
    check(WideBvh<4, SpatialSplitBuilder>::build(triangles, cut), rays);
    check(WideBvh<8, SpatialSplitBuilder>::build(triangles, cut), rays);
    check(FastHighBvh<>::build(triangles), rays);
    const auto hits =
        std::ranges::count_if(rays, [](const auto& r) { return r.nearest.has_value(); });
    fmt::print("  {}: {} triangles, {} rays, {} hits, no wrong answer\n", scene, triangles.size(),
               rays.size(), hits);
    CHECK(hits > 0);
}

void check_scenes(std::size_t rays) {
    for (const char* scene : {"icosphere", "soup", "soup_uneven", "slivers", "boxes", "stadium:3",
                              "lattice:2", "tree:4"})
        check_scene(scene, make_scene(scene, 1, true).mesh.triangles(), rays);
}

/// One scene at the ends of what floats can hold.
void check_sizes(std::size_t rays) {
    for (const float scale : {1e-30f, 1e-6f, 1e6f, 1e30f})
        check_scene(fmt::format("soup of size {}", scale),
                    scenes::mapped(scenes::soup(300, 0.3f, 30),
                                   [&](const Point3& p) { return (p - 0.5f) * scale; }),
                    rays);
}

}  // namespace

TEST_CASE("aimed rays: each width and instruction set gives exact arithmetic's nearest hit") {
    check_scenes(400);
    check_sizes(400);
}

// By hand: ch10.aimed_oracle "[.big]".
TEST_CASE("the same with 1,000,000 rays a scene", "[.big]") {
    check_scenes(1'000'000);
}

TEST_CASE("the same with 1,000,000 rays a size", "[.big]") {
    check_sizes(1'000'000);
}

TEST_CASE("the same with 1,000,000 rays at meshes", "[.big]") {
    for (const char* scene : {"building:1", "shells:1", "bunny", "dragon_48k"})
        check_scene(scene, make_scene(scene).mesh.triangles(), 1'000'000);
}

}  // namespace space
