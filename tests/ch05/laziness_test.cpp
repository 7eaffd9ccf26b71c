// What a lazy tree makes, and when: nothing before a ray comes, only what rays enter, and in the
// end the eager tree.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "common/limit_error.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch05/same_tree.hpp"
#include "tests/suite/adversarial_scenes.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <map>
#include <new>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace space {
namespace test {
extern std::atomic<std::ptrdiff_t> living_allocations, allocations_left;  // allocations.cpp
}
namespace {

using Rule = LazyKdTreeConfig::Rule;

/// All adversarial scenes, and icosahedra; sanitized: every third.
std::vector<TestScene> all_scenes() {
    std::vector<TestScene> all = adversarial_scenes();
    for (const int size : {1, 4, sized(16, 8)}) {
        const std::string name = fmt::format("icosphere:{}", size);
        all.push_back({name, make_scene(name).mesh.triangles()});
    }
    all.push_back({"much soup", scenes::soup(sized(5'000u, 500u), 0.05f, 41)});
    return some_of(all);
}

std::vector<LazyKdTreeConfig> all_configs() {
    std::vector<LazyKdTreeConfig> all{{},
                                      {.clips = false},
                                      {.rule = Rule::middle},
                                      {.rule = Rule::median, .clips = false},
                                      {.costs = {.traversal = 0.01, .intersection = 10.0}}};
    for (LazyKdTreeConfig& config : all) config.at_once = 0;
    all.push_back({.at_once = 8});
    all.push_back({});
    return all;
}

/// Rays of every kind.
std::vector<Ray> some_rays(std::span<const Triangle> triangles, int of_each) {
    RayMaker maker(triangles, 71);
    std::vector<Ray> rays;
    for (int i = 0; i < of_each; ++i)
        for (const TestRay& test :
             {maker.random(), maker.axis_parallel(), maker.within_a_slab(), maker.from_vertex(),
              maker.from_face(), maker.at_vertex(), maker.at_edge()})
            rays.push_back(test.ray);
    return rays;
}

/// Tells which nodes a walk visits.
struct Visited {
    std::set<std::uint32_t>& nodes;
    void observe(const KdVisit& visit) { nodes.insert(visit.node); }
};

/// The eager tree's lists: how many references every node was made from.
struct Sizes : NoObserver {
    std::map<std::uint32_t, std::size_t>& of;

    explicit Sizes(std::map<std::uint32_t, std::size_t>& to) : of(to) {}
    using NoObserver::observe;
    void observe(const KdBuilder<3>::Chosen& event) { of[event.node] = event.references.size(); }
};

/// What is to stand when rays have visited these nodes: they, and all below short lists.
std::set<std::uint32_t> expected_to_stand(const KdNodes<3>& tree,
                                          const std::set<std::uint32_t>& visited,
                                          const std::map<std::uint32_t, std::size_t>& sizes,
                                          std::size_t at_once) {
    std::set<std::uint32_t> all;
    std::vector<std::uint32_t> open(visited.begin(), visited.end());
    while (!open.empty()) {
        const std::uint32_t node = open.back();
        open.pop_back();
        if (!all.insert(node).second || sizes.at(node) > at_once || tree.node(node).is_leaf())
            continue;
        open.insert(open.end(), {tree.node(node).below(), tree.node(node).below() + 1});
    }
    return all;
}

}  // namespace

TEST_CASE(
    "without rays nothing is made, and a ray that misses the box of everything makes nothing") {
    const auto triangles = scenes::soup(100, 0.2f, 1);
    const auto tree = LazyKdTree<>::build(triangles);
    const auto untouched = [&] {
        const LazyKdCounts counts = tree.nodes().counts();
        return counts.standing() == 0 && counts.waiting == 1 && counts.references == 0 &&
               counts.waiting_references == 100 && counts.waiting_bytes == 0;
    };
    CHECK(untouched());
    for (const Ray& ray : {Ray{{-9, -9, -9}, {1, 0, 0}}, Ray{{9, 9, 9}, {1, 1, 1}},
                           Ray{{0.5f, 0.5f, -9}, {0, 0, 1}, 0.0f, 1.0f}, Ray{}}) {
        TraversalCounts counts;
        CHECK(!tree.closest_hit(ray, counts));
        CHECK(!tree.any_hit(ray, counts));
        CHECK(counts == TraversalCounts{});
    }
    CHECK(untouched());
}

TEST_CASE("one ray, by hand: the root is cut, and of its halves only the one that the ray enters") {
    // Three triangles at x = 0 .. 1 and three at x = 9 .. 10, cut in the middle, at 5.
    std::vector<Triangle> triangles;
    for (const float x : {0.0f, 9.0f})
        for (const float z : {0.0f, 1.0f, 2.0f})
            triangles.push_back({{x, 0, z}, {x + 1, 0, z}, {x + 1, 1, z}});
    const auto tree =
        LazyKdTree<>::build(triangles, {.rule = Rule::middle, .max_leaf_size = 3, .at_once = 0});
    const auto hit = closest_hit(tree, Ray{{9.75f, 0.25f, -1}, {0, 0, 1}});
    REQUIRE(hit);
    CHECK(hit->triangle == 3);
    using State = LazyKdNodes<3>::State;
    std::vector<std::pair<State, std::size_t>> cells;
    tree.nodes().for_each_cell(
        [&](const auto& cell) { cells.emplace_back(cell.state, cell.references); });
    CHECK(cells == std::vector<std::pair<State, std::size_t>>{
                       {State::inner, 0}, {State::waiting, 3}, {State::leaf, 3}});
    const LazyKdCounts counts = tree.nodes().counts();
    CHECK(counts.inner == 1);
    CHECK(counts.leaves == 1);
    CHECK(counts.waiting == 1);
    CHECK(counts.depth == 1);
    CHECK(counts.references == 3);
    CHECK(counts.waiting_references == 3);
    CHECK(counts.waiting_bytes == 3 * sizeof(KdSplitter<3>::Reference));  // no events: no sweep
}

TEST_CASE("when everything has been entered it is the eager tree: cells, planes, lists in order") {
    for (const TestScene& scene : all_scenes())
        for (const LazyKdTreeConfig& config : all_configs()) {
            CAPTURE(scene.name, int(config.rule), config.clips);
            const auto eager = KdBuilder<3>::build(scene.triangles, config.eager());
            const LazyKdNodes<3> lazy(scene.triangles, config);
            lazy.build_all();
            const SameTree same(eager, lazy);
            CHECK(same.fault() == "");
            CHECK(same.waiting() == 0);
            const LazyKdCounts counts = lazy.counts();
            CHECK(counts.depth == eager.depth);
            CHECK(counts.references == eager.references.size());
            CHECK(counts.waiting_bytes == 0);
        }
}

TEST_CASE("rays that begin in every leaf make the whole eager tree") {
    for (const TestScene& scene : all_scenes()) {
        CAPTURE(scene.name);
        const auto eager = KdBuilder<3>::build(scene.triangles);
        const auto lazy = LazyKdTree<>::build(scene.triangles, {.at_once = 0});
        std::vector<Ray> rays;
        eager.for_each_cell([&](std::uint32_t node, const Aabb& cell, std::size_t) {
            if (eager.node(node).is_leaf())
                rays.push_back({cell.centroid(), {1.0f, 0.5f, 0.25f}, 0.0f, 0.0f});
        });
        for (const Ray& ray : rays) closest_hit(lazy, ray);
        const SameTree same(eager, lazy.nodes());
        CHECK(same.fault() == "");
        CHECK(same.waiting() == 0);
    }
}

TEST_CASE(
    "exactly what rays enter is made, and what has a short list; answers and work are the eager "
    "tree's") {
    std::size_t standing = 0, nodes = 0, rays = 0;
    for (const TestScene& scene : all_scenes())
        for (LazyKdTreeConfig config : all_configs()) {
            CAPTURE(scene.name, int(config.rule), config.clips);
            config.mailboxes = false;  // they know triangles by other numbers in the eager tree
            std::map<std::uint32_t, std::size_t> sizes;
            const auto eager = KdTree<>::build(scene.triangles, config.eager(), Sizes(sizes));
            const auto lazy = LazyKdTree<>::build(scene.triangles, config);
            const auto naive = Naive<FilteredExact>::build(scene.triangles);
            std::set<std::uint32_t> visited;
            for (const Ray& ray : some_rays(scene.triangles, 4)) {
                TraversalCounts eager_counts, lazy_counts;
                const auto expected = eager.closest_hit(ray, eager_counts);
                REQUIRE(lazy.closest_hit(ray, lazy_counts) == expected);
                REQUIRE(lazy_counts == eager_counts);
                REQUIRE(closest_hit(naive, ray) == expected);
                REQUIRE(any_hit(lazy, ray) == expected.has_value());
                // The same search once more, watched.
                double limit = infinity;
                NoCounts none;
                walk_cells(
                    eager.nodes(), ray, none,
                    [&](std::uint32_t node) {
                        for (const std::uint32_t i : eager.nodes().own(node))
                            if (const auto hit = FilteredExact::intersect(ray, scene.triangles[i]))
                                limit = std::min(limit, double{std::nextafter(hit->t, infinity)});
                        return limit;
                    },
                    Visited{visited});
                ++rays;
            }
            const SameTree same(eager.nodes(), lazy.nodes());
            CHECK(same.fault() == "");
            const std::set stands(same.standing().begin(), same.standing().end());
            CHECK(stands == expected_to_stand(eager.nodes(), visited, sizes, config.at_once));
            if (config.at_once == 0) CHECK(stands == visited);
            standing += same.standing().size();
            nodes += *eager.shape().nodes;
        }
    fmt::print("  {} rays made {} of {} nodes\n", rays, standing, nodes);
    CHECK(standing < nodes);
}

TEST_CASE("with mailboxes the same nodes are visited, and the answers are the same") {
    const auto triangles = scenes::soup(sized(2'000u, 300u), 0.3f, 5);
    const auto eager = KdTree<>::build(triangles);
    const auto lazy = LazyKdTree<>::build(triangles);
    for (const Ray& ray : some_rays(triangles, 100)) {
        TraversalCounts eager_counts, lazy_counts;
        REQUIRE(lazy.closest_hit(ray, lazy_counts) == eager.closest_hit(ray, eager_counts));
        REQUIRE(lazy_counts.nodes_visited == eager_counts.nodes_visited);
    }
}

TEST_CASE("lists are given back as nodes stand") {
    const auto triangles = scenes::soup(sized(3'000u, 500u), 0.05f, 6);
    const LazyKdNodes<3> lazy(triangles, {});
    const auto node = lazy.node(0);
    REQUIRE(!node.is_leaf());
    const LazyKdCounts first = lazy.counts();
    CHECK(first.waiting == 2);
    CHECK(first.waiting_references >= triangles.size());
    // A reference with its six events, but what the lists have to spare.
    const std::size_t one = sizeof(KdSplitter<3>::Reference) + 6 * sizeof(SplitEvent);
    CHECK(first.waiting_bytes >= one * first.waiting_references);
    CHECK(first.waiting_bytes <= one * (first.waiting_references + 100));
    lazy.build_all();
    const LazyKdCounts last = lazy.counts();
    CHECK(last.waiting == 0);
    CHECK(last.waiting_bytes == 0);
    CHECK(last.bytes == sizeof lazy + last.standing() * sizeof(KdNode) +
                            last.references * (sizeof(std::uint32_t) + sizeof(Triangle)));
    fmt::print("  {} bytes with the root alone, {} in the end\n", first.bytes, last.bytes);
}

TEST_CASE("what stands holds no list: a few allocations, however many nodes; in the end none") {
    const auto triangles = scenes::soup(sized(3'000u, 500u), 0.05f, 6);
    const std::ptrdiff_t before = test::living_allocations;
    const auto living = [&] { return test::living_allocations - before; };
    for (const std::size_t at_once : {0, 64}) {
        {
            const auto lazy = LazyKdTree<>::build(triangles, {.at_once = at_once});
            const std::ptrdiff_t untouched = living();
            for (const Ray& ray : some_rays(triangles, 2)) closest_hit(lazy, ray);
            const auto waiting = std::ptrdiff_t(lazy.nodes().counts().waiting);
            constexpr std::ptrdiff_t later_chunks = 9;
            CHECK(waiting > 0);
            CHECK(living() <= untouched + 5 * waiting + later_chunks);  // a task has four lists
            lazy.build_all();
            CHECK(living() <= untouched + later_chunks);
            CHECK(lazy.nodes().counts().standing() > sized(2'000u, 200u));
        }
        CHECK(living() == 0);
        // Nor does a tree keep anything that dies young.
        { const auto lazy = LazyKdTree<>::build(triangles, {.at_once = at_once}); }
        CHECK(living() == 0);
    }
}

TEST_CASE("memory that ends at any moment leaves the node as it was, and its share of the limit") {
    const auto triangles = scenes::soup(32, 0.8f, 15);
    const KdSplitter<3> splitter(triangles, {});
    KdBuilder<3> builder(splitter, {});
    NoObserver none;
    const auto eager = builder.run(splitter.root(), none);
    // More than the first chunk has: another is made when the limit has been asked.
    CHECK(eager.references.size() > 2 * triangles.size());
    for (const std::size_t at_once : {0, 10, 32}) {
        CAPTURE(at_once);
        const LazyKdNodes<3> lazy(triangles,
                                  {.max_references = builder.references(), .at_once = at_once});
        int failures = 0;
        bool is_refused = false;
        for (bool is_done = false; !is_done; failures += sized(1, 7)) {
            test::allocations_left = failures;
            try {
                lazy.build_all();
                is_done = true;
            } catch (const std::bad_alloc&) {
            } catch (const LimitError&) {
                is_done = is_refused = true;
            }
            test::allocations_left = -1;
        }
        CHECK(failures > 20);
        CHECK_FALSE(is_refused);
        const SameTree same(eager, lazy);
        CHECK(same.fault() == "");
        CHECK(same.waiting() == 0);
    }
}

TEST_CASE(
    "a tree that was never built, or has been moved from, is not hit and has nothing to make") {
    const std::vector<Triangle> triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    const Ray ray{{0.25f, 0.25f, 1}, {0, 0, -1}};
    auto built = LazyKdTree<>::build(triangles);
    const LazyKdTree<> moved = std::move(built), never{};
    for (const LazyKdTree<>* tree : {&std::as_const(built), &never}) {
        CHECK(!closest_hit(*tree, ray));
        CHECK(!any_hit(*tree, ray));
        CHECK_NOTHROW(tree->build_all());
        CHECK(tree->shape().nodes.value_or(0) == 0);
        CHECK(tree->shape().references == 0);
    }
    CHECK(closest_hit(moved, ray));
    built = LazyKdTree<>::build(triangles);  // and can be built again
    CHECK(any_hit(built, ray));
}

TEST_CASE("shape is that of the tree as it stands, where what waits is a leaf") {
    const auto triangles = scenes::soup(200, 0.1f, 7);
    const auto tree = LazyKdTree<>::build(triangles);
    const TreeShape before = tree.shape();
    CHECK(before.nodes == 1);
    CHECK(before.leaves == 1);
    CHECK(before.references == 200);
    CHECK(*before.sah_cost == Approx(200.0));
    tree.build_all();
    const TreeShape lazy = tree.shape(), eager = KdTree<>::build(triangles).shape();
    CHECK(lazy.nodes == eager.nodes);
    CHECK(lazy.leaves == eager.leaves);
    CHECK(lazy.depth == eager.depth);
    CHECK(lazy.references == eager.references);
    CHECK(lazy.sah_cost == eager.sah_cost);
}

}  // namespace space
