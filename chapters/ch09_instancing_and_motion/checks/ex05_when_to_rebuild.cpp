#include "ex05_when_to_rebuild.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

using namespace space;

namespace {

/// What all frames cost, counted frame by frame.
double cost(double build, double refit, const std::vector<double>& rays, std::size_t period) {
    double total = 0.0;
    std::size_t age = 0;
    for (std::size_t frame = 0; frame < rays.size(); ++frame, ++age) {
        if (age == period) age = 0;
        total += (age == 0 ? build : refit) + rays[age];
    }
    return total;
}

void check(double build, double refit, const std::vector<double>& rays) {
    std::size_t expected = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t period = 1; period <= rays.size(); ++period)
        if (const double total = cost(build, refit, rays, period); total <= least)
            least = total, expected = period;
    const std::size_t is = best_period(build, refit, rays);
    CAPTURE(build, refit, rays);
    REQUIRE(is >= 1);
    REQUIRE(is <= rays.size());
    CAPTURE(cost(build, refit, rays, is), least);
    REQUIRE(is == expected);
}

}  // namespace

TEST_CASE("a build that costs no more than a refit pays in each frame, if rays gain at all") {
    check(5, 5, {10, 11, 12, 13});
    check(3, 5, {10, 10, 10, 10});
    check(0, 0, {1, 2, 3});
}

TEST_CASE("where the tree stays as good as it was, one build is enough") {
    check(100, 1, {10, 10, 10, 10, 10, 10});
    check(1000, 1, {10, 20, 30, 40});
    check(7, 0, {5});
}

TEST_CASE("six frames by hand: two builds, three frames each") {
    // 20 + (10 + 16 + 22) + 2 for each half.
    check(20, 1, {10, 16, 22, 28, 34, 40});
    CHECK(best_period(20, 1, std::vector<double>{10, 16, 22, 28, 34, 40}) == 3);
}

TEST_CASE("the last tree may serve fewer frames, and has to be built all the same") {
    check(30, 0, {10, 16, 22, 28, 34});
    check(12, 1, {10, 14, 18, 22, 26, 30, 34});
    check(40, 2, {5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55});
}

TEST_CASE("a refit is paid where there is no build") {
    check(10, 9, {20, 21, 22, 23, 24, 25, 26, 27});
    check(10, 0, {20, 21, 22, 23, 24, 25, 26, 27});
    check(50, 30, {1, 2, 4, 8, 16, 32, 64, 128});
}

TEST_CASE("of periods that cost the same the longest") {
    check(4, 0, {1, 5, 9, 13});
    check(0, 0, {7, 7, 7, 7, 7});
    check(6, 6, {7, 7, 7, 7});
}

TEST_CASE("what costs more at first may cost less in the end") {
    // A wave: the tree fits again after each four frames.
    check(60, 1, {10, 40, 40, 10, 10, 40, 40, 10, 10, 40, 40, 10});
    check(25, 2, {10, 30, 12, 11, 30, 10, 11, 12, 30, 10});
}

TEST_CASE("the growth need not be even") {
    check(200, 1, {10, 10, 10, 10, 10, 500, 500, 500, 500, 500});
    check(30, 3, {1, 2, 5, 12, 28, 60, 130, 270, 550, 1110, 2230});
}

TEST_CASE("long animations of dear frames, whose sums differ by little") {
    Pcg32 random(10);
    for (int round = 0; round < sized(8, 2); ++round) {
        std::vector<double> rays;
        double now = 900'000.0;
        for (std::uint32_t frames = 1500 + random.below(100); frames > 0; --frames) {
            rays.push_back(now);
            now += random.below(round % 2 ? 3 : 50);
        }
        const double refit = 990'000.0 + random.below(5'000);
        const double build = refit + random.below(4'000);
        CAPTURE(round);
        check(build, refit, rays);
    }
}

TEST_CASE("random animations") {
    Pcg32 random(9);
    for (int round = 0; round < sized(4'000, 300); ++round) {
        std::vector<double> rays;
        double now = random.below(50);
        const std::uint32_t step = 1 + random.below(20);
        for (std::uint32_t frames = 1 + random.below(24); frames > 0; --frames) {
            rays.push_back(now);
            now += random.below(step);
            if (random.below(8) == 0) now = random.below(60);
        }
        const double build = random.below(150);
        const double refit = random.below(random.below(3) ? 8 : 60);
        CAPTURE(round);
        check(build, refit, rays);
    }
}
