/// @file
/// The lab: any structure of the book on a mesh and rays of one's own, measured side by side and
/// checked.
#pragma once

#include "chapters/ch12_comparison/structures.hpp"

#include <cstddef>
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

/// A structure's name and what it answered.
struct Answers {
    std::string_view structure;
    std::span<const HitRecord> hits;
};

/// One line for each ray with different answers, such as "ray 38: naive triangle 7 at t = 2.5, bvh
/// none". `rays` are the indices that the records belong to.
std::vector<std::string> disagreements(const Answers& trusted, const Answers& other,
                                       std::span<const std::size_t> rays);

/// The command line `lab ...`. The first structure is the one that --check trusts; the start points
/// of diffuse rays are found with the last. Returns 1 where structures disagree.
/// @throws Error
int run_lab(std::span<const Structure> structures, int argc, char** argv);

}  // namespace space
