// Searches among points against a loop in rational numbers.
#include "chapters/ch04_kd_trees/point_search.hpp"
#include "tests/catch.hpp"
#include "tests/ch04/point_sets.hpp"

#include <rapidcheck.h>

#include <cstdlib>

namespace space {
namespace {

#ifdef BOOK_SANITIZED
constexpr int sets_of_a_kind = 10;
#else
constexpr int sets_of_a_kind = 100;
#endif
constexpr int queries_of_a_set = 10;

/// The same examples on every run; RC_PARAMS in the environment asks for others.
const int seeded = ::setenv("RC_PARAMS", "seed=1 max_success=300", 0);

std::vector<std::uint32_t> indices_of(std::span<const Neighbour> neighbours) {
    std::vector<std::uint32_t> indices;
    for (const Neighbour& neighbour : neighbours) indices.push_back(neighbour.index);
    return indices;
}

template <int D>
std::vector<std::uint32_t> nearest_in_rationals(std::span<const Point<D>> points,
                                                const Point<D>& query, std::size_t k) {
    std::vector<std::uint32_t> indices;
    for (const auto& [distance, index] : all_by_distance<D>(points, query))
        if (indices.size() < k) indices.push_back(index);
    return indices;
}
template <int D>
std::vector<std::uint32_t> within_in_rationals(std::span<const Point<D>> points,
                                               const Point<D>& query, float radius) {
    const mpq_class square = mpq_class(radius) * mpq_class(radius);
    std::vector<std::uint32_t> indices;
    for (const auto& [distance, index] : all_by_distance<D>(points, query))
        if (distance <= square) indices.push_back(index);
    return indices;
}

/// How programs find it that compare squared distances in float.
template <int D>
std::uint32_t nearest_in_float(std::span<const Point<D>> points, const Point<D>& query) {
    std::uint32_t best = 0;
    float least = infinity;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const Vector<D> away = points[i] - query;
        if (const float d = glm::dot(away, away); d < least) {
            least = d;
            best = i;
        }
    }
    return best;
}

/// A query near the points, at one of them, or anywhere.
template <int D>
Point<D> drawn_query(Pcg32& random, const NumberKind& kind, std::span<const Point<D>> points) {
    const std::uint32_t way = random.below(3);
    if (way == 0) return points[random.below(static_cast<std::uint32_t>(points.size()))];
    if (way == 1) return Point<D>{0.0f};
    return drawn_point<D>(random, kind);
}

template <int D>
void compare_with_rationals() {
    Pcg32 random(40 + D);
    int queries = 0, float_is_wrong = 0;
    for (const NumberKind& kind : number_kinds)
        for (int set = 0; set < sets_of_a_kind; ++set) {
            const auto points = drawn_points<D>(random, kind, 1 + random.below(60));
            const auto tree = KdPoints<D>::build(points);
            for (int i = 0; i < queries_of_a_set; ++i, ++queries) {
                const Point<D> query = drawn_query<D>(random, kind, points);
                const std::size_t k = random.below(70);
                CAPTURE(kind.name, set, i, k, points.size());
                const auto best = k_nearest<D>(tree, query, k);
                const auto truth = nearest_in_rationals<D>(points, query, k);
                REQUIRE(indices_of(best) == truth);
                if (!truth.empty())
                    float_is_wrong += nearest_in_float<D>(points, query) != truth[0];

                const Point<D> on_the_edge = drawn_query<D>(random, kind, points);
                const Double<D> away = Double<D>(on_the_edge) - Double<D>(query);
                const auto radius = static_cast<float>(std::min(glm::length(away), 3e38));
                std::vector<Neighbour> found;
                within_radius<D>(tree, query, radius, found);
                CAPTURE(radius);
                REQUIRE(indices_of(found) == within_in_rationals<D>(points, query, radius));
            }
        }
    CHECK(queries == int(number_kinds.size()) * sets_of_a_kind * queries_of_a_set);
    CHECK(float_is_wrong > queries / 20);
}

}  // namespace

TEST_CASE("the k nearest and those within a radius are a rational loop's, on every kind of point") {
    SECTION("in the plane") {
        compare_with_rationals<2>();
    }
    SECTION("in space") {
        compare_with_rationals<3>();
    }
}

namespace {

/// Coordinates that often tie.
rc::Gen<float> coordinate() {
    return rc::gen::map(rc::gen::inRange(-8, 9), [](int i) { return 0.1f * float(i); });
}
Point3 some_point() {
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = *coordinate();
    return p;
}
std::vector<Point3> some_points() {
    std::vector<Point3> points(*rc::gen::inRange<std::size_t>(1, 100));
    for (Point3& p : points) p = some_point();
    return points;
}

}  // namespace

