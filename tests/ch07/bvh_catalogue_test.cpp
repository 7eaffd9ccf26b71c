// Where hierarchies of boxes fail: of each failure a test in which the plain method fails, by how
// much, and the cure holds. (V7 stands with the builder by Morton codes.)
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/box_rays.hpp"
#include "tests/ch07/bvh_trees.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/small_bvh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace space {
namespace {

/// Answers rays as the naive loop does.
template <class Structure>
void check_answers(const Structure& bvh, const std::vector<Triangle>& triangles, int rays) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    BoxRays maker(bvh.nodes(), triangles, 3);
    std::size_t hits = 0;
    for (int i = 0; i < sized(rays, 70 + rays / 10); ++i) {
        const Ray ray = maker.next().ray;
        const auto expected = closest_hit(naive, ray);
        REQUIRE(closest_hit(bvh, ray) == expected);
        REQUIRE(any_hit(bvh, ray) == expected.has_value());
        hits += expected.has_value();
    }
    CHECK(hits > 0);
}

std::size_t largest_leaf(const BvhNodes<3>& tree) {
    std::size_t largest = 0;
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i)
        largest = std::max<std::size_t>(largest, tree.nodes[i].count);
    return largest;
}

}  // namespace

TEST_CASE("V1: equal middles have no bin; halved by their indices they have a tree") {
    const std::vector<Triangle> copies(sized(1000u, 200u),
                                       Triangle{{0, 0, 0}, {1, 0.1f, 0.3f}, {0.2f, 1, 1}});
    const auto all = boxed<3>(copies);
    const Aabb middles = box_around_centroids<3>(all);
    std::size_t no_number = 0;  // to cast it to an integer has no meaning
    for (const auto& reference : all) {
        const float from_start = reference.box.centroid().x - middles.min.x;
        no_number += std::isnan(16.0f * from_start / (middles.max.x - middles.min.x));
    }
    CHECK(no_number == copies.size());

    for_each_builder([&](const char* name, const auto& build, std::size_t max_leaf_size) {
        INFO(name);
        const BvhNodes<3> tree = build(copies);
        CHECK(faults_of(tree, copies, max_leaf_size) == "");
        CHECK(tree.depth <= 10);  // 2^10 leaves
    });
    check_answers(Bvh<BinnedBuilder>::build(copies), copies, 300);
}

TEST_CASE("V2: ratios of areas that are zero are no costs; ratios of lengths are") {
    // Triangles whose boxes lie in a line.
    std::vector<Triangle> triangles;
    for (int i = 0; i < 1000; ++i) {
        const float x = float(i * 37 % 1000);
        triangles.push_back({{x, 0, 0}, {x + 0.5f, 0, 0}, {x + 1, 0, 0}});
    }
    const auto all = boxed<3>(triangles);
    const Aabb box = box_around<3>(all);
    CHECK(std::isnan(all[0].box.half_area() / box.half_area()));  // never less: all in one leaf
    CHECK(HitChance<3>(box)(all[0].box) == 1.0 / 1000.0);
    CHECK(HitChance<3>(Aabb{Point3(1), Point3(1)})(Aabb{Point3(1), Point3(1)}) == 1.0);
    for (const auto& tree :
         {SweepBuilder::build<3>(triangles), BinnedBuilder::build<3>(triangles)}) {
        CHECK(largest_leaf(tree) <= 4);
        CHECK(tree.depth <= 12);
        CHECK(std::isfinite(tree.sah_cost({})));
    }
    // In a plane, where they can be hit.
    const auto flat = scenes::mapped(scenes::soup(500, 0.05f, 6),
                                     [](const Point3& p) { return Point3(p.x, 0.5f, p.z); });
    CHECK(largest_leaf(BinnedBuilder::build<3>(flat)) <= 8);
    check_answers(Bvh<BinnedBuilder>::build(flat), flat, 2'000);
}

TEST_CASE("V3: a vertex that is not a number makes a box forget what came before it") {
    auto triangles = scenes::soup(1000, 0.1f, 7);
    triangles[996].b.x = std::numeric_limits<float>::quiet_NaN();
    triangles[500].c.z = infinity;
    float low = infinity;
    std::vector<float> xs;
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner) {
            xs.push_back(triangles[i][corner].x);
            low = std::min(xs.back(), low);  // NaN < low is false, and so is low < NaN
        }
    const auto outside = std::ranges::count_if(xs, [&](float x) { return x < low; });
    fmt::print("  of {} vertices {} lie below the box's lower end\n", xs.size(), outside);
    CHECK(outside > 500);

    for_each_builder([&](const char* name, const auto& build, std::size_t) {
        INFO(name);
        const BvhNodes<3> tree = build(triangles);
        CHECK(diagnosis(layout_faults(tree)) == "");
        CHECK(tree.references.size() == 998);
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            const bool left_out = i == 996 || i == 500;
            REQUIRE((std::ranges::count(tree.references, i) == (left_out ? 0 : 1)));
            if (!left_out) REQUIRE(tree.nodes[0].box.contains(bounds(triangles[i])));
        }
    });
    check_answers(Bvh<BinnedBuilder>::build(triangles), triangles, 2'000);
    const std::vector<Triangle> none(3, triangles[996]);
    CHECK(Bvh<BinnedBuilder>::build(none).nodes().empty());
}

