// The kernels for one instruction set; its CMakeLists.txt has the compiler's options.
#define SPACE_ISA avx512
#define SPACE_X86 1
#include "chapters/ch10_fast_traversal/kernels/many_kernels.hpp"
#include "chapters/ch10_fast_traversal/kernels/wide_kernel.hpp"
