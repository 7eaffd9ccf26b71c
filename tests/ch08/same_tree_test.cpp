// Parallel builds give the sequential builder's tree: the same nodes at the same places.
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "common/limit_error.hpp"
#include "common/pcg32.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch05/watchdog.hpp"
#include "tests/ch08/parallel_builders.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace space {
namespace {

constexpr unsigned thread_counts[] = {0, 1, 2, 3, 16};

/// Compares all builders' trees with the sequential one's.
void check_trees(const TestScene& scene, const BinnedBuilder::Config& config = {}) {
    const BvhNodes<3> expected = BinnedBuilder::build<3>(scene.triangles, config);
    for (const ParallelBuilder& builder : parallel_builders())
        for (const unsigned threads : thread_counts) {
            Watcher watcher;
            const BvhNodes<3> tree = builder.build(scene.triangles, config, threads, watcher);
            const std::string fault = difference(tree, expected);
            INFO(scene.name << ", " << builder.name << ", " << threads << " threads: " << fault);
            CHECK(fault.empty());
        }
}

/// Triangles whose sizes and places grow by powers of two: each cut parts one from the rest.
std::vector<Triangle> chain(int length) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < length; ++i) {
        const float at = std::ldexp(1.0f, i - 60);
        triangles.push_back({{at, 0.0f, 0.0f}, {at, at, 0.0f}, {at, 0.0f, at}});
    }
    return triangles;
}

std::vector<TestScene> few() {
    const std::vector<Triangle> some = scenes::soup(5, 0.3f, 1);
    std::vector<TestScene> all{{"none", {}}};
    for (std::size_t i = 1; i <= some.size(); ++i)
        all.push_back({std::to_string(i), {some.begin(), some.begin() + std::ptrdiff_t(i)}});
    return all;
}

/// Some are left out, at the beginning, at the end and in whole chunks.
std::vector<Triangle> with_numbers_that_are_none() {
    std::vector<Triangle> triangles = scenes::soup(500, 0.1f, 2);
    const float none[] = {std::nanf(""), infinity, -infinity};
    for (std::size_t i = 0; i < triangles.size(); ++i)
        if (i < 3 || i > 495 || i % 5 == 0 || (i > 100 && i < 180)) triangles[i].b.y = none[i % 3];
    return triangles;
}

}  // namespace

TEST_CASE("every method, with any number of threads, makes the sequential tree node for node") {
    const Watchdog watchdog(sized(300, 800));
    SECTION("of few triangles") {
        for (const TestScene& scene : few()) check_trees(scene);
    }
    SECTION("of random triangles") {
        check_trees({"soup", scenes::soup(sized(3000u, 400u), 0.05f, 3)});
    }
    SECTION("of adversarial scenes") {
        for (const TestScene& scene : adversarial_scenes())
            if (!is_sanitized || scene.triangles.size() < 300) check_trees(scene);
    }
    SECTION("where all middles are one point") {
        check_trees({"equal", std::vector<Triangle>(sized(300u, 60u), scenes::soup(1, 1, 4)[0])});
    }
    SECTION("where triangles are left out, for they have a coordinate that is no number") {
        check_trees({"none", with_numbers_that_are_none()});
    }
    SECTION("of a chain") {
        check_trees({"chain", chain(120)});
    }
    SECTION("with other limits") {
        const TestScene scene{"soup", scenes::soup(sized(1000u, 200u), 0.1f, 5)};
        check_trees(scene, {.costs = {0.0, 1.0}, .max_leaf_size = 1});
        check_trees(scene, {.max_leaf_size = 3, .max_depth = 3});
        check_trees(scene, {.max_leaf_size = 0, .max_depth = 0});
        check_trees(scene, {.max_leaf_size = 1000, .bins = 2});
    }
}

TEST_CASE("a scene that has large nodes by our own limits gives the sequential tree, too") {
    const Watchdog watchdog(sized(120, 600));
    const auto triangles = scenes::soup(sized(100'000u, 70'000u), 0.01f, 6);
    const BvhNodes<3> expected = BinnedBuilder::build<3>(triangles);
    for (const unsigned threads : {1u, 2u, 5u}) {
        WorkStealingBuilder::Config config;
        config.threads = threads;
        CHECK(difference(WorkStealingBuilder::build<3>(triangles, config), expected) == "");
    }
}

TEST_CASE("sizes larger than any scene are those of the whole scene") {
    const auto triangles = scenes::soup(200, 0.1f, 9);
    const BvhNodes<3> expected = BinnedBuilder::build<3>(triangles);
    for (const std::size_t huge : {std::size_t{1} << 60, ~std::size_t{0}})
        for (const std::size_t large : {std::size_t{0}, huge}) {
            WorkStealingBuilder::Config config;
            config.threads = 3, config.large = large, config.chunk = config.grain = huge;
            CAPTURE(huge, large);
            CHECK(difference(WorkStealingBuilder::build<3>(triangles, config), expected) == "");
        }
}

TEST_CASE(
    "a zero's sign in a box is the only thing that chunks can change, for all threads alike") {
    std::vector<Triangle> triangles = scenes::soup(400, 0.1f, 10);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (Point3* corner : {&triangles[i].a, &triangles[i].b, &triangles[i].c})
            corner->z = i % 3 == 0 ? -0.0f : 0.0f;
    WorkStealingBuilder::Config config;
    config.large = 4, config.chunk = 3, config.grain = 2;
    const BvhNodes<3> one = WorkStealingBuilder::build<3>(triangles, config);
    CHECK(difference(one, BinnedBuilder::build<3>(triangles)) == "");
    config.threads = 5;
    const BvhNodes<3> five = WorkStealingBuilder::build<3>(triangles, config);
    REQUIRE(five.nodes.size() == one.nodes.size());
    const auto is_negative = [](const BvhNode<3>& node) {
        return std::pair(std::signbit(node.box.min.z), std::signbit(node.box.max.z));
    };
    for (std::size_t i = 0; i < one.nodes.size(); ++i)
        REQUIRE((i == 1 || is_negative(five.nodes[i]) == is_negative(one.nodes[i])));
}

TEST_CASE("the same in the plane") {
    Pcg32 random(7);
    std::vector<Segment> segments;
    for (int i = 0; i < 400; ++i) {
        const Point2 a = random_point(random, Aabb2{Point2(0.0f), Point2(1.0f)});
        segments.push_back({a, random_point(random, Aabb2{a, a + Point2(0.1f)})});
    }
    const BvhNodes<2> expected = BinnedBuilder::build<2>(segments);
    WorkStealingBuilder::Config config;
    config.threads = 3, config.large = 100, config.chunk = 16, config.grain = 8;
    const BvhNodes<2> tree = WorkStealingBuilder::build<2>(segments, config);
    CHECK(std::ranges::equal(tree.nodes, expected.nodes));
    CHECK(tree.references == expected.references);
}

TEST_CASE("1024 threads may be asked for, and not one more") {
    const auto triangles = scenes::soup(50, 0.1f, 8);
    const BvhNodes<3> expected = BinnedBuilder::build<3>(triangles);
    for (const ParallelBuilder& builder : parallel_builders()) {
        INFO(builder.name);
        Watcher watcher;
        if (!is_sanitized)
            CHECK(difference(builder.build(triangles, {}, 1024, watcher), expected) == "");
        CHECK_THROWS_AS(builder.build(triangles, {}, 1025, watcher), LimitError);
        CHECK_THROWS_WITH(builder.build(triangles, {}, 4'000'000'000, watcher),
                          "parallel build: more than 1024 threads");
    }
}

}  // namespace space
