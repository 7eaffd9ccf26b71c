// The filter as the compiler's own vectors have it: products and sums, each rounded.
#pragma GCC diagnostic ignored "-Wpsabi"  // no vector leaves this file
#define SPACE_ISA measured_plain
#include "tests/ch10/leaf_filter_errors.hpp"

namespace space {
FilterErrors plain_filter_errors(std::uint64_t seed, int blocks) {
    return measured_plain::filter_errors(seed, blocks);
}
}  // namespace space
