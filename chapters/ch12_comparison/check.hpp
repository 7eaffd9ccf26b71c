/// @file
/// --check: the answers of every structure beside those of naive tracing and of exact arithmetic.
#pragma once

#include "chapters/ch12_comparison/measurement.hpp"

#include <array>
#include <cstddef>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

namespace space {

/// --check compares all rays with naive tracing up to this many ray-triangle tests (some seconds),
/// and a sample beyond.
inline constexpr std::size_t check_limit = 1'000'000'000;

/// Indices of the rays that --check compares: all of them, or a random one from each of equal parts
/// of the batch.
std::vector<std::size_t> check_sample(std::size_t rays, std::size_t triangles, std::uint64_t seed,
                                      std::size_t limit = check_limit);

/// How an answer relates to the exact one. One place of a float is granted to t, none to the choice
/// between hit and miss.
enum class Relation {
    right,           ///< the same miss or the same triangle
    equal_t,         ///< another triangle, at this very t: across a shared edge, or one in another
    t_off,           ///< the same triangle, elsewhere
    other_triangle,  ///< another triangle, elsewhere
    missed,          ///< there is a hit
    false_hit,       ///< there is none
};
inline constexpr std::size_t relation_count = 6;
Relation relation(const HitRecord& exact, const HitRecord& answer);

/// What --check found in one structure's answers.
struct Checked {
    std::size_t rays = 0;           ///< that were compared
    std::size_t disagreements = 0;  ///< with naive tracing by the same test, in any bit
    std::size_t naive_wrong = 0;    ///< further ones, where it is naive tracing that is wrong
    std::array<std::size_t, relation_count> relations{};

    std::size_t operator[](Relation r) const { return relations[static_cast<std::size_t>(r)]; }
};

/// A structure's name and what it answered.
struct Answers {
    std::string_view structure;
    std::span<const HitRecord> hits;
};

/// How many answers relate to the exact ones in which way.
std::array<std::size_t, relation_count> relations(std::span<const HitRecord> exact,
                                                  std::span<const HitRecord> answers);

/// Of the answers that differ from naive ones by the same test: a line for each disagreement, such
/// as "ray 38: naive triangle 7 at t = 2.5, bvh none", and how many there are where the naive
/// answer is wrong. `rays` are the indices that the records belong to.
struct Differences {
    std::vector<std::string> lines;
    std::size_t naive_wrong = 0;
};
Differences differences(std::span<const HitRecord> exact, const Answers& naive,
                        const Answers& other, std::span<const std::size_t> rays);

/// Checks every structure that stands: `naive` is naive tracing, whose first test is exact. Prints
/// each disagreement of a structure of the book to `out`, and then one line. A peer is compared
/// with exact answers alone. @return one entry for each measurement
std::vector<Checked> check(const Structure& naive, std::span<const Triangle> triangles,
                           std::span<const Ray> rays, std::span<const Measurement> measurements,
                           const LabOptions& options, std::FILE* out);

}  // namespace space
