// A k-d tree of points: its shape, answers that can be reckoned by hand, and queries at the edges.
#include "chapters/ch04_kd_trees/point_search.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <bit>
#include <stdexcept>

namespace space {
namespace {

using Indices = std::vector<std::uint32_t>;

Indices indices_of(std::span<const Neighbour> neighbours) {
    Indices indices;
    for (const Neighbour& neighbour : neighbours) indices.push_back(neighbour.index);
    return indices;
}
template <int D>
Indices nearest(const std::vector<Point<D>>& points, const Point<D>& query, std::size_t k) {
    return indices_of(k_nearest<D>(KdPoints<D>::build(points), query, k));
}
template <int D>
Indices around(const std::vector<Point<D>>& points, const Point<D>& query, float radius) {
    std::vector<Neighbour> found;
    within_radius<D>(KdPoints<D>::build(points), query, radius, found);
    return indices_of(found);
}
template <int D>
Indices in_box(const std::vector<Point<D>>& points, const BasicAabb<D>& box) {
    Indices found;
    within_box<D>(KdPoints<D>::build(points), box, found);
    return found;
}

std::vector<Point3> random_points(std::size_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Point3> points;
    for (std::size_t i = 0; i < count; ++i) points.push_back(random_point(random, -1.0f, 1.0f));
    return points;
}
/// Twenty points on the x axis, at 0, 1, 2 ... 19.
const std::vector<Point2> steps = [] {
    std::vector<Point2> points;
    for (int i = 0; i < 20; ++i) points.emplace_back(float(i), 0.0f);
    return points;
}();

/// Counts the events of a search.
struct Counter : NoObserver {
    std::size_t buckets = 0, subtrees = 0, pruned = 0, compared = 0;

