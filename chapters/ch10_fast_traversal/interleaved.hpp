/// @file
/// Single rays, several of them under way in one thread: each does a step and asks for the lines of
/// its next one; while they come, the others do theirs.
#pragma once

#include "chapters/ch10_fast_traversal/many_rays.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace space {

// [interleaved]
/// Rays of any kind and order, `together` of them under way (at most 32). The answers are those of
/// single rays, bit for bit.
template <TracedTogether Tree, class Answer>
void trace_interleaved(const Tree& tree, std::span<const Ray> rays, unsigned together,
                       ManyQuery query, const Answer& answer) {
    static_assert(sizeof(Ray) == 8 * sizeof(float));
    constexpr std::size_t block = 1024;  // few enough to stay in the nearest caches
    const ManyKernels* const kernels = many_kernels(tree.instructions());
    std::array<KernelHit, block> hits;
    std::array<KernelAnswer, block> answers;
    if (!kernels || tree.tree().empty()) return trace_singly(tree, rays, query, answer);
    for (std::size_t first = 0; first < rays.size(); first += block) {
        const std::size_t count = std::min(block, rays.size() - first);
        kernels->interleaved(tree.kernel_tree(), reinterpret_cast<const float*>(&rays[first]),
                             hits.data(), answers.data(), count, together, query == ManyQuery::any);
        for (std::size_t i = 0; i < count; ++i)
            answer(first + i, answers[i] == kernel_refuses
                                  ? single_answer(tree, rays[first + i], query)
                                  : hit_of(hits[i].t, hits[i].u, hits[i].v, hits[i].triangle));
    }
}
// [interleaved]

}  // namespace space
