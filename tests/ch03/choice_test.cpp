// Which splitter the builder chooses, held against a choice that counts in whole numbers.
#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <optional>
#include <vector>

namespace space {
namespace {

using SplitterChoice = BspConfig::SplitterChoice;
using Set = std::vector<Segment>;

/// With corners on a small grid, where many touch and coincide.
Set random_set(Pcg32& random, std::uint32_t count) {
    Set set;
    while (set.size() < count) {
        int numbers[4];
        for (int& number : numbers) number = static_cast<int>(random.below(7));
        const Segment segment{Point2(numbers[0], numbers[1]), Point2(numbers[2], numbers[3])};
        if (segment.a != segment.b) set.push_back(segment);
    }
    return set;
}

int side(const Segment& line, const Point2& p) {
    const auto whole = [](float x) { return static_cast<std::int64_t>(x); };
    const std::int64_t area = (whole(line.b.x) - whole(line.a.x)) * (whole(p.y) - whole(line.a.y)) -
                              (whole(line.b.y) - whole(line.a.y)) * (whole(p.x) - whole(line.a.x));
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

struct Counts {
    int front = 0, back = 0, cuts = 0;
};
Counts counts(const Set& set, std::size_t splitter) {
    Counts result;
    for (const Segment& segment : set) {
        const int a = side(set[splitter], segment.a), b = side(set[splitter], segment.b);
        result.cuts += a * b < 0;
        result.front += a * b >= 0 && a + b > 0;
        result.back += a * b >= 0 && a + b < 0;
    }
    return result;
}

/// Of equal costs the first.
template <class Cost>
std::uint32_t cheapest(const Set& set, const Cost& cost) {
    std::uint32_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < set.size(); ++i)
        if (cost(counts(set, i)) < least) least = cost(counts(set, i)), best = i;
    return best;
}

/// The root's splitter: a polygon's number, or none for a free plane.
struct Root : NoObserver {
    std::optional<std::uint32_t> polygon = {};
    std::size_t front = 0, back = 0, nodes = 0;

    using NoObserver::observe;
    void observe(const BspBuilder<2>::Chosen& event) {
        if (nodes++ == 0) polygon = event.polygon;
    }
    void observe(const BspBuilder<2>::Placed& event) {
        if (nodes > 1) return;
        front += event.side == PlaneSide::front;
        back += event.side == PlaneSide::back;
    }
};
/// Every side has all others behind it.
Set convex_body() {
    Set body;
    for (int i = 0; i < 32; ++i) {
        const auto corner = [](int k) {
            const double angle = -6.283185307179586 * k / 32;
            return Point2(std::cos(angle), std::sin(angle));
        };
        body.push_back({corner(i), corner(i + 1)});
    }
    return body;
}
Root root_of(const Set& set, const BspConfig& config) {
    Root root;
    BspBuilder<2>::build(set, config, root);
    return root;
}

}  // namespace

TEST_CASE(
    "of a set that is tried whole, each choice takes its cheapest splitter, the first of equals") {
    Pcg32 random(1);
    const auto imbalance = [](const Counts& c) { return std::abs(c.front - c.back); };
    int wrong = 0, differ = 0;
    for (int round = 0; round < 300; ++round) {
        const Set set = random_set(random, 12);
        const auto chosen = [&](SplitterChoice splitter, double weight) {
            return root_of(set, {.splitter = splitter, .candidates = 12, .split_weight = weight})
                .polygon;
        };
        const auto weighed = [&](double weight) {
            return cheapest(set, [&](const Counts& c) { return imbalance(c) + weight * c.cuts; });
        };
        const std::uint32_t balanced = cheapest(set, imbalance),
                            fewest = cheapest(set, [](const Counts&c) { return c.cuts; });
        wrong += chosen(SplitterChoice::first, 8.0) != 0u;
        wrong += chosen(SplitterChoice::balanced, 8.0) != balanced;
        wrong += chosen(SplitterChoice::fewest_splits, 8.0) != fewest;
        wrong += chosen(SplitterChoice::weighted, 8.0) != weighed(8.0);
        wrong += chosen(SplitterChoice::weighted, 1.5) != weighed(1.5);
        wrong += chosen(SplitterChoice::free, 1.5) != weighed(1.5);  // none left untried: no plane
        differ += balanced != fewest && weighed(8.0) != weighed(1.5);
    }
    CHECK(wrong == 0);
    CHECK(differ > 30);
}

TEST_CASE("of more candidates a cheaper splitter comes, and one is any of the set") {
    Pcg32 random(2);
    std::vector<bool> taken(40);
    double cost_of_one = 0.0, cost_of_eight = 0.0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const Set set = random_set(random, 40);
        const auto cost = [&](std::uint32_t candidates) {
            const auto polygon =
                root_of(set, {.candidates = candidates, .seed = seed}).polygon.value();
            if (candidates == 1) taken[polygon] = true;
            const Counts c = counts(set, polygon);
            return std::abs(c.front - c.back) + 8.0 * c.cuts;
        };
        cost_of_one += cost(1);
        cost_of_eight += cost(8);
    }
    CHECK(cost_of_eight < 0.7 * cost_of_one);
    CHECK(std::count(taken.begin(), taken.end(), true) > 35);
}

