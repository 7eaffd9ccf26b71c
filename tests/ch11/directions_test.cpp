#include "chapters/ch11_sampling_and_caching/directions.hpp"

#include "chapters/ch11_sampling_and_caching/multiple_importance.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"
#include "tests/ch11/up.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace space {
namespace {

TEST_CASE("cosine and sine of a part of a turn are within 2^-52 of the exact ones") {
    const int count = sized(200'000, 20'000);
    long double largest = 0.0L;
    for (int i = 0; i < count; ++i) {
        const double turns = (i + 0.25) / count;
        const long double angle = 2.0L * std::numbers::pi_v<long double> * turns;
        const Double2 p = circle_point(turns);
        largest =
            std::max({largest, std::abs(p.x - std::cos(angle)), std::abs(p.y - std::sin(angle))});
    }
    CAPTURE(largest);
    CHECK(largest < 0x1p-52L);
    CHECK(circle_point(0.0) == Double2(1.0, 0.0));
    CHECK(circle_point(0.25) == Double2(0.0, 1.0));
    CHECK(circle_point(0.5) == Double2(-1.0, 0.0));
    CHECK(circle_point(0.75) == Double2(0.0, -1.0));
    CHECK(glm::distance(circle_point(1.0 - 0x1p-53), Double2(1.0, 0.0)) < 1e-15);
}

TEST_CASE("the sine of a tiny part of a turn keeps its relative accuracy") {
    for (double turns = 0.1; turns > 1e-300; turns *= 0.1)
        CHECK(circle_point(turns).y ==
              Approx(std::sin(2.0 * std::numbers::pi * turns)).epsilon(4e-16));
}

TEST_CASE("a basis is orthonormal and right-handed, whatever its normal") {
    Pcg32 random(1);
    std::vector<Double3> normals{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0, 1, -0.0}};
    for (int i = 0; i < 10'000; ++i) normals.push_back(random_direction(random));
    for (const double tilt : {1e-3, 1e-8, 1e-20, 1e-200})
        normals.push_back(glm::normalize(Double3(tilt, -tilt, -1.0)));
    double worst = 0.0;
    for (const Double3& n : normals) {
        const Basis basis(n);
        worst =
            std::max({worst, std::abs(glm::dot(basis.x, basis.y)),
                      std::abs(glm::dot(basis.x, basis.z)), std::abs(glm::dot(basis.y, basis.z)),
                      std::abs(glm::length(basis.x) - 1.0), std::abs(glm::length(basis.y) - 1.0),
                      glm::distance(glm::cross(basis.x, basis.y), basis.z)});
    }
    CHECK(worst < 2e-15);
}

constexpr std::size_t rings = 16, sectors = 16;

/// The cell of a direction over n: rings of the height, sectors around.
std::size_t cell_of(const Double3& n, const Double3& direction) {
    const Basis basis(n);
    const double height = glm::dot(n, direction);
    REQUIRE((height > 0.0 && height < 1.0 + 1e-15));
    const double turns = std::atan2(glm::dot(direction, basis.y), glm::dot(direction, basis.x)) /
                             (2.0 * std::numbers::pi) +
                         0.5;
    const auto index = [](double x, std::size_t count) {
        return std::min(static_cast<std::size_t>(x * static_cast<double>(count)), count - 1);
    };
    return index(height, rings) * sectors + index(turns, sectors);
}

/// Chi-square of the samples against the density `pdf`, which depends on the height alone and is
/// integrated over a ring exactly where it is linear.
template <class Sample, class Pdf>
double misfit(const Double3& n, const Sample& sample, const Pdf& pdf) {
    const int count = sized(200'000, 20'000);
    Pcg32 random(17);
    std::vector<std::uint64_t> observed(rings * sectors);
    for (int i = 0; i < count; ++i)
        ++observed[cell_of(n, sample(n, random_pair(random)).direction)];
    std::vector<double> expected;
    for (std::size_t cell = 0; cell < observed.size(); ++cell) {
        const double middle = (static_cast<double>(cell / sectors) + 0.5) / rings;
        const double solid_angle = 2.0 * std::numbers::pi / (rings * sectors);
        const Double3 direction =
            Basis(n).to_world({std::sqrt(1.0 - middle * middle), 0.0, middle});
        expected.push_back(count * solid_angle * pdf(n, direction));
    }
    return chi_square(observed, expected);
}

TEST_CASE("directions on a hemisphere are as dense as their densities say; a wrong one is caught") {
    const double limit = chi_square_limit(rings * sectors);
    Pcg32 random(4);
    for (int i = 0; i < 3; ++i) {
        const Double3 n = random_direction(random);
        CHECK(misfit(n, uniform_hemisphere, uniform_hemisphere_pdf) < limit);
        CHECK(misfit(n, cosine_hemisphere, cosine_hemisphere_pdf) < limit);
        CHECK(misfit(n, uniform_hemisphere, cosine_hemisphere_pdf) > 2.0 * limit);
        CHECK(misfit(n, cosine_hemisphere, uniform_hemisphere_pdf) > 2.0 * limit);
    }
    // A near miss: the height uniform in the square root of its right number.
    const auto wrong = [](const Double3& n, const Double2& u) {
        return DirectionSample{direction_at(n, std::sqrt(std::sqrt(1.0 - u.x)), u.y), 1.0};
    };
    CHECK(misfit({0, 0, 1}, wrong, cosine_hemisphere_pdf) > 2.0 * limit);
}

TEST_CASE("a sample's density is the density of its direction, and it is positive") {
    Pcg32 random(5);
    for (int i = 0; i < 10'000; ++i) {
        const Double3 n = random_direction(random);
        Double2 u = random_pair(random);
        if (i % 10 == 0) u.x = 1.0 - 0x1p-53;  // the lowest directions
        if (i % 10 == 1) u.x = 0.0;
        const DirectionSample uniform = uniform_hemisphere(n, u), cosine = cosine_hemisphere(n, u);
        REQUIRE(uniform.pdf == 0.5 / std::numbers::pi);
        REQUIRE(cosine.pdf > 0.0);
        REQUIRE(std::abs(cosine.pdf - cosine_hemisphere_pdf(n, cosine.direction)) < 1e-15);
        REQUIRE(std::abs(glm::length(cosine.direction) - 1.0) < 1e-15);
        REQUIRE(std::abs(glm::length(uniform.direction) - 1.0) < 1e-15);
    }
}

TEST_CASE("the mean of 1 / density is the hemisphere's solid angle, that of cosine / density pi") {
    Pcg32 random(6);
    Mean inverse, cosine;
    const Double3 n = random_direction(random);
    for (int i = 0; i < 100'000; ++i) {
        // 1 / pdf has no variance under a bound near the horizon: only the upper part is counted.
        const DirectionSample sample = cosine_hemisphere(n, random_pair(random));
        inverse.add(glm::dot(n, sample.direction) > 0.1 ? 1.0 / sample.pdf : 0.0);
        const DirectionSample other = uniform_hemisphere(n, random_pair(random));
        cosine.add(glm::dot(n, other.direction) / other.pdf);
    }
    CHECK(inverse.agrees_with(0.9 * 2.0 * std::numbers::pi));
    CHECK(cosine.agrees_with(std::numbers::pi));
}

TEST_CASE("a mirror keeps lengths, turns the way along the normal round, and twice is none") {
    Pcg32 random(7);
    for (int i = 0; i < 1'000; ++i) {
        const Double3 n = random_direction(random), d = random_direction(random);
        const Double3 m = mirrored(d, n);
        REQUIRE(std::abs(glm::dot(m, n) + glm::dot(d, n)) < 1e-15);
        REQUIRE(std::abs(glm::length(m) - 1.0) < 1e-15);
        REQUIRE(glm::distance(mirrored(m, n), d) < 2e-15);
        REQUIRE(mirrored(d, n) == mirrored(d, -n));
    }
}

TEST_CASE("the weights of a direction add up to 1 over the ways that can choose it") {
    Pcg32 random(8);
    for (int i = 0; i < 100'000; ++i) {
        const double p = std::exp(600.0 * random.uniform_double() - 300.0),
                     q = std::exp(600.0 * random.uniform_double() - 300.0);
        REQUIRE(std::abs(balance_heuristic(p, q) + balance_heuristic(q, p) - 1.0) < 4e-16);
        REQUIRE(std::abs(power_heuristic(p, q) + power_heuristic(q, p) - 1.0) < 4e-16);
    }
    CHECK(balance_heuristic(2.0, 0.0) == 1.0);
    CHECK(power_heuristic(2.0, 0.0) == 1.0);
    CHECK(power_heuristic(2.0, 1.0) == 0.8);
    CHECK(power_heuristic(1.0, std::numeric_limits<double>::max()) == 0.0);
}

TEST_CASE("two ways with any weights that add up to 1 have the right mean, and no others") {
    // The integral of 2 x over [0, 1] by densities 1 and 3 x^2.
    Mean balance, power, half_forgotten;
    Pcg32 random(9);
    for (int i = 0; i < 100'000; ++i) {
        const double x = random.uniform_double(), y = std::cbrt(1.0 - random.uniform_double());
        const double px = 3.0 * x * x, py = 3.0 * y * y;
        const double from_x = 2.0 * x, from_y = 2.0 * y / py;
        balance.add(balance_heuristic(1.0, px) * from_x + balance_heuristic(py, 1.0) * from_y);
        power.add(power_heuristic(1.0, px) * from_x + power_heuristic(py, 1.0) * from_y);
        half_forgotten.add(power_heuristic(1.0, px) * from_x + balance_heuristic(py, 1.0) * from_y);
    }
    CHECK(balance.agrees_with(1.0));
    CHECK(power.agrees_with(1.0));
    CHECK_FALSE(half_forgotten.agrees_with(1.0));
}

}  // namespace
}  // namespace space
