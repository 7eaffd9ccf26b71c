/// @file
/// The random numbers of the book: PCG32 (O'Neill 2014, "PCG: A Family of Simple Fast
/// Space-Efficient Statistically Good Algorithms", XSH-RR). std::uniform_* gives other numbers in
/// another library; this does not.
#pragma once

#include <bit>
#include <cstdint>

namespace space {

/// The same numbers for the same seed, with every compiler and library.
class Pcg32 {
  public:
    /// Two generators with the same seed and different streams are independent.
    explicit constexpr Pcg32(std::uint64_t seed, std::uint64_t stream = 0)
        : increment_(2 * stream + 1) {
        next();
        state_ += seed;
        next();
    }

    constexpr std::uint32_t next() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005u + increment_;
        const auto xorshifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
        return std::rotr(xorshifted, static_cast<int>(old >> 59));
    }
    /// Uniform in [0, 1): a multiple of 2^-24, so the float is exact and never 1.
    constexpr float uniform() { return static_cast<float>(next() >> 8) * 0x1p-24f; }
    /// Uniform in [0, 1): a multiple of 2^-53.
    constexpr double uniform_double() {
        const std::uint64_t high = next() >> 6, low = next() >> 5;
        return static_cast<double>((high << 27) | low) * 0x1p-53;
    }
    constexpr float uniform(float low, float high) { return low + (high - low) * uniform(); }
    /// Uniform in 0 .. bound - 1, without bias (Lemire 2019); bound > 0.
    constexpr std::uint32_t below(std::uint32_t bound) {
        std::uint64_t product = std::uint64_t{next()} * bound;
        if (static_cast<std::uint32_t>(product) < bound) {
            const std::uint32_t threshold = (0u - bound) % bound;
            while (static_cast<std::uint32_t>(product) < threshold)
                product = std::uint64_t{next()} * bound;
        }
        return static_cast<std::uint32_t>(product >> 32);
    }

  private:
    std::uint64_t state_ = 0;
    std::uint64_t increment_;
};

}  // namespace space
