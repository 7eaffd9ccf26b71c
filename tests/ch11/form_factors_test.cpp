#include "chapters/ch11_sampling_and_caching/form_factors.hpp"

#include "common/pcg32.hpp"
#include "common/random.hpp"
#include "tests/ch11/up.hpp"
#include "tests/check.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

using namespace space;

namespace {

constexpr double pi = std::numbers::pi;

/// A rectangle above z = 0 that looks down.
std::array<Double3, 4> ceiling(double x0, double x1, double y0, double y1, double z) {
    return {Double3(x0, y0, z), Double3(x0, y1, z), Double3(x1, y1, z), Double3(x1, y0, z)};
}

/// A wall in the plane x = `x` that looks down the x axis.
std::array<Double3, 4> wall(double x, double y0, double y1, double z0, double z1) {
    return {Double3(x, y0, z0), Double3(x, y0, z1), Double3(x, y1, z1), Double3(x, y1, z0)};
}

double below(std::span<const Double3> polygon, const Double3& normal = up) {
    return polygon_irradiance(Double3(0.0), normal, polygon);
}

/// Rectangles of the textbooks (Howell, Menguc, Siegel, "A Catalog of Radiation Transfer
/// Configuration Factors", C-11): two a x b, one above the other at the distance c.
double facing(double a, double b, double c) {
    const double x = a / c, y = b / c, x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
    return 2 / (pi * x * y) *
           (std::log(x1 * y1 / std::sqrt(1 + x * x + y * y)) + x * y1 * std::atan(x / y1) +
            y * x1 * std::atan(y / x1) - x * std::atan(x) - y * std::atan(y));
}

/// C-14: a floor of the width w and a wall of the height h, which meet in an edge of the length l.
double meeting(double w, double h, double l) {
    const double W = w / l, H = h / l, W2 = W * W, H2 = H * H, all = 1 + W2 + H2;
    const double logarithm = std::log((1 + W2) * (1 + H2) / all) +
                             W2 * std::log(W2 * all / ((1 + W2) * (W2 + H2))) +
                             H2 * std::log(H2 * all / ((1 + H2) * (H2 + W2)));
    return (W * std::atan(1 / W) + H * std::atan(1 / H) -
            std::sqrt(H2 + W2) * std::atan(1 / std::sqrt(H2 + W2)) + logarithm / 4) /
           (pi * W);
}

const Rectangle floor_1{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
const Rectangle ceiling_1{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
const Rectangle wall_1{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// The mean over `from` of what its points see of `to`: the middles of n x n parts.
double by_points(const Rectangle& from, const Rectangle& to, int n) {
    const Double3 normal = glm::normalize(glm::cross(from.u, from.v));
    double sum = 0.0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            sum += polygon_irradiance(
                from.corner + from.u * ((i + 0.5) / n) + from.v * ((j + 0.5) / n), normal,
                to.corners());
    return sum / (n * n * pi);
}

}  // namespace

TEST_CASE("below a regular polygon the irradiance is that of its edges, all alike") {
    for (const int n : {3, 4, 6, 1000})
        for (const double height : {0.1, 1.0, 7.0}) {
            std::vector<Double3> corners;  // clockwise from above: its front looks down
            for (int i = 0; i < n; ++i)
                corners.emplace_back(std::cos(2 * pi * i / n), -std::sin(2 * pi * i / n), height);
            const double apothem = std::cos(pi / n), far = std::hypot(apothem, height);
            CAPTURE(n, height);
            REQUIRE(below(corners) ==
                    Approx(n * apothem / far * std::atan(std::sin(pi / n) / far)).epsilon(1e-13));
            // A disc of radius 1: pi / (1 + h^2).
            if (n == 1000) {
                REQUIRE(below(corners) == Approx(pi / (1 + height * height)).epsilon(1e-4));
            }
        }
}

TEST_CASE("below a corner of a rectangle, and beside one") {
    for (const double x : {0.3, 1.0, 5.0})
        for (const double y : {0.2, 1.0, 9.0}) {
            CAPTURE(x, y);
            const double x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
            REQUIRE(below(ceiling(0, x, 0, y, 1)) ==
                    Approx((x / x1 * std::atan(y / x1) + y / y1 * std::atan(x / y1)) / 2)
                        .epsilon(1e-13));
            const double r = std::sqrt(1 + x * x);  // a wall at the distance 1, x high, y wide
            REQUIRE(below(wall(1, 0, y, 0, x)) ==
                    Approx((std::atan(y) - std::atan(y / r) / r) / 2).epsilon(1e-13));
        }
}

TEST_CASE("a sky of radiance 1 gives pi, whatever the surface's tilt leaves of it") {
    CHECK(below(ceiling(-1e6, 1e6, -1e6, 1e6, 1)) == Approx(pi).epsilon(1e-5));
    // Tilted by 60 degrees: the part of the plane that is seen gives pi (1 + cos 60) / 2.
    const Double3 tilted{std::sin(pi / 3), 0, 0.5};
    CHECK(below(ceiling(-1e6, 1e6, -1e6, 1e6, 1), tilted) == Approx(0.75 * pi).epsilon(1e-5));
}

TEST_CASE("what is below the horizon gives nothing") {
    const auto whole = wall(1, -2, 3, -4, 5), upper = wall(1, -2, 3, 0, 5);
    CHECK(below(whole) == Approx(below(upper)).epsilon(1e-14));
    CHECK(below(wall(1, -2, 3, -5, -1)) == 0.0);
    CHECK(below(wall(1, -2, 3, -5, 0)) == 0.0);
    // A triangle with one corner below, cut by hand at a third of each of two edges.
    const std::array<Double3, 3> triangle{Double3(2, 0, -1), Double3(2, -3, 2), Double3(2, 3, 2)};
    const std::array<Double3, 4> above{Double3(2, -1, 0), Double3(2, -3, 2), Double3(2, 3, 2),
                                       Double3(2, 1, 0)};
    CHECK(below(triangle) == Approx(below(above)).epsilon(1e-14));
}

TEST_CASE("a polygon shines to its front alone") {
    auto corners = ceiling(-1, 2, -1, 1, 1);
    CHECK(below(corners) > 0.5);
    std::swap(corners[1], corners[3]);
    CHECK(below(corners) == 0.0);
}

TEST_CASE("the parts of a polygon give as much as the whole, across the horizon, too") {
    Pcg32 random(1);
    for (int i = 0; i < 1000; ++i) {
        const Double3 a{random_vector(random)}, b{random_vector(random)}, c{random_vector(random)};
        const Double3 normal = random_direction(random);
        const Double3 middle = (a + b + c) / 3.0;
        CAPTURE(i, a, b, c, normal);
        // Near the plane of the triangle angles are near pi and the sum cancels.
        if (std::abs(glm::dot(glm::normalize(glm::cross(b - a, c - a)), a)) < 0.01) continue;
        const auto part = [&](const Double3& p, const Double3& q, const Double3& r) {
            return below(std::array{p, q, r}, normal);
        };
        REQUIRE(std::abs(part(a, b, c) - part(a, b, middle) - part(b, c, middle) -
                         part(c, a, middle)) < 1e-12);
    }
}

TEST_CASE("irradiance is the integral of cosines over squared distance") {
    const int n = 400;  // the middles of n x n parts: an error of some (4 / n)^2 / 24
    const auto lamp = ceiling(-1, 3, 0.5, 2, 1.5);
    for (const Double3& normal : {up, Double3(0.6, 0, 0.8), Double3(0, -0.8, 0.6)}) {
        double sum = 0.0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const Double3 to{-1 + 4 * (i + 0.5) / n, 0.5 + 1.5 * (j + 0.5) / n, 1.5};
                const double square = glm::dot(to, to);
                sum += std::max(0.0, glm::dot(to, normal)) * to.z / (square * square);
            }
        CAPTURE(normal);
        REQUIRE(below(lamp, normal) == Approx(sum * 6.0 / (n * n)).epsilon(1e-4));
    }
}

TEST_CASE("far from the polygon as many digits are lost as the distance has in its sizes") {
    for (const double d : {1e2, 1e4, 1e6}) {
        // 1 / d^2 but for a part of 1 / d^2 of it.
        const double error = below(ceiling(-0.5, 0.5, -0.5, 0.5, d)) * d * d - 1.0;
        CAPTURE(d, error);
        CHECK(std::abs(error) < 1.0 / (d * d) + d * 4e-16);
    }
}

TEST_CASE("squares of a cube see a fifth of each other: 0.19982 across, 0.20004 around the edge") {
    CHECK(form_factor(floor_1, ceiling_1) == Approx(0.199824895698).epsilon(1e-11));
    CHECK(form_factor(floor_1, wall_1) == Approx(0.200043776075).epsilon(1e-11));
}

TEST_CASE("parallel and perpendicular rectangles are those of the catalogue") {
    for (const double a : {0.1, 0.5, 1.0, 4.0, 20.0})
        for (const double b : {0.2, 1.0, 10.0}) {
            CAPTURE(a, b);
            const Rectangle low{{0, 0, 0}, {a, 0, 0}, {0, b, 0}},
                high{{0, 0, 1}, {0, b, 0}, {a, 0, 0}};
            REQUIRE(form_factor(low, high) == Approx(facing(a, b, 1)).epsilon(1e-10));
            const Rectangle flat{{0, 0, 0}, {a, 0, 0}, {0, 1, 0}},
                upright{{0, 0, 0}, {0, 1, 0}, {0, 0, b}};
            REQUIRE(form_factor(flat, upright) == Approx(meeting(a, b, 1)).epsilon(1e-10));
        }
}

TEST_CASE("long strips: crossed strings (Hottel)") {
    const double l = 1e4;  // the ends cost some 1 / l
    const Rectangle low{{0, 0, 0}, {2, 0, 0}, {0, l, 0}}, high{{0, 0, 1}, {0, l, 0}, {2, 0, 0}};
    CHECK(form_factor(low, high) == Approx(std::sqrt(1.25) - 0.5).epsilon(1e-3));
    const Rectangle upright{{0, 0, 0}, {0, l, 0}, {0, 0, 3}};
    CHECK(form_factor(low, upright) == Approx((2 + 3 - std::sqrt(13.0)) / 4).epsilon(1e-3));
}

TEST_CASE("rectangles that are moved and of different sizes: the mean of Lambert's formula") {
    const Rectangle low{{-1, 2, 0}, {3, 0, 0}, {0, 0.5, 0}};
    for (const Rectangle& to :
         {Rectangle{{0.5, 1, 2}, {0, 1, 0}, {4, 0, 0}},
          Rectangle{{5, 7, 0.7}, {0, 2, 0}, {1, 0, 0}},
          Rectangle{{-1.5, 1, 0.5}, {0, 3, 0}, {0, 0, 1}},
          Rectangle{{4, 1, 0}, {0, 0, 2}, {0, 3, 0}}, Rectangle{{-4, 4, 0}, {9, 0, 0}, {0, 0, 1}},
          Rectangle{{1, 1, 3}, {1, 0, 0}, {0, 0, -2}}}) {
        CAPTURE(to.corner, to.u, to.v);
        // The middles of 40 x 40 parts of 3 x 0.5, at distances of 0.5 or more.
        REQUIRE(form_factor(low, to) > 5e-5);
        REQUIRE(form_factor(low, to) == Approx(by_points(low, to, 40)).epsilon(1e-3));
        REQUIRE(form_factor(to, low) == Approx(by_points(to, low, 40)).epsilon(1e-3));
    }
}

TEST_CASE("what goes there would come back") {
    const Rectangle low{{-1, 2, 0}, {3, 0, 0}, {0, 0.5, 0}}, high{{0, 1, 2}, {0, 1, 0}, {4, 0, 0}};
    CHECK(exchange_area(low, high) == Approx(exchange_area(high, low)).epsilon(1e-14));
    CHECK(form_factor(low, high) * low.area() ==
          Approx(form_factor(high, low) * high.area()).epsilon(1e-14));
}
