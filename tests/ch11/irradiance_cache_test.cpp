// Records in octrees: against a loop over all of them, with fields whose answers are known, with
// neighbours clamped, and with a wall.
#include "chapters/ch11_sampling_and_caching/irradiance_cache.hpp"

#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/up.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

namespace space {
namespace test {
extern std::atomic<std::ptrdiff_t> allocations_left;  // tests/ch05/allocations.cpp
}

namespace {

/// Anywhere in a cube of edge 2, of radii from 2^-6 to 2.
std::vector<IrradianceRecord> random_records(std::size_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<IrradianceRecord> records(count);
    for (IrradianceRecord& record : records) {
        record.position = Double3(random_vector(random));
        record.normal = random_direction(random);
        record.irradiance = Double3(2.0) + Double3(random_vector(random));
        record.radius = std::exp2(double(random.uniform(-6.0f, 1.0f)));
        record.nearest = std::exp2(double(random.uniform(-6.0f, 1.0f)));
        for (int axis = 0; axis < 3; ++axis) {
            record.translation_gradient[axis] = Double3(random_vector(random));
            record.rotation_gradient[axis] = Double3(random_vector(random));
        }
    }
    return records;
}

/// What the cache must say, by a loop over all.
std::optional<Double3> by_loop(std::span<const IrradianceRecord> records, double accuracy,
                               const Double3& x, const Double3& n) {
    Double3 sum{0.0};
    double weights = 0.0;
    for (const IrradianceRecord& record : records) {
        const double error = split_sphere_error(record, x, n);
        if (error >= accuracy || lies_in_front(record, x, n)) continue;
        if (error == 0.0) return record.irradiance;
        const double weight = 1.0 / error - 1.0 / accuracy;
        sum += weight * extrapolated(record, x, n);
        weights += weight;
    }
    if (weights == 0.0) return std::nullopt;
    return sum / weights;
}

/// A grid of records on the floor whose irradiance and gradient are those of a field.
template <class Field, class Slope>
IrradianceCache cache_of(const Field& field, const Slope& slope, double accuracy, bool gradients) {
    std::vector<IrradianceRecord> records;
    for (double x = -2.0; x <= 2.0; x += accuracy / 2)
        for (double y = -2.0; y <= 2.0; y += accuracy / 2) {
            IrradianceRecord record{.position = {x, y, 0}, .normal = up};
            record.irradiance = Double3(field(record.position));
            record.radius = 1.0;
            if (gradients) {
                const Double3 by_axis = slope(record.position);
                for (int axis = 0; axis < 3; ++axis)
                    record.translation_gradient[axis] = Double3(by_axis[axis]);
            }
            records.push_back(record);
        }
    IrradianceCache cache(accuracy);
    cache.add(records);
    return cache;
}

/// The largest difference at 1000 points of the floor.
template <class Field>
double largest_error(const IrradianceCache& cache, const Field& field) {
    Pcg32 random(5);
    double largest = 0.0;
    for (int i = 0; i < 1'000; ++i) {
        Double3 x{random_vector(random)};
        x.z = 0.0;
        largest = std::max(largest, std::abs(cache.irradiance(x, up).value().x - field(x)));
    }
    return largest;
}

double plane(const Double3& x) {
    return 10.0 + 2.0 * x.x - 3.0 * x.y;
}
Double3 plane_slope(const Double3&) {
    return {2.0, -3.0, 0.0};
}
double bowl(const Double3& x) {
    return 10.0 + x.x * x.x - x.x * x.y;
}
Double3 bowl_slope(const Double3& x) {
    return {2.0 * x.x - x.y, -x.x, 0.0};
}

}  // namespace

TEST_CASE("the octrees answer as a loop over all records") {
    constexpr double accuracy = 0.5;
    const auto records = random_records(sized(3'000, 300), 21);
    IrradianceCache cache(accuracy);
    cache.add(std::span(records).first(100));
    cache.add(std::span(records).subspan(100));
    Pcg32 random(22);
    int answers = 0;
    for (int i = 0; i < sized(3'000, 300); ++i) {
        const Double3 n = random_direction(random), x{random_vector(random)};
        const auto mine = cache.irradiance(x, n), right = by_loop(cache.records(), accuracy, x, n);
        REQUIRE(mine.has_value() == right.has_value());
        REQUIRE(cache.covers(x, n) == right.has_value());
        if (!mine) continue;
        ++answers;
        REQUIRE(glm::length(*mine - *right) <= 1e-11 * glm::length(*right));
    }
    CHECK(answers > sized(100, 2));
}

TEST_CASE("records far from the origin are found to the end of their reach") {
    // There the trees' floats are coarse: 2^-10 apart.
    Pcg32 random(23);
    for (int i = 0; i < 1'000; ++i) {
        const Double3 away = 1e4 * random_direction(random);
        IrradianceRecord record{.position = away, .normal = up, .irradiance = Double3(1.0)};
        record.radius = 0.9999 * 0x1p-6;  // just below what their octree is asked for
        IrradianceCache cache(0.5);
        cache.add(std::span(&record, 1));
        const double angle = 2.0 * std::numbers::pi * random.uniform_double();
        const Double3 way{std::cos(angle), std::sin(angle), 0.0};
        REQUIRE(cache.covers(away + 0.499 * record.radius * way, up));
        REQUIRE_FALSE(cache.covers(away + 0.501 * record.radius * way, up));
    }
}

TEST_CASE("M5: at a record the cache says what the record does, and of equal ones the first") {
    auto records = random_records(200, 24);
    for (const IrradianceRecord& record : std::vector(records)) {
        records.push_back(record);
        records.back().irradiance *= 2.0;
    }
    IrradianceCache cache(0.5);
    cache.add(records);
    for (std::size_t i = 0; i < 200; ++i)
        REQUIRE(cache.irradiance(records[i].position, records[i].normal) == records[i].irradiance);
}

TEST_CASE("no record reaches past the nearest surface that it knows of") {
    IrradianceRecord record{.position = {1, 2, 3}, .normal = up, .irradiance = Double3(1.0)};
    record.radius = 4.0;
    record.nearest = 0.5;
    IrradianceCache cache(0.25);
    cache.add(std::span(&record, 1));
    CHECK(cache.records()[0].radius == 2.0);
    CHECK(cache.covers({1.4999, 2, 3}, up));
    CHECK_FALSE(cache.covers({1.5, 2, 3}, up));
}

TEST_CASE("M5: records that are valid nowhere or everywhere are refused") {
    IrradianceCache cache(0.5);
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double radius : {0.0, -1.0, infinite, std::nan("")}) {
        IrradianceRecord record;
        record.radius = radius;
        CHECK_THROWS_AS(cache.add(std::span(&record, 1)), std::invalid_argument);
    }
    IrradianceRecord record;
    record.radius = 1.0;
    record.nearest = 0.0;
    CHECK_THROWS_AS(cache.add(std::span(&record, 1)), std::invalid_argument);
    record.nearest = infinite;
    record.position.y = infinite;
    CHECK_THROWS_AS(cache.add(std::span(&record, 1)), std::invalid_argument);
    CHECK(cache.records().empty());
    CHECK_FALSE(cache.irradiance({0, 0, 0}, up).has_value());
}

TEST_CASE("an even field comes back as it is") {
    const auto even = [](const Double3&) { return 0.7; };
    const auto flat = [](const Double3&) { return Double3(0.0); };
    CHECK(largest_error(cache_of(even, flat, 0.4, true), even) < 1e-14);
    CHECK(largest_error(cache_of(even, flat, 0.4, false), even) < 1e-14);
}

TEST_CASE(
    "with gradients a linear field is exact; without them the error falls with the accuracy") {
    double before = 1e9;
    for (const double accuracy : {0.4, 0.2, 0.1}) {
        CHECK(largest_error(cache_of(plane, plane_slope, accuracy, true), plane) < 1e-13);
        // No record is farther than the accuracy in radii, which are 1.
        const double plain = largest_error(cache_of(plane, plane_slope, accuracy, false), plane);
        CHECK(plain <= accuracy * std::sqrt(13.0));
        CHECK(plain < 0.6 * before);
        CHECK(plain > 1e-3);
        before = plain;
    }
}

TEST_CASE("with gradients a curved field's error falls with the square of the accuracy") {
    double before = 1e9;
    for (const double accuracy : {0.4, 0.2, 0.1}) {
        const double error = largest_error(cache_of(bowl, bowl_slope, accuracy, true), bowl);
        const double plain = largest_error(cache_of(bowl, bowl_slope, accuracy, false), bowl);
        CHECK(error <= 1.21 * accuracy * accuracy);  // half of the largest curvature, 1 + sqrt 2
        CHECK(error < 0.3 * before);
        CHECK(error < plain);
        before = error;
    }
}

TEST_CASE(
    "clamped to neighbours, the nearest surface is the least of any neighbour's and the way") {
    constexpr double accuracy = 0.3;
    const auto records = random_records(sized(2'000, 200), 25);
    IrradianceCache cache(accuracy), parallel(accuracy);
    cache.add(records);
    parallel.add(records);
    cache.clamp_to_neighbours(1);
    parallel.clamp_to_neighbours(3);
    std::size_t lowered = 0;
    for (std::size_t i = 0; i < records.size(); ++i) {
        double least = records[i].nearest;
        for (const IrradianceRecord& other : records)
            least =
                std::min(least, other.nearest + glm::length(other.position - records[i].position));
        REQUIRE(cache.records()[i].nearest == least);
        REQUIRE(cache.records()[i].radius == std::min(records[i].radius, least / accuracy));
        REQUIRE(parallel.records()[i].nearest == least);
        lowered += least < records[i].nearest;
    }
    CHECK(lowered > records.size() / 10);
    cache.clamp_to_neighbours(1);  // ways by way of others are no shorter
    for (std::size_t i = 0; i < records.size(); ++i)
        REQUIRE(cache.records()[i].nearest == Approx(parallel.records()[i].nearest).epsilon(1e-14));
}

TEST_CASE(
    "through a wall that mean distances overlook light leaks, and not past clamped neighbours") {
    // Beside a long wall of a wide hall the mean distance is 3 pi / 2 times that of the wall. All
    // rays but those of one record, the nearest, have missed what stands there.
    constexpr double accuracy = 0.5;
    std::vector<IrradianceRecord> lit_side;
    for (const double x : {-1.6, -0.8, -0.4, -0.2, -0.1, -0.05, -0.025}) {
        lit_side.push_back({.position = {x, 0, 0}, .normal = up, .irradiance = Double3(1.0)});
        lit_side.back().radius = 1.5 * std::numbers::pi * std::abs(x);
    }
    lit_side.back().nearest = 0.025;
    IrradianceCache plain(accuracy), clamped(accuracy);
    plain.add(lit_side);
    clamped.add(lit_side);
    clamped.clamp_to_neighbours(1);
    CHECK(plain.covers({0.5, 0, 0}, up));  // half a metre behind the wall
    for (double x = 0.001; x < 2.0; x += 0.001) REQUIRE_FALSE(clamped.covers({x, 0, 0}, up));
    for (double x = -2.0; x < -0.001; x += 0.001) REQUIRE(clamped.covers({x, 0, 0}, up));
}

TEST_CASE("asking allocates nothing") {
    IrradianceCache cache(0.5);
    cache.add(random_records(500, 26));
    Pcg32 random(27);
    int answers = 0;
    test::allocations_left = 0;  // the next one throws
    for (int i = 0; i < 1'000; ++i) {
        const Double3 n = random_direction(random), x{random_vector(random)};
        answers += cache.irradiance(x, n).has_value();
    }
    test::allocations_left = -1;
    CHECK(answers > 0);
}

}  // namespace space
