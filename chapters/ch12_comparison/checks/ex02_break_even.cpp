#include "ex02_break_even.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace space;

namespace {

using Structures = std::vector<BuildAndRay>;
using Parts = std::vector<PaysFrom>;

constexpr std::uint64_t most_rays = ~std::uint64_t{0}, most_ps = most_rays >> 1;

std::string text_of(const Structures& structures) {
    std::string text;
    for (const BuildAndRay& s : structures)
        text += std::to_string(s.build_ps) + " + N " + std::to_string(s.ray_ps) + " ps; ";
    return text;
}
std::string text_of(const Parts& parts) {
    std::string text;
    for (const PaysFrom& part : parts)
        text += "from " + std::to_string(part.rays) + " rays on structure " +
                std::to_string(part.structure) + "; ";
    return text;
}

/// A whole number of 128 bits; high * 2^64 + low.
struct Wide {
    std::uint64_t high, low;

    auto operator<=>(const Wide&) const = default;
};
/// Exactly b + N t, in halves of 32 bits.
Wide cost(const BuildAndRay& s, std::uint64_t rays) {
    constexpr std::uint64_t low_half = 0xFFFFFFFFu;
    const std::uint64_t n0 = rays & low_half, n1 = rays >> 32, t0 = s.ray_ps & low_half,
                        t1 = s.ray_ps >> 32;
    const std::uint64_t middle = n1 * t0 + (n0 * t0 >> 32);  // at most 2^64 - 2^33 + 2^32
    const std::uint64_t rest = n0 * t1 + (middle & low_half);
    Wide sum{n1 * t1 + (middle >> 32) + (rest >> 32), (rest << 32) | (n0 * t0 & low_half)};
    const std::uint64_t low = sum.low + s.build_ps;
    return {sum.high + (low < sum.low ? 1u : 0u), low};
}
std::size_t exact_cheapest(const Structures& structures, std::uint64_t rays) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < structures.size(); ++i)
        if (cost(structures[i], rays) < cost(structures[best], rays)) best = i;
    return best;
}

void check(const Structures& structures, const Parts& parts) {
    CAPTURE(text_of(structures));
    const Parts answer = break_even(structures);
    CAPTURE(text_of(answer), text_of(parts));
    REQUIRE(answer == parts);
}

/// A line that is the lowest at both ends of a part is so all the way between them. So all parts
/// are right if both ends of each are.
void check_ends(const Structures& structures) {
    const Parts answer = break_even(structures);
    CAPTURE(text_of(structures), text_of(answer));
    REQUIRE(!answer.empty());
    REQUIRE(answer.front().rays == 0);
    for (std::size_t i = 0; i < answer.size(); ++i) {
        const bool is_last = i + 1 == answer.size();
        if (!is_last) {
            REQUIRE(answer[i].rays < answer[i + 1].rays);
            REQUIRE(answer[i].structure != answer[i + 1].structure);
        }
        const std::uint64_t last = is_last ? most_rays : answer[i + 1].rays - 1;
        for (const std::uint64_t rays : {answer[i].rays, last}) {
            CAPTURE(rays, exact_cheapest(structures, rays));
            REQUIRE(answer[i].structure == exact_cheapest(structures, rays));
        }
    }
}

std::uint64_t random_bits(Pcg32& random, int bits) {
    const std::uint64_t high = random.next(), low = random.next();
    return (high << 32 | low) >> (64 - bits);
}

}  // namespace

TEST_CASE("of no structure there is none; one is the cheapest for all numbers of rays") {
    check({}, {});
    check({{7, 3}}, {{0, 0}});
}

TEST_CASE("a tree pays from the ray on that makes up for its build") {
    // Naive 1,000 a ray; the tree 10,000 and 10 a ray: as much at 10.1 rays.
    check({{0, 1'000}, {10'000, 10}}, {{0, 0}, {11, 1}});
    check({{10'000, 10}, {0, 1'000}}, {{0, 1}, {11, 0}});
}

TEST_CASE("a structure that is built sooner and traced faster is the only one") {
    check({{500, 20}, {100, 10}}, {{0, 1}});
    check({{100, 10}, {100, 20}}, {{0, 0}});
    check({{100, 10}, {90, 10}, {95, 10}}, {{0, 1}});  // parallel
}

