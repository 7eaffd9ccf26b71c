/// @file
/// The accelerator over compressed nodes.
#pragma once

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch10_fast_traversal/collapse.hpp"
#include "chapters/ch10_fast_traversal/compressed_tree.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/kernels/many_table.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"
#include "chapters/ch10_fast_traversal/wide_walk.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"

#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace space {

/// With the exact test its answers are those of the naive loop, bit for bit: its boxes are larger
/// than others', and none is smaller.
template <class Builder, TriangleTest Test = FilteredExact>
class BasicCompressedBvh {
  public:
    using Config = WideBvhConfig<Builder>;

    /// @throws LimitError where the tree is deeper than the stack of a ray's walk
    static BasicCompressedBvh build(std::span<const Triangle> triangles,
                                    const Config& config = {}) {
        return over(Builder::template build<3>(triangles, config.binary), triangles, config);
    }
    /// Over a binary tree that stands.
    static BasicCompressedBvh over(const BvhNodes<3>& binary, std::span<const Triangle> triangles,
                                   const Config& config = {}) {
        BasicCompressedBvh bvh;
        const ManyKernels* const kernels =
            many_kernels(config.instructions ? *config.instructions : chosen_instruction_set());
        bvh.table_ = kernels ? &kernels->compressed : nullptr;
        bvh.tree_ = TreeCompressor(collapsed<8>(binary, triangles, config.collapse)).run();
        if (bvh.tree_.depth > max_wide_depth)
            throw LimitError("compressed tree: deeper than " + std::to_string(max_wide_depth));
        bvh.largest_ = bvh.tree_.largest();
        return bvh;
    }
    const CompressedTree& tree() const { return tree_; }

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        if constexpr (std::same_as<Test, FilteredExact> && std::same_as<Counts, NoCounts>) {
            if (table_ != nullptr && !tree_.empty()) {
                KernelHit best = nothing_yet;
                const KernelAnswer answer = table_->closest(kernel_tree(), &ray.origin.x, best);
                if (answer == kernel_miss) return {};
                if (answer == kernel_hit)
                    return Hit{.t = best.t, .triangle = best.triangle, .u = best.u, .v = best.v};
            }
        }
        return nearest_found([&](const auto& found) { search(ray, counts, found); });
    }

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        if constexpr (std::same_as<Test, FilteredExact> && std::same_as<Counts, NoCounts>) {
            if (table_ != nullptr && !tree_.empty()) {
                const KernelAnswer answer = table_->any(kernel_tree(), &ray.origin.x);
                if (answer != kernel_refuses) return answer == kernel_hit;
            }
        }
        return is_any_found([&](const auto& found) { search(ray, counts, found); });
    }

    TreeShape shape() const {
        return {.nodes = tree_.nodes.size() + tree_.leaves,
                .leaves = tree_.leaves,
                .depth = tree_.depth,
                .references = tree_.triangles.size(),
                .bytes = sizeof *this + tree_.bytes(),
                .sah_cost = tree_.cost};
    }

  private:
    KernelTree kernel_tree() const {
        static_assert(sizeof(Ray) == 8 * sizeof(float) && sizeof(Point3) == 3 * sizeof(float));
        return {.nodes = reinterpret_cast<const char*>(tree_.nodes.data()),
                .blocks = reinterpret_cast<const char*>(tree_.triangles.data()),
                .root = tree_.root.word,
                .stack_size = static_cast<std::uint32_t>(tree_.stack_size()),
                .largest = largest_,
                .exact = exact_lane,
                .prepare = prepare_kernel_floats,
                .corners = &tree_.corners[0].x};
    }
    template <class Counts, class Found>
    void search(const Ray& ray, Counts& counts, const Found& found) const {
        double limit = infinity;
        walk_wide_any(tree_, ray, counts, [&](const TriangleBlock& block) {
            for (std::size_t lane = 0; lane < TriangleBlock::size && block.is_used(lane); ++lane) {
                counts.test_triangle();
                if (auto hit = Test::intersect(ray, block.triangle(lane))) {
                    hit->triangle = block.indices[lane];
                    limit = found(*hit);
                }
            }
            return limit;
        });
    }

    CompressedTree tree_;
    const KernelTable* table_ = nullptr;
    float largest_ = 0.0f;
};

template <TriangleTest Test = FilteredExact>
using CompressedBvh = BasicCompressedBvh<QuickBuilder, Test>;

}  // namespace space
