/// @file
/// Rays in packets: neighbours on the picture go the same way, so they share each node that is
/// fetched, and triangles are tested against all of them at once.
#pragma once

#include "chapters/ch10_fast_traversal/many_rays.hpp"
#include "common/camera.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// The order in which pixels' rays make good packets: tiles of `side` x `side` pixels, row by row.
/// At the picture's edges a tile has what is left.
inline std::vector<std::uint32_t> tiled_order(int width, int height, int side) {
    std::vector<std::uint32_t> order;
    for (int top = 0; top < height; top += side)
        for (int left = 0; left < width; left += side)
            for (int y = top; y < std::min(top + side, height); ++y)
                for (int x = left; x < std::min(left + side, width); ++x)
                    order.push_back(static_cast<std::uint32_t>(y * width + x));
    return order;
}

/// Rays in packets of consecutive ones, of which `answer(i, hit)` is told each one's hit.
template <TracedTogether Tree, class Answer>
class PacketTracer {
  public:
    PacketTracer(const Tree& tree, std::span<const Ray> rays, ManyQuery query, const Answer& answer)
        : tree_(tree),
          kernels_(tree.tree().empty() || !(tree.tree().largest() <= largest_kernel_float)
                       ? nullptr
                       : many_kernels(tree.instructions())),
          rays_(rays),
          query_(query),
          answer_(answer) {
        packet_.is_any_asked = query == ManyQuery::any;
    }

    // [trace_packet]
    /// Rays that go different ways, or that no kernel takes, are traced in halves, and at last
    /// alone.
    void trace(std::size_t first, std::size_t count) {
        if (count > 1 && kernels_) {
            packet_.count = static_cast<std::uint32_t>(count);
            packet_.rays = reinterpret_cast<const float*>(&rays_[first]);
            if (kernels_->packet(tree_.kernel_tree(), packet_, largest_kernel_float,
                                 exact_packet_lane, counts_)) {
                tell(first, count);
            } else {
                trace(first, count / 2);
                trace(first + count / 2, count - count / 2);
            }
            return;
        }
        for (std::size_t i = first; i < first + count; ++i)
            answer_(i, single_answer(tree_, rays_[i], query_));
    }
    // [trace_packet]
    const PacketCounts& counts() const { return counts_; }

  private:
    static_assert(sizeof(Ray) == 8 * sizeof(float));

    void tell(std::size_t first, std::size_t count) const {
        for (std::size_t i = 0; i < count; ++i)
            answer_(first + i,
                    hit_of(packet_.t[i], packet_.u[i], packet_.v[i], packet_.triangle[i]));
    }

    const Tree& tree_;
    const ManyKernels* kernels_;
    std::span<const Ray> rays_;
    ManyQuery query_;
    const Answer& answer_;
    PacketRays packet_;
    PacketCounts counts_ = {};
};

// [packets]
/// Traces rays that go the same way together; neighbours should follow each other. The answers are
/// those of single rays, bit for bit.
template <TracedTogether Tree, class Answer>
PacketCounts trace_in_packets(const Tree& tree, std::span<const Ray> rays, std::size_t size,
                              ManyQuery query, const Answer& answer) {
    size = std::clamp<std::size_t>(size, 1, most_packet_rays);
    PacketTracer tracer(tree, rays, query, answer);
    for (std::size_t first = 0; first < rays.size(); first += size)
        tracer.trace(first, std::min(size, rays.size() - first));
    return tracer.counts();
}
// [packets]

}  // namespace space
