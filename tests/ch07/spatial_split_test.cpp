// Spatial splits: nothing is lost, references stay within their bound, long triangles are cheaper.
#include "chapters/ch07_bounding_volume_hierarchies/bounding_volume.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/parts_check.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace space {
namespace {

const auto all_needed = [](const auto&) { return true; };

/// Houses whose walls are long triangles, aslant to all axes.
std::vector<Triangle> turned_town(int houses) {
    const auto town = make_scene("boxes:" + std::to_string(houses)).mesh.triangles();
    return scenes::mapped(town, [](const Point3& p) {
        const Point3 q(0.8f * p.x - 0.6f * p.y, 0.6f * p.x + 0.8f * p.y, p.z);
        return Point3(0.8f * q.x - 0.6f * q.z, q.y, 0.6f * q.x + 0.8f * q.z);
    });
}

/// Thin triangles from one side of the unit cube to the opposite one, aslant to all axes.
std::vector<Triangle> diagonal_slivers(int count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Triangle> triangles;
    for (int i = 0; i < count; ++i) {
        const Point3 a = random_point(random, Aabb{{0, 0, 0}, {1, 1, 0}}),
                     b = random_point(random, Aabb{{0, 0, 1}, {1, 1, 1}});
        triangles.push_back({a, b, b + 0.01f * random_vector(random)});
    }
    return triangles;
}

/// Of rays between random points of the scene's box.
template <class Builder>
TraversalCounts work(std::span<const Triangle> triangles, const typename Builder::Config& config) {
    const auto bvh = Bvh<Builder>::build(triangles, config);
    Pcg32 random(17);
    TraversalCounts counts;
    const Aabb box = bvh.nodes().nodes[0].box;
    for (int i = 0; i < 2'000; ++i) {
        const Point3 from = random_point(random, box);
        bvh.closest_hit({from, random_point(random, box) - from}, counts);
    }
    return counts;
}

}  // namespace

TEST_CASE(
    "spatial splits: each point of a triangle is in a leaf that names it, in scenes made to "
    "lose some") {
    for (const TestScene& scene : some_of(adversarial_scenes())) {
        INFO(scene.name);
        const std::span<const Triangle> triangles = scene.triangles;
        for (const SpatialSplitConfig& config :
             {SpatialSplitConfig{},
              {.min_overlap = 0.0, .max_growth = 3.0},
              {.max_leaf_size = 2, .max_depth = 4, .max_growth = 2.0},
              {.costs = {0.0, 1.0}, .max_leaf_size = 1, .unsplits = false},
              // Some parents' boxes are larger than their children's together, before they are
              // united.
              {.costs = {0.0, 1.0}, .max_leaf_size = 1, .min_overlap = 0.0, .max_growth = 20.0}}) {
            const auto tree = SpatialSplitBuilder::build<3>(triangles, config);
            REQUIRE(faults_of_parts<3>(tree, triangles, config.max_leaf_size, all_needed) == "");
            const auto most = config.max_growth * double(triangles.size());
            REQUIRE(double(tree.references.size()) <= most);
        }
    }
}

TEST_CASE("spatial splits in the plane: the same of segments") {
    Pcg32 random(4);
    std::vector<Segment> segments;
    const Aabb2 square{Point2(0.0f), Point2(1.0f)};
    for (int i = 0; i < 300; ++i) {
        const Point2 a = random_point(random, square);
        segments.push_back({a, random_point(random, square)});
    }
    const auto tree = SpatialSplitBuilder::build<2>(segments);
    CHECK(faults_of_parts<2>(tree, segments, 8, all_needed) == "");
}

TEST_CASE("there are never more references than the bound says, and at 1 none twice") {
    const auto triangles = turned_town(sized(100, 36));
    const std::size_t n = triangles.size();
    for (const double growth : {1.0, 1.1, 1.3, 2.0, 5.0}) {
        const auto tree = SpatialSplitBuilder::build<3>(triangles, {.max_growth = growth});
        INFO(growth << ": " << tree.references.size());
        CHECK(tree.references.size() <= n + std::size_t((growth - 1.0) * double(n)));
        CHECK((tree.references.size() > n) == (growth > 1.0));
        if (growth == 1.0) CHECK(faults_of(tree, triangles, 8) == "");
    }
    for (const double growth : {0.0, -1.0, 0.5})
        CHECK(SpatialSplitBuilder::build<3>(triangles, {.max_growth = growth}).references.size() ==
              n);
}

