/// @file
/// A box of two vectors of four floats: a builder's arithmetic, one instruction for three axes.
#pragma once

#include "common/geometry.hpp"

#include <cstdint>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

namespace space {

/// Three coordinates and a fourth that says nothing.
typedef float FourFloats __attribute__((vector_size(16)));

inline FourFloats smaller_of(FourFloats a, FourFloats b) {
#ifdef __SSE2__
    return _mm_min_ps(a, b);
#else
    return a < b ? a : b;
#endif
}
inline FourFloats larger_of(FourFloats a, FourFloats b) {
#ifdef __SSE2__
    return _mm_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
inline FourFloats four_of(const Point3& p) {
    return FourFloats{p.x, p.y, p.z, 0.0f};
}

// [float_box]
/// Empty at first, as an Aabb is.
struct FloatBox {
    FourFloats low{infinity, infinity, infinity, 0.0f};
    FourFloats high{-infinity, -infinity, -infinity, 0.0f};

    void extend(const FloatBox& box) {
        low = smaller_of(low, box.low);
        high = larger_of(high, box.high);
    }
    void extend(FourFloats p) {
        low = smaller_of(low, p);
        high = larger_of(high, p);
    }
    /// Half the surface of the box times `scale`; infinite, or no number, where a side is.
    float half_area(float scale) const {
        const FourFloats e = (high - low) * scale;
        return e[0] * e[1] + (e[0] + e[1]) * e[2];
    }
    FourFloats middle() const { return 0.5f * low + 0.5f * high; }
    Aabb aabb() const { return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}; }
};
// [float_box]

}  // namespace space
