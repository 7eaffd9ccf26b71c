#include "chapters/ch10_fast_traversal/kernels/many_table.hpp"

#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"

namespace space {

namespace portable {
extern const ManyKernels many_kernels;
}
#ifdef __x86_64__
namespace sse2 {
extern const ManyKernels many_kernels;
}
namespace avx2 {
extern const ManyKernels many_kernels;
}
namespace avx512 {
extern const ManyKernels many_kernels;
}
#endif

const ManyKernels* many_kernels(InstructionSet set) {
    switch (set) {
        case InstructionSet::portable:
            return &portable::many_kernels;
#ifdef __x86_64__
        case InstructionSet::sse2:
            return &sse2::many_kernels;
        case InstructionSet::avx2:
            return &avx2::many_kernels;
        case InstructionSet::avx512:
            return &avx512::many_kernels;
#endif
        default:
            return nullptr;
    }
}

void exact_packet_lane(PacketRays& rays, unsigned ray, const float* block, unsigned lane) {
    const float* const numbers = rays.rays + 8 * ray;
    KernelRay single;
    for (int axis = 0; axis < 3; ++axis) {
        single.origin[axis] = numbers[axis];
        single.direction[axis] = numbers[axis + 3];
    }
    single.tmin = rays.tmin[ray];
    single.tmax = rays.tmax[ray];
    KernelHit best{rays.t[ray], rays.u[ray], rays.v[ray], rays.triangle[ray]};
    exact_lane(single, block, lane, best);
    rays.t[ray] = best.t;
    rays.u[ray] = best.u;
    rays.v[ray] = best.v;
    rays.triangle[ray] = best.triangle;
}

}  // namespace space