TEST_CASE("an order that is given comes first, whatever is chosen else") {
    Pcg32 random(3);
    const Set set = random_set(random, 12);
    const std::uint32_t order[] = {40, 7, 3};  // the first of them that is there
    for (const SplitterChoice splitter : {SplitterChoice::first, SplitterChoice::weighted})
        CHECK(root_of(set, {.splitter = splitter, .order = order}).polygon == 7u);
}

TEST_CASE("a free plane comes where all candidates are lopsided, and has something on both sides") {
    const Set body = convex_body();
    const Root free = root_of(body, {.splitter = SplitterChoice::free});
    CHECK_FALSE(free.polygon);
    CHECK(free.front > 4);
    CHECK(free.back > 4);
    CHECK(root_of(body, {.splitter = SplitterChoice::weighted}).polygon);
    CHECK(root_of(body, {.splitter = SplitterChoice::free, .lopsided = 0.0}).polygon);
    // Parallel and all alike: across an axis they straddle or lie on the plane, and none parts
    // them.
    const Set same(20, Segment{{-1, 0.5f}, {1, 0.5f}});
    CHECK(root_of(same, {.splitter = SplitterChoice::free, .lopsided = 1.1}).polygon);
}

TEST_CASE("a free plane is no place to send a whole set to, however cheap") {
    // A pencil through one point: each cuts all others. x = 0 cuts none, and has all on one side.
    for (const float way : {2.0f, -2.0f}) {
        Set pencil;
        for (int i = 0; i < 20; ++i) pencil.push_back({Point2(0, i), Point2(way, 20 - i)});
        CHECK(root_of(pencil,
                      {.splitter = SplitterChoice::free, .lopsided = 1.1, .max_placed = 10'000})
                  .polygon);
    }
}

TEST_CASE("a free plane is counted exactly, however thick the planes of candidates are") {
    // The whole body lies within 9/8 of a plane through its middle; of each side's the half does.
    const Root free = root_of(convex_body(), {.splitter = SplitterChoice::free,
                                              .split_weight = 1.0,
                                              .thickness_in_roundings = 0x1.2p53});
    CHECK_FALSE(free.polygon);
    CHECK(free.front > 10);
    CHECK(free.back > 10);
}

TEST_CASE("a candidate is said to cut only what leaves its thick plane on both sides") {
    // 0 and 1 cross at an angle of a sixteenth; both have 2 on their left, and 2 has both behind.
    const Set set{{{-8, 0}, {8, 0}}, {{8, -0.5f}, {-8, 0.5f}}, {{-8, 4}, {8, 4}}};
    CHECK(root_of(set, {.thickness_in_roundings = 0x1p50}).polygon == 0u);  // one thick
    CHECK(root_of(set, {.thickness_in_roundings = 0.0}).polygon == 2u);
}

TEST_CASE("planes that are not exact are as thick as eight roundings of their grade's numbers") {
    const Set set{{{-4, 1}, {2, 3}}, {{1, 0}, {0, 1}}};
    const auto thickness = [&](Grade grade) {
        return thickness_of_planes<2>(set, {.grade = grade});
    };
    for (const Grade grade : {Grade::thick_float, Grade::ordered_float})
        CHECK(thickness(grade) == 8.0 * 0x1p-24 * 4.0);
    for (const Grade grade : {Grade::ordered_double, Grade::exact})
        CHECK(thickness(grade) == 8.0 * 0x1p-53 * 4.0);
}

}  // namespace space