TEST_CASE("planes are tried where boxes overlap in more than the share that is asked for") {
    const auto triangles = turned_town(36);
    const auto references = [&](double min_overlap) {
        return SpatialSplitBuilder::build<3>(triangles, {.min_overlap = min_overlap})
            .references.size();
    };
    CHECK(references(1.0) == triangles.size());  // a share is at most 1
    CHECK(references(0.3) <= references(0.0));
    CHECK(references(0.0) > triangles.size());
}

TEST_CASE("without planes the tree is the sweep's") {
    for (const auto& triangles : {scenes::soup(500, 0.2f, 3), scenes::ball(3)}) {
        const auto tree = SpatialSplitBuilder::build<3>(triangles, {.max_growth = 1.0}),
                   swept = SweepBuilder::build<3>(triangles);
        CHECK(tree.nodes == swept.nodes);
        CHECK(tree.references == swept.references);
    }
}

TEST_CASE("where triangles are long and aslant, rays visit and test a quarter less and more") {
    const auto total = [](const TraversalCounts& counts) {
        return double(counts.nodes_visited + counts.triangles_tested);
    };
    const auto town = turned_town(400);
    const double swept = total(work<SweepBuilder>(town, {}));
    CHECK(total(work<SpatialSplitBuilder>(town, {})) < 0.75 * swept);
    CHECK(total(work<SpatialSplitBuilder>(town, {.max_growth = 1.1})) < 0.95 * swept);
    CHECK(total(work<SpatialSplitBuilder>(town, {.max_growth = 1.0})) == swept);
}

