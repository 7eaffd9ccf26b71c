#include "chapters/ch11_sampling_and_caching/sampler.hpp"

#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace space {
namespace {

constexpr std::array patterns{SamplePattern::independent, SamplePattern::stratified,
                              SamplePattern::sobol};

/// Whether each of the elementary intervals of area 2^-m holds exactly one of the 2^m points.
bool is_net(const std::vector<SobolPoint>& points, int m) {
    for (int by_x = 0; by_x <= m; ++by_x) {
        std::set<std::uint64_t> boxes;
        for (const SobolPoint& p : points) {
            const std::uint64_t column = std::uint64_t{p.x} >> (32 - by_x),
                                row = std::uint64_t{p.y} >> (32 - (m - by_x));
            boxes.insert(column << 32 | row);
        }
        if (boxes.size() != std::size_t{1} << m) return false;
    }
    return true;
}

std::vector<SobolPoint> block(std::uint32_t first, int m) {
    std::vector<SobolPoint> points;
    for (std::uint32_t i = 0; i < (1u << m); ++i) points.push_back(sobol_point(first + i));
    return points;
}

TEST_CASE("the second dimension's matrix is the recurrence of the polynomial x + 1") {
    // Sobol's odd numbers m_k = 2 m_(k-1) xor m_(k-1), each a fraction m_k / 2^(k+1).
    std::uint64_t m = 1;
    for (int k = 0; k < 32; ++k) {
        CHECK(direction_number(k) == static_cast<std::uint32_t>(m << (31 - k)));
        CHECK(sobol_point(1u << k) == SobolPoint{0x80000000u >> k, direction_number(k)});
        m = (2 * m) ^ m;
    }
    CHECK(sobol_point(0) == SobolPoint{0, 0});
    CHECK(sobol_point(3) == SobolPoint{0xC0000000u, 0x40000000u});
}

TEST_CASE("every elementary interval holds exactly one of 2^m Sobol points, and after scrambling") {
    for (int m = 0; m <= sized(11, 8); ++m)
        for (const std::uint32_t blocks_before : {0u, 1u, 5u, 1000u}) {
            CAPTURE(m, blocks_before);
            std::vector<SobolPoint> points = block(blocks_before << m, m);
            REQUIRE(is_net(points, m));
            const std::uint32_t seed = 77 * blocks_before + static_cast<std::uint32_t>(m);
            for (SobolPoint& p : points)
                p = {owen_scrambled(p.x, seed), owen_scrambled(p.y, ~seed)};
            REQUIRE(is_net(points, m));
        }
}

TEST_CASE("a block that does not begin at a multiple of its size is no net") {
    CHECK_FALSE(is_net(block(1, 4), 4));
}

TEST_CASE("a sampler's first 2^m Sobol pairs are nets in each of its dimensions") {
    Sampler sampler(SamplePattern::sobol, 1, 9);
    for (int m = 0; m <= sized(10, 7); ++m) {
        std::array<std::vector<SobolPoint>, 3> dimensions;
        for (std::uint32_t i = 0; i < (1u << m); ++i) {
            sampler.start(123, i);
            sampler.next();
            for (auto& points : dimensions) {
                const Double2 u = 0x1p32 * sampler.next_pair();
                points.push_back(
                    {static_cast<std::uint32_t>(u.x), static_cast<std::uint32_t>(u.y)});
            }
        }
        for (const auto& points : dimensions) REQUIRE(is_net(points, m));
        REQUIRE((m < 3 || dimensions[0] != dimensions[1]));
    }
}

TEST_CASE("an index is permuted: each place is taken once, and by each with the same chance") {
    for (std::uint32_t count = 1; count < 130; ++count) {
        std::set<std::uint32_t> places;
        for (std::uint32_t i = 0; i < count; ++i)
            places.insert(permuted_index(i, count, key_for(3, count)));
        REQUIRE((places.size() == count && *places.rbegin() == count - 1));
    }
    for (const std::uint32_t count : {4u, 12u, 16u}) {
        const std::uint32_t keys = sized(144'000u, 14'400u);
        std::vector<std::uint64_t> observed(count * count);
        for (std::uint32_t key = 0; key < keys; ++key) {
            const std::uint64_t k = key_for(1, key);
            ++observed[permuted_index(0, count, k) * count + permuted_index(1, count, k)];
        }
        std::vector<double> expected(count * count, keys / (count * (count - 1.0)));
        for (std::uint32_t i = 0; i < count; ++i) expected[i * count + i] = 0.0;
        CHECK(chi_square(observed, expected) < chi_square_limit(count * (count - 1)));
    }
}

TEST_CASE("stratified samples: one in each cell, in each dimension, also of a grid with a rest") {
    for (const std::uint32_t samples : {1u, 2u, 5u, 16u, 23u}) {
        Sampler sampler(SamplePattern::stratified, samples, 4);
        const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(samples)));
        const std::uint32_t rows = (samples + columns - 1) / columns;
        for (int dimension = 0; dimension < 3; ++dimension) {
            std::set<std::uint32_t> strata, cells;
            for (std::uint32_t i = 0; i < samples; ++i) {
                sampler.start(7, i);
                for (int before = 0; before < dimension; ++before) sampler.next();
                strata.insert(static_cast<std::uint32_t>(sampler.next() * samples));
                const Double2 u = sampler.next_pair();
                cells.insert(static_cast<std::uint32_t>(u.x * columns) +
                             columns * static_cast<std::uint32_t>(u.y * rows));
            }
            CHECK(strata.size() == samples);
            CHECK(cells.size() == samples);
        }
    }
}

