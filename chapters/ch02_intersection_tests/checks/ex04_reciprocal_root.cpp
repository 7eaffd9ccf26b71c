#include "ex04_reciprocal_root.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

using namespace space;

namespace {

/// A float that counts its multiplications, and cannot be divided.
struct CountingFloat {
    float value;

    CountingFloat(float x) : value(x) {}
    CountingFloat& operator+=(CountingFloat x) { return *this = value + x.value; }
    CountingFloat& operator-=(CountingFloat x) { return *this = value - x.value; }
    CountingFloat& operator*=(CountingFloat x);
    friend CountingFloat operator+(CountingFloat a, CountingFloat b) { return a += b; }
    friend CountingFloat operator-(CountingFloat a, CountingFloat b) { return a -= b; }
    friend CountingFloat operator*(CountingFloat a, CountingFloat b) { return a *= b; }
    friend CountingFloat operator-(CountingFloat a) { return -a.value; }
    friend CountingFloat operator/(CountingFloat, CountingFloat) = delete;  // none is needed
    CountingFloat& operator/=(CountingFloat) = delete;
    friend auto operator<=>(CountingFloat, CountingFloat) = default;
};
int multiplications = 0;
CountingFloat& CountingFloat::operator*=(CountingFloat x) {
    ++multiplications;
    return *this = value * x.value;
}

void check(float a) {
    const float guess = std::bit_cast<float>(0x5F375A86u - (std::bit_cast<std::uint32_t>(a) >> 1));
    multiplications = 0;
    const float y = refined<CountingFloat>(a, guess).value;
    const Error error{std::abs(static_cast<double>(y) * std::sqrt(static_cast<double>(a)) - 1.0),
                      0x1p-21};
    if (!error) {
        CAPTURE(Number{a}, Number{guess}, Number{y});
        REQUIRE(error);
    }
    REQUIRE(multiplications <= 12);
}

}  // namespace

TEST_CASE("the reciprocal root of powers of four is nearly a power of two") {
    for (int exponent = -60; exponent <= 60; exponent += 2) check(std::ldexp(1.0f, exponent));
}

TEST_CASE("twelve multiplications make the error at most 2^-21 over two binades") {
    for (std::uint32_t bits = 0x3F800000u; bits < 0x40800000u; bits += 97)
        check(std::bit_cast<float>(bits));
}

TEST_CASE(
    "twelve multiplications make the error at most 2^-21 for every exponent of a normal float") {
    Pcg32 random(4);
    for (int exponent = -126; exponent < 128; ++exponent)
        for (int i = 0; i < 64; ++i) check(std::ldexp(1.0f + random.uniform(), exponent));
}
