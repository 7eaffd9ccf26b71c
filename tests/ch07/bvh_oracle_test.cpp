// All that a ray hits, and the nearest hit, by the trees of all nine builders: as CGAL's exact
// arithmetic has it, on the scenes of the book.
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/over_bsp_builder.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/box_rays.hpp"
#include "tests/ch07/bvh_trees.hpp"
#include "tests/oracle/exact.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space {
namespace {

/// A ray, and what it hits in the order of t, of equal t by the triangles' indices.
struct JudgedRay {
    std::string_view kind;
    Ray ray;
    std::vector<Hit> hits;
};

/// Whether the line may meet the box: seen along the ray, does the box cover the origin? No
/// division; the slack is far above all roundings.
bool may_meet(const Ray& ray, const Aabb& box) {
    const Double3 low(box.min), high(box.max), d(ray.direction);
    const Double3 middle = 0.5 * (low + high) - Double3(ray.origin), half = 0.5 * (high - low);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const double left = d[i] * middle[j], right = d[j] * middle[i];
        const double reach = std::abs(d[i]) * half[j] + std::abs(d[j]) * half[i];
        const double slack = 0x1p-40 * (std::abs(left) + std::abs(right) + reach) +
                             0x1p-40 * std::abs(d[i]) * std::abs(double{ray.origin[j]}) +
                             0x1p-40 * std::abs(d[j]) * std::abs(double{ray.origin[i]});
        if (std::abs(left - right) > reach + slack) return false;
    }
    return true;
}

/// What the oracle says, of the triangles whose boxes the line may meet.
std::vector<Hit> judged(const Ray& ray, std::span<const Triangle> triangles,
                        std::span<const Aabb> boxes) {
    std::vector<Triangle> near;
    std::vector<std::uint32_t> names;
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        if (may_meet(ray, boxes[i])) near.push_back(triangles[i]), names.push_back(i);
    std::vector<Hit> hits;
    float last = -infinity;
    for (const ExactHit& hit : ExactOracle::build(near).hits(ray)) {
        REQUIRE(last <= hit.t);  // floats in the order of the exact t
        last = hit.t;
        hits.push_back({.t = hit.t, .triangle = names[hit.triangle]});
    }
    std::ranges::sort(hits, nearer);
    return hits;
}

/// Some end at one of their hits, or begin there.
std::vector<JudgedRay> judged_rays(std::span<const Triangle> triangles, int count) {
    std::vector<Aabb> boxes;
    for (const Triangle& triangle : triangles) boxes.push_back(bounds(triangle));
    BoxRays maker(BinnedBuilder::build<3>(triangles), triangles, 29);
    std::vector<JudgedRay> rays;
    while (rays.size() < std::size_t(count)) {
        auto [kind, ray] = maker.next();
        if (!is_valid(ray)) continue;
        auto hits = judged(ray, triangles, boxes);
        if (!hits.empty() && rays.size() % 4 < 2) {
            const float end = hits[rays.size() / 4 % hits.size()].t;
            (rays.size() % 4 == 0 ? ray.tmax : ray.tmin) = end;
            std::erase_if(hits,
                          [&](const Hit& hit) { return hit.t < ray.tmin || hit.t > ray.tmax; });
        }
        rays.push_back({kind, ray, std::move(hits)});
    }
    return rays;
}

/// What a walk comes to when nothing but the ray ends it.
std::vector<Hit> all_hits(const BvhNodes<3>& tree, std::span<const Triangle> triangles,
                          const Ray& ray) {
    std::vector<Hit> hits;
    NoCounts none;
    walk_bvh(tree, ray, none, [&](const BvhNode<3>& leaf) {
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
            const std::uint32_t triangle = tree.references[i];
            if (const auto hit = FilteredExact::intersect(ray, triangles[triangle]))
                hits.push_back({.t = hit->t, .triangle = triangle});
        }
        return double{infinity};
    });
    std::ranges::sort(hits, nearer);
    hits.erase(std::unique(hits.begin(), hits.end()), hits.end());  // met in several parts
    return hits;
}

template <class Builder>
void check(const char* name, std::span<const Triangle> triangles, std::span<const JudgedRay> rays,
           const typename Builder::Config& config = {}) {
    INFO(name);
    const auto bvh = Bvh<Builder>::build(triangles, config);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto& [kind, ray, hits] = rays[i];
        CAPTURE(i, kind);
        const auto nearest = closest_hit(bvh, ray);
        REQUIRE(nearest.has_value() == !hits.empty());
        if (nearest) REQUIRE(Hit{.t = nearest->t, .triangle = nearest->triangle} == hits[0]);
        REQUIRE(any_hit(bvh, ray) == !hits.empty());
        REQUIRE((all_hits(bvh.nodes(), triangles, ray) == hits));
    }
}

void check_builders(const std::string& scene, const std::vector<Triangle>& triangles, int count) {
    INFO(scene);
    const std::vector<JudgedRay> rays = judged_rays(triangles, count);
    check<MedianBuilder>("median", triangles, rays);
    check<MiddleBuilder>("middle", triangles, rays);
    check<SweepBuilder>("sweep", triangles, rays);
    check<BinnedBuilder>("binned", triangles, rays);
    check<SpatialSplitBuilder>("spatial", triangles, rays, {.min_overlap = 0.0, .max_growth = 2.0});
    check<MortonBuilder>("morton", triangles, rays);
    check<BottomUpBuilder>("bottom-up", triangles, rays);
    check<OptimisedBuilder>("optimised", triangles, rays);
    check<OverBspBuilder>("over BSP", triangles, rays);
    std::size_t hits = 0;
    for (const JudgedRay& ray : rays) hits += ray.hits.size();
    fmt::print("  {}: {} triangles, {} rays, {} hits\n", scene, triangles.size(), rays.size(),
               hits);
}

/// Scenes of the book, and one at the ends of what floats can hold.
void check_all(int rays, bool small) {
    for (const char* scene : {"icosphere", "soup", "soup_uneven", "slivers", "boxes", "building:1",
                              "stadium:3", "lattice:2", "shells:1", "tree:4"})
        check_builders(scene, make_scene(scene, 1, small).mesh.triangles(), rays);
    for (const float scale : {1e-30f, 1e30f})
        check_builders(fmt::format("soup of size {}", scale),
                       scenes::mapped(scenes::soup(300, 0.3f, 30),
                                      [&](const Point3& p) { return (p - 0.5f) * scale; }),
                       rays);
}

}  // namespace

TEST_CASE("all that a ray hits, in the order of t, is what exact arithmetic says, by any builder") {
    check_all(300, true);
}

// By hand, half an hour of one core: ch07.oracle "[.big]".
TEST_CASE("the same with 100,000 rays a scene", "[.big]") {
    check_all(100'000, false);
}

TEST_CASE("the same on the bunny and the coarse dragon", "[.big]") {
    for (const char* scene : {"bunny", "dragon_48k"})
        check_builders(scene, make_scene(scene).mesh.triangles(), 100'000);
}

}  // namespace space