TEST_CASE("bins hold the parts of a diagonal, each in its own") {
    const Triangle flat{{0, 0, 0}, {32, 32, 0}, {32, 32, 0}};
    SpatialBins<3> bins(bounds(flat), 0, 32);
    bins.add(flat, {bounds(flat), 0});
    // On both sides of the middle plane it needs a quarter of the box.
    CHECK(bins.best(1, 1, HitChance<3>(bounds(flat))).position == 16.0f);
    CHECK(bins.best(1, 1, HitChance<3>(bounds(flat))).tests == Approx(0.25 + 0.25));
    // The same with two small ones at the ends.
    const Triangle low{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
        high{{32, 32, 0}, {31, 32, 0}, {32, 31, 0}};
    bins.add(low, {bounds(low), 1});
    bins.add(high, {bounds(high), 2});
    const HitChance<3> chance(bounds(flat));
    const SpatialSplit best = bins.best(3, 1, chance);
    CHECK(best.axis == 0);
    CHECK(best.position == 16.0f);
    CHECK(best.tests == Approx(0.25 * 2 + 0.25 * 2));
    CHECK(bins.best(3, 0, chance).tests == infinity);
}

TEST_CASE("what begins on a plane is above it, what ends there is below, as bins count them") {
    // Planes at whole numbers. Segments that end, begin and lie on x = 16.
    const std::vector<Segment> segments{{{0, 0}, {16, 1}}, {{16, 0}, {32, 1}}, {{16, 0}, {16, 1}}};
    SpatialBins<2> bins(Aabb2{{0, 0}, {32, 1}}, 0, 32);
    for (std::uint32_t i = 0; i < 3; ++i) {
        Aabb2 box;
        box.extend(segments[i].a), box.extend(segments[i].b);
        bins.add(segments[i], {box, i});
    }
    const SpatialSplit best = bins.best(3, 0, HitChance<2>(Aabb2{{0, 0}, {32, 1}}));
    CHECK(best.position == 16.0f);
    CHECK(best.tests == Approx((17.0 * 1 + 17.0 * 2) / 33.0));
}

TEST_CASE("what only touches a plane stays on its side: what lies across it alone is named twice") {
    struct Watcher : NoObserver {
        using NoObserver::observe;
        std::size_t across = 0, touching = 0;
        void observe(const SpatialSplitBuild<3>::Chosen& event) {
            if (!event.choice.plane) return;
            const auto [axis, position, tests] = *event.choice.plane;
            for (const auto& reference : event.task.references) {
                const Aabb& box = reference.box;
                across += box.min[axis] < position && position < box.max[axis];
                touching += box.min[axis] == position || box.max[axis] == position;
            }
        }
    } watcher;
    // The root's 32 bins have planes at whole numbers, where small ones begin and end.
    Pcg32 random(6);
    std::vector<Triangle> triangles;
    for (int i = 0; i < 200; ++i) {
        Point3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = float(random.below(32));
        triangles.push_back({p, p + Vector3(1, 0, 1), p + Vector3(0, 1, 1)});
        if (i % 10 == 0) triangles.push_back({Point3(0), Point3(32), p});
    }
    const auto tree = SpatialSplitBuilder::build<3>(
        triangles, {.min_overlap = 0.0, .max_growth = 3.0, .unsplits = false}, watcher);
    CHECK(watcher.touching > 20);
    CHECK(tree.references.size() > triangles.size());
    CHECK(tree.references.size() <= triangles.size() + watcher.across);
}

TEST_CASE("what a plane leaves of the spare references goes to the children by their surfaces") {
    struct Seen {
        std::size_t spare = 0, references = 0;
        double surfaces = 0.0;
    };
    struct Watcher : NoObserver {
        using NoObserver::observe;
        std::map<std::uint32_t, Seen> seen;
        std::vector<std::uint32_t> parents;  // whose pairs follow one another from 2 on
        void observe(const SpatialSplitBuild<3>::Chosen& event) {
            Seen& own = seen[event.task.node];
            own = {event.task.spare, event.task.references.size()};
            for (const auto& reference : event.task.references)
                own.surfaces += surface(reference.box);
            if (event.choice.cut || event.choice.plane) parents.push_back(event.task.node);
        }
    } watcher;
    const auto triangles = turned_town(sized(100, 36));
    SpatialSplitBuilder::build<3>(triangles, {.max_growth = 2.0}, watcher);
    CHECK(watcher.seen[0].spare == triangles.size());
    for (std::uint32_t i = 0; i < watcher.parents.size(); ++i) {
        const Seen &node = watcher.seen[watcher.parents[i]], &low = watcher.seen[2 * i + 2],
                   &high = watcher.seen[2 * i + 3];
        const std::size_t more = low.references + high.references - node.references;
        REQUIRE(low.spare + high.spare + more == node.spare);
        const double share = low.surfaces / (low.surfaces + high.surfaces);
        REQUIRE(double(low.spare) == Approx(share * double(low.spare + high.spare)).margin(1.0));
    }
}

TEST_CASE("unsplitting keeps a triangle whole that reaches over the plane by little") {
    struct Watcher : NoObserver {
        using NoObserver::observe;
        std::size_t planes = 0;
        void observe(const SpatialSplitBuild<3>::Chosen& event) {
            planes += event.choice.plane.has_value();
        }
    };
    const auto triangles = turned_town(sized(100, 36));
    Watcher with, without;
    const auto kept = SpatialSplitBuilder::build<3>(triangles, {.max_growth = 9.0}, with);
    const auto split =
        SpatialSplitBuilder::build<3>(triangles, {.max_growth = 9.0, .unsplits = false}, without);
    CHECK(with.planes > 0);
    CHECK(kept.references.size() < split.references.size());
}

TEST_CASE(
    "coordinates near the largest float, flat boxes and what is not finite are cut like any") {
    std::vector<Triangle> triangles = diagonal_slivers(sized(400, 100), 5);
    const auto check = [&] {
        const auto tree = SpatialSplitBuilder::build<3>(triangles, {.min_overlap = 0.0});
        const auto finite = [](const Triangle& t) { return !box_if_finite<3>(t).is_empty(); };
        CHECK(faults_of_parts<3>(tree, triangles, 8, finite) == "");
    };
    triangles[7].b.x = std::nanf("");
    triangles[3].c.z = -infinity;
    check();
    for (Triangle& t : triangles)
        for (Point3* p : {&t.a, &t.b, &t.c}) *p = (*p - 0.5f) * 3e38f * 2.0f;
    check();
    for (Triangle& t : triangles)
        for (Point3* p : {&t.a, &t.b, &t.c}) p->y = 0.25f;
    check();
}

TEST_CASE("spatial splits: the same tree every time") {
    const auto triangles = turned_town(100);
    const auto a = SpatialSplitBuilder::build<3>(triangles);
    const auto b = SpatialSplitBuilder::build<3>(triangles);
    CHECK(a.nodes == b.nodes);
    CHECK(a.references == b.references);
}

}  // namespace space
