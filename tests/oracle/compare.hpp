/// @file
/// How an answer relates to the exact one, and how many answers relate in which way.
#pragma once

#include "common/accelerator.hpp"
#include "tests/oracle/exact.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace space {

/// "As near as Möller-Trumbore in double can tell" below: nearer than a unit in the last place of t
/// plus the error bound of tests/oracle/moller_trumbore_bound.hpp.
enum class Agreement {
    agree,           ///< both miss, or the one nearest triangle
    tie,             ///< one of several triangles at exactly the nearest t
    inversion,       ///< a triangle as near as the nearest one, as near as can be told
    interval_end,    ///< a hit at tmin or tmax, as near as can be told, taken for outside or vice
                     ///< versa
    wrong_hit,       ///< the ray misses everything
    wrong_miss,      ///< the ray hits something
    wrong_triangle,  ///< another triangle is nearer, or the reported one is not hit
};
inline constexpr std::size_t agreements = 7;
const char* name(Agreement agreement);

struct Comparison {
    Agreement agreement = Agreement::agree;
    bool rounded = false;  ///< the reported t is not the float nearest to that triangle's exact one
    bool beyond_bound = false;  ///< and differs from it by more than can be told; or the wrong
                                ///< decision is beyond the bound
    /// Of a wrong answer: the triangle that was decided wrongly, taken for a hit or for a miss.
    std::optional<std::uint32_t> wrongly_decided = {};

    bool is_wrong() const { return agreement >= Agreement::wrong_hit; }
};

Comparison compare(const ExactOracle& oracle, const Ray& ray, const std::optional<Hit>& answer);

/// Möller-Trumbore in double may decide this ray and triangle wrongly: an exact weight lies within
/// the error bound of zero, or the triangle is seen edge-on.
bool within_bound(const Ray& ray, const Triangle& triangle);

struct Tally {
    std::array<std::size_t, agreements> counts{};
    std::size_t rounded_t = 0;  ///< right answers whose t is not the nearest float
    std::size_t beyond_bound =
        0;  ///< answers that rounding in Möller-Trumbore in double does not explain
    std::size_t skipped = 0;  ///< rays that the oracle was not asked about

    std::size_t operator[](Agreement agreement) const {
        return counts[static_cast<std::size_t>(agreement)];
    }
    std::size_t examined() const;
    std::size_t wrong() const;
    void add(const Comparison& comparison);
    Tally& operator+=(const Tally& other);
    /// "agree 9,990, tie 10; t not the nearest float 3; beyond the error bound 0; skipped 0".
    std::string text() const;
};

}  // namespace space
