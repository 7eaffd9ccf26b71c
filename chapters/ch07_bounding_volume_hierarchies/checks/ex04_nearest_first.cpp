#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "common/pcg32.hpp"
#include "tests/check.hpp"

// The exercise is to do without the chapter's own: the compiler refuses it from here on.
#pragma GCC poison walk_bvh walk_nearest_first walk_all_boxes
#include "ex04_nearest_first.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

using namespace space;

namespace {

/// A tree without boxes: where the ray enters each node, and the nearest hit in each leaf.
struct Scene {
    BvhNodes<3> tree;
    std::vector<float> enter, hit;

    std::uint32_t root(float t) {
        tree.nodes.assign(2, {});
        enter.assign(2, t);
        hit.assign(2, infinity);
        return 0;
    }
    /// Gives the node two children. @return the first
    std::uint32_t children(std::uint32_t node, float first, float second) {
        const auto pair = std::uint32_t(tree.nodes.size());
        tree.nodes[node].first = pair;
        tree.nodes.resize(pair + 2);
        enter.insert(enter.end(), {first, second});
        hit.insert(hit.end(), {infinity, infinity});
        return pair;
    }
    void leaf(std::uint32_t node, float t = infinity) {
        tree.nodes[node].count = 1;
        hit[node] = t;
    }
};

/// What a walk asked for, in order: "?3" is the box of node 3, "!3" the triangles of leaf 3.
struct Walk {
    std::string all, leaves;
    float nearest = infinity;
    bool boxes_twice = false, orphans = false;
    std::uintptr_t lowest = ~std::uintptr_t{0}, highest = 0;  ///< where the processor's stack was
};
Walk walk(const Scene& scene) {
    Walk walk;
    std::size_t questions = 0;
    const auto question = [&](std::uint32_t node) {
        if (node >= scene.enter.size()) FAIL("there is no node " << node);
        if (++questions > 10 * scene.enter.size()) FAIL("a walk without end");
        const auto place = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
        walk.lowest = std::min(walk.lowest, place);
        walk.highest = std::max(walk.highest, place);
    };
    std::vector<int> asked(scene.enter.size());
    std::vector<std::uint32_t> parent(scene.enter.size());
    for (std::uint32_t i = 0; i < scene.tree.nodes.size(); ++i)
        if (i != 1 && !scene.tree.nodes[i].is_leaf())
            for (const std::uint32_t child :
                 {scene.tree.nodes[i].first, scene.tree.nodes[i].first + 1})
                parent[child] = i;
    nearest_first(
        scene.tree,
        [&](std::uint32_t node) {
            question(node);
            walk.boxes_twice = walk.boxes_twice || asked[node]++ > 0;
            walk.orphans = walk.orphans || (node != 0 && asked[parent[node]] == 0);
            walk.all += " ?" + std::to_string(node);
            return scene.enter[node];
        },
        [&](std::uint32_t leaf) {
            question(leaf);
            walk.all += " !" + std::to_string(leaf);
            walk.leaves += " " + std::to_string(leaf);
            walk.nearest = std::min(walk.nearest, scene.hit[leaf]);
            return walk.nearest;
        });
    return walk;
}

/// The same by recursion: where the ray is to go, by the words of the exercise.
void expected(const Scene& scene, std::uint32_t node, Walk& walk) {
    if (!(scene.enter[node] < infinity) || scene.enter[node] > walk.nearest) return;
    if (scene.tree.nodes[node].is_leaf()) {
        walk.leaves += " " + std::to_string(node);
        walk.nearest = std::min(walk.nearest, scene.hit[node]);
        return;
    }
    const std::uint32_t first = scene.tree.nodes[node].first;
    const bool second_is_nearer = scene.enter[first + 1] < scene.enter[first];
    expected(scene, first + second_is_nearer, walk);
    expected(scene, first + !second_is_nearer, walk);
}

/// A leaf at each side of the root.
Scene two_leaves(float enter_first, float hit_first, float enter_second, float hit_second) {
    Scene scene;
    scene.children(scene.root(0), enter_first, enter_second);
    scene.leaf(2, hit_first);
    scene.leaf(3, hit_second);
    return scene;
}

}  // namespace

TEST_CASE("an empty tree has nothing to walk through, and a missed root neither") {
    CHECK(walk({}).all == "");
    Scene scene;
    scene.leaf(scene.root(infinity));
    CHECK(walk(scene).all == " ?0");
}

TEST_CASE("a root that is a leaf is tested") {
    Scene scene;
    scene.leaf(scene.root(2), 3);
    CHECK(walk(scene).all == " ?0 !0");
}

TEST_CASE("the child that the ray enters earlier comes first, whichever it is") {
    CHECK(walk(two_leaves(1, infinity, 2, infinity)).leaves == " 2 3");
    CHECK(walk(two_leaves(2, infinity, 1, infinity)).leaves == " 3 2");
    CHECK(walk(two_leaves(-1, infinity, -2, infinity)).leaves == " 3 2");
}

TEST_CASE("of children that the ray enters at one t the first one comes first") {
    CHECK(walk(two_leaves(1, infinity, 1, infinity)).leaves == " 2 3");
    CHECK(walk(two_leaves(0, 5, 0, 5)).leaves == " 2 3");
}

