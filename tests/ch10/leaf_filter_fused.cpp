// The filter with fused multiply-add, for processors that have it. What other files have inline,
// too, stands before the pragma: it must run on any processor.
#include "common/pcg32.hpp"
#include "tests/ch10/filter_errors.hpp"

#include <cmath>
#include <cstdint>

#ifdef __x86_64__
#pragma GCC target("avx2,fma")
#define SPACE_X86 1
#endif
#pragma GCC diagnostic ignored "-Wpsabi"  // no vector leaves this file
#define SPACE_ISA measured_fused
#include "tests/ch10/leaf_filter_errors.hpp"

namespace space {
FilterErrors fused_filter_errors(std::uint64_t seed, int blocks) {
    return measured_fused::filter_errors(seed, blocks);
}
}  // namespace space
