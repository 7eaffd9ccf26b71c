// What the teachers' notes on chapter 2 say was measured is measured here.
#include "chapters/ch02_intersection_tests/solutions/ex06_orientation_filter.hpp"
#include "common/program/report.hpp"
#include "common/random.hpp"
#include "tests/text.hpp"

namespace space {
namespace {

/// How often the filter asks, of so many triples of points.
std::uint64_t asked(std::uint64_t triples, const auto& point) {
    std::uint64_t asked = 0;
    for (std::uint64_t i = 0; i < triples; ++i) {
        const Point2 a = point(), b = point(), c = point();
        orientation(a, b, c, [&](const Point2&, const Point2&, const Point2&) {
            ++asked;
            return 0;
        });
    }
    return asked;
}

}  // namespace

TEST_CASE("how often the orientation's filter asks: the numbers for teachers") {
    const Text notes("docs/teachers/ch02.md");
    constexpr std::uint64_t many = 100'000'000, fewer = 10'000'000;
    Pcg32 random(1);
    const std::uint64_t of_random = asked(many, [&] {
        return random_point(random, Aabb2{{0, 0}, {1, 1}});
    });
    notes.check_says(fmt::format("Measured with `random_point` and seed 1: **{} of {}**", of_random,
                                 with_commas(many)));
    Pcg32 whole(1);
    const std::uint64_t of_whole = asked(fewer, [&] {
        const auto x = static_cast<float>(whole.below(1'024));
        const auto y = static_cast<float>(whole.below(1'024));
        return Point2(x, y);
    });
    const double share = static_cast<double>(of_whole) / fewer;
    notes.check_says(fmt::format(
        "With whole coordinates below 1,024: **{} of {}**, {:.1f} × 10^-5, {:.0f} times as many.",
        of_whole, with_commas(fewer), 1e5 * share,
        share / (static_cast<double>(of_random) / many)));
}

}  // namespace space