/// 16 x 16 cells of two numbers each.
template <class Pair>
bool is_uniform(std::uint64_t count, const Pair& pair) {
    std::vector<std::uint64_t> observed(256);
    for (std::uint64_t i = 0; i < count; ++i) {
        const Double2 u = pair(i);
        REQUIRE((u.x >= 0.0 && u.x < 1.0 && u.y >= 0.0 && u.y < 1.0));
        ++observed[static_cast<std::size_t>(u.x * 16.0) +
                   16 * static_cast<std::size_t>(u.y * 16.0)];
    }
    const std::vector<double> expected(256, static_cast<double>(count) / 256.0);
    return chi_square(observed, expected) < chi_square_limit(256);
}

TEST_CASE("over seeds and over pixels each sample alone is uniform, in pairs and between them") {
    const std::uint64_t count = sized(50'000u, 5'000u);
    for (const SamplePattern pattern : patterns)
        for (const std::uint32_t sample : {0u, 1u, 13u, 40u}) {
            CAPTURE(static_cast<int>(pattern), sample);
            const auto over_seeds = [&](std::uint64_t seed) {
                Sampler sampler(pattern, 16, seed);
                sampler.start(5, sample);
                return sampler;
            };
            Sampler one(pattern, 16, 8);
            CHECK(is_uniform(count, [&](auto seed) { return over_seeds(seed).next_pair(); }));
            CHECK(is_uniform(count, [&](auto pixel) {
                one.start(pixel, sample);
                return one.next_pair();
            }));
            CHECK(is_uniform(count, [&](auto seed) {
                Sampler sampler = over_seeds(seed);
                Double2 u;
                u.x = sampler.next();
                u.y = sampler.next();
                return u;
            }));
            CHECK(is_uniform(count, [&](auto seed) {
                Sampler sampler = over_seeds(seed);
                const Double2 first = sampler.next_pair(), second = sampler.next_pair();
                return Double2(first.y, second.x);
            }));
        }
}

TEST_CASE("the numbers of two samples of a pixel are independent over dimensions") {
    // Were the dimensions' sequences not shuffled, each would be a function of the sample's index.
    const std::uint32_t count = sized(65'536u, 8'192u);
    for (const SamplePattern pattern : patterns) {
        Sampler sampler(pattern, count, 3);
        CHECK(is_uniform(count, [&](auto sample) {
            sampler.start(0, static_cast<std::uint32_t>(sample));
            const double x = sampler.next_pair().x;
            return Double2(x, sampler.next());
        }));
    }
}

