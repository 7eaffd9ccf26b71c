/// @file
/// The accelerators of this chapter: a wide tree over any binary one, walked by the kernels of the
/// chosen instruction set.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/optimised_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch10_fast_traversal/collapse.hpp"
#include "chapters/ch10_fast_traversal/instruction_set.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"
#include "chapters/ch10_fast_traversal/wide_tree.hpp"
#include "chapters/ch10_fast_traversal/wide_walk.hpp"
#include "common/accelerator.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"

#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace space {

/// The binary tree, how it becomes a wide one, and which kernels walk that.
template <class Builder>
struct WideBvhConfig {
    typename Builder::Config binary = {};
    CollapseConfig collapse = {};
    std::optional<InstructionSet> instructions = {};  ///< none: chosen_instruction_set()
};

/// With the exact test its answers are those of the naive loop, bit for bit, whatever the width and
/// the instruction set. With another test, when it counts, and for rays that are too large or small
/// for kernels it walks in plain C++.
template <int N, class Builder, TriangleTest Test = FilteredExact>
class WideBvh {
  public:
    using Config = WideBvhConfig<Builder>;
    static constexpr int width = N;
    static constexpr bool has_exact_test = std::same_as<Test, FilteredExact>;

    // [fast_bvh_build]
    /// @throws LimitError where the tree is deeper than the stack of a ray's walk
    static WideBvh build(std::span<const Triangle> triangles, const Config& config = {}) {
        return over(Builder::template build<3>(triangles, config.binary), triangles, config);
    }
    // [fast_bvh_build]
    /// Over a binary tree that stands. @throws LimitError as build
    static WideBvh over(const BvhNodes<3>& binary, std::span<const Triangle> triangles,
                        const Config& config = {}) {
        return of(collapsed<N>(binary, triangles, config.collapse),
                  config.instructions ? *config.instructions : chosen_instruction_set());
    }
    /// Over a tree that stands. @throws LimitError as build
    static WideBvh of(WideTree<N> tree, InstructionSet instructions) {
        if (tree.depth > max_wide_depth)
            throw LimitError("wide tree: deeper than " + std::to_string(max_wide_depth));
        WideBvh bvh;
        bvh.tree_ = std::move(tree);
        bvh.instructions_ = instructions;
        bvh.table_ = kernel_table<N>(instructions);
        bvh.largest_ = bvh.tree_.largest();
        return bvh;
    }
    const WideTree<N>& tree() const { return tree_; }
    InstructionSet instructions() const { return instructions_; }
    /// As kernels see it; valid while this stands.
    KernelTree kernel_tree() const {
        return {.nodes = reinterpret_cast<const char*>(tree_.nodes.data()),
                .blocks = reinterpret_cast<const char*>(tree_.blocks.data()),
                .root = tree_.root.word,
                .stack_size = static_cast<std::uint32_t>(tree_.stack_size()),
                .largest = largest_,
                .exact = exact_lane,
                .prepare = prepare_kernel_floats};
    }

    // [fast_bvh_query]
    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        if constexpr (has_exact_test && std::same_as<Counts, NoCounts>) {
            if (table_ != nullptr && !tree_.empty()) {
                KernelHit best = nothing_yet;
                const KernelAnswer answer = table_->closest(kernel_tree(), floats_of(ray), best);
                if (answer == kernel_miss) return {};
                if (answer == kernel_hit)
                    return Hit{.t = best.t, .triangle = best.triangle, .u = best.u, .v = best.v};
            }
        }
        return nearest_found([&](const auto& found) { search(ray, counts, found); });
    }

    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        if constexpr (has_exact_test && std::same_as<Counts, NoCounts>) {
            if (table_ != nullptr && !tree_.empty()) {
                const KernelAnswer answer = table_->any(kernel_tree(), floats_of(ray));
                if (answer != kernel_refuses) return answer == kernel_hit;
            }
        }
        return is_any_found([&](const auto& found) { search(ray, counts, found); });
    }
    // [fast_bvh_query]

    TreeShape shape() const {
        return {.nodes = tree_.nodes.size() + tree_.leaves,
                .leaves = tree_.leaves,
                .depth = tree_.depth,
                .references = tree_.references,
                .bytes = sizeof *this + tree_.bytes(),
                .sah_cost = tree_.cost};
    }

  private:
    static const float* floats_of(const Ray& ray) {
        static_assert(sizeof ray == 8 * sizeof(float));
        return &ray.origin.x;
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

    WideTree<N> tree_;
    InstructionSet instructions_ = InstructionSet::scalar;
    const KernelTable* table_ = nullptr;
    float largest_ = 0.0f;
};

/// The best for one ray at a time.
template <TriangleTest Test = FilteredExact>
using FastBvh = WideBvh<8, QuickBuilder, Test>;

/// Of the two builders, one after the other.
struct HighQualityConfig {
    SpatialSplitConfig splits{.costs = {0.0, 1.0}, .max_leaf_size = 1};
    OptimisedBuilder::Config moves{.max_leaf_size = 1};
};

/// A tree for rays, however long it takes to build: spatial splits, then subtrees put back where
/// they cost least.
struct HighQualityBuilder {
    using Config = HighQualityConfig;
    template <int D = 3>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {}) {
        return OptimisedBuilder::improved<D>(SpatialSplitBuilder::build<D>(polygons, config.splits),
                                             config.moves);
    }
};
template <TriangleTest Test = FilteredExact>
using FastHighBvh = WideBvh<8, HighQualityBuilder, Test>;

}  // namespace space
