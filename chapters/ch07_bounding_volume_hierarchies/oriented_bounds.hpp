/// @file
/// Oriented boxes around points: a slab along each of three axes at right angles, that of the
/// principal axes first.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/bounding_volume.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/slab.hpp"
#include "common/geometry.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace space {

// [oriented_bounds]
/// A box with axes of its own. They are rounded to floats, so angles and lengths are right to a few
/// units of 2^-24; the box *is* the slabs' common part, whatever the axes are, and contains all of
/// what it was made around.
template <int D>
struct OrientedBounds {
    std::array<Vector<D>, D> axes = axes_of(Frame<D>(1.0));
    std::array<Slab, D> slabs{};  ///< along the axes

    bool is_empty() const { return slabs[0].is_empty(); }
    bool operator==(const OrientedBounds&) const = default;

    static std::array<Vector<D>, D> axes_of(const Frame<D>& frame) {
        std::array<Vector<D>, D> axes;
        for (std::size_t i = 0; i < D; ++i) axes[i] = Vector<D>(frame[int(i)]);
        return axes;
    }
};

/// With these axes, around all points.
template <int D>
OrientedBounds<D> bounds_along(const Frame<D>& frame, std::span<const Point<D>> points) {
    OrientedBounds<D> box{.axes = OrientedBounds<D>::axes_of(frame)};
    for (const Point<D>& p : points)
        for (std::size_t i = 0; i < D; ++i) box.slabs[i].extend(dot_range<D>(box.axes[i], p));
    return box;
}
// [oriented_bounds]

template <int D>
Double<D> edges(const OrientedBounds<D>& box) {
    Double<D> widths;
    for (std::size_t i = 0; i < D; ++i) widths[int(i)] = box.slabs[i].width();
    return widths;
}
/// As of axes at right angles. The exact factor is between (1 - u24)^4 and (1 + u24)^4, u24 =
/// 2^-24: the lengths and the determinant of the axes, each column off by u24 of its length.
template <int D>
double surface(const OrientedBounds<D>& box) {
    return surface_of_edges<D>(edges(box));
}
template <int D>
double content(const OrientedBounds<D>& box) {
    return content_of_edges<D>(edges(box));
}

template <int D>
Frame<D> frame_of(const OrientedBounds<D>& box) {
    Frame<D> frame;
    for (std::size_t i = 0; i < D; ++i) frame[int(i)] = Double<D>(box.axes[i]);
    return frame;
}

/// Where D of the planes meet; neighbours differ in one bit of their index. Each is off by at most
/// 16 u53 times the slabs' sum of sizes (below).
template <int D>
std::array<Double<D>, (std::size_t{1} << D)> corners(const OrientedBounds<D>& box) {
    const Frame<D> inverse = glm::inverse(glm::transpose(frame_of(box)));
    std::array<Double<D>, (std::size_t{1} << D)> result;
    for (std::size_t k = 0; k < result.size(); ++k) {
        Double<D> along;
        for (std::size_t i = 0; i < D; ++i)
            along[int(i)] = k >> i & 1 ? box.slabs[i].high : box.slabs[i].low;
        result[k] = inverse * along;
    }
    return result;
}

// [merged_oriented]
/// A box with the axes of one of the two, whichever is smaller, around the corners of both.
///
/// With u53 = 2^-53 and S the sum of the sizes of one box's planes, each in its slab: an entry of
/// the inverse is a cofactor of floats, whose products are exact (one rounding), over a determinant
/// (four), and two more of reciprocal and product; a corner's coordinate is a sum of three products
/// with these (three): with the terms above 1 less than 16 u53 S in all. The product of a corner
/// with an axis adds three roundings of at most S: 20 u53 S, and 32 u53 S below.
template <int D>
OrientedBounds<D> merged(const OrientedBounds<D>& a, const OrientedBounds<D>& b) {
    if (a.is_empty() || b.is_empty()) return a.is_empty() ? b : a;
    const auto with_axes_of = [&](const OrientedBounds<D>& one) {
        OrientedBounds<D> both{.axes = one.axes};
        for (const OrientedBounds<D>& box : {a, b}) {
            double off = 0.0;
            for (const Slab& slab : box.slabs)
                off += 0x1p-48 * std::max(std::abs(double{slab.low}), std::abs(double{slab.high}));
            for (const Double<D>& corner : corners(box))
                for (std::size_t i = 0; i < D; ++i) {
                    const double along = glm::dot(Double<D>(both.axes[i]), corner);
                    both.slabs[i].extend(DotRange{along - off, along + off});
                }
        }
        return both;
    };
    const OrientedBounds<D> along_a = with_axes_of(a), along_b = with_axes_of(b);
    return surface(along_a) <= surface(along_b) ? along_a : along_b;
}
// [merged_oriented]

// ---- principal axes ---------------------------------------------------------------------------

// [principal_frame]
/// The axes along which the points spread most and least: of their covariance, by turning two axes
/// at a time until their product in it is 0 (Jacobi 1846). The angle has tan 2a = 2 both / (first -
/// second); the smaller of the two solutions is taken. Each round at least squares what is left, so
/// a dozen are more than double has digits for.
template <int D>
Frame<D> principal_frame(std::span<const Point<D>> points) {
    Frame<D> frame(1.0), covariance(0.0);
    Double<D> mean(0.0);
    for (const Point<D>& p : points) mean += Double<D>(p) / double(points.size());
    for (const Point<D>& p : points)
        covariance += glm::outerProduct(Double<D>(p) - mean, Double<D>(p) - mean);
    for (int round = 0; round < 12; ++round)
        for (int i = 0; i < D; ++i)
            for (int j = i + 1; j < D; ++j) {
                const Double<D> u = frame[i], v = frame[j];
                const double both = glm::dot(u, covariance * v);
                if (both == 0.0) continue;
                const double ratio =
                    0.5 * (glm::dot(v, covariance * v) - glm::dot(u, covariance * u)) / both;
                const double tangent =
                    std::copysign(1.0 / (std::abs(ratio) + std::sqrt(1.0 + ratio * ratio)), ratio);
                const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
                frame[i] = cosine * (u - tangent * v);
                frame[j] = cosine * (v + tangent * u);
            }
    return frame;
}
// [principal_frame]

template <int D>
OrientedBounds<D> principal_box(std::span<const Point<D>> points) {
    return bounds_along<D>(principal_frame<D>(points), points);
}

// ---- rays -------------------------------------------------------------------------------------

/// There is nothing to prepare: each box has other axes.
template <int D>
const BasicRay<D>& prepared_for(const BasicRay<D>& ray, const OrientedBounds<D>&) {
    return ray;
}

template <int D>
bool meets(const BasicRay<D>& ray, const OrientedBounds<D>& box) {
    double enter = ray.tmin, leave = ray.tmax;
    for (std::size_t i = 0; i < D; ++i) SlabRay(box.axes[i], ray).clip(box.slabs[i], enter, leave);
    return !box.is_empty() && enter <= leave;
}

}  // namespace space
