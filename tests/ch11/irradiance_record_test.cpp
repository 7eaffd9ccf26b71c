// Where a record of the radiance cache may be used, by hand and where the plain estimate fails:
// radii of 0 and infinity, the point of the record itself, records in front.
#include "chapters/ch11_sampling_and_caching/irradiance_record.hpp"

#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/up.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace space {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

IrradianceRecord record_at(const Double3& position, double radius, const Double3& normal = up) {
    IrradianceRecord record{.position = position, .normal = normal, .irradiance = Double3(1.0)};
    record.radius = radius;
    return record;
}

/// As published: each weighs 1 / error, and is used where that exceeds 1 / accuracy.
double plain_weight(const IrradianceRecord& record, const Double3& x, const Double3& n) {
    return 1.0 / (glm::length(x - record.position) / record.radius +
                  std::sqrt(1.0 - glm::dot(n, record.normal)));
}
Double3 plain_mean(std::span<const IrradianceRecord> records, const Double3& x, const Double3& n,
                   double accuracy) {
    Double3 sum{0.0};
    double weights = 0.0;
    for (const IrradianceRecord& record : records) {
        const double weight = plain_weight(record, x, n);
        if (!(weight > 1.0 / accuracy)) continue;
        sum += weight * record.irradiance;
        weights += weight;
    }
    return sum / weights;
}

/// A slope's record: red grows by `slope` along x.
IrradianceRecord sloping(double radius, double slope) {
    IrradianceRecord record = record_at({0, 0, 0}, radius);
    record.translation_gradient[0][0] = slope;
    return record;
}

}  // namespace

TEST_CASE("the split-sphere error is the distance in radii and the turn, as reckoned by hand") {
    const IrradianceRecord record = record_at({1, 2, 3}, 4.0);
    CHECK(split_sphere_error(record, {1, 2, 3}, up) == 0.0);
    CHECK(split_sphere_error(record, {2, 2, 3}, up) == 0.25);
    CHECK(split_sphere_error(record, {1, 2, 3}, {1, 0, 0}) == Approx(1.0));
    CHECK(split_sphere_error(record, {1, 2, 3}, -up) == Approx(std::sqrt(2.0)));
    CHECK(split_sphere_error(record, {1, -2, 6}, {0, 0.6, 0.8}) ==
          Approx(1.25 + std::sqrt(1.0 - 0.8)));
}

TEST_CASE("the published weight and that of the error are one number") {
    Pcg32 random(11);
    for (int i = 0; i < 1'000; ++i) {
        const Double3 position = random_direction(random), normal = random_direction(random);
        const Double3 x = random_direction(random), n = random_direction(random);
        const IrradianceRecord record = record_at(position, 0.7, normal);
        CHECK(1.0 / split_sphere_error(record, x, n) ==
              Approx(plain_weight(record, x, n)).epsilon(1e-9));
    }
}

TEST_CASE("M5: the plain mean is no number at a record, and it has no bounds under an open sky") {
    const std::vector records{record_at({0, 0, 0}, 1.0), record_at({0.1, 0, 0}, 1.0)};
    CHECK(std::isnan(plain_mean(records, {0, 0, 0}, up, 0.3).x));

    // Its rays all met something at once, or nothing at all.
    const std::vector corner{record_at({0, 0, 0}, 0.0)}, sky{record_at({0, 0, 0}, infinite)};
    CHECK(std::isnan(plain_mean(corner, {0, 0, 0}, up, 0.3).x));
    CHECK(std::isnan(plain_mean(corner, {1e-300, 0, 0}, up, 0.3).x));  // nothing is valid
    CHECK(plain_weight(sky[0], {1e9, 0, 0}, up) == infinite);
    CHECK(std::isnan(plain_mean(sky, {1e9, 0, 0}, up, 0.3).x));
}

