// The chapter's own are not the answer.
#pragma GCC poison cosine_hemisphere cosine_hemisphere_pdf
#include "ex01_pdf_of_the_cosine.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace space;

namespace {

constexpr double pi = std::numbers::pi;

/// Along the axes, up and down, and in all directions.
std::vector<Double3> normals() {
    std::vector<Double3> normals;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            Double3 n{0.0};
            n[axis] = sign;
            normals.push_back(n);
        }
    Pcg32 random(111);
    while (normals.size() < 20) normals.push_back(random_direction(random));
    return normals;
}

/// Two unit vectors at right angles to n and to each other.
std::array<Double3, 2> around(const Double3& n) {
    const Double3 aside = std::abs(n.z) < 0.7 ? Double3(0, 0, 1) : Double3(1, 0, 0);
    const Double3 x = glm::normalize(glm::cross(n, aside));
    return {x, glm::cross(n, x)};
}

/// The middles of 128 x 128 squares. What lies on one side of a curve in the square is counted
/// within some hundredth of all.
template <class See>
void for_each_direction(const Double3& n, const See& see) {
    constexpr int side = 128;
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            see(cosine_direction(n, {(i + 0.5) / side, (j + 0.5) / side}), 1.0 / (side * side));
}

}  // namespace

TEST_CASE("a direction has length 1 and lies on the side of the normal, whatever the numbers") {
    Pcg32 random(112);
    for (const Double3& n : normals())
        for (int i = 0; i < 300; ++i) {
            constexpr std::array<double, 3> ends{0.0, 1.0 - 0x1p-53, 0x1p-53};
            Double2 u;
            u.x = i < 9 ? ends[std::size_t(i / 3)] : random.uniform_double();
            u.y = i < 9 ? ends[std::size_t(i % 3)] : random.uniform_double();
            const Double3 direction = cosine_direction(n, u);
            CAPTURE(n, u, direction);
            REQUIRE(Error{std::abs(glm::length(direction) - 1.0), 1e-12});
            REQUIRE(glm::dot(direction, n) > -1e-12);
        }
}

TEST_CASE(
    "a quarter lies within 30 degrees of the normal, half within 45, three quarters within 60") {
    for (const Double3& n : normals()) {
        double quarter = 0.0, half = 0.0, three = 0.0;
        for_each_direction(n, [&](const Double3& direction, double share) {
            const double cosine = glm::dot(n, direction);
            if (cosine > std::cos(pi / 6)) quarter += share;
            if (cosine > std::cos(pi / 4)) half += share;
            if (cosine > std::cos(pi / 3)) three += share;
        });
        CAPTURE(n);
        REQUIRE(quarter == Approx(0.25).margin(0.01));
        REQUIRE(half == Approx(0.5).margin(0.01));
        REQUIRE(three == Approx(0.75).margin(0.01));
    }
}

TEST_CASE("all directions around the normal are alike, high above the surface and low") {
    for (const Double3& n : normals()) {
        const auto [x, y] = around(n);
        std::array<double, 16> shares{};
        for_each_direction(n, [&](const Double3& direction, double share) {
            const double turns =
                std::atan2(glm::dot(y, direction), glm::dot(x, direction)) / (2 * pi);
            const auto sector = static_cast<std::size_t>(std::clamp(8 * (turns + 0.5), 0.0, 7.0));
            const bool is_high = glm::dot(n, direction) > std::sqrt(0.5);
            shares[2 * sector + is_high] += share;
        });
        for (std::size_t i = 0; i < 16; ++i) {
            CAPTURE(n, i / 2, i % 2);
            REQUIRE(shares[i] == Approx(1.0 / 16).margin(0.005));
        }
    }
}

TEST_CASE("the mean of all directions is two thirds of the normal") {
    for (const Double3& n : normals()) {
        Double3 mean{0.0};
        for_each_direction(n, [&](const Double3& d, double share) { mean += share * d; });
        CAPTURE(n, mean);
        REQUIRE(Error{glm::length(mean - 2.0 / 3.0 * n), 0.005});
    }
}

TEST_CASE("the densities of all directions add up to 1") {
    for (const Double3& n : normals()) {
        const auto [x, y] = around(n);
        double sum = 0.0;
        constexpr int heights = 100, turns = 24;  // rings of equal solid angle
        for (int i = 0; i < heights; ++i)
            for (int j = 0; j < turns; ++j) {
                const double height = 2 * (i + 0.5) / heights - 1, angle = 2 * pi * j / turns;
                const double radius = std::sqrt(1 - height * height);
                const Double3 direction =
                    height * n + radius * (std::cos(angle) * x + std::sin(angle) * y);
                sum += cosine_density(n, direction) * 4 * pi / (heights * turns);
            }
        CAPTURE(n);
        REQUIRE(sum == Approx(1.0).epsilon(1e-9));
    }
}

TEST_CASE("straight up the density is twice that at 60 degrees, and below the surface 0") {
    for (const Double3& n : normals()) {
        const Double3 x = around(n)[0];
        CAPTURE(n);
        REQUIRE(cosine_density(n, n) > 0.0);
        REQUIRE(cosine_density(n, 0.5 * n + std::sqrt(0.75) * x) ==
                Approx(cosine_density(n, n) / 2).epsilon(1e-9));
        REQUIRE(cosine_density(n, -n) == 0.0);
        REQUIRE(cosine_density(n, 0.8 * x - 0.6 * n) == 0.0);
    }
}

TEST_CASE("below an even sky each direction alone gives the whole irradiance, pi") {
    for (const Double3& n : normals())
        for_each_direction(n, [&](const Double3& direction, double) {
            const double irradiance = glm::dot(n, direction) / cosine_density(n, direction);
            if (std::abs(irradiance - pi) < 1e-9) return;
            CAPTURE(n, direction);
            REQUIRE(irradiance == Approx(pi).epsilon(1e-9));
        });
}