    using NoObserver::observe;
    void observe(const PointSearch<3>::Visited& visited) {
        ++(visited.subtree.is_bucket() ? buckets : subtrees);
    }
    void observe(const PointSearch<3>::Pruned&) { ++pruned; }
    void observe(const PointSearch<3>::Compared&) { ++compared; }
};

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("the nearest of 3-4-5 triangles and their like are as reckoned by hand") {
    const std::vector<Point2> points{{3, 4}, {6, 8}, {0, 1}, {-5, 12}, {8, 15}};
    const auto best = k_nearest<2>(KdPoints<2>::build(points), {0, 0}, 5);
    CHECK(best == std::vector<Neighbour>{{2, 1.0}, {0, 25.0}, {1, 100.0}, {3, 169.0}, {4, 289.0}});
    CHECK(nearest<2>(steps, {7.25f, 3.0f}, 4) == Indices{7, 8, 6, 9});
    CHECK(nearest<3>({{1, 2, 2}, {2, 3, 6}, {1, 4, 8}}, {0, 0, 0}, 2) == Indices{0, 1});
}

TEST_CASE("of equally near points the lower index comes first") {
    const std::vector<Point2> points{{5, 0}, {3, 4}, {-4, 3}, {0, -5}, {1, 0}};
    CHECK(nearest<2>(points, {0, 0}, 5) == Indices{4, 0, 1, 2, 3});
    CHECK(nearest<2>(points, {0, 0}, 3) == Indices{4, 0, 1});
    CHECK(nearest<2>(steps, {9.5f, 0.0f}, 4) == Indices{9, 10, 8, 11});
}

TEST_CASE("a radius is closed, zero too") {
    const std::vector<Point2> points{{3, 4}, {5, 0}, {0, 5.0000005f}, {0, 0}};
    CHECK(around<2>(points, {0, 0}, 5.0f) == Indices{3, 0, 1});
    CHECK(around<2>(points, {0, 0}, std::nextafter(5.0f, 0.0f)) == Indices{3});
    CHECK(around<2>(points, {0, 0}, 0.0f) == Indices{3});
    CHECK(around<2>(points, {0, 1e-30f}, 0.0f).empty());
    CHECK(around<2>(points, {0, 0}, infinity) == Indices{3, 0, 1, 2});
    CHECK(around<2>(points, {0, 0}, -1.0f).empty());
    CHECK(around<2>(points, {0, 0}, nan).empty());
}

TEST_CASE("a box is closed, and may be a point") {
    CHECK(in_box<2>(steps, {{3, 0}, {6, 1}}) == Indices{3, 4, 5, 6});
    CHECK(in_box<2>(steps, {{17, 0}, {17, 0}}) == Indices{17});
    CHECK(in_box<2>(steps, {{3.5f, 0}, {3.75f, 0}}).empty());
    CHECK(in_box<2>(steps, {{0, 0.5f}, {19, 1}}).empty());
    CHECK(in_box<2>(steps, {Point2(-infinity), Point2(infinity)}).size() == 20);
    CHECK(in_box<2>(steps, BasicAabb<2>::empty()).empty());
    CHECK(in_box<2>(steps, {Point2(nan), Point2(nan)}).empty());
}

TEST_CASE("k = 0 finds none, k beyond the number of points all, no points nothing") {
    CHECK(nearest<2>(steps, {0, 0}, 0).empty());
    CHECK(nearest<2>(steps, {0, 0}, 1000).size() == 20);
    CHECK(nearest<2>(steps, {0, 0}, std::size_t(-1)).size() == 20);
    CHECK(nearest<3>({}, {0, 0, 0}, 3).empty());
    CHECK(around<3>({}, {0, 0, 0}, infinity).empty());
    CHECK(in_box<3>({}, {Point3(-1), Point3(1)}).empty());
}

TEST_CASE("a point that is not finite is refused by its number") {
    for (const float bad : {nan, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<Point3> points(5, Point3(1));
            points[3][axis] = bad;
            CHECK_THROWS_WITH(KdPoints<3>::build(points), "k-d tree: point 3 is not finite");
            CHECK_THROWS_AS(KdPoints<3>::build(points), std::invalid_argument);
        }
}

TEST_CASE("a query that is not finite finds nothing") {
    for (const float bad : {nan, infinity, -infinity}) {
        CHECK(nearest<2>(steps, {bad, 0}, 3).empty());
        CHECK(around<2>(steps, {0, bad}, infinity).empty());
    }
}

TEST_CASE("a search serves query after query, between them one that finds nothing") {
    const auto tree = KdPoints<2>::build(steps);
    NearestSearch<2> search(tree, 2);
    CHECK(indices_of(search({4.25f, 0})) == Indices{4, 5});
    CHECK(search({nan, 0}).empty());
    CHECK(indices_of(search({-9.0f, 0})) == Indices{0, 1});
}

// ---- the tree ---------------------------------------------------------------------------------

TEST_CASE("buckets hold every point once, all are full but the last, cells enclose their points") {
    for (const std::size_t count : {1u, 7u, 8u, 9u, 64u, 65u, 1000u}) {
        const auto points = random_points(count, count);
        const auto tree = KdPoints<3>::build(points);
        REQUIRE(tree.buckets.size() == (count + 7) / 8);
        std::vector<int> seen(count);
        for (std::uint32_t slot = 0; slot < count; ++slot) {
            ++seen[tree.index(slot)];
            CHECK(tree.point(slot) == points[tree.index(slot)]);
        }
        CHECK(std::ranges::count(seen, 1) == std::ptrdiff_t(count));
        for (const std::uint32_t index : tree.buckets.back().index)
            CHECK((index < count || index == std::uint32_t(-1)));

        for (std::uint32_t middle = 1; middle < tree.nodes.size(); ++middle) {
            const auto& node = tree.nodes[middle];
            CHECK(node.axis < 3);
            CHECK(node.left <= node.right);
        }
        Counter all;
        std::vector<std::uint32_t> found;
        within_box<3>(tree, tree.bounds, found, all);
        CHECK(found.size() == count);
        CHECK(all.subtrees + 1 == tree.buckets.size());
    }
}

TEST_CASE("a million equal points, or on a line, make a tree as deep as any") {
#ifdef BOOK_SANITIZED
    constexpr std::size_t count = 20'000;
#else
    constexpr std::size_t count = 1'000'000;
#endif
    std::vector<Point3> points(count, Point3(0.1f, 0.2f, 0.3f));
    CHECK(nearest<3>(points, {9, 9, 9}, 3) == Indices{0, 1, 2});
    CHECK(around<3>(points, points[0], 0.0f).size() == count);
    for (std::size_t i = 0; i < count; ++i) points[i].y = float(i);
    const auto tree = KdPoints<3>::build(points);
    Counter counter;
    NearestSearch<3> search(tree, 3);
    CHECK(indices_of(search({5, 12345.25f, 5}, counter)) == Indices{12345, 12346, 12344});
    CHECK(counter.subtrees <= 2 * 17);
    CHECK(counter.buckets <= 3);
}

TEST_CASE("the nearest of 100,000 is found with a few buckets") {
    const auto tree = KdPoints<3>::build(random_points(100'000, 5));
    NearestSearch<3> search(tree, 1);
    Counter counter;
    for (const Point3& query : random_points(1000, 6)) search(query, counter);
    CHECK(counter.buckets < 5 * 1000);
    CHECK(counter.compared < 5 * 1000);
    CHECK(counter.subtrees < 30 * 1000);
    CHECK(counter.pruned == counter.subtrees + 1000 - counter.buckets);  // each child either way
}

TEST_CASE("whatever the order of the points, the tree is the same but for indices") {
    const auto points = random_points(1000, 7);
    const std::vector<Point3> reversed(points.rbegin(), points.rend());
    const auto a = KdPoints<3>::build(points), b = KdPoints<3>::build(reversed);
    for (std::uint32_t middle = 1; middle < a.nodes.size(); ++middle) {
        CHECK(a.nodes[middle].axis == b.nodes[middle].axis);
        CHECK(a.nodes[middle].left == b.nodes[middle].left);
        CHECK(a.nodes[middle].right == b.nodes[middle].right);
    }
}

// ---- failure and cure -------------------------------------------------------------------------

namespace {

/// How most programs do it: squared distances in float, the least one wins.
template <int D>
std::uint32_t nearest_in_float(const std::vector<Point<D>>& points, const Point<D>& query) {
    std::uint32_t best = 0;
    float least = infinity;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const Vector<D> away = points[i] - query;
        const float d = glm::dot(away, away);
        if (d < least) {
            least = d;
            best = i;
        }
    }
    return best;
}

}  // namespace

TEST_CASE("a square of 25 bits: float calls a tie what is none") {
    const std::vector<Point2> points{{4097, 0}, {4096, 90.5125f}};  // 16785409; 16777216 + 8192.51
    CHECK(nearest_in_float<2>(points, {0, 0}) == 0);
    CHECK(nearest<2>(points, {0, 0}, 1) == Indices{1});
}

TEST_CASE("a difference that float can't hold: the farther cluster seems nearer") {
    // From 1e-3, 8388608 is 8388607.999 away: float says 8388608, as for the point at -8388608.
    const std::vector<Point2> points{{-8388608, 0}, {8388608, 0}};
    CHECK(nearest_in_float<2>(points, {1e-3f, 0}) == 0);
    CHECK(nearest<2>(points, {1e-3f, 0}, 1) == Indices{1});
}

TEST_CASE("a difference that double can't hold: decided without rounding") {
    const std::vector<Point2> points{{-1e30f, 0}, {1e30f, 0}};
    CHECK(squared_distance<2>(points[0], {1e-30f, 0}) ==
          squared_distance<2>(points[1], {1e-30f, 0}));
    CHECK(nearest<2>(points, {1e-30f, 0}, 1) == Indices{1});
    CHECK(nearest<2>(points, {-1e-30f, 0}, 1) == Indices{0});
    CHECK(nearest<2>(points, {0, 0}, 1) == Indices{0});
}

TEST_CASE("squares that over- or underflow in float keep their order") {
    for (const float unit : {1e20f, 1e37f, 1e-30f, 1e-44f}) {
        const std::vector<Point2> points{{3 * unit, 0}, {0, 2 * unit}, {unit, 0}};
        CHECK(nearest_in_float<2>(points, {0, 0}) == 0);
        CHECK(nearest<2>(points, {0, 0}, 3) == Indices{2, 1, 0});
        CHECK(around<2>(points, {0, 0}, 2 * unit) == Indices{2, 1});
    }
}

TEST_CASE("a tie beyond the k-th that float doesn't see still goes to the lower index") {
    // Each is at squared distance 50 in units of 2^-24 from the query, which is far away.
    const float far = 0.5f, unit = 0x1p-24f;
    std::vector<Point2> points;
    for (const auto& [x, y] : {std::pair{1, 7}, {-1, 7}, {7, 1}, {5, 5}, {-5, 5}, {7, -1}, {-7, 1}})
        points.emplace_back(far + float(x) * unit, far + float(y) * unit);
    for (std::size_t k = 0; k <= points.size(); ++k) {
        const Indices found = nearest<2>(points, {far, far}, k);
        REQUIRE(found.size() == k);
        for (std::uint32_t i = 0; i < k; ++i) CHECK(found[i] == i);
    }
}

}  // namespace space
