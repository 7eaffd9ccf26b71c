#include "ex03_k_or_k_minus_one.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace space;

namespace {

constexpr double pi = std::numbers::pi;

double answer(const std::vector<double>& squares, std::size_t k, double smallest, double largest) {
    return photons_per_area(squares, k, smallest, largest);
}

/// Squared distances of photons with a mean of `density` per area: between the areas of two
/// discs there lies an exponential variable.
std::vector<double> by_chance(Pcg32& random, double density, double largest) {
    std::vector<double> squares;
    double square = 0.0;
    for (;;) {
        square -= std::log(1.0 - random.uniform_double()) / (pi * density);
        if (square > largest * largest) return squares;
        squares.push_back(square);
    }
}

/// Within five times its standard deviation the mean is right, which one of a million right answers
/// misses. (Densities that are not bounded are so for k > 3 alone, or have a least radius.)
void right_on_average(double density, std::size_t k, double smallest, double largest) {
    Pcg32 random(115);
    const int rounds = sized(20'000, 4'000);
    double sum = 0.0, of_squares = 0.0;
    for (int i = 0; i < rounds; ++i) {
        const double is = answer(by_chance(random, density, largest), k, smallest, largest);
        REQUIRE(std::isfinite(is));
        sum += is;
        of_squares += is * is;
    }
    const double mean = sum / rounds;
    const double deviation = std::sqrt((of_squares / rounds - mean * mean) / rounds);
    CAPTURE(density, k, smallest, largest, mean, deviation);
    REQUIRE(Error{std::abs(mean - density), 5.0 * deviation});
}

}  // namespace

TEST_CASE("where there is no photon the density is 0") {
    CHECK(answer({}, 2, 0.1, 1) == 0.0);
    CHECK(answer({}, 50, 1, 3) == 0.0);
}

TEST_CASE("the disc ends at the k-th photon, whoever comes behind it") {
    const double three = answer({0.25, 0.5, 1, 2, 3}, 3, 0.1, 2);
    CHECK(answer({0.25, 0.5, 1}, 3, 0.1, 2) == three);
    CHECK(answer({0.9, 0.95, 1, 1.01}, 3, 0.1, 2) == three);  // nor where in it the others are
    CHECK(answer({0.9, 0.95, 1}, 3, 0.2, 20) == three);       // nor how large it might have been
    CHECK(answer({1, 2, 4, 8, 12}, 3, 0.1, 4) == Approx(three / 4).epsilon(1e-14));
}

TEST_CASE("photons by chance: the disc up to the k-th is right on average") {
    right_on_average(10, 4, 1e-6, 4);
    right_on_average(1, 10, 1e-6, 8);
    right_on_average(100, 50, 1e-6, 2);
}

TEST_CASE("photons by chance: fewer than k within the largest disc, more or less often") {
    right_on_average(1, 50, 1e-6, 1);   // always
    right_on_average(2, 10, 1e-6, 1);   // nearly always
    right_on_average(1, 4, 1e-6, 1);    // mostly
    right_on_average(1, 4, 1e-6, 1.5);  // seldom
}

TEST_CASE("three photons of fifty in the largest disc: 3 over its area") {
    CHECK(answer({0.0025, 0.004, 0.01}, 50, 0.001, 1) == Approx(3 / pi).epsilon(1e-14));
    CHECK(answer({0.01}, 2, 0.001, 0.5) == Approx(4 / pi).epsilon(1e-14));
}

TEST_CASE("photons by chance: the k-th within the smallest disc, more or less often") {
    right_on_average(10, 2, 1, 3);    // nearly always
    right_on_average(1, 4, 1, 3);     // sometimes
    right_on_average(5, 10, 0.7, 3);  // sometimes
    right_on_average(2, 2, 0.2, 1);   // seldom
}

TEST_CASE("photons by chance: all three cases at once") {
    right_on_average(1, 2, 0.5, 0.8);
    right_on_average(1, 3, 0.9, 1.1);
    right_on_average(20, 50, 0.8, 0.9);
}

TEST_CASE("fifty photons on the point itself") {
    const std::vector<double> squares(50, 0.0);
    CHECK(answer(squares, 50, 0.5, 1) == Approx(200 / pi).epsilon(1e-14));
    CHECK(answer(squares, 10, 0.5, 1) == Approx(200 / pi).epsilon(1e-14));
}

TEST_CASE("a photon on the smallest disc's edge is within") {
    CHECK(answer({0.1, 0.25}, 2, 0.5, 1) == Approx(8 / pi).epsilon(1e-14));
    CHECK(answer({0.1, 0.2, 0.25}, 2, 0.5, 1) == Approx(12 / pi).epsilon(1e-14));
    CHECK(answer({0.1, 0.2, 0.26}, 2, 0.5, 1) == Approx(8 / pi).epsilon(1e-14));
}