TEST_CASE("V4: areas of huge boxes are infinite, and costs not numbers; in double they are") {
    for (const float size : {1e30f, 3e38f}) {
        auto triangles = scenes::soup(400, 0.1f, 8);
        for (Triangle& t : triangles)
            t = {(2.0f * t.a - 1.0f) * size, (2.0f * t.b - 1.0f) * size,
                 (2.0f * t.c - 1.0f) * size};
        std::erase_if(triangles, [](const Triangle& t) {
            return !is_finite<3>(t.a) || !is_finite<3>(t.b) || !is_finite<3>(t.c);
        });
        const Aabb box = box_around<3>(boxed<3>(triangles));
        const Vector3 extent = box.max - box.min;
        const float area = extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
        CHECK(std::isnan(area / area));  // by which no cut is ever cheaper
        CHECK(std::isfinite(HitChance<3>(box).whole()));
        const auto sweep = SweepBuilder::build<3>(triangles),
                   binned = BinnedBuilder::build<3>(triangles);
        CHECK(std::isfinite(binned.sah_cost({})));
        CHECK(binned.sah_cost({}) < 0.25 * double(triangles.size()));
        CHECK(sweep.sah_cost({}) < 0.25 * double(triangles.size()));
        check_answers(Bvh<BinnedBuilder>::build(triangles), triangles, 2'000);
        // One vertex far away, and all others where one bin would hold them.
        auto one_far = scenes::soup(400, 0.1f, 9);
        one_far[7].c.x = size;
        CHECK(BinnedBuilder::build<3>(one_far).sah_cost({}) < 20.0);
        check_answers(Bvh<BinnedBuilder>::build(one_far), one_far, 2'000);
    }
}

namespace {

/// Triangles above each other, z = 0, 1, 2, ...; all but one are beside the z axis.
std::vector<Triangle> tower(int height, int hit) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < height; ++i) {
        const auto z = static_cast<float>(i);
        triangles.push_back(i == hit ? Triangle{{-1, -1, z}, {2, -1, z}, {-1, 2, z}}
                                     : Triangle{{-1, 1, z}, {1, -1, z}, {1, 1, z}});
    }
    for (int i = 0; i < height; ++i)  // moved off the axis, which its box still meets
        if (i != hit)
            for (Point3* p : {&triangles[std::size_t(i)].a, &triangles[std::size_t(i)].b})
                *p += Vector3(p->x < 0 ? 0.25f : 0.0f, p->y < 0 ? 0.25f : 0.0f, 0.0f);
    return triangles;
}

/// A chain: each node has a leaf of one triangle, and all the higher ones.
template <int depth>
struct ChainBuilder {
    struct Config {
        BvhCosts costs = {};
    };
    template <int D, class Observer>
    static BvhNodes<3> build(std::span<const Triangle> triangles, const Config&, Observer&) {
        BvhNodes<3> tree;
        tree.depth = depth;
        tree.nodes.resize(2 * depth + 2);
        Aabb box;
        for (std::uint32_t i = depth; i-- > 0;) {
            box.extend(bounds(triangles[i + 1]));
            if (i + 1 == depth) tree.nodes[2 * i + 3] = {box, depth, 1};
            tree.nodes[2 * i + 2] = {bounds(triangles[i]), i, 1};
            box.extend(bounds(triangles[i]));
            tree.nodes[i == 0 ? 0 : 2 * i + 1] = {box, 2 * i + 2, 0};
        }
        for (std::uint32_t i = 0; i <= depth; ++i) tree.references.push_back(i);
        return tree;
    }
};

}  // namespace

