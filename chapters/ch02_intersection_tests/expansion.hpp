/// @file
/// Exact sums and products of doubles: a number held as a sum of doubles that do not overlap
/// (Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
/// Predicates", sections 2.3-2.5).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace space {

/// The sum of `size` doubles, smallest first, none of them zero, at most N of them. They are
/// nonadjacent: between the highest bit of one and the lowest of the next at least one bit is zero.
/// (Without common bits is not enough: -(2^7 - 2^-46), -(2^60 - 2^7), 2^60 have none, their sum is
/// 2^-46, and adding them up in double gives 0.) The operations below keep it so, since rounding
/// ties to even (Shewchuk's theorems 10, 12 and 19). The sign is the last one's. Sums and products
/// are exact as long as nothing over- or underflows: a product of k floats is a multiple of 2^(-149
/// k) below 2^(128 k), so up to seven factors are safe.
template <std::size_t N>
struct Expansion {
    std::array<double, N> part{};
    std::size_t size = 0;

    void push(double value) {
        if (value != 0.0) part[size++] = value;
    }
    int sign() const { return size == 0 ? 0 : part[size - 1] > 0.0 ? 1 : -1; }
    /// The sum, off by at most one unit in the last place: each part is below a half of the next,
    /// so the partial sums are below a half, a quarter ... of the whole, and so are their
    /// roundings.
    double value() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < size; ++i) sum += part[i];
        return sum;
    }
};

/// A number as the unevaluated sum of two doubles.
struct TwoParts {
    double high, low;
};

// [two_sum]
/// a + b = high + low exactly, high the rounded sum (Knuth 1998, section 4.2.2, theorem B;
/// Shewchuk's theorem 7).
inline TwoParts two_sum(double a, double b) {
    const double high = a + b;
    const double b_part = high - a;
    const double a_part = high - b_part;
    return {high, (a - a_part) + (b - b_part)};
}

/// a b = high + low exactly, high the rounded product. std::fma rounds once by definition, with or
/// without hardware.
inline TwoParts two_product(double a, double b) {
    const double high = a * b;
    return {high, std::fma(a, b, -high)};
}
// [two_sum]

/// b - a of two floats: one or two parts.
inline Expansion<2> difference(float b, float a) {
    const auto [high, low] = two_sum(b, -static_cast<double>(a));
    Expansion<2> result;
    result.push(low);
    result.push(high);
    return result;
}

template <std::size_t N>
Expansion<N> operator-(Expansion<N> e) {
    for (std::size_t i = 0; i < e.size; ++i) e.part[i] = -e.part[i];
    return e;
}

/// e + b (Shewchuk's GROW-EXPANSION, section 2.4, without the zeros).
template <std::size_t N>
Expansion<N + 1> operator+(const Expansion<N>& e, double b) {
    Expansion<N + 1> result;
    double carry = b;
    for (std::size_t i = 0; i < e.size; ++i) {
        const auto [high, low] = two_sum(carry, e.part[i]);
        result.push(low);
        carry = high;
    }
    result.push(carry);
    return result;
}

/// e + f, one part of f after the other (EXPANSION-SUM).
template <std::size_t N, std::size_t M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
    Expansion<N + M> result;
    for (std::size_t i = 0; i < e.size; ++i) result.push(e.part[i]);
    for (std::size_t j = 0; j < f.size; ++j) {
        // Grows in place: part i of the result is written after part i of the old one was read.
        double carry = f.part[j];
        std::size_t size = 0;
        const std::size_t old_size = result.size;
        for (std::size_t i = 0; i < old_size; ++i) {
            const auto [high, low] = two_sum(carry, result.part[i]);
            if (low != 0.0) result.part[size++] = low;
            carry = high;
        }
        if (carry != 0.0) result.part[size++] = carry;
        result.size = size;
    }
    return result;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> operator-(const Expansion<N>& e, const Expansion<M>& f) {
    return e + -f;
}

/// e b (SCALE-EXPANSION, section 2.5).
template <std::size_t N>
Expansion<2 * N> operator*(const Expansion<N>& e, double b) {
    Expansion<2 * N> result;
    if (e.size == 0) return result;
    auto [carry, first_low] = two_product(e.part[0], b);
    result.push(first_low);
    for (std::size_t i = 1; i < e.size; ++i) {
        const auto [product_high, product_low] = two_product(e.part[i], b);
        const auto [middle, middle_low] = two_sum(carry, product_low);
        result.push(middle_low);
        const auto [high, high_low] = two_sum(product_high, middle);
        result.push(high_low);
        carry = high;
    }
    result.push(carry);
    return result;
}

/// e f: the sum of e times each part of f.
template <std::size_t N, std::size_t M>
Expansion<2 * N * M> operator*(const Expansion<N>& e, const Expansion<M>& f) {
    Expansion<2 * N * M> result;
    for (std::size_t j = 0; j < f.size; ++j) {
        const auto term = e * f.part[j];
        Expansion<2 * N * M> sum;
        const auto total = result + term;
        for (std::size_t i = 0; i < total.size; ++i) sum.push(total.part[i]);
        result = sum;
    }
    return result;
}

}  // namespace space
