// The filter with the compiler's own vectors: products and sums, each rounded.
#define SPACE_ISA plain_filter
#include "tests/ch10/leaf_filter_volumes.hpp"
