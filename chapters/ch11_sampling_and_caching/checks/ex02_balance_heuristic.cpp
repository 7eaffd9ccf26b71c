#include "ex02_balance_heuristic.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

using namespace space;

namespace {

double weight(const std::vector<Way>& ways, std::size_t chosen) {
    return balance_weight(ways, chosen);
}

bool can_choose(const Way& way) {
    return way.samples > 0 && way.density > 0.0;
}

std::vector<Way> random_ways(Pcg32& random) {
    std::vector<Way> ways(1 + random.below(6));
    for (Way& way : ways) {
        way.samples = static_cast<int>(random.below(5));
        way.density = random.below(4) ? 8.0 * random.uniform_double() : 0.0;
    }
    ways[random.below(static_cast<std::uint32_t>(ways.size()))] = {0.5, 2};  // one can, at least
    return ways;
}

}  // namespace

TEST_CASE("alone a way counts in full") {
    CHECK(weight({{0.25, 1}}, 0) == 1.0);
    CHECK(weight({{3.0, 16}}, 0) == 1.0);
}

TEST_CASE(
    "of two ways with a sample each the one that is three times as dense counts three times") {
    CHECK(weight({{3.0, 1}, {1.0, 1}}, 0) == Approx(0.75).epsilon(1e-14));
    CHECK(weight({{3.0, 1}, {1.0, 1}}, 1) == Approx(0.25).epsilon(1e-14));
}

TEST_CASE("what only one way can choose counts in full") {
    CHECK(weight({{0.1, 1}, {0.0, 1}}, 0) == 1.0);
    CHECK(weight({{0.0, 7}, {0.1, 1}, {0.0, 1}}, 1) == 1.0);
    CHECK(weight({{5.0, 0}, {0.1, 1}}, 1) == 1.0);  // the other makes no samples
}

TEST_CASE("the weights of a point add up to 1 over the ways that can choose it") {
    Pcg32 random(113);
    for (int i = 0; i < 5'000; ++i) {
        const std::vector<Way> ways = random_ways(random);
        double sum = 0.0;
        for (std::size_t k = 0; k < ways.size(); ++k)
            if (can_choose(ways[k])) {
                const double is = weight(ways, k);
                CAPTURE(i, k, is);
                REQUIRE(is >= 0.0);
                sum += is;
            }
        CAPTURE(i);
        REQUIRE(sum == Approx(1.0).epsilon(1e-12));
    }
}

TEST_CASE("four samples of density 1 count as much as one of density 4") {
    CHECK(weight({{1.0, 4}, {4.0, 1}}, 0) == Approx(0.5).epsilon(1e-14));
    CHECK(weight({{1.0, 4}, {4.0, 1}}, 1) == Approx(0.5).epsilon(1e-14));
    CHECK(weight({{1.0, 4}, {2.0, 1}, {6.0, 1}}, 0) == Approx(1.0 / 3).epsilon(1e-14));
}

TEST_CASE("where f is what all samples together are dense, each adds the same") {
    Pcg32 random(114);
    for (int i = 0; i < 5'000; ++i) {
        const std::vector<Way> ways = random_ways(random);
        double f = 0.0;
        for (const Way& way : ways) f += way.samples * way.density;
        for (std::size_t k = 0; k < ways.size(); ++k)
            if (can_choose(ways[k])) {
                const double added = weight(ways, k) * f / (ways[k].samples * ways[k].density);
                CAPTURE(i, k, f, ways[k].density, ways[k].samples);
                REQUIRE(added == Approx(1.0).epsilon(1e-12));
            }
    }
}

TEST_CASE("huge densities and tiny ones") {
    CHECK(weight({{1e308, 16}, {1e308, 16}}, 0) == Approx(0.5).epsilon(1e-14));
    CHECK(weight({{1e308, 1}, {1e308, 3}}, 1) == Approx(0.75).epsilon(1e-14));
    CHECK(weight({{1e308, 1}, {1.0, 1}}, 0) == 1.0);
    CHECK(weight({{1e308, 8}, {1.0, 1}}, 1) <= 1e-300);
    CHECK(weight({{1e308, 8}, {1e-300, 1}}, 1) <= 1e-300);
    CHECK(weight({{1e-300, 1}, {1e-300, 3}}, 0) == Approx(0.25).epsilon(1e-14));
    CHECK(weight({{1e-300, 1}, {0.0, 3}}, 0) == 1.0);
}
