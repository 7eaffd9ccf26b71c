#include "common/zero_area.hpp"

#include <array>
#include <cmath>

namespace space {
namespace {

/// Does the exact sum of the six terms vanish? Rounded addition decides where its error bound
/// allows; else the sum is kept without error as an expansion (Shewchuk 1997, "Adaptive Precision
/// Floating-Point Arithmetic", Grow-Expansion).
bool sum_is_zero(const std::array<double, 6>& terms) {
    double sum = 0.0, magnitude = 0.0;
    for (const double term : terms) {
        sum += term;
        magnitude += std::abs(term);
    }
    // Five additions, each wrong by at most 2^-53 of a partial sum that is no larger than the
    // magnitude.
    constexpr double error_bound = 8 * 0x1p-53;
    if (std::abs(sum) > error_bound * magnitude) return false;

    std::array<double, 6> expansion{};
    for (std::size_t count = 0; count < terms.size(); ++count) {
        double carry = terms[count];
        for (std::size_t i = 0; i < count; ++i) {  // two-sum: carry + part = total + error, exactly
            const double part = expansion[i], total = carry + part, virtual_part = total - carry;
            expansion[i] = (carry - (total - virtual_part)) + (part - virtual_part);
            carry = total;
        }
        expansion[count] = carry;
    }
    for (const double part : expansion)
        if (part != 0.0) return false;
    return true;
}

}  // namespace

/// Multiplied out, each component of (b - a) x (c - a) is a sum of six products of two floats, and
/// such a product is exact in double: 24 + 24 bits fit into 53, and the exponents are far from the
/// ends.
bool has_zero_area(const Triangle& triangle) {
    const Double3 a{triangle.a}, b{triangle.b}, c{triangle.c};
    for (int axis = 0; axis < 3; ++axis) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        if (!sum_is_zero(
                {a[i] * b[j], -a[j] * b[i], b[i] * c[j], -b[j] * c[i], c[i] * a[j], -c[j] * a[i]}))
            return false;
    }
    return true;
}

}  // namespace space
