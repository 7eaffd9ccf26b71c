/// @file
/// Rays that leave surfaces in all directions are no neighbours. Sorted by direction and place they
/// are: then packets have something to share, and single rays find what the ray before them
/// fetched.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"
#include "chapters/ch10_fast_traversal/many_rays.hpp"
#include "common/geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace space {

// [stream_key]
/// Like keys stand for rays that go the same way: the octant of the direction; then in which of 8^3
/// cells of the box the ray begins, as a Morton code; then where its direction points, in 4 x 4
/// cells of the octant; then in which of 64^3 cells it begins.
class StreamKeys {
  public:
    explicit StreamKeys(const Aabb& box)
        : low_(box.min), scale_(64.0f / glm::max(box.extent(), Vector3(0x1p-100f))) {}

    std::uint32_t operator()(const Ray& ray) const {
        std::uint32_t octant = 0;
        std::array<std::uint32_t, 3> cell_of{};
        float length = 0.0f;
        for (int axis = 0; axis < 3; ++axis) {
            octant |= std::uint32_t{std::signbit(ray.direction[axis])} << axis;
            length += std::abs(ray.direction[axis]);
            const float cell = (ray.origin[axis] - low_[axis]) * scale_[axis];
            // What is outside of the box, or no number, goes to its nearest cell, or the first.
            const float inside = cell >= 0.0f ? std::min(cell, 63.0f) : 0.0f;
            cell_of[std::size_t(axis)] = static_cast<std::uint32_t>(inside);
        }
        const auto place = static_cast<std::uint32_t>(interleave<3>(cell_of));
        std::uint32_t way = 0;
        for (int axis = 0; axis < 2; ++axis) {
            const float share = 4.0f * std::abs(ray.direction[axis]) / length;
            way |= std::uint32_t(share >= 0.0f ? std::min(share, 3.0f) : 0.0f) << 2 * axis;
        }
        return octant << 22 | place >> 9 << 13 | way << 9 | (place & 0x1ffu);
    }
    static constexpr unsigned bits = 25;

  private:
    Point3 low_;
    Vector3 scale_;
};
// [stream_key]

// [sorted_stream]
/// The rays' numbers in the order of their keys; of like keys the first comes first. A radix sort:
/// its time does not hang on the rays.
inline std::vector<std::uint32_t> stream_order(std::span<const Ray> rays, const Aabb& box) {
    using Keyed = std::pair<std::uint32_t, std::uint32_t>;
    constexpr unsigned digit = 13;
    const StreamKeys key_of(box);
    std::vector<Keyed> keyed(rays.size()), sorted(rays.size());
    for (std::uint32_t i = 0; i < rays.size(); ++i) keyed[i] = {key_of(rays[i]), i};
    for (unsigned shift = 0; shift < StreamKeys::bits; shift += digit) {
        std::array<std::uint32_t, (1u << digit) + 1> first{};
        const auto digit_of = [&](const Keyed& k) {
            return k.first >> shift & ((1u << digit) - 1);
        };
        for (const Keyed& k : keyed) ++first[digit_of(k) + 1];
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        for (const Keyed& k : keyed) sorted[first[digit_of(k)]++] = k;
        std::swap(keyed, sorted);
    }
    std::vector<std::uint32_t> order(rays.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = keyed[i].second;
    return order;
}

/// Traces a stream in its order of keys, by trace(rays, answer), which is one of the other ways;
/// answer(i, hit) is told of the rays as they came.
template <class Trace, class Answer>
void trace_sorted(std::span<const Ray> rays, const Aabb& box, const Trace& trace,
                  const Answer& answer) {
    const std::vector<std::uint32_t> order = stream_order(rays, box);
    std::vector<Ray> sorted(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) sorted[i] = rays[order[i]];
    trace(std::span<const Ray>(sorted),
          [&](std::size_t i, const auto& hit) { answer(order[i], hit); });
}
// [sorted_stream]

}  // namespace space
