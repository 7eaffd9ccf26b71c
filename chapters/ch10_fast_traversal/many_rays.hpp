/// @file
/// What all ways to trace a span of rays have in common: who gets the answers, and the rays that
/// kernels do not take.
#pragma once

#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/kernels/many_table.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <optional>
#include <span>

namespace space {

/// Trees that the kernels for many rays walk: of nodes with eight children, by the exact test.
template <class Tree>
concept TracedTogether = Tree::width == 8 && Tree::has_exact_test;

/// The two questions of the concept Accelerator, asked of many rays.
enum class ManyQuery { closest, any };

/// What a kernel has found.
inline std::optional<Hit> hit_of(float t, float u, float v, std::uint32_t triangle) {
    if (triangle == no_kernel_hit) return std::nullopt;
    return Hit{.t = t, .triangle = triangle, .u = u, .v = v};
}

/// By the walk of one ray. To the question for any hit the answer is a hit that says no more.
template <class Tree>
std::optional<Hit> single_answer(const Tree& tree, const Ray& ray, ManyQuery query) {
    if (query == ManyQuery::closest) return closest_hit(tree, ray);
    return any_hit(tree, ray) ? std::optional(Hit{}) : std::nullopt;
}

/// One ray after the other: answer(i, hit) for each.
template <class Tree, class Answer>
void trace_singly(const Tree& tree, std::span<const Ray> rays, ManyQuery query,
                  const Answer& answer) {
    for (std::size_t i = 0; i < rays.size(); ++i) answer(i, single_answer(tree, rays[i], query));
}

}  // namespace space
