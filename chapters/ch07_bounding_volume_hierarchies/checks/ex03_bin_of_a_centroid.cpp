#include "ex03_bin_of_a_centroid.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace space;

namespace {

constexpr float largest = std::numeric_limits<float>::max(),
                smallest = std::numeric_limits<float>::denorm_min();

/// From low to high, none of them out of the bins and none before the one below it.
void check_in_order(std::vector<float> centroids, std::size_t bins) {
    std::ranges::sort(centroids);
    const float low = centroids.front(), high = centroids.back();
    std::size_t before = 0;
    for (const float centroid : centroids) {
        const std::size_t bin = bin_of(centroid, low, high, bins);
        if (bin >= bins || bin < before) {
            CAPTURE(Number{centroid}, Number{low}, Number{high}, bins, before);
            REQUIRE(bin < bins);
            REQUIRE(bin >= before);
        }
        before = bin;
    }
    if (low == high) return;
    REQUIRE(bin_of(low, low, high, bins) == 0);
    REQUIRE(bin_of(high, low, high, bins) == bins - 1);
}

float any_float(Pcg32& random) {
    for (;;)
        if (const auto x = std::bit_cast<float>(random.next()); std::isfinite(x)) return x;
}

}  // namespace

TEST_CASE("four bins from 0 to 8: each is two wide, and boundaries belong to the upper one") {
    const std::size_t wanted[] = {0, 0, 1, 1, 2, 2, 3, 3};
    for (int i = 0; i < 8; ++i) {
        CAPTURE(i);
        REQUIRE(bin_of(float(i), 0, 8, 4) == wanted[i]);
        REQUIRE(bin_of(float(i) + 0.5f, 0, 8, 4) == wanted[i]);
    }
}

TEST_CASE("the centroid at the upper end is in the last bin, not beyond it") {
    CHECK(bin_of(8, 0, 8, 4) == 3);
    CHECK(bin_of(3, -2, 3, 16) == 15);
    CHECK(bin_of(1, 0, 1, 1) == 0);
}

TEST_CASE("bins begin at the lower end, wherever that is") {
    CHECK(bin_of(-8, -8, 8, 4) == 0);
    CHECK(bin_of(-4, -8, 8, 4) == 1);
    CHECK(bin_of(-4.5f, -8, 8, 4) == 0);
    CHECK(bin_of(0, -8, 8, 4) == 2);
    CHECK(bin_of(1'025, 1'000, 1'100, 4) == 1);
    CHECK(bin_of(-1'075, -1'100, -1'000, 4) == 1);
}

TEST_CASE("where all centroids are at one place the bin is 0") {
    for (const float place : {0.0f, -0.0f, 1.0f, -3.5f, largest, -largest, smallest}) {
        CAPTURE(Number{place});
        REQUIRE(bin_of(place, place, place, 16) == 0);
        REQUIRE(bin_of(place, place, place, 1) == 0);
    }
    CHECK(bin_of(0.0f, -0.0f, 0.0f, 8) == 0);
}

TEST_CASE("one bin holds all") {
    for (const float centroid : {0.0f, 1.0f, 4.0f, 7.0f}) CHECK(bin_of(centroid, 0, 7, 1) == 0);
}

TEST_CASE("an extent that is too large for a float is cut like any other") {
    CHECK(bin_of(-largest, -largest, largest, 4) == 0);
    CHECK(bin_of(-0.75f * largest, -largest, largest, 4) == 0);
    CHECK(bin_of(-0.25f * largest, -largest, largest, 4) == 1);
    CHECK(bin_of(0, -largest, largest, 4) == 2);
    CHECK(bin_of(largest, -largest, largest, 4) == 3);
    CHECK(bin_of(0x1p126f, -0x1p127f, 0x1p127f, 1'024) == 768);
}

TEST_CASE("so is one whose reciprocal is too large") {
    CHECK(bin_of(0, 0, smallest, 16) == 0);
    CHECK(bin_of(smallest, 0, smallest, 16) == 15);
    CHECK(bin_of(smallest, 0, 4 * smallest, 4) == 1);
    CHECK(bin_of(3 * smallest, 0, 4 * smallest, 1'024) == 768);
    CHECK(bin_of(-smallest, -2 * smallest, 2 * smallest, 8) == 2);
}

TEST_CASE("far from the origin centroids that are floats apart are told apart") {
    const float low = 16'777'000.0f;
    for (int i = 0; i < 200; ++i) {
        CAPTURE(i);
        REQUIRE(bin_of(low + float(i), low, low + 200, 200) == std::size_t(i));
    }
}

TEST_CASE("every boundary of whole numbers belongs to the upper bin") {
    for (int bins = 1; bins <= 128; ++bins)
        for (int width = 1; width <= 16; ++width)
            for (int k = 0; k < bins; ++k) {
                const std::size_t bin =
                    bin_of(float(k * width), 0, float(bins * width), std::size_t(bins));
                if (bin == std::size_t(k)) continue;
                CAPTURE(bins, width, k);
                REQUIRE(bin == std::size_t(k));
            }
}

TEST_CASE("a centroid that is as little below a boundary as whole numbers can be is below it") {
    // By 1 / 16777215 of a bin: 1024 * 16384 is one more than the extent, and 2 * 8388607 one less.
    CHECK(bin_of(16'777'215 - 16'384, 0, 16'777'215, 1'024) == 1'022);
    CHECK(bin_of(8'388'607, 0, 16'777'215, 2) == 0);
    CHECK(bin_of(8'388'608, 0, 16'777'215, 2) == 1);
    CHECK(bin_of(16'384, 0, 16'777'215, 1'024) == 1);
    CHECK(bin_of(16'383, 0, 16'777'215, 1'024) == 0);
}

TEST_CASE("random whole numbers: the bin is the exact one") {
    Pcg32 random(3);
    for (int i = 0; i < sized(500'000, 50'000); ++i) {
        const std::uint32_t top = random.below(2) ? 100 : 1u << 23;
        std::int64_t numbers[3];
        for (std::int64_t& number : numbers) number = std::int64_t(random.below(2 * top)) - top;
        std::ranges::sort(numbers);
        const auto [low, centroid, high] = numbers;
        if (low == high) continue;
        const std::int64_t bins = 1 + random.below(random.below(2) ? 32 : 1'024);
        const std::int64_t wanted = std::min(bins * (centroid - low) / (high - low), bins - 1);
        const std::size_t bin = bin_of(float(centroid), float(low), float(high), std::size_t(bins));
        if (bin == std::size_t(wanted)) continue;
        CAPTURE(low, centroid, high, bins);
        REQUIRE(bin == std::size_t(wanted));
    }
}

TEST_CASE("whatever the floats are, bins are in range and in order") {
    Pcg32 random(4);
    for (int i = 0; i < sized(20'000, 2'000); ++i) {
        std::vector<float> any, near;
        const float start = any_float(random);
        for (int k = 0; k < 12; ++k) {
            any.push_back(any_float(random));
            float x = start;
            for (std::uint32_t steps = random.below(20); steps > 0; --steps)
                x = std::nextafter(x, largest);
            near.push_back(x);
        }
        const std::size_t bins = 1 + random.below(64);
        check_in_order(any, bins);
        check_in_order(near, bins);
    }
}
