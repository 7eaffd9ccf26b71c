// The filter with fused multiply-add; CMakeLists.txt has the compiler's options.
#ifdef __x86_64__
#define SPACE_X86 1
#endif
#define SPACE_ISA fused_filter
#include "tests/ch10/leaf_filter_volumes.hpp"
