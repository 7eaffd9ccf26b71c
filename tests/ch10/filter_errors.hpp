/// @file
/// How large the errors of the filter of a leaf's four lanes are.
#pragma once

#include <cstdint>

namespace space {

/// The largest errors, each divided by what the filter allows.
struct FilterErrors {
    double volumes = 0.0;  ///< of u, v and w, by `bound`
    double late = 0.0;     ///< of t det against the limit, by `late`
    double early = 0.0;    ///< and against tmin, by `early`
};

FilterErrors plain_filter_errors(std::uint64_t seed, int blocks);
FilterErrors fused_filter_errors(std::uint64_t seed, int blocks);

}  // namespace space