TEST_CASE("V8: a chain of depth 576 needs 576 places; a stack of 64 loses what is pushed later") {
    constexpr int depth = 576;
    const auto triangles = tower(depth + 1, 300);
    const auto bvh = Bvh<ChainBuilder<depth>>::build(triangles);
    CHECK(faults_of(bvh.nodes(), triangles, 1) == "");
    const Ray down{.origin = {0, 0, 1000}, .direction = {0, 0, -1}};
    // All leaves wait, but for the first: counted by a walk that keeps the first 64 of them.
    std::size_t pushed = 0;
    bool kept_hit = false;
    for (std::uint32_t node = 0; !bvh.nodes().nodes[node].is_leaf();
         node = bvh.nodes().nodes[node].first + 1) {
        const std::uint32_t leaf = bvh.nodes().nodes[node].first;
        kept_hit = kept_hit || (pushed < 64 && bvh.nodes().own(leaf)[0] == 300);
        ++pushed;
    }
    CHECK(pushed == depth);
    CHECK(!kept_hit);
    const auto hit = closest_hit(bvh, down);
    REQUIRE(hit.has_value());
    CHECK(hit->triangle == 300);
    CHECK(any_hit(bvh, down));
    check_answers(bvh, triangles, 2'000);
}

TEST_CASE("V8: builders end chains before the stack does, and a deeper tree is refused") {
    // Each triangle as far away as all others are wide: a plane in the middle frees one at a time.
    std::vector<Triangle> triangles;
    for (int i = 0; i < 240; ++i) {
        const float x = std::ldexp(1.0f, i - 120);
        triangles.push_back({{x, 0, 0}, {x, x, 0}, {x, 0, x}});
    }
    for_each_builder([&](const char* name, const auto& build, std::size_t) {
        INFO(name);
        CHECK(build(triangles).depth <= 64 + 8);
    });
    CHECK(MiddleBuilder::build<3>(triangles, {.max_leaf_size = 1, .max_depth = 500}).depth > 100);
    CHECK_NOTHROW(Bvh<ChainBuilder<int(max_bvh_depth)>>::build(tower(max_bvh_depth + 1, 0)));
    CHECK_THROWS_AS(Bvh<ChainBuilder<int(max_bvh_depth) + 1>>::build(tower(max_bvh_depth + 2, 0)),
                    LimitError);
}

TEST_CASE("V9: what begins at the nearest hit may tie with it; cut off there, ties are lost") {
    std::vector<Triangle> triangles;  // all in z = 1, the lowest index in another box than the rest
    for (const float reach : {3.0f, 1.0f, 1.5f, 2.0f, 1.25f, 1.75f})
        triangles.push_back({{-reach, -reach, 1}, {3 * reach, -reach, 1}, {-reach, 3 * reach, 1}});
    const auto bvh =
        Bvh<BinnedBuilder>::build(triangles, {.costs = {0.0, 1.0}, .max_leaf_size = 1});
    const auto pruned = SmallBvh<TreeFlaw::box_equals_pruned>::build(triangles);
    const auto naive = Naive<FilteredExact>::build(triangles);
    Pcg32 random(4);
    std::size_t ties = 0, lost = 0;
    for (int i = 0; i < 1'000; ++i) {
        const Point3 target{random.uniform(-0.5f, 0.5f), random.uniform(-0.5f, 0.5f), 1.0f};
        const Ray ray{.origin = random_vector(random) - Point3(0, 0, 3),
                      .direction = target - Point3(0, 0, -2)};
        const auto expected = closest_hit(naive, ray);
        REQUIRE(closest_hit(bvh, ray) == expected);
        ties += expected.has_value();
        lost += closest_hit(pruned, ray) != expected;
    }
    fmt::print("  of {} ties {} are lost\n", ties, lost);
    CHECK(ties > 500);
    CHECK(lost > 0);
}

TEST_CASE("V9: what begins at the limit itself is visited, what begins beyond it is not") {
    std::vector<Triangle> triangles;  // boxes from z = 1 on, but for the last
    for (const float z : {1.0f, 1.0f, 2.0f})
        triangles.push_back({{-1, -1, z}, {1, -1, z}, {0, 1, 3}});
    const auto tree = MedianBuilder::build<3>(triangles, {.max_leaf_size = 1});
    struct Watcher : NoObserver {
        using NoObserver::observe;
        void observe(const BvhVisit& visit) { enter = visit.enter; }
        double enter = 0.0;
    } watcher;
    std::size_t leaves = 0;
    NoCounts none;
    const auto own = [&](const BvhNode<3>&) { return ++leaves, watcher.enter; };
    walk_bvh(tree, Ray{.origin = {0, 0, -1}, .direction = {0, 0, 1}}, none, own, watcher);
    CHECK(leaves == 2);
}

}  // namespace space
