// Refitting in one pass, rotations, and trees that follow.
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch09_instancing_and_motion/deforming.hpp"
#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/box_rays.hpp"
#include "tests/ch07/bvh_trees.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace space {
namespace {

const float nan = std::numeric_limits<float>::quiet_NaN();

/// Faults of a tree that rotations have changed: all but the order of its leaves' references.
std::string faults_after_rotations(const BvhNodes<3>& tree, std::span<const Triangle> triangles,
                                   const TreeRules& rules = {.tight = true}) {
    auto faults = tree_faults(tree_nodes(tree), triangles, rules);
    std::uint32_t next = 2;
    unsigned deepest = 0;
    tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        deepest = std::max(deepest, depth);
        if (tree.nodes[index].is_leaf()) return;
        if (tree.nodes[index].first != next) faults.push_back("a pair out of order");
        next += 2;
    });
    if (deepest != tree.depth) faults.push_back("another depth");
    return diagnosis(faults);
}

/// Answers rays as the naive loop does.
template <class Structure>
void check_answers(const Structure& bvh, const std::vector<Triangle>& triangles, int rays) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    BoxRays maker(bvh.nodes(), triangles, 3);
    for (int i = 0; i < rays; ++i) {
        const Ray ray = maker.next().ray;
        const auto expected = closest_hit(naive, ray);
        REQUIRE(closest_hit(bvh, ray) == expected);
        REQUIRE(any_hit(bvh, ray) == expected.has_value());
    }
}

/// Inner nodes' boxes that are not the one around their children's.
std::size_t wrong_boxes(const BvhNodes<3>& tree) {
    std::size_t wrong = 0;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        const BvhNode<3>& node = tree.nodes[index];
        wrong += !node.is_leaf() && node.box != box_of_both(tree, node.first, node.first + 1);
    });
    return wrong;
}

/// The weights of all inner nodes: what rotations make less.
double inner_area(const BvhNodes<3>& tree) {
    double sum = 0.0;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        if (!tree.nodes[index].is_leaf()) sum += tree.nodes[index].box.half_area();
    });
    return sum;
}

std::vector<Triangle> moved_to(double time, const auto& motion, const std::vector<Triangle>& rest) {
    std::vector<Triangle> moved(rest.size());
    move_to(time, motion, rest, moved);
    return moved;
}

/// Calls test(name, motion) for each motion that has no matrices.
template <class Test>
void for_each_motion(const std::vector<Triangle>& rest, const Test& test) {
    const Aabb box = bounds(rest);
    test("wave", Wave{0.2, 0.7});
    test("twist", Twist{box, 1.0});
    test("explosion", Explosion{Double3(box.centroid()), 0.5});
    test("scatter", Scatter{});
}

}  // namespace

TEST_CASE("motion: at time 0 all is at rest, and a wave is back at time 1") {
    const auto rest = scenes::soup(200, 0.1f, 4);
    for_each_motion(rest, [&](const char* name, const auto& motion) {
        INFO(name);
        const auto start = moved_to(0.0, motion, rest), later = moved_to(0.3, motion, rest);
        double farthest = 0.0;
        for (std::size_t i = 0; i < rest.size(); ++i)
            for (int corner = 0; corner < 3; ++corner)
                farthest =
                    std::max(farthest, double{glm::distance(start[i][corner], rest[i][corner])});
        CHECK(farthest <= 1e-7);
        CHECK(later != rest);
        CHECK(moved_to(0.3, motion, rest) == later);
    });
    std::vector<Triangle> by_four(rest.size());
    move_to(0.3, Scatter{}, rest, by_four, 4);
    CHECK(by_four == moved_to(0.3, Scatter{}, rest));
}