TEST_CASE("a sampler's numbers depend on seed, pixel, sample and call alone") {
    for (const SamplePattern pattern : patterns) {
        Sampler one(pattern, 16, 21), other(pattern, 16, 21), another(pattern, 16, 22);
        for (std::uint64_t pixel = 0; pixel < 100; ++pixel) one.next();
        one.start(10, 3);
        other.start(99, 2);
        other.next_pair();
        other.start(10, 3);
        another.start(10, 3);
        bool differs = false;
        for (int call = 0; call < 20; ++call) {
            const double x = one.next();
            REQUIRE(x == other.next());
            differs |= x != another.next();
            REQUIRE(one.next_pair() == other.next_pair());
        }
        CHECK(differs);
    }
}

TEST_CASE("a stratified pixel may have as many samples as there are numbers for them") {
    for (const std::uint32_t samples : {0xFFFEFFFFu, 0xFFFF0000u, 0xFFFF0001u, 0xFFFFFFFFu}) {
        Sampler sampler(SamplePattern::stratified, samples, 5);
        for (const std::uint32_t sample : {0u, 1u, 0x80000000u, 0xFFFEFFFFu, 0xFFFFFFFFu}) {
            sampler.start(3, sample);
            const double x = sampler.next();
            const Double2 u = sampler.next_pair();
            CAPTURE(samples, sample, x, u.x, u.y);
            CHECK((x >= 0.0 && x < 1.0 && u.x >= 0.0 && u.x < 1.0 && u.y >= 0.0 && u.y < 1.0));
        }
    }
}

TEST_CASE("single numbers fall into every part of [0, 1), however small: below 2^-32, evenly") {
    for (const SamplePattern pattern : patterns) {
        CAPTURE(static_cast<int>(pattern));
        Sampler sampler(pattern, 64, 6);
        CHECK(is_uniform(sized(50'000u, 5'000u), [&](auto pixel) {
            sampler.start(pixel, static_cast<std::uint32_t>(pixel % 64));
            const double digits = sampler.next() * 0x1p32;
            return Double2(std::floor(digits) * 0x1p-32, digits - std::floor(digits));
        }));
    }
}

TEST_CASE("a sampler's numbers are these, with every compiler") {
    const auto third = [](SamplePattern pattern) {
        Sampler sampler(pattern, 9, 1);
        sampler.start(2, 3);
        const double x = sampler.next();
        const Double2 u = sampler.next_pair();
        return std::array{x, u.x, u.y};
    };
    const auto near = [](const std::array<double, 3>& u, const std::array<double, 3>& kept) {
        for (std::size_t i = 0; i < 3; ++i)
            CHECK(u[i] == Approx(kept[i]).epsilon(0.0).margin(1e-9));
    };
    near(third(SamplePattern::independent), {0.2887368271, 0.0479019854, 0.3917960497});
    near(third(SamplePattern::stratified), {0.1431929808, 0.0159673285, 0.1305986832});
    near(third(SamplePattern::sobol), {0.9498452174, 0.2290153594, 0.2183250366});
}

/// Root of the mean square error of the mean of f over `samples` pairs, over 300 pixels.
template <class F>
double error_of(SamplePattern pattern, std::uint32_t samples, double exact, const F& f) {
    Sampler sampler(pattern, samples, 5);
    double squares = 0.0;
    const std::uint64_t pixels = sized(300u, 60u);
    for (std::uint64_t pixel = 0; pixel < pixels; ++pixel) {
        double sum = 0.0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            sampler.start(pixel, i);
            sum += f(sampler.next_pair());
        }
        squares += (sum / samples - exact) * (sum / samples - exact);
    }
    return std::sqrt(squares / static_cast<double>(pixels));
}

TEST_CASE("of a smooth function strata beat independent samples, and Sobol's pairs beat strata") {
    const auto smooth = [](const Double2& u) { return u.x * u.y * u.y; };
    const double independent = error_of(SamplePattern::independent, 256, 1.0 / 6.0, smooth),
                 stratified = error_of(SamplePattern::stratified, 256, 1.0 / 6.0, smooth),
                 sobol = error_of(SamplePattern::sobol, 256, 1.0 / 6.0, smooth);
    CAPTURE(independent, stratified, sobol);
    // Slopes -1/2, -1 and about -3/2 of the error over the number of samples.
    CHECK(stratified < independent / 8.0);
    CHECK(sobol < stratified / 4.0);
}

}  // namespace
}  // namespace space