TEST_CASE("of structures that cost the same the first counts, where they cross, too") {
    check({{0, 100}, {1'000, 50}}, {{0, 0}, {21, 1}});  // equal at 20
    check({{1'000, 50}, {0, 100}}, {{0, 1}, {20, 0}});
    check({{100, 20}, {100, 10}}, {{0, 0}, {1, 1}});  // as long as there are no rays
    check({{5, 5}, {5, 5}, {5, 5}}, {{0, 0}});
    check({{50, 1}, {0, 100}, {50, 1}}, {{0, 1}, {1, 0}});
}

TEST_CASE("a structure whose line lies above the crossing of two others is never the cheapest") {
    check({{0, 100}, {900, 60}, {1'000, 50}}, {{0, 0}, {21, 2}});
    check({{0, 100}, {400, 75}, {1'000, 50}}, {{0, 0}, {17, 1}, {25, 2}});
}

TEST_CASE("three lines through one point: there the first of them, for that one number of rays") {
    // All cost 2,000 at 20 rays.
    check({{0, 100}, {500, 75}, {1'000, 50}}, {{0, 0}, {21, 2}});
    check({{500, 75}, {0, 100}, {1'000, 50}}, {{0, 1}, {20, 0}, {21, 2}});
    check({{1'000, 50}, {500, 75}, {0, 100}}, {{0, 2}, {20, 0}});
}

TEST_CASE("small times, as counted out for every number of rays up to 200") {
    Pcg32 random(122);
    for (int turn = 0; turn < 2'000; ++turn) {
        Structures structures(1 + random.below(6));
        for (BuildAndRay& s : structures) {
            s.build_ps = random.below(60);
            s.ray_ps = random.below(8);
        }
        Parts parts;
        for (std::uint64_t rays = 0; rays <= 200; ++rays) {
            const std::size_t best = exact_cheapest(structures, rays);
            if (parts.empty() || parts.back().structure != best) parts.push_back({rays, best});
        }
        check(structures, parts);
    }
}

TEST_CASE("twenty structures, from milliseconds to hours, and up to 2^64 - 1 rays") {
    Pcg32 random(123);
    for (int turn = 0; turn < 300; ++turn) {
        Structures structures(20);
        for (BuildAndRay& s : structures) {
            s.build_ps = random_bits(random, 20 + int(random.below(35)));
            s.ray_ps = random_bits(random, 8 + int(random.below(20)));
        }
        check_ends(structures);
    }
}

TEST_CASE("the largest times: nothing overflows, and one picosecond counts") {
    check({{0, most_ps}, {most_ps, 0}}, {{0, 0}, {2, 1}});
    check({{most_ps, 1}, {most_ps, 0}}, {{0, 0}, {1, 1}});
    check({{0, 1}, {most_ps, 0}}, {{0, 0}, {most_ps + 1, 1}});
    check({{most_ps, 0}, {0, 1}}, {{0, 1}, {most_ps, 0}});
    check({{most_ps, 7}, {most_ps - 1, 7}}, {{0, 1}});
    check({{0, 8}, {std::uint64_t{1} << 60, 7}, {(std::uint64_t{1} << 60) + 1, 6}},
          {{0, 0}, {(std::uint64_t{1} << 59) + 1, 2}});
    constexpr std::uint64_t much = std::uint64_t{1} << 61;
    check({{0, 2 * much + 1}, {much, 2 * much}}, {{0, 0}, {much + 1, 1}});
    check({{much, 2 * much}, {0, 2 * much + 1}}, {{0, 1}, {much, 0}});
    Pcg32 random(124);
    for (int turn = 0; turn < 2'000; ++turn) {
        Structures structures(1 + random.below(8));
        const int build_bits = 40 + int(random.below(24)), ray_bits = 1 + int(random.below(63));
        for (BuildAndRay& s : structures) {
            s.build_ps = random_bits(random, build_bits);
            s.ray_ps = random_bits(random, ray_bits);
        }
        check_ends(structures);
    }
}
