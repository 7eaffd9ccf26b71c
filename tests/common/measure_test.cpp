#include "common/measure.hpp"

#include "tests/catch.hpp"

#include <string>

namespace space {

TEST_CASE("the median is the middle value, or the mean of the middle two") {
    CHECK(median({3, 1, 2}) == 2);
    CHECK(median({4, 1, 3, 2}) == 2.5);
    CHECK(median({7}) == 7);
    CHECK(median({1, 1, 1000}) == 1);
    CHECK(std::isnan(median({})));
}

TEST_CASE("the log-log slope is the exponent of a power, whatever the factor") {
    const std::vector<double> x{1, 10, 100, 1000};
    const auto slope = [&](double factor, double exponent) {
        std::vector<double> y;
        for (const double value : x) y.push_back(factor * std::pow(value, exponent));
        return log_log_slope(x, y);
    };
    CHECK(slope(3, 1) == Approx(1));
    CHECK(slope(0.001, 2) == Approx(2));
    CHECK(slope(5, 0) == Approx(0).margin(1e-12));
    CHECK(slope(5, -0.5) == Approx(-0.5));
    // The least squares of log2 y = 0, 1, 1 over log2 x = 0, 1, 2: by hand 1/2.
    CHECK(log_log_slope(std::vector<double>{1, 2, 4}, std::vector<double>{1, 2, 2}) == Approx(0.5));
}

TEST_CASE("measured candidates take turns, after one round of warming up") {
    std::string order;
    const std::vector<std::function<void()>> candidates{
        [&] { order += 'a'; }, [&] { order += 'b'; }, [&] { order += 'c'; }};
    const std::vector<double> medians = interleaved_medians(candidates, 3);
    CHECK(order == "abcabcabcabc");
    CHECK(medians.size() == 3);
    for (const double time : medians) CHECK(time >= 0.0);
    CHECK(interleaved_medians({}, 3).empty());
}

TEST_CASE("a stopwatch never runs backwards, and a lap starts the next") {
    Stopwatch stopwatch;
    CHECK(stopwatch.lap().count() >= 0.0);
    CHECK(stopwatch.lap().count() >= 0.0);
}

}  // namespace space