TEST_CASE("M5: limited radii are usable, and a record has no error at itself") {
    const RadiusLimits limits{.smallest = 0.01, .largest = 10.0};
    for (const double radius : {0.0, 1e-300, 0.01, 1.0, 10.0, 1e300, infinite}) {
        IrradianceRecord record = record_at({0, 0, 0}, radius);
        CHECK(split_sphere_error(record, {0, 0, 0}, up) == 0.0);
        limit_radius(record, limits);
        CHECK(record.radius == std::clamp(radius, 0.01, 10.0));
        CHECK(std::isfinite(split_sphere_error(record, {1e-300, 0, 0}, up)));
        CHECK(split_sphere_error(record, {1e9, 0, 0}, up) > 1e7);
    }
}

TEST_CASE("a radius shrinks where the light changes fast, and no step of a radius takes it all") {
    const RadiusLimits limits{.smallest = 0.5, .largest = 10.0};
    IrradianceRecord gentle = sloping(2.0, 0.5), steep = sloping(2.0, 3.0),
                     cliff = sloping(2.0, 9.0);
    for (IrradianceRecord* record : {&gentle, &steep, &cliff}) {
        limit_radius(*record, limits);
        CHECK(record->translation_gradient[0][0] * record->radius <= 3.0);
    }
    CHECK(gentle.radius == 2.0);  // 3 of irradiance in all, 0.5 of slope
    CHECK(gentle.translation_gradient[0][0] == 0.5);
    CHECK(steep.radius == 1.0);
    CHECK(steep.translation_gradient[0][0] == 3.0);
    CHECK(cliff.radius == 0.5);
    CHECK(cliff.translation_gradient[0][0] == Approx(6.0));
    CHECK(extrapolated(cliff, {-0.5, 0, 0}, up) == Double3(0, 1, 1));
}

TEST_CASE("a record on a step lies in front of the step's foot, and the foot not of the step") {
    const IrradianceRecord above = record_at({0, 0, 1}, 10.0), below = record_at({0.1, 0, 0}, 10.0);
    CHECK(lies_in_front(above, below.position, up));
    CHECK_FALSE(lies_in_front(below, above.position, up));
    CHECK_FALSE(lies_in_front(above, {0.1, 0, 1}, up));
}

TEST_CASE("records beyond an edge of two neighbouring faces do not lie in front") {
    Pcg32 random(12);
    for (int i = 0; i < 10'000; ++i) {
        // The edge is the y axis; the faces fall, or rise, from there by half of the angle each.
        const double half = double(random.uniform(-0.5f, 0.5f));
        const double left = double(random.uniform(0.0f, 2.0f)), y = double(random.uniform());
        const double right = double(random.uniform(0.0f, 2.0f));
        const Double3 to_left{-std::cos(half), 0, -std::sin(half)};
        const Double3 to_right{std::cos(half), 0, -std::sin(half)};
        const Double3 n_left{-std::sin(half), 0, std::cos(half)};
        const Double3 n_right{std::sin(half), 0, std::cos(half)};
        const IrradianceRecord record = record_at(left * to_left + Double3(0, y, 0), 1.0, n_left);
        CAPTURE(half, left, right, y);
        REQUIRE_FALSE(lies_in_front(record, right * to_right, n_right));
    }
}

TEST_CASE("a plane's points do not lie in front of each other for being rounded to floats") {
    Pcg32 random(13);
    int by_rounding = 0;
    for (int i = 0; i < 10'000; ++i) {
        const Double3 n = random_direction(random);
        const Double3 origin = 1'000.0 * random_direction(random);
        const Double3 one = glm::cross(n, random_direction(random));
        const Double3 other = glm::cross(n, random_direction(random));
        const Double3 x{Point3(origin + one)};
        const IrradianceRecord record = record_at(Double3(Point3(origin + other)), 1.0, n);
        by_rounding += glm::dot(record.position - x, n) > 0.0;
        REQUIRE_FALSE(lies_in_front(record, x, n));
    }
    CHECK(by_rounding > 4'000);
}

}  // namespace space