TEST_CASE("a child that is missed is not visited") {
    CHECK(walk(two_leaves(1, infinity, infinity, infinity)).leaves == " 2");
    CHECK(walk(two_leaves(infinity, infinity, 1, infinity)).leaves == " 3");
    CHECK(walk(two_leaves(infinity, infinity, infinity, infinity)).leaves == "");
}

TEST_CASE("a hit ends what begins beyond it, and nothing that begins before it") {
    CHECK(walk(two_leaves(1, 2, 3, 4)).leaves == " 2");
    CHECK(walk(two_leaves(1, 4, 3, 3.5f)).leaves == " 2 3");
    CHECK(walk(two_leaves(3, 3.5f, 1, 2)).leaves == " 3");
}

TEST_CASE("what begins at the hit is visited: another hit there may have the smaller index") {
    CHECK(walk(two_leaves(1, 3, 3, 3)).leaves == " 2 3");
    CHECK(walk(two_leaves(2, 2, 2, 2)).leaves == " 2 3");
    Scene scene;  // and also where it has not waited since before
    scene.children(scene.root(0), 1, 2);
    scene.leaf(2, 5);
    scene.children(3, 5, 6);
    scene.leaf(4);
    scene.leaf(5);
    CHECK(walk(scene).leaves == " 2 4");
}

TEST_CASE("what waits since before the hit is passed over, and its children are not asked for") {
    Scene scene;
    scene.children(scene.root(0), 1, 4);
    scene.children(3, 4, 5);
    scene.leaf(4, 4.5f);
    scene.leaf(5, 5);
    scene.leaf(2, 3);
    CHECK(walk(scene).all == " ?0 ?2 ?3 !2");
}

TEST_CASE("a last place of t earlier is earlier, and a last place beyond the hit is beyond it") {
    const float after = std::nextafter(3.0f, 4.0f), before = std::nextafter(3.0f, 0.0f);
    CHECK(walk(two_leaves(after, infinity, 3, infinity)).leaves == " 3 2");
    CHECK(walk(two_leaves(3, infinity, before, infinity)).leaves == " 3 2");
    CHECK(walk(two_leaves(1, 3, after, 4)).leaves == " 2");
    CHECK(walk(two_leaves(1, 3, before, 4)).leaves == " 2 3");
}

TEST_CASE("all below the nearer child comes before the farther one, even what begins later") {
    Scene scene;
    scene.children(scene.root(0), 1, 2);
    scene.children(2, 5, 3);
    scene.leaf(3);
    scene.leaf(4);
    scene.leaf(5);
    CHECK(walk(scene).leaves == " 5 4 3");
}

TEST_CASE("a hit that is farther than an earlier one changes nothing") {
    Scene scene;
    scene.children(scene.root(0), 1, 2);
    scene.leaf(2, 3);
    scene.children(3, 2, 4);
    scene.leaf(4, 9);
    scene.leaf(5, 4);
    CHECK(walk(scene).leaves == " 2 4");
}

TEST_CASE(
    "a chain of 1000 levels, the far child a leaf on each: nearest first, and one hit ends it") {
    for (const bool hit_at_end : {false, true}) {
        Scene scene;
        std::uint32_t node = scene.root(0);
        for (int level = 0; level < 1'000; ++level) {
            node = scene.children(node, float(level), float(2'000 - level));
            scene.leaf(node + 1);
        }
        scene.leaf(node, hit_at_end ? 999.5f : infinity);
        const Walk found = walk(scene);
        CHECK(std::ranges::count(found.leaves, ' ') == (hit_at_end ? 1 : 1'001));
        CHECK(std::ranges::count(found.all, '?') == 2'001);
    }
}

TEST_CASE("a chain of 1000 levels needs no recursion") {
    Scene scene;
    std::uint32_t node = scene.root(0);
    for (int level = 0; level < 1'000; ++level) {
        node = scene.children(node, float(level), infinity);
        scene.leaf(node + 1);
    }
    scene.leaf(node);
    const Walk found = walk(scene);
    const bool is_recursive = found.highest - found.lowest > 8'000;  // bytes, for 1000 levels
    CHECK_FALSE(is_recursive);
}

TEST_CASE(
    "random trees: the same leaves in the same order, each box asked for once, by its parent") {
    Pcg32 random(5);
    for (int i = 0; i < sized(20'000, 2'000); ++i) {
        Scene scene;
        scene.root(float(random.below(3)));
        for (std::uint32_t node = 0; node < scene.tree.nodes.size(); ++node) {
            if (node == 1) continue;
            const bool is_leaf = random.below(3) == 0 || scene.tree.nodes.size() > 40;
            const auto later = [&] {
                return random.below(8) == 0 ? infinity : scene.enter[node] + float(random.below(3));
            };
            const float hit = later();
            if (is_leaf) {
                scene.leaf(node, hit);
                continue;
            }
            const float first = later();
            const float second = later();
            scene.children(node, first, second);
        }
        const Walk found = walk(scene);
        Walk wanted;
        expected(scene, 0, wanted);
        CAPTURE(i, found.all);
        REQUIRE(found.leaves == wanted.leaves);
        REQUIRE_FALSE(found.boxes_twice);
        REQUIRE_FALSE(found.orphans);
    }
}
