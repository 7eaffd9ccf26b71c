/// @file
/// The random numbers of a picture: the same for the same seed, pixel, sample and call, whichever
/// thread asks.
#pragma once

#include "chapters/ch11_sampling_and_caching/sobol.hpp"
#include "common/geometry.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace space {

/// How the samples of one pixel lie to each other in each of their dimensions. Each number alone is
/// uniform in all three.
enum class SamplePattern {
    independent,  ///< not at all
    stratified,   ///< one in each cell of a grid, in random order
    sobol,        ///< an Owen-scrambled Sobol' sequence in each pair of dimensions
};

/// Spreads what differs little over all 64 bits; a bijection (Steele, Lea & Flood 2014).
constexpr std::uint64_t mixed_bits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}
/// A key of `key` for each `number`.
constexpr std::uint64_t key_for(std::uint64_t key, std::uint64_t number) {
    return mixed_bits(key + (number + 1) * 0x9e3779b97f4a7c15u);
}

/// Where `index` goes in a permutation of 0 .. count - 1 that the key chooses: bijections of as
/// many bits as count - 1 has, repeated until the result is below count. Of 4, 12 or 16 indices,
/// four rounds of them leave some pairs of places too likely, and eight do not (ch11.sampler).
constexpr std::uint32_t permuted_index(std::uint32_t index, std::uint32_t count,
                                       std::uint64_t key) {
    const int bits = std::bit_width(count - 1);
    if (bits == 0) return 0;
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    std::uint64_t x = index;
    do {
        std::uint64_t k = key;
        for (int round = 0; round < 8; ++round) {
            x = ((x ^ k) * (2 * (k >> 32) + 1) + (k >> 20)) & mask;
            x ^= x >> ((bits + 1) / 2);
            k = mixed_bits(k);
        }
    } while (x >= count);
    return static_cast<std::uint32_t>(x);
}

/// Numbers in [0, 1), next() in steps of 2^-53: so small a part of a light may be chosen. start()
/// says for which sample of which pixel; each next() or next_pair() after it is a dimension of its
/// own, well spread over the pixel's samples and independent of the other dimensions and pixels.
class Sampler {
  public:
    /// `samples`: how many a pixel will have; that is the size of the stratified grids (a pixel's
    /// further samples begin another one, and so do those beyond most_strata). The other patterns
    /// do not care.
    Sampler(SamplePattern pattern, std::uint32_t samples, std::uint64_t seed)
        : pattern_(pattern),
          samples_(std::clamp(samples, 1u, most_strata)),
          seed_key_(mixed_bits(seed)) {
        columns_ = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(samples_))));
        rows_ = (samples_ - 1) / columns_ + 1;
        start(0, 0);
    }

    void start(std::uint64_t pixel, std::uint32_t sample) {
        pixel_key_ = key_for(seed_key_, pixel);
        sample_ = sample;
        dimension_ = 0;
        random_ = Pcg32(key_for(mixed_bits(pixel_key_), sample));
    }

    double next() {
        if (pattern_ == SamplePattern::independent) return random_.uniform_double();
        const std::uint64_t key = next_key();
        if (pattern_ == SamplePattern::stratified)
            return below_one((stratum(samples_, key) + random_.uniform_double()) / samples_);
        // Sobol's 32 digits, and below them random ones.
        const std::uint64_t digits = owen_scrambled(sobol_point(shuffled_sample(key)).x, low(key));
        return static_cast<double>((digits << 21) | (random_.next() >> 11)) * 0x1p-53;
    }

    Double2 next_pair() {
        if (pattern_ == SamplePattern::independent) return jitter();
        const std::uint64_t key = next_key();
        if (pattern_ == SamplePattern::stratified) {
            const std::uint32_t cell = stratum(columns_ * rows_, key);
            const Double2 corner{cell % columns_, cell / columns_};
            const Double2 u = (corner + jitter()) / Double2(columns_, rows_);
            return {below_one(u.x), below_one(u.y)};
        }
        const SobolPoint p = sobol_point(shuffled_sample(key));
        const std::uint64_t second = mixed_bits(key);
        return {fraction(owen_scrambled(p.x, low(key))),
                fraction(owen_scrambled(p.y, low(second)))};
    }

    /// The largest grid whose cells 32 bits can count: 2^16 columns, and a row less.
    static constexpr std::uint32_t most_strata = 0xFFFF0000u;

  private:
    std::uint64_t next_key() { return key_for(pixel_key_, dimension_++); }
    static std::uint32_t low(std::uint64_t key) { return static_cast<std::uint32_t>(key); }
    /// A sum may have been rounded up to 1.
    static double below_one(double u) { return std::min(u, 0x1.fffffffffffffp-1); }
    static double fraction(std::uint32_t bits) { return bits * 0x1p-32; }

    Double2 jitter() {
        Double2 u;
        u.x = random_.uniform_double();
        u.y = random_.uniform_double();
        return u;
    }
    std::uint32_t stratum(std::uint32_t strata, std::uint64_t key) const {
        return permuted_index(sample_ % strata, strata, key_for(key, sample_ / strata));
    }
    /// The sample's place in this dimension's sequence: scrambled as a number's digits are, from
    /// the highest, so that aligned blocks of 2^m samples stay such blocks (Burley 2020).
    std::uint32_t shuffled_sample(std::uint64_t key) const {
        return owen_scrambled(sample_, static_cast<std::uint32_t>(key >> 32));
    }

    SamplePattern pattern_;
    std::uint32_t samples_, columns_ = 1, rows_ = 1;
    std::uint64_t seed_key_, pixel_key_ = 0;
    std::uint32_t sample_ = 0, dimension_ = 0;
    Pcg32 random_{0};
};

}  // namespace space
