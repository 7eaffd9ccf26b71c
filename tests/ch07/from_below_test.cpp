// Trees from the leaves up, their layout, reinsertion and refitting.
#include "chapters/ch07_bounding_volume_hierarchies/bottom_up_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_layout.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_walk.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/optimised_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/bvh_trees.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace space {
namespace {

/// Segments along x, from each to one unit on.
std::vector<Segment> units(const std::vector<float>& starts) {
    std::vector<Segment> segments;
    for (const float x : starts) segments.push_back({{x, 0}, {x + 1, 0}});
    return segments;
}

/// What the weights of all inner nodes are in sum.
double inner_weights(const BvhNodes<3>& tree) {
    const HitChance<3> chance(tree.nodes[0].box);
    double sum = 0.0;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        if (!tree.nodes[index].is_leaf()) sum += chance.weight(tree.nodes[index].box);
    });
    return sum;
}

struct Rounds : NoObserver {
    using NoObserver::observe;
    std::vector<unsigned> merged;  ///< by round
    template <int D>
    void observe(const BottomUpBuilder::Merged<D>& event) {
        merged.resize(event.round + 1);
        ++merged[event.round];
    }
};

}  // namespace

TEST_CASE("bottom-up: the nearest first, by hand") {
    // Gaps of 1, 7.5, 0.5: in the first round 0 1 and 2 3, then both.
    Rounds rounds;
    const auto tree =
        BottomUpBuilder::build<2>(units({0, 2, 10.5, 12}), {.max_leaf_size = 1}, rounds);
    CHECK(rounds.merged == std::vector<unsigned>{2, 1});
    CHECK(tree.nodes[2].box == Aabb2{{0, 0}, {3, 0}});
    CHECK(tree.nodes[3].box == Aabb2{{10.5f, 0}, {13, 0}});
    CHECK(tree.depth == 2);
    // Gaps of 9, 3, 1: 2 3, then that and 1, then 0.
    const auto chain = BottomUpBuilder::build<2>(units({0, 10, 14, 16}), {.max_leaf_size = 1});
    CHECK(chain.depth == 3);
    CHECK(chain.references == std::vector<std::uint32_t>{0, 1, 2, 3});
}

