#include "ex04_radius_clamp.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

using namespace space;

namespace {

constexpr double nothing = std::numeric_limits<double>::infinity();

/// The radius of a record that has no others.
double alone(std::vector<double> distances, double low = 0.01, double high = 100.0) {
    const std::vector<Record> records{{Double3(0.0), std::move(distances)}};
    const std::vector<double> radii = record_radii(records, low, high);
    REQUIRE(radii.size() == 1);
    return radii[0];
}

/// Records with one ray each: their places along x, and what it met.
std::vector<double> in_a_row(const std::vector<std::pair<double, double>>& row, double low = 0.01,
                             double high = 100.0) {
    std::vector<Record> records;
    for (const auto& [x, distance] : row) records.push_back({Double3(x, 0, 0), {distance}});
    const std::vector<double> radii = record_radii(records, low, high);
    REQUIRE(radii.size() == row.size());
    return radii;
}

using Radii = std::vector<double>;

std::vector<Record> random_records(Pcg32& random, std::size_t count) {
    std::vector<Record> records;
    while (records.size() < count) {
        Record record{Double3(random_point(random, 0.0f, 4.0f)), {}};
        for (std::uint32_t rays = 1 + random.below(8); rays > 0; --rays) {
            const int exponent = int(random.below(8)) - 3;
            const double distance = std::ldexp(random.uniform_double(), exponent);
            const std::uint32_t kind = random.below(20);
            record.distances.push_back(kind > 1 ? distance : kind > 0 ? nothing : 0.0);
        }
        records.push_back(std::move(record));
    }
    return records;
}

/// By the definition: down and down, until nothing is too large.
Radii slowly(const std::vector<Record>& records, double low, double high) {
    Radii radii;
    for (const Record& record : records) {
        double sum = 0.0;
        for (const double d : record.distances) sum += 1.0 / d;
        radii.push_back(std::clamp(double(record.distances.size()) / sum, low, high));
    }
    for (bool changes = true; changes;) {
        changes = false;
        for (std::size_t i = 0; i < radii.size(); ++i)
            for (std::size_t j = 0; j < radii.size(); ++j) {
                const double most =
                    radii[j] + glm::distance(records[i].position, records[j].position);
                if (radii[i] > most * (1 + 1e-14)) radii[i] = most, changes = true;
            }
    }
    return radii;
}

}  // namespace

TEST_CASE("without records there are no radii") {
    CHECK(record_radii({}, 1, 2).empty());
}

TEST_CASE("equal distances are the radius, of different ones the harmonic mean") {
    CHECK(alone({2}) == 2.0);
    CHECK(alone({3, 3, 3}) == Approx(3.0).epsilon(1e-14));
    CHECK(alone({1, 3}) == Approx(1.5).epsilon(1e-14));
    CHECK(alone({6, 3, 2}) == Approx(3.0).epsilon(1e-14));
}

TEST_CASE("a ray that met nothing adds nothing to the sum, and counts") {
    CHECK(alone({1, nothing}) == Approx(2.0).epsilon(1e-14));
    CHECK(alone({nothing, 2, nothing, nothing}) == Approx(8.0).epsilon(1e-14));
}

TEST_CASE("below an open sky the radius is high, in a corner low") {
    CHECK(alone({nothing}) == 100.0);
    CHECK(alone({nothing, nothing, nothing}) == 100.0);
    CHECK(alone({1e6, nothing}) == 100.0);
    CHECK(alone({1e-9, 5}) == 0.01);
    CHECK(alone({0, 5}) == 0.01);
    CHECK(alone({0, nothing}) == 0.01);
    CHECK(alone({0}) == 0.01);
    CHECK(alone({0.5, 0.5}, 2, 3) == 2.0);
    CHECK(alone({1e-320, 1e-320}) == 0.01);
}

TEST_CASE("the range is for the mean, not for each distance") {
    CHECK(alone({1, 1000}, 0.5, 1.5) == 1.5);  // the mean is 1.998
    CHECK(alone({0.1, nothing}, 0.15, 1) == Approx(0.2).epsilon(1e-14));
}

TEST_CASE("two records: what one sees, the other must have nearly as near") {
    CHECK(in_a_row({{0, 1}, {2, 10}}) == Radii{1, 3});
    CHECK(in_a_row({{0, 10}, {2, 1}}) == Radii{3, 1});  // and whoever comes first
    CHECK(in_a_row({{0, 1}, {2, 2.5}}) == Radii{1, 2.5});
    CHECK(in_a_row({{0, 1}, {-5, 10}}) == Radii{1, 6});  // also beyond both radii
    CHECK(in_a_row({{7, nothing}, {0, nothing}}) == Radii{100, 100});
    CHECK(in_a_row({{3, 5}, {3, 4}}) == Radii{4, 4});
}

TEST_CASE("first the range, then the neighbours") {
    // The corner's own radius is 0, but it serves up to 1, and so allows 1 + 3.
    CHECK(in_a_row({{0, 0}, {3, 50}}, 1, 20) == Radii{1, 4});
    CHECK(in_a_row({{0, 8}, {3, 50}}, 1, 10) == Radii{8, 10});
}

TEST_CASE("distances are measured in space") {
    const std::vector<Record> records{{Double3(1, 2, 3), {1}}, {Double3(3, 5, 9), {50}}};
    CHECK(record_radii(records, 0.01, 100) == Radii{1, 8});  // 2, 3, 6: 7
}

TEST_CASE("every record may be the one that tells all others") {
    for (std::size_t sees = 0; sees < 7; ++sees) {
        std::vector<std::pair<double, double>> row;
        Radii expected;
        for (std::size_t i = 0; i < 7; ++i) {
            const double apart = std::abs(double(i) - double(sees));
            row.emplace_back(double(i), i == sees ? 0.5 : 50.0);
            expected.push_back(0.5 + apart);
        }
        CAPTURE(sees);
        REQUIRE(in_a_row(row) == expected);
    }
}

TEST_CASE("random records, by the definition") {
    Pcg32 random(116);
    for (int i = 0; i < sized(300, 60); ++i) {
        const std::vector<Record> records = random_records(random, 1 + random.below(20));
        const Radii expected = slowly(records, 0.05, 3.0);
        const Radii is = record_radii(records, 0.05, 3.0);
        REQUIRE(is.size() == records.size());
        for (std::size_t k = 0; k < is.size(); ++k) {
            CAPTURE(i, k);
            REQUIRE(is[k] == Approx(expected[k]).epsilon(1e-12));
        }
    }
}
