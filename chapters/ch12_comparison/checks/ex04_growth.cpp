#include "ex04_growth.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace space;

namespace {

using Series = std::vector<Timed>;

constexpr double none = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

std::string text_of(const Series& series) {
    std::string text;
    for (const Timed& one : series) text += shortest(one.size) + ": " + shortest(one.time) + "; ";
    return text;
}

FittedGrowth fitted(const Series& series) {
    CAPTURE(text_of(series));
    const std::optional<FittedGrowth> growth = growth_of(series);
    REQUIRE(growth.has_value());
    return *growth;
}

void check(const Series& series, double power, double error) {
    const FittedGrowth growth = fitted(series);
    CAPTURE(text_of(series));
    REQUIRE(growth.power == Approx(power).margin(1e-12));
    REQUIRE(growth.error == Approx(error).margin(1e-9));
}

/// Times of size^power times a factor each.
Series series_of(const std::vector<double>& sizes, double power,
                 const std::vector<double>& factors) {
    Series series;
    for (std::size_t i = 0; i < sizes.size(); ++i)
        series.push_back({sizes[i], std::pow(sizes[i], power) * factors[i]});
    return series;
}

}  // namespace

TEST_CASE("an exact power is found, with no error: 0, 1/2, 1, 2 and less than 0") {
    const std::vector<double> sizes{1e3, 1e4, 1e5, 1e6}, ones(4, 1.0), sevens(4, 7.0);
    for (const double power : {0.0, 0.5, 1.0, 2.0, -0.5, 1.37}) {
        check(series_of(sizes, power, ones), power, 0.0);
        check(series_of(sizes, power, sevens), power, 0.0);
    }
}

TEST_CASE("every measurement counts: the ones between, too") {
    // Logarithms to the base 2: (0, 0), (1, 2), (2, 1). Slope 1/2.
    CHECK(fitted({{1, 1}, {2, 4}, {4, 2}}).power == Approx(0.5));
    // (0, 0), (1, 2), (3, 1): means 4/3 and 1, sums 14/3 and 1.
    const FittedGrowth growth = fitted({{1, 1}, {2, 4}, {8, 2}});
    CHECK(growth.power == Approx(3.0 / 14.0));
    // (0, 0), (1, 1), (2, 5), (3, 3): slope 1.3.
    CHECK(fitted({{1, 1}, {2, 2}, {4, 32}, {8, 8}}).power == Approx(1.3));
}

TEST_CASE("the error is that of m - 2: in a case that can be done by hand") {
    // (0, 0), (1, 1), (2, 5), (3, 3): the line leaves -0.3, -0.6, 2.1, -1.2; 6.3 / 2 / 5.
    CHECK(fitted({{1, 1}, {2, 2}, {4, 32}, {8, 8}}).error == Approx(std::sqrt(0.63)));
    // (0, 0), (1, 2), (2, 1): it leaves -1/2, 1, -1/2; 1.5 / 1 / 2.
    CHECK(fitted({{1, 1}, {2, 4}, {4, 2}}).error == Approx(std::sqrt(0.75)));
}

TEST_CASE("in which units size and time are does not matter, nor in which order they stand") {
    const Series series{{1'000, 3.1}, {10'000, 29.0}, {100'000, 350.0}, {1'000'000, 3'600.0}};
    const FittedGrowth growth = fitted(series);
    Series other;
    for (const Timed& one : series) other.push_back({one.size / 1'000, one.time * 1e6});
    std::ranges::reverse(other);
    std::swap(other[0], other[1]);
    check(other, growth.power, growth.error);
}

TEST_CASE("a size that was measured twice counts twice") {
    // Logarithms to the base 2: (0, 0), (0, 2), (1, 1), (2, 4): means 3/4 and 7/4.
    const FittedGrowth growth = fitted({{1, 1}, {1, 4}, {2, 2}, {4, 16}});
    CHECK(growth.power == Approx(3.75 / 2.75));
    CHECK(fitted({{1, 1}, {1, 4}, {4, 16}}).power == Approx(1.5));
}

TEST_CASE("what gave up is left out: NaN, infinity, 0 and less, as a size and as a time") {
    const Series series{{1, 1}, {2, 4}, {4, 2}};
    for (const double bad : {none, infinite, 0.0, -1.0}) {
        CAPTURE(bad);
        for (const Timed& one : {Timed{3.0, bad}, {bad, 3.0}, {bad, bad}}) {
            for (std::size_t at = 0; at <= 3; ++at) {
                Series longer = series;
                longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(at), one);
                check(longer, 0.5, std::sqrt(0.75));
            }
        }
    }
}

TEST_CASE("of fewer than three measurements, or of one size, nothing is said") {
    for (const Series& series : std::vector<Series>{{},
                                                    {{1, 1}},
                                                    {{1, 1}, {2, 4}},
                                                    {{1, 1}, {2, 4}, {4, none}},
                                                    {{1, 1}, {2, 4}, {0, 1}, {-1, 5}},
                                                    {{5, 1}, {5, 2}, {5, 4}},
                                                    {{1e6, 1}, {1e6, 2}, {1e6, 3}, {1e6, 3}},
                                                    {{0.1, 1}, {0.1, 2}, {0.1, 4}, {0.1, 5}}}) {
        CAPTURE(text_of(series));
        REQUIRE_FALSE(growth_of(series).has_value());
    }
}

TEST_CASE("n log n from a thousand to a million looks like a power of 1.1, and not like 1") {
    Series series;
    for (double size = 1e3; size < 2e6; size *= 10.0)
        series.push_back({size, size * std::log2(size)});
    const FittedGrowth growth = fitted(series);
    CHECK(growth.power == Approx(1.1).margin(0.005));
    CHECK(growth.error > 0.001);
    CHECK(growth.power - 2.0 * growth.error > 1.0);
}

TEST_CASE("of 2,000 noisy series the true power lies within two errors as often as it should") {
    // Student's t with 3 degrees of freedom is within 2 of 0 with probability 0.861, and with 8 of
    // them 0.919; three standard deviations of 2,000 draws are 0.023 and 0.018.
    Pcg32 random(125);
    for (const auto& [sizes, share, margin] :
         {std::tuple{5, 0.8607, 0.023}, std::tuple{10, 0.9195, 0.018}}) {
        int within = 0;
        for (int turn = 0; turn < 2'000; ++turn) {
            Series series;
            for (int i = 0; i < sizes; ++i) {
                double noise = -6.0;  // of twelve numbers: nearly normal, of variance 1
                for (int j = 0; j < 12; ++j) noise += random.uniform_double();
                const double size = 1e3 * std::pow(3.0, i);
                series.push_back({size, 5.0 * std::pow(size, 1.2) * std::exp(0.1 * noise)});
            }
            const FittedGrowth growth = fitted(series);
            within += std::abs(growth.power - 1.2) <= 2.0 * growth.error;
        }
        CAPTURE(sizes);
        CHECK(within / 2'000.0 == Approx(share).margin(margin));
    }
}
