// Searches in an orthtree of points: by hand, against a loop in rational numbers, and against
// chapter 4's tree.
#include "chapters/ch06_quadtrees_and_octrees/orthtree_search.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch04/point_sets.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace space {
namespace {

using Indices = std::vector<std::uint32_t>;

template <int D>
std::vector<Neighbour> nearest(const OrthtreePoints<D>& tree, const Point<D>& query,
                               std::size_t k) {
    return k_nearest<D, OrthtreeSearch<D>>(tree, query, k);
}
template <int D>
std::vector<Neighbour> around(const OrthtreePoints<D>& tree, const Point<D>& query, float radius) {
    std::vector<Neighbour> found;
    within_radius<D, OrthtreeSearch<D>>(tree, query, radius, found);
    return found;
}
template <int D>
Indices in_box(const OrthtreePoints<D>& tree, const BasicAabb<D>& box) {
    Indices found;
    points_in_box<D>(tree, box, found);
    return found;
}
Indices indices_of(const std::vector<Neighbour>& neighbours) {
    Indices indices;
    for (const Neighbour& neighbour : neighbours) indices.push_back(neighbour.index);
    return indices;
}

/// Twenty points on the x axis, at 0, 1, 2 ... 19.
std::vector<Point2> steps() {
    std::vector<Point2> points;
    for (int i = 0; i < 20; ++i) points.emplace_back(float(i), 0.0f);
    return points;
}

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("answers are as reckoned by hand, ties by index, and balls and boxes closed") {
    const auto tree = OrthtreePoints<2>::build(
        std::vector<Point2>{{5, 0}, {3, 4}, {-4, 3}, {0, -5}, {1, 0}}, {.leaf_size = 1});
    CHECK(nearest<2>(tree, {0, 0}, 5) ==
          std::vector<Neighbour>{{4, 1.0}, {0, 25.0}, {1, 25.0}, {2, 25.0}, {3, 25.0}});
    CHECK(indices_of(nearest<2>(tree, {0, 0}, 3)) == Indices{4, 0, 1});
    CHECK(indices_of(around<2>(tree, {0, 0}, 5.0f)) == Indices{4, 0, 1, 2, 3});
    CHECK(indices_of(around<2>(tree, {0, 0}, std::nextafter(5.0f, 0.0f))) == Indices{4});
    CHECK(in_box<2>(tree, {{1, 0}, {5, 4}}) == Indices{0, 1, 4});
    CHECK(in_box<2>(tree, {{5, 0}, {5, 0}}) == Indices{0});
    CHECK(in_box<2>(tree, {Point2(-infinity), Point2(infinity)}) == Indices{0, 1, 2, 3, 4});
}

TEST_CASE("nothing is found in an empty tree, or by a query that is none") {
    const auto tree = OrthtreePoints<2>::build(steps()), empty = OrthtreePoints<2>::build({});
    CHECK(nearest<2>(empty, {0, 0}, 3).empty());
    CHECK(around<2>(empty, {0, 0}, infinity).empty());
    CHECK(in_box<2>(empty, {Point2(-1), Point2(1)}).empty());
    CHECK(nearest<2>(tree, {nan, 0}, 3).empty());
    CHECK(around<2>(tree, {0, infinity}, 3.0f).empty());
    CHECK(around<2>(tree, {0, 0}, -1.0f).empty());
    CHECK(in_box<2>(tree, BasicAabb<2>::empty()).empty());
    CHECK(in_box<2>(tree, {Point2(nan), Point2(nan)}).empty());
    CHECK(nearest<2>(tree, {0, 0}, 0).empty());
    CHECK(nearest<2>(tree, {0, 0}, 1'000).size() == 20);
}

namespace {

/// Bits that only exact numbers hold are in chapter 4's kinds of points.
template <int D>
void compare_with_rationals(const NumberKind& kind, Pcg32& random,
                            const LinearOrthtreeConfig& config) {
    const auto points = drawn_points<D>(random, kind, 1 + random.below(60));
    const auto tree = OrthtreePoints<D>::build(points, config);
    const auto kd = KdPoints<D>::build(points);
    for (int i = 0; i < 6; ++i) {
        const std::uint32_t way = random.below(3), at = random.below(std::uint32_t(points.size()));
        const Point<D> query = way == 0   ? points[at]
                               : way == 1 ? Point<D>(0.0f)
                                          : drawn_point<D>(random, kind);
        const std::size_t k = random.below(70);
        CAPTURE(kind.name, i, k, points.size());
        const auto all = all_by_distance<D>(points, query);
        const auto best = nearest<D>(tree, query, k);
        REQUIRE(best.size() == std::min(k, points.size()));
        for (std::size_t j = 0; j < best.size(); ++j) REQUIRE(best[j].index == all[j].second);
        REQUIRE(best == k_nearest<D>(kd, query, k));

        const Double<D> away = Double<D>(points[at]) - Double<D>(query);
        const auto radius = static_cast<float>(std::min(glm::length(away), 3e38));
        std::vector<Neighbour> by_kd;
        within_radius<D>(kd, query, radius, by_kd);
        REQUIRE(around<D>(tree, query, radius) == by_kd);

        BasicAabb<D> box;
        box.extend(query);
        box.extend(points[at]);
        Indices wanted;
        for (std::uint32_t j = 0; j < points.size(); ++j)
            if (box.contains(points[j])) wanted.push_back(j);
        REQUIRE(in_box<D>(tree, box) == wanted);
    }
}

template <int D>
void compare_all_kinds() {
    Pcg32 random(60 + D);
    for (const NumberKind& kind : number_kinds)
        for (int set = 0; set < sized(60, 6); ++set)
            compare_with_rationals<D>(
                kind, random,
                {.leaf_size = 1 + random.below(8), .max_depth = 31, .skip_chains = set % 2 == 1});
}

}  // namespace

TEST_CASE("the answers are a rational loop's and chapter 4's tree's, on every kind of point") {
    SECTION("in the plane") {
        compare_all_kinds<2>();
    }
    SECTION("in space") {
        compare_all_kinds<3>();
    }
}

// ---- work -------------------------------------------------------------------------------------

namespace {

struct Counter : NoObserver {
    using NoObserver::observe;
    std::size_t leaves = 0, inner = 0, pruned = 0, compared = 0;

    void observe(const OrthtreeSearch<3>::Visited& event) { ++(event.is_leaf ? leaves : inner); }
    void observe(const OrthtreeSearch<3>::Pruned&) { ++pruned; }
    void observe(const OrthtreeSearch<3>::Compared&) { ++compared; }
};

std::vector<Point3> random_points(std::size_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Point3> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(random_point(random, -1.0f, 1.0f));
    return points;
}

}  // namespace

TEST_CASE("the nearest of 100,000 is found with a few leaves") {
    const auto tree = OrthtreePoints<3>::build(random_points(sized(100'000u, 10'000u), 5));
    NearestSearch<3, OrthtreeSearch<3>> search(tree, 1);
    Counter counter;
    for (const Point3& query : random_points(1000, 6)) search(query, counter);
    CHECK(counter.leaves < 5 * 1000);
    CHECK(counter.inner < 12 * 1000);
    CHECK(counter.compared < 5 * 1000);
    CHECK(counter.pruned > 0);
}

TEST_CASE("of cells within the box no point is compared") {
    const auto tree = OrthtreePoints<3>::build(random_points(10'000, 7));
    Counter whole, half;
    Indices found;
    points_in_box<3>(tree, {Point3(-9), Point3(9)}, found, whole);
    CHECK(found.size() == 10'000);
    CHECK(whole.compared == 0);
    CHECK(whole.inner + whole.leaves == 1);
    points_in_box<3>(tree, {Point3(-0.7f), Point3(0.7f)}, found, half);
    CHECK(half.compared > 0);
    CHECK(half.compared < found.size());
}

TEST_CASE("many equal points: all of them are in one leaf, and the first come first") {
    const std::vector<Point3> points(sized(100'000u, 5'000u), Point3(0.1f, 0.2f, 0.3f));
    const auto tree = OrthtreePoints<3>::build(points);
    CHECK(indices_of(nearest<3>(tree, {9, 9, 9}, 3)) == Indices{0, 1, 2});
    CHECK(around<3>(tree, points[0], 0.0f).size() == points.size());
}

}  // namespace space