TEST_CASE("motion: by hand") {
    // A quarter of a period, where the wave along x is highest, and where it is not at all.
    const Wave wave{0.5, 4.0};
    CHECK(wave({1, 2, 3}, 0, 0.25) == Point3(1, 2.5f, 3));
    CHECK(wave({0, 2, 3}, 0, 0.25) == Point3(0, 2, 3));
    // One turn over the height: half way up, half a turn; a quarter of the time, a quarter of it.
    const Twist twist{{{-1, 0, -1}, {1, 2, 1}}, 1.0};
    const Point3 half = twist({1, 1, 0}, 0, 1.0), foot = twist({1, 0, 0}, 0, 1.0);
    CHECK(double{glm::distance(half, Point3(-1, 1, 0))} < 1e-6);
    CHECK(foot == Point3(1, 0, 0));
    CHECK(double{glm::distance(twist({1, 2, 0}, 0, 0.25), Point3(0, 2, -1))} < 1e-6);
    // A triangle keeps its shape.
    const Triangle small{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    std::vector<Triangle> moved(1);
    move_to(0.5, Scatter{}, std::vector{small}, moved);
    CHECK(double{glm::distance(moved[0].b - moved[0].a, Vector3(1, 0, 0))} < 1e-6);
    CHECK(moved[0].a != small.a);
}

TEST_CASE("refit in one pass: chapter 7's boxes, bit for bit, whatever builder and motion") {
    const auto rest = scenes::soup(400, 0.1f, 5);
    for_each_builder([&](const char* name, const auto& build, std::size_t leaf_size) {
        INFO(name);
        const BvhNodes<3> built = build(rest);
        for_each_motion(rest, [&](const char* motion_name, const auto& motion) {
            INFO(motion_name);
            const auto moved = moved_to(0.4, motion, rest);
            BvhNodes<3> expected = built, tree = built;
            refit<3>(expected, moved);
            refit_upwards(
                tree,
                [&](const BvhNode<3>& leaf) {
                    Aabb box;
                    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
                        box.extend(box_if_finite<3>(moved[tree.references[i]]));
                    return box;
                },
                [](std::uint32_t) {});
            CHECK(tree.nodes == expected.nodes);
            CHECK(faults_of(tree, moved, leaf_size) == "");
        });
    });
}

TEST_CASE("refit by hand: four triangles, two leaves") {
    // At x = 0, 1, 10, 11; the first pair goes up, the last triangle to the right.
    const auto at = [](float x, float y) {
        return Triangle{{x, y, 0}, {x + 0.5f, y, 0}, {x, y + 0.5f, 1}};
    };
    const std::vector<Triangle> rest{at(0, 0), at(1, 0), at(10, 0), at(11, 0)},
        moved{at(0, 5), at(1, 5), at(10, 0), at(20, 0)};
    auto bvh = RefittedBvh<>::build(rest, {.max_leaf_size = 2});
    REQUIRE(bvh.nodes().size() == 3);
    CHECK(bvh.nodes().nodes[0].box == Aabb{{0, 0, 0}, {11.5f, 0.5f, 1}});
    bvh.refit(moved);
    CHECK(bvh.nodes().nodes[0].box == Aabb{{0, 0, 0}, {20.5f, 5.5f, 1}});
    CHECK(bvh.nodes().nodes[2].box == Aabb{{0, 5, 0}, {1.5f, 5.5f, 1}});
    CHECK(bvh.nodes().nodes[3].box == Aabb{{10, 0, 0}, {20.5f, 0.5f, 1}});
    bvh.refit(rest);  // boxes shrink
    CHECK(bvh.nodes().nodes == RefittedBvh<>::build(rest, {.max_leaf_size = 2}).nodes().nodes);
}

TEST_CASE("refit: nothing, and one triangle") {
    const std::vector<Triangle> none;
    auto empty = RefittedBvh<>::build(none);
    empty.refit(none);
    CHECK(empty.refit_and_rotate(none) == 0);
    CHECK(!closest_hit(empty, {.origin = {0, 0, -1}, .direction = {0, 0, 1}}));
    std::vector<Triangle> one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
    auto bvh = RefittedBvh<>::build(one);
    for (Point3* corner : {&one[0].a, &one[0].b, &one[0].c}) *corner += Vector3(7, 0, 0);
    bvh.refit(one);
    CHECK(bvh.refit_and_rotate(one) == 0);
    CHECK(closest_hit(bvh, {.origin = {7.2f, 0.2f, -1}, .direction = {0, 0, 1}}).has_value());
    CHECK(!closest_hit(bvh, {.origin = {0.2f, 0.2f, -1}, .direction = {0, 0, 1}}));
}

TEST_CASE("refit: the naive loop's answers on every frame, by all ways to follow") {
    const auto rest = scenes::soup(sized(600, 120), 0.1f, 6);
    for_each_motion(rest, [&](const char* name, const auto& motion) {
        INFO(name);
        auto refitted = RefittedBvh<>::build(rest), rotated = refitted;
        auto singly = RefittedBvh<>::build(rest, {.costs = {0.0, 1.0}, .max_leaf_size = 1});
        for (int frame = 1; frame <= 8; ++frame) {
            CAPTURE(frame);
            const auto moved = moved_to(frame / 8.0, motion, rest);
            refitted.refit(moved);
            rotated.refit_and_rotate(moved);
            singly.refit_and_rotate(moved);
            CHECK(faults_of(refitted.nodes(), moved, 8) == "");
            CHECK(faults_after_rotations(rotated.nodes(), moved) == "");
            CHECK(faults_after_rotations(singly.nodes(), moved) == "");
            check_answers(refitted, moved, sized(400, 40));
            check_answers(rotated, moved, sized(400, 40));
            check_answers(singly, moved, sized(400, 40));
        }
    });
}

TEST_CASE("V5: the farther triangles move, the dearer are rays; the answers stay") {
    // Published for another tree: 20,000 triangles moved by random vectors of these lengths.
    constexpr std::array<std::pair<double, double>, 5> published{
        {{0.01, 1.07}, {0.05, 2.03}, {0.1, 4.17}, {0.3, 19.0}, {1.0, 70.0}}};
    const auto rest = make_scene("soup:20000").mesh.triangles();
    const auto built = RefittedBvh<>::build(rest);
    for (const auto& [length, factor] : published) {
        CAPTURE(length);
        const auto moved = moved_to(length, Scatter{}, rest);
        auto bvh = built;
        bvh.refit(moved);
        const auto anew = RefittedBvh<>::build(moved);
        TraversalCounts old_counts, new_counts;
        for (const Ray& ray : rays_from_around(moved, sized(4'000, 200), 7))
            REQUIRE(bvh.closest_hit(ray, old_counts) == anew.closest_hit(ray, new_counts));
        const double ratio = double(old_counts.nodes_visited) / double(new_counts.nodes_visited);
        CHECK(ratio > 0.75 * factor);
        CHECK(ratio < 1.25 * factor);
    }
}

TEST_CASE("V6: children before their parents have no place in a pass from the last to the first") {
    const auto rest = scenes::soup(2'000, 0.05f, 8);
    BvhNodes<3> tree = BinnedBuilder::build<3>(rest);
    const auto leaf_box_in = [](const BvhNodes<3>& of, const std::vector<Triangle>& triangles) {
        return [&](const BvhNode<3>& leaf) {
            Aabb box;
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
                box.extend(box_if_finite<3>(triangles[of.references[i]]));
            return box;
        };
    };
    const auto moved = moved_to(0.2, Scatter{}, rest), later = moved_to(0.4, Scatter{}, rest);
    std::size_t rotations = 0;
    refit_upwards(tree, leaf_box_in(tree, moved),
                  [&](std::uint32_t node) { rotations += rotate_below(tree, node); });
    CHECK(rotations > 50);
    CHECK(wrong_boxes(tree) == 0);  // within the pass all is well
    std::size_t before_parents = 0;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        before_parents += !tree.nodes[index].is_leaf() && tree.nodes[index].first < index;
    });
    CHECK(before_parents > 10);

    BvhNodes<3> as_it_is = tree;
    refit_upwards(as_it_is, leaf_box_in(as_it_is, later), [](std::uint32_t) {});
    CHECK(wrong_boxes(as_it_is) > 10);

    put_parents_first(tree);
    CHECK(faults_after_rotations(tree, moved) == "");
    refit_upwards(tree, leaf_box_in(tree, later), [](std::uint32_t) {});
    CHECK(wrong_boxes(tree) == 0);
    CHECK(faults_after_rotations(tree, later) == "");
}

TEST_CASE("refit: what is no longer finite is in no box, and back when it is") {
    const auto rest = scenes::soup(300, 0.2f, 9);
    for (const float odd : {nan, infinity}) {
        auto bvh = RefittedBvh<>::build(rest), rotated = bvh;
        auto broken = rest;
        broken[17].b.y = odd;
        broken[250].a.x = -odd;
        bvh.refit(broken);
        rotated.refit_and_rotate(broken);
        CHECK(is_finite<3>(bvh.nodes().nodes[0].box.max));
        check_answers(bvh, broken, 500);
        check_answers(rotated, broken, 500);
        bvh.refit(rest);
        rotated.refit_and_rotate(rest);
        check_answers(bvh, rest, 500);
        check_answers(rotated, rest, 500);
    }
}

TEST_CASE("refit: what was not finite when the tree was built is found when it is") {
    const auto rest = scenes::soup(300, 0.2f, 10);
    auto broken = rest;
    for (const std::size_t i : {0u, 17u, 299u}) broken[i].c.z = nan;
    auto bvh = RefittedBvh<>::build(broken), rotated = bvh;
    CHECK(bvh.nodes().references.size() == 297);
    bvh.refit(broken);
    check_answers(bvh, broken, 200);
    broken[17] = rest[17];
    bvh.refit(broken);
    rotated.refit_and_rotate(broken);
    CHECK(bvh.nodes().references.size() == 298);
    for (const std::uint32_t i : {17u}) {
        const Point3 middle = (rest[i].a + rest[i].b + rest[i].c) / 3.0f;
        const Vector3 way(normal(rest[i]));
        const Ray ray{.origin = middle - way, .direction = way};
        CHECK(closest_hit(bvh, ray) == closest_hit(Naive<>::build(broken), ray));
    }
    check_answers(bvh, broken, 500);
    check_answers(rotated, broken, 500);
    // From then on it is refitted again.
    const auto far = moved_to(0.5, Scatter{}, broken);
    bvh.refit(far);
    CHECK(bvh.nodes().references != RefittedBvh<>::build(far).nodes().references);
    check_answers(bvh, far, 200);
    // All of them gone, and all of them back.
    auto none = rest;
    for (Triangle& t : none) t.a.x = nan;
    auto from_none = RefittedBvh<>::build(none);
    CHECK(from_none.nodes().empty());
    from_none.refit(rest);
    check_answers(from_none, rest, 500);
    from_none.refit(none);
    check_answers(from_none, none, 50);
}

TEST_CASE("refit: whatever is done in whatever order, the naive loop's answers") {
    Pcg32 random(14);
    for (int film = 0; film < sized(20, 4); ++film) {
        const auto rest = scenes::soup(1 + random.below(120), 0.3f, 20 + std::uint64_t(film));
        auto now = rest;
        auto bvh = RefittedBvh<>::build(now, {.max_leaf_size = 1 + random.below(6)});
        for (int frame = 0; frame < 12; ++frame) {
            CAPTURE(film, frame);
            const Scatter scatter{random.below(4)};
            const auto towards = moved_to(random.uniform(), scatter, rest);
            for (std::size_t i = 0; i < now.size(); ++i) {
                const std::uint32_t change = random.below(12);
                if (change < 6) now[i] = towards[i];
                if (change == 6) now[i].b.y = nan;
                if (change == 7) now[i] = now[random.below(std::uint32_t(now.size()))];
            }
            switch (random.below(5)) {
                case 0:
                    bvh.rebuild(now);
                    break;
                case 1:
                case 2:
                    bvh.refit(now);
                    break;
                default:
                    bvh.refit_and_rotate(now);
            }
            REQUIRE(wrong_boxes(bvh.nodes()) == 0);
            check_answers(bvh, now, sized(60, 15));
        }
    }
}

// --- rotations ---

namespace {

/// Four leaves, each of one flat triangle with this box, under two inner nodes.
struct FourLeaves {
    std::vector<Triangle> triangles;
    BvhNodes<3> tree;

    explicit FourLeaves(const std::array<Aabb, 4>& boxes) {
        tree.nodes.resize(8);
        tree.references = {0, 1, 2, 3};
        tree.depth = 2;
        for (std::uint32_t i = 0; i < 4; ++i) tree.nodes[4 + i] = {boxes[i], i, 1};
        tree.nodes[2] = {box_of_both(tree, 4, 5), 4, 0};
        tree.nodes[3] = {box_of_both(tree, 6, 7), 6, 0};
        tree.nodes[0] = {box_of_both(tree, 2, 3), 2, 0};
    }
};

Aabb cell(float x, float y, float z) {
    return {{x, y, z}, {x + 1, y + 1, z + 1}};
}

}  // namespace

TEST_CASE("rotations by hand: grandchildren that are in each other's place") {
    // Cells in a row at x = 0, 10, 1, 11. Each child is 11 x 1 x 1: half its surface is 23.
    for (const bool crosswise : {false, true}) {
        FourLeaves four({cell(0, 0, 0), cell(10, 0, 0), crosswise ? cell(11, 0, 0) : cell(1, 0, 0),
                         crosswise ? cell(1, 0, 0) : cell(11, 0, 0)});
        const BvhRotation best = best_rotation(four.tree, 0);
        // Two boxes of 2 x 1 x 1 instead: 2 (23 - 5) is saved.
        CHECK(best.saved == 36.0);
        CHECK(best.one == 4u);
        CHECK(best.other == (crosswise ? 6u : 7u));
        CHECK(rotate_below(four.tree, 0));
        CHECK(wrong_boxes(four.tree) == 0);
        CHECK(inner_area(four.tree) - four.tree.nodes[0].box.half_area() == 10.0);
        CHECK(!rotate_below(four.tree, 0));
    }
}

TEST_CASE("rotations by hand: a child goes below its sibling, on either side") {
    // The odd one out is far away, paired with one of three neighbours in a row.
    for (std::uint32_t odd = 0; odd < 4; ++odd) {
        CAPTURE(odd);
        std::array<Aabb, 4> boxes;
        float x = 0;
        for (std::uint32_t i = 0; i < 4; ++i)
            boxes[i] = i == odd ? cell(100, 0, 0) : cell(x++, 0, 0);
        FourLeaves four(boxes);
        const BvhRotation best = best_rotation(four.tree, 0);
        // The node of the far one, 101 - its neighbour's x long, becomes a leaf; the other two,
        // with the neighbour, are in a box of 3 x 1 x 1.
        const std::uint32_t pair = odd < 2 ? 2 : 3, sibling = pair ^ 1u;
        CHECK(best.one == sibling);
        CHECK(best.other == 4 + odd);
        rotate_below(four.tree, 0);
        CHECK(wrong_boxes(four.tree) == 0);
        CHECK(four.tree.nodes[sibling].is_leaf());
        CHECK(four.tree.nodes[pair].box.extent() == Vector3(3, 1, 1));
        put_parents_first(four.tree);
        CHECK(four.tree.depth == 3);
    }
}

TEST_CASE(
    "rotations: none where nothing is saved, none of leaves, none where areas are no numbers") {
    FourLeaves good({cell(0, 0, 0), cell(1, 0, 0), cell(10, 0, 0), cell(11, 0, 0)});
    CHECK(!rotate_below(good.tree, 0));
    FourLeaves same({cell(0, 0, 0), cell(0, 0, 0), cell(0, 0, 0), cell(0, 0, 0)});
    CHECK(!rotate_below(same.tree, 0));
    BvhNodes<3> two =
        BinnedBuilder::build<3>(std::vector<Triangle>{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                                      {{9, 0, 0}, {10, 0, 0}, {9, 1, 0}}},
                                {.max_leaf_size = 1});
    REQUIRE(two.size() == 3);
    CHECK(!rotate_below(two, 0));
    const Aabb empty;
    FourLeaves nothing({empty, empty, empty, empty});
    CHECK(!rotate_below(nothing.tree, 0));
    // In a line, where areas are 0, lengths count.
    const auto piece = [](float x) { return Aabb{{x, 0, 0}, {x + 1, 0, 0}}; };
    FourLeaves line({piece(0), piece(10), piece(1), piece(11)});
    CHECK(best_rotation(line.tree, 0).saved == 18.0);
}

TEST_CASE("rotations: all of a pass's lower the sum of inner areas, and a tree at rest settles") {
    auto triangles = scenes::soup(3'000, 0.05f, 11);
    auto bvh = RefittedBvh<MedianBuilder>::build(triangles, {.max_leaf_size = 1});
    double area = inner_area(bvh.nodes());
    std::size_t total = 0, last = 1;
    for (int pass = 0; pass < 40 && last > 0; ++pass) {
        last = bvh.refit_and_rotate(triangles);
        const double now = inner_area(bvh.nodes());
        CHECK((last == 0 ? now == area : now < area));
        area = now;
        total += last;
    }
    CHECK(total > 300);
    CHECK(last == 0);
    CHECK(faults_after_rotations(bvh.nodes(), triangles) == "");
    check_answers(bvh, triangles, sized(500, 50));
}

TEST_CASE("rotations: a tree that has become too deep is built anew") {
    const auto rest = scenes::soup(500, 0.05f, 12);
    auto bvh = RefittedBvh<>::build(rest);
    const auto moved = moved_to(0.3, Scatter{}, rest);
    const auto anew = RefittedBvh<>::build(moved);
    bvh.refit_and_rotate(moved, 3);
    CHECK(bvh.nodes().nodes == anew.nodes().nodes);
    check_answers(bvh, moved, 200);
}

TEST_CASE("rotations: of references that are in several leaves none is lost") {
    const auto rest = scenes::soup(500, 0.3f, 13);
    auto bvh = RefittedBvh<SpatialSplitBuilder>::build(rest, {.costs = {0.0, 1.0},
                                                              .max_leaf_size = 1,
                                                              .min_overlap = 0.0,
                                                              .max_growth = 2.0,
                                                              .unsplits = false});
    CHECK(bvh.nodes().references.size() > rest.size());
    const auto moved = moved_to(0.2, Scatter{}, rest);
    bvh.refit_and_rotate(moved);
    CHECK(faults_after_rotations(bvh.nodes(), moved, {.tight = true, .once = false}) == "");
    check_answers(bvh, moved, sized(500, 50));
}

}  // namespace space
