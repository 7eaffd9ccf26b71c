#include "common/random.hpp"
#include "tests/catch.hpp"

#include <array>
#include <cmath>

namespace space {

TEST_CASE("PCG32 gives the published sequence") {
    // pcg32-demo of O'Neill's C library: seed 42, stream 54, "Round 1".
    Pcg32 random(42, 54);
    for (const std::uint32_t expected :
         {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
        CHECK(random.next() == expected);
}

TEST_CASE("PCG32 can be used at compile time, and streams differ") {
    static_assert(Pcg32(42, 54).next() == 0xa15c02b7u);
    static_assert(Pcg32(42, 54).next() != Pcg32(42, 55).next());
    static_assert(Pcg32(42, 54).next() != Pcg32(43, 54).next());
}

TEST_CASE("uniform numbers are multiples of 2^-24 and 2^-53 in [0, 1)") {
    Pcg32 random(1), again(1);
    CHECK(random.uniform() == static_cast<float>(again.next() >> 8) / 16777216.0f);
    double sum = 0.0;
    for (int i = 0; i < 100'000; ++i) {
        const float f = random.uniform();
        const double d = random.uniform_double();
        if (!(f >= 0.0f && f < 1.0f && d >= 0.0 && d < 1.0))
            FAIL("outside [0, 1): " << f << ", " << d);
        sum += f + d;
    }
    CHECK(sum == Approx(100'000).epsilon(0.01));
}

TEST_CASE("uniform numbers of a range stay in it") {
    Pcg32 random(2);
    for (int i = 0; i < 10'000; ++i) {
        const float f = random.uniform(-3.0f, 5.0f);
        if (!(f >= -3.0f && f <= 5.0f)) FAIL("outside: " << f);
    }
}

TEST_CASE("below(n) gives each of 0 .. n - 1 about as often") {
    Pcg32 random(3);
    std::array<int, 6> counts{};
    for (int i = 0; i < 60'000; ++i) ++counts.at(random.below(6));
    for (const int count : counts)
        CHECK(std::abs(count - 10'000) < 500);  // five standard deviations are 456
    CHECK(random.below(1) == 0);
    // 3 * 2^30: numbers below 2^30 would come twice as often if the product's remainder were not
    // rejected.
    int low = 0;
    for (int i = 0; i < 30'000; ++i) low += random.below(3u << 30) < (1u << 30);
    CHECK(std::abs(low - 10'000) < 500);
}

TEST_CASE("a random point lies in its box; x is drawn first") {
    Pcg32 random(4), again(4);
    const Aabb box{{-1.0f, 2.0f, 5.0f}, {1.0f, 2.5f, 9.0f}};
    for (int i = 0; i < 1'000; ++i) {
        const Point3 p = random_point(random, box);
        CHECK(box.contains(p));
        CHECK(p.x == again.uniform(-1.0f, 1.0f));
        CHECK(p.y == again.uniform(2.0f, 2.5f));
        CHECK(p.z == again.uniform(5.0f, 9.0f));
    }
}

TEST_CASE("random directions have length 1 and go to all sides alike") {
    Pcg32 random(5);
    Double3 sum(0.0), squares(0.0);
    constexpr int count = 30'000;
    for (int i = 0; i < count; ++i) {
        const Double3 d = random_direction(random);
        CHECK(std::abs(glm::length(d) - 1.0) < 1e-15);
        sum += d;
        squares += d * d;
    }
    for (int axis = 0; axis < 3; ++axis) {  // five standard deviations
        CHECK(std::abs(sum[axis]) < 5.0 * std::sqrt(count / 3.0));
        CHECK(std::abs(squares[axis] - count / 3.0) < 5.0 * std::sqrt(count * 4.0 / 45.0));
    }
}

}  // namespace space
