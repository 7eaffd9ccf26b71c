// What the teachers' notes on chapter 3 say was measured is measured here.
#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "chapters/ch03_bsp_trees/solutions/ex08_growth.hpp"
#include "common/program/report.hpp"
#include "common/random.hpp"
#include "tests/text.hpp"

#include <cmath>
#include <numbers>

namespace space {
namespace {

/// Their middles anywhere in the unit square, all directions as likely.
std::vector<Segment> random_segments(std::size_t count, double length, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < count; ++i) {
        const Double2 middle(random_point(random, Aabb2{{0, 0}, {1, 1}}));
        const double angle = std::numbers::pi * random.uniform_double();
        const Double2 half = 0.5 * length * Double2(std::cos(angle), std::sin(angle));
        segments.push_back({Point2(middle - half), Point2(middle + half)});
    }
    return segments;
}

bool cross(const Segment& s, const Segment& t) {
    const auto side = [](const Segment& of, const Point2& p) {
        const Double2 way = Double2(of.b) - Double2(of.a), to = Double2(p) - Double2(of.a);
        return way.x * to.y - way.y * to.x;
    };
    return side(s, t.a) * side(s, t.b) < 0.0 && side(t, s.a) * side(t, s.b) < 0.0;
}

/// Means over three sets.
struct Row {
    double crossings = 0.0, cuts = 0.0, levels = 0.0;
};
Row row_of(std::size_t count, double length) {
    Row row;
    for (const std::uint64_t seed : {7, 8, 9}) {
        const std::vector<Segment> segments = random_segments(count, length, seed);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < i; ++j)
                row.crossings += cross(segments[i], segments[j]) / 3.0;
        const Growth growth = growth_of(BspBuilder<2>::build(
            segments, {.splitter = BspConfig::SplitterChoice::random, .seed = seed}));
        row.cuts += static_cast<double>(growth.cuts) / 3.0;
        row.levels += static_cast<double>(growth.levels) / 3.0;
    }
    return row;
}

std::string whole(double x) {
    return with_commas(static_cast<std::uint64_t>(std::llround(x)));
}

}  // namespace

TEST_CASE("how random segments are cut as their number grows: the table for teachers") {
    const Text notes("docs/teachers/ch03.md");
    Row fixed_before, shrinking_before;
    for (const std::size_t n : {250u, 500u, 1'000u, 2'000u, 4'000u}) {
        const Row fixed = row_of(n, 0.25), shrinking = row_of(n, 1.0 / std::sqrt(n));
        const auto factor = [](const Row& now, const Row& before) {
            return before.cuts == 0.0 ? std::string("")
                                      : fmt::format("{:.1f} ", now.cuts / before.cuts);
        };
        const std::string row =
            fmt::format("| {} | {} | {} | {}| {} | {} | {} | {}| {} |", with_commas(n),
                        whole(fixed.crossings), whole(fixed.cuts), factor(fixed, fixed_before),
                        whole(fixed.levels), whole(shrinking.crossings), whole(shrinking.cuts),
                        factor(shrinking, shrinking_before), whole(shrinking.levels));
        fmt::print("{}\n", row);
        notes.check_says(row);
        fixed_before = fixed;
        shrinking_before = shrinking;
    }
}

TEST_CASE("the order that cuts most, and the one that cuts nothing: the numbers for teachers") {
    const Text notes("docs/teachers/ch03.md");
    std::vector<std::size_t> cuts;
    for (const int k : {5, 10, 20}) {
        std::vector<Segment> across, upright;
        for (int i = 0; i < k; ++i) {
            const auto x = static_cast<float>(i) + 0.5f, y = static_cast<float>(i + 1);
            across.push_back({{0, y}, {static_cast<float>(k), y}});
            upright.push_back({{x, -1}, {x, -0.5f}});
        }
        const auto cuts_of = [](std::vector<Segment> first, const std::vector<Segment>& then) {
            first.insert(first.end(), then.begin(), then.end());
            return growth_of(
                       BspBuilder<2>::build(first, {.splitter = BspConfig::SplitterChoice::first}))
                .cuts;
        };
        cuts.push_back(cuts_of(upright, across));
        CHECK(cuts.back() == static_cast<std::size_t>(k * k));
        CHECK(cuts_of(across, upright) == 0);
    }
    notes.check_says(
        fmt::format("{}, {} and {} cuts for *k* = 5, 10, 20, and 0.", cuts[0], cuts[1], cuts[2]));
}

}  // namespace space
