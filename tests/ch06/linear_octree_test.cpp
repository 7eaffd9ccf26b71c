// The suite over the linear octree of triangles, and its shape.
#include "chapters/ch06_quadtrees_and_octrees/linear_octree.hpp"

#include "common/random.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <vector>

namespace space {
namespace {

void check_cells(std::string_view name, const LinearOrthtreeConfig& cells) {
    check_accelerator<LinearOctree<>>(
        name, [=](std::span<const Triangle> t) { return LinearOctree<>::build(t, {cells}); },
        SuiteOptions{}.fewer());
}

std::vector<Triangle> scattered(std::size_t count, float size) {
    Pcg32 random(count);
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < count; ++i) {
        const Point3 a = random_point(random, -1.0f, 1.0f);
        const Vector3 b = size * random_vector(random), c = size * random_vector(random);
        triangles.push_back({a, a + b, a + c});
    }
    return triangles;
}

}  // namespace

TEST_CASE("the suite: linear octree") {
    run_suite<LinearOctree>("linear octree");
}

TEST_CASE("the suite: linear octrees with chains, shallow ones, and with one triangle a leaf") {
    check_cells("linear octree with chains", {.leaf_size = 4});
    check_cells("linear octree, depth 2", {.leaf_size = 4, .max_depth = 2});
    check_cells("linear octree, leaves of one", {.leaf_size = 1, .skip_chains = true});
}

TEST_CASE("each triangle is in one leaf, and each box around all that is below it, and no larger") {
    const auto triangles = scattered(2'000, 0.1f);
    const auto tree = BoxedOrthtree<3>::build(triangles, {.leaf_size = 2});
    auto polygons = tree.polygons;
    std::ranges::sort(polygons);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) REQUIRE(polygons[i] == i);
    for (std::size_t i = 0; i < tree.cells.nodes.size(); ++i) {
        Aabb box;
        for (auto place = tree.cells.nodes[i].first; place < tree.cells.nodes[i].last; ++place)
            box.extend(bounds(triangles[tree.polygons[place]]));
        REQUIRE(box == tree.boxes[i]);
    }
}

TEST_CASE("triangles that are not finite are in no box") {
    const auto triangles = scattered(50, 0.1f);
    const Aabb box = BoxedOrthtree<3>::build(triangles).boxes.front();
    for (const float bad : {std::nanf(""), infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            auto all = triangles;
            all.push_back(triangles.front());
            all.back().b[axis] = bad;
            CAPTURE(bad, axis);
            CHECK(BoxedOrthtree<3>::build(all).boxes.front() == box);
            CHECK(BoxedOrthtree<3>::build(std::span(all).last(1)).boxes.front().is_empty());
        }
}

TEST_CASE("without chains there are fewer than two nodes a triangle, and references are as many") {
    // Two clusters, 2^-18 wide, in opposite corners.
    auto triangles = scattered(500, 0x1p-20f);
    for (Triangle& t : triangles) {
        const float corner = t.a.x < 0.0f ? 0.0f : 1.0f;
        for (Point3* p : {&t.a, &t.b, &t.c}) *p = corner + 0x1p-18f * *p;
    }
    const auto jump = LinearOctree<>::build(triangles).shape();
    const auto chain = LinearOctree<>::build(triangles, {{.leaf_size = 4}}).shape();
    CHECK(jump.references == 500);
    CHECK(jump.nodes < 2u * 500u);
    CHECK(jump.leaves == chain.leaves);
    CHECK(*jump.nodes + 20 < *chain.nodes);
    CHECK(*jump.depth + 8 < *chain.depth);
    CHECK(LinearOctree<>::build({}).shape().nodes == 0u);
}

TEST_CASE("a walk tells nodes front to back among siblings, and none behind the hit") {
    std::vector<Triangle> sheets;
    for (int i = 0; i < 64; ++i) {
        const auto z = float(i);
        sheets.push_back({{-1, -1, z}, {1, -1, z}, {0, 1, z}});
    }
    const auto octree = LinearOctree<>::build(sheets, {{.leaf_size = 1}});
    const Ray ray{{0, 0, -1}, {0, 0, 1}};
    TraversalCounts counts;
    const auto hit = octree.closest_hit(ray, counts);
    REQUIRE(hit);
    CHECK(hit->t == 1.0f);
    CHECK(hit->triangle == 0);
    CHECK(counts.triangles_tested == 1);
    struct Watcher : NoObserver {
        using NoObserver::observe;
        std::vector<double> entered;
        void observe(const BoxVisit& visit) { entered.push_back(visit.part.enter); }
    } watcher;
    NoCounts none;
    walk_boxes(
        octree.tree(), ray, none, [](std::uint32_t) { return double{infinity}; }, watcher);
    CHECK(watcher.entered.size() == octree.tree().cells.nodes.size());
    CHECK(std::ranges::is_sorted(watcher.entered));
}

}  // namespace space