TEST_CASE("property: the k nearest begin with the k - 1 nearest") {
    CHECK(rc::check([] {
        const auto tree = KdPoints<3>::build(some_points());
        const Point3 query = some_point();
        const auto k = *rc::gen::inRange<std::size_t>(1, 100);
        auto more = k_nearest<3>(tree, query, k);
        if (more.size() == k) more.pop_back();
        RC_ASSERT(more == k_nearest<3>(tree, query, k - 1));
    }));
}

TEST_CASE("property: those within a radius are the nearest, as many as there are") {
    CHECK(rc::check([] {
        const auto tree = KdPoints<3>::build(some_points());
        const Point3 query = some_point();
        std::vector<Neighbour> found;
        within_radius<3>(tree, query, std::abs(*coordinate()), found);
        RC_ASSERT(found == k_nearest<3>(tree, query, found.size()));
    }));
}

TEST_CASE("property: the order in which points are given changes indices and nothing else") {
    CHECK(rc::check([] {
        const auto points = some_points();
        const std::vector<Point3> reversed(points.rbegin(), points.rend());
        const Point3 query = some_point();
        const auto a = k_nearest<3>(KdPoints<3>::build(points), query, points.size());
        const auto b = k_nearest<3>(KdPoints<3>::build(reversed), query, points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            RC_ASSERT(a[i].squared_distance == b[i].squared_distance);
    }));
}

TEST_CASE("property: a closed box finds what a loop finds") {
    CHECK(rc::check([] {
        const auto points = some_points();
        Aabb box;
        box.extend(some_point());
        box.extend(some_point());
        std::vector<std::uint32_t> found, wanted;
        within_box<3>(KdPoints<3>::build(points), box, found);
        for (std::uint32_t i = 0; i < points.size(); ++i)
            if (box.contains(points[i])) wanted.push_back(i);
        RC_ASSERT(found == wanted);
    }));
}

// ---- bounds -----------------------------------------------------------------------------------

namespace {

/// The largest error of squared_distance and of the float distance, as parts of their bounds.
struct Worst {
    double in_double = 0.0, in_float = 0.0;
};

template <int D>
Worst worst_of(int samples) {
    Worst worst;
    Pcg32 random(4);
    for (int i = 0; i < samples; ++i) {
        Point<D> p, q;
        for (int axis = 0; axis < D; ++axis) {
            p[axis] = random.uniform(1.0f, 2.0f);
            q[axis] = random.uniform(-1.0f, 1.0f) * 0x1p-31f;  // the difference has many bits
        }
        const mpq_class truth = rational_distance<D>(p, q);
        const auto part = [&](double value) {
            const mpq_class error = abs(mpq_class(value) - truth) / truth;
            return error.get_d();
        };
        const Vector<D> away = p - q;
        worst.in_double =
            std::max(worst.in_double, part(squared_distance<D>(p, q)) / squared_distance_bound<D>);
        worst.in_float = std::max(worst.in_float,
                                  part(glm::dot(away, away)) / (distance_roundings<D> * 0x1p-24));
    }
    return worst;
}

}  // namespace

TEST_CASE("squared distances are wrong by less than their bounds, and by not much less") {
#ifdef BOOK_SANITIZED
    constexpr int samples = 2'000;
#else
    constexpr int samples = 100'000;
#endif
    const Worst plane = worst_of<2>(samples), space = worst_of<3>(samples);
    for (const double ratio : {plane.in_double, plane.in_float, space.in_double, space.in_float}) {
        CHECK(ratio <= 1.0);
        CHECK(ratio > 0.3);
    }
}

TEST_CASE("what double calls certainly less is less, and in near ties it is not certain") {
    Pcg32 random(8);
    int certain = 0, uncertain = 0;
    for (const NumberKind& kind : number_kinds)
        for (int i = 0; i < 2'000; ++i) {
            const auto p = drawn_points<3>(random, kind, 3);
            const double a = squared_distance<3>(p[0], p[2]), b = squared_distance<3>(p[1], p[2]);
            const int truth =
                cmp(rational_distance<3>(p[0], p[2]), rational_distance<3>(p[1], p[2]));
            CAPTURE(kind.name, a, b);
            if (certainly_less<3>(a, b)) REQUIRE(truth < 0);
            if (certainly_less<3>(b, a)) REQUIRE(truth > 0);
            certainly_less<3>(a, b) || certainly_less<3>(b, a) ? ++certain : ++uncertain;
            const int exact =
                (exact_squared_distance<3>(p[0], p[2]) - exact_squared_distance<3>(p[1], p[2]))
                    .sign();
            REQUIRE(exact == (truth > 0) - (truth < 0));
        }
    CHECK(certain > 5'000);
    CHECK(uncertain > 2'000);
}

}  // namespace space
