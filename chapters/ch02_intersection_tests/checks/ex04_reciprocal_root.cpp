#include "ex04_reciprocal_root.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <cmath>

using namespace space;

namespace {

double relative_error(float a) {
    return std::abs(static_cast<double>(reciprocal_root(a)) * std::sqrt(static_cast<double>(a)) -
                    1.0);
}

}  // namespace

TEST_CASE("the reciprocal root of powers of four is nearly a power of two") {
    for (int exponent = -60; exponent <= 60; exponent += 2)
        CHECK(std::abs(std::ldexp(reciprocal_root(std::ldexp(1.0f, exponent)), exponent / 2) -
                       1.0f) <= 0x1p-21f);
}

TEST_CASE("the relative error is at most 2^-21 over two binades") {
    double worst = 0.0;
    for (std::uint32_t bits = 0x3F800000u; bits < 0x40800000u; bits += 97)
        worst = std::max(worst, relative_error(std::bit_cast<float>(bits)));
    CHECK(worst <= 0x1p-21);
}

TEST_CASE("the relative error is at most 2^-21 for every exponent of a normal float") {
    Pcg32 random(4);
    double worst = 0.0;
    for (int exponent = -126; exponent < 128; ++exponent)
        for (int i = 0; i < 64; ++i)
            worst = std::max(worst, relative_error(std::ldexp(1.0f + random.uniform(), exponent)));
    CHECK(worst <= 0x1p-21);
}