TEST_CASE("bottom-up: where all are equally near each round halves them") {
    for (const std::size_t n : {2u, 8u, 9u, 1'000u}) {
        const std::vector<Triangle> copies(n, Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        Rounds rounds;
        const auto tree = BottomUpBuilder::build<3>(copies, {.max_leaf_size = 1}, rounds);
        const auto levels = unsigned(std::bit_width(n - 1));
        CHECK(rounds.merged.size() == levels);
        CHECK(tree.depth == levels);
    }
}

TEST_CASE("bottom-up: each merge is of two that have no nearer one within the radius") {
    struct Watcher : NoObserver {
        using NoObserver::observe;
        std::vector<Aabb> boxes, joined;
        void observe(const BottomUpBuilder::Merged<3>& event) {
            if (event.round > 0) return;
            joined.push_back(event.box);
        }
    } watcher;
    const auto triangles = scenes::soup(200, 0.1f, 8);
    BottomUpBuilder::build<3>(triangles, {.radius = 1'000}, watcher);
    REQUIRE(!watcher.joined.empty());
    const HitChance<3> chance(watcher.joined[0]);
    const auto weight = [&](const Triangle& a, const Triangle& b) {
        Aabb both = bounds(a);
        both.extend(bounds(b));
        return chance.weight(both);
    };
    // By all pairs: those that are each other's nearest.
    std::vector<std::uint32_t> nearest;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        std::uint32_t best = i == 0;
        for (std::uint32_t j = 0; j < triangles.size(); ++j)
            if (j != i &&
                weight(triangles[i], triangles[j]) < weight(triangles[i], triangles[best]))
                best = j;
        nearest.push_back(best);
    }
    std::size_t mutual = 0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        if (nearest[nearest[i]] != i || nearest[i] < i) continue;
        ++mutual;
        Aabb both = bounds(triangles[i]);
        both.extend(bounds(triangles[nearest[i]]));
        CHECK(std::ranges::count(watcher.joined, both) == 1);
    }
    CHECK(watcher.joined.size() == mutual);
}

TEST_CASE("bottom-up: a neighbour is found at the radius, and not beyond it") {
    // In the order of their middles a long one stands between two short ones, side by side.
    const std::vector<Segment> row{{{0, 0}, {1, 0}}, {{-49, 0}, {51, 0}}, {{1, 0}, {2, 0}}};
    const auto order = [&](std::uint32_t radius) {
        return BottomUpBuilder::build<2>(row, {.max_leaf_size = 1, .radius = radius}).references;
    };
    CHECK(order(2) == std::vector<std::uint32_t>{0, 2, 1});
    CHECK(order(1) == std::vector<std::uint32_t>{0, 1, 2});
    CHECK(order(0) == order(1));
}

TEST_CASE("bottom-up: rounds end, also where each would merge one pair") {
    Rounds usual;
    BottomUpBuilder::build<3>(scenes::soup(sized(20'000u, 1'000u), 0.01f, 2), {}, usual);
    CHECK(usual.merged.size() < 60);
    // Each gap half as wide as the one before: only the last two are each other's nearest.
    std::vector<Triangle> chain;
    for (int i = 0; i < 100; ++i) {
        const Point3 p(std::ldexp(1.0f, -i));
        chain.push_back({p, p, p});
    }
    Rounds one_by_one, limited;
    BottomUpBuilder::build<3>(chain, {}, one_by_one);
    BottomUpBuilder::build<3>(chain, {.max_rounds = 5}, limited);
    CHECK(one_by_one.merged.size() > 60);
    CHECK(limited.merged.size() <= 5 + 7);
}

TEST_CASE("layout: leaves are merged where they cost no more, and never beyond their limit") {
    // Four triangles side by side in one plane. Leaves of one: 1 + 2/4 + 2/4 steps and 4 quarters
    // of tests; of two: 1 step and a test in each half of rays, twice: 2 + 1; of four: 4.
    std::vector<Segment> row = units({0, 1, 2, 3});
    const auto ones = MedianBuilder::build<2>(row, {.max_leaf_size = 1});
    REQUIRE(ones.sah_cost({1.0, 1.0}) == Approx(2.0 + 1.0));
    CHECK(BvhLayout<2>::of(ones, {.max_leaf_size = 1}).size() == 7);
    CHECK(BvhLayout<2>::of(ones, {.costs = {0.9, 1.0}}).size() == 7);
    CHECK(BvhLayout<2>::of(ones, {.costs = {1.0, 1.0}}).size() == 3);
    CHECK(BvhLayout<2>::of(ones, {.costs = {2.1, 1.0}}).size() == 1);
    CHECK(BvhLayout<2>::of(ones, {.costs = {2.1, 1.0}, .max_leaf_size = 3}).size() == 3);
}

TEST_CASE("layout: a tree in depth-first order with its leaves as they are stays as it is") {
    const auto triangles = scenes::soup(500, 0.1f, 9);
    const auto tree = MedianBuilder::build<3>(triangles, {.max_leaf_size = 1});
    const auto same = BvhLayout<3>::of(tree, {.max_leaf_size = 1});
    CHECK(same.nodes == tree.nodes);
    CHECK(same.references == tree.references);
    CHECK(same.depth == tree.depth);
}

TEST_CASE("layout: a tree that ends at the limit stays as it is") {
    // A leaf beside a full tree of four.
    BvhNodes<2> tree;
    tree.nodes.resize(10);
    tree.references = {0, 1, 2, 3, 4};
    const std::vector<Segment> row = units({0, 10, 11, 12, 13});
    const std::uint32_t leaves[] = {2, 6, 7, 8, 9};
    for (std::uint32_t i = 0; i < 5; ++i) {
        Aabb2 box{row[i].a, row[i].b};
        tree.nodes[leaves[i]] = {box, i, 1};
    }
    tree.nodes[0].first = 2, tree.nodes[3].first = 4;
    tree.nodes[4].first = 6, tree.nodes[5].first = 8;
    unite_boxes(tree);
    const auto same = BvhLayout<2>::of(tree, {.max_leaf_size = 1, .max_depth = 3});
    CHECK(same.nodes == tree.nodes);
    CHECK(BvhLayout<2>::of(tree, {.max_leaf_size = 1, .max_depth = 2}).depth == 2);
}

TEST_CASE("layout: no leaf is deeper than the limit, where one leaf can't hold them also halves") {
    // A chain: leaf i beside all later ones, which are its second sibling, or its first.
    const auto chain = [](std::uint32_t n, std::size_t rest) {
        BvhNodes<2> tree;
        tree.nodes.resize(2);
        for (std::uint32_t i = 0; i < n; ++i) {
            const BvhNode<2> leaf{{Point2(float(i)), Point2(float(i))}, i, 1};
            tree.references.push_back(i);
            const std::size_t top = i == 0 ? 0 : tree.nodes.size() - 2 + rest;
            if (i + 1 == n) {
                tree.nodes[top] = leaf;
                continue;
            }
            tree.nodes[top].first = std::uint32_t(tree.nodes.size());
            tree.nodes.resize(tree.nodes.size() + 2);
            tree.nodes[tree.nodes.size() - 1 - rest] = leaf;
        }
        unite_boxes(tree);
        return tree;
    };
    const auto tree = chain(1'000, 1), mirrored = chain(1'000, 0);
    CHECK(BvhLayout<2>::of(tree, {.max_leaf_size = 1, .max_depth = 1'000}).depth == 999);
    for (const unsigned depth : {10u, 11u, 20u, 500u, 998u}) {
        const auto laid = BvhLayout<2>::of(tree, {.max_leaf_size = 1, .max_depth = depth});
        CHECK(laid.depth <= depth);
        CHECK(diagnosis(layout_faults(laid)) == "");
        CHECK(laid.references == tree.references);
        const auto other = BvhLayout<2>::of(mirrored, {.max_leaf_size = 1, .max_depth = depth});
        CHECK(other.depth <= depth);
        CHECK(diagnosis(layout_faults(other)) == "");
        CHECK(laid.size() == 2 * 1'000 - 1);
    }
    // Too few levels for leaves of one.
    const auto shallow = BvhLayout<2>::of(tree, {.max_leaf_size = 1, .max_depth = 3});
    CHECK(shallow.depth == 3);
    CHECK(shallow.size() == 15);
    CHECK(BvhLayout<2>::of(tree, {.max_depth = 0}).size() == 1);
    CHECK(BvhLayout<2>::of(BvhNodes<2>{}).empty());
}

TEST_CASE("reinsertion: the best place is the best of all, and saves what it says") {
    const auto triangles = scenes::soup(40, 0.3f, 11);
    const BvhReinsertion<3> start(MedianBuilder::build<3>(triangles, {.max_leaf_size = 1}));
    const auto& nodes = start.tree().nodes;
    const double before = inner_weights(start.tree());
    std::vector<std::uint32_t> parent(nodes.size(), 0);
    for (std::uint32_t i = 0; i < nodes.size(); ++i)
        if (i != 1 && !nodes[i].is_leaf()) parent[nodes[i].first] = parent[nodes[i].first + 1] = i;
    int improved = 0;
    for (std::uint32_t moved = 2; moved < nodes.size(); ++moved) {
        double most = 0.0;
        for (std::uint32_t place = 0; place < nodes.size(); ++place) {
            bool is_below = place == 1 || place == parent[moved] || place == (moved ^ 1u);
            for (std::uint32_t i = place; i > 1; i = parent[i]) is_below = is_below || i == moved;
            if (is_below) continue;
            auto other = start;
            other.move(moved, place);
            REQUIRE(other.tree().nodes[0].box == nodes[0].box);
            most = std::max(most, before - inner_weights(other.tree()));
        }
        auto search = start;
        CHECK(search.best_place(moved).saved == Approx(most).margin(1e-12 * before));
        improved += most > 1e-9 * before;
    }
    CHECK(improved > 10);
}

TEST_CASE("reinsertion: each move saves what it says, and the tree never gets worse") {
    struct Watcher : NoObserver {
        using NoObserver::observe;
        double weights;
        int moves = 0;
        void observe(const BvhReinsertion<3>::Moved& event) {
            const double now = inner_weights(event.tree);
            CHECK(weights - now == Approx(event.saved).margin(1e-12 * now));
            REQUIRE(event.tree.nodes[event.place].first + 1 == event.node);
            weights = now;
            ++moves;
        }
    };
    for (const auto& triangles : {scenes::soup(300, 0.3f, 12), scenes::ball(3)}) {
        const auto tree =
            BinnedBuilder::build<3>(triangles, {.costs = {0.0, 1.0}, .max_leaf_size = 1});
        Watcher watcher;
        watcher.weights = inner_weights(tree);
        const OptimisedBuilder::Config config{.max_leaf_size = 1, .min_gain = 0.0, .max_rounds = 4};
        const auto better = OptimisedBuilder::improved(tree, config, watcher);
        CHECK(watcher.moves > 10);
        CHECK(better.sah_cost({}) < tree.sah_cost({}));
        CHECK(faults_of(better, triangles, 1) == "");
    }
}

TEST_CASE("reinsertion: a triangle as large as the scene gets a place beside the root's others") {
    auto triangles = scenes::soup(200, 0.02f, 13);
    triangles.push_back({{-1, -1, -1}, {2, 2, 2}, {2, -1, 2}});
    const auto tree = OptimisedBuilder::build<3>(triangles, {.max_leaf_size = 1});
    bool is_at_root = false;
    for (const std::uint32_t child : {tree.nodes[0].first, tree.nodes[0].first + 1})
        is_at_root = is_at_root || (tree.nodes[child].count == 1 && tree.own(child)[0] == 200);
    CHECK(is_at_root);
}

TEST_CASE("reinsertion ends when a round gains too little, or after the last round") {
    const auto triangles = scenes::soup(1'000, 0.1f, 14);
    const auto cost = [&](double min_gain, unsigned rounds) {
        return OptimisedBuilder::build<3>(
                   triangles, {.max_leaf_size = 1, .min_gain = min_gain, .max_rounds = rounds})
            .sah_cost({});
    };
    CHECK(cost(0.0, 1) < cost(0.0, 0));
    CHECK(cost(0.0, 4) <= cost(0.0, 1));
    CHECK(cost(0.9, 8) == cost(0.0, 1));
}

TEST_CASE("refit: where nothing has moved nothing changes, and what has moved is held") {
    auto triangles = scenes::soup(500, 0.1f, 15);
    for (auto tree : {BinnedBuilder::build<3>(triangles), BottomUpBuilder::build<3>(triangles)}) {
        const auto before = tree.nodes;
        refit<3>(tree, triangles);
        CHECK(tree.nodes == before);
        auto moved = scenes::mapped(triangles, [](const Point3& p) {
            return Point3(p.x + p.y * p.y, p.y * 3.0f, p.z - p.x);
        });
        refit<3>(tree, moved);
        CHECK(faults_of(tree, moved, 8) == "");
        // One that is no longer finite is in no box.
        moved[17].b.y = std::nanf("");
        refit<3>(tree, moved);
        tree.for_each_node([&](std::uint32_t index, unsigned) {
            const Aabb& box = tree.nodes[index].box;
            CHECK((box.is_empty() || (is_finite<3>(box.min) && is_finite<3>(box.max))));
        });
    }
}

TEST_CASE("refit: what is no longer finite is in no box, and costs nothing") {
    auto triangles = scenes::soup(50, 0.1f, 12);
    auto tree = MedianBuilder::build<3>(triangles, {.max_leaf_size = 1});
    const double before = tree.sah_cost({});
    triangles[7].b.y = std::nanf("");
    refit<3>(tree, triangles);
    CHECK(tree.sah_cost({}) < before);
    CHECK(tree.sah_cost({}) > 0.5 * before);
    for (Triangle& t : triangles) t.a.x = infinity;
    refit<3>(tree, triangles);
    CHECK(tree.sah_cost({}) == 0.0);
    std::size_t leaves = 0;
    NoCounts none;
    for (const Vector3& way : {Vector3(1, 0.5f, 0.25f), Vector3(-1, 0, 0), Vector3(0, -0.0f, 1)})
        walk_bvh(tree, Ray{.origin = Point3(0.5f), .direction = way}, none,
                 [&](const BvhNode<3>&) { return ++leaves, double{infinity}; });
    CHECK(leaves == 0);
}

}  // namespace space
