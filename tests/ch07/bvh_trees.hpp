/// @file
/// What must be so in every tree of the chapter, and the builders that all tests go through.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bottom_up_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/middle_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/optimised_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_split_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "tests/suite/tree_check.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace space {

/// For tree_faults. A node's number there is its place in depth-first order.
inline std::vector<TreeNode> tree_nodes(const BvhNodes<3>& tree) {
    std::vector<TreeNode> nodes;
    std::vector<std::uint32_t> number(tree.nodes.size());
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        number[index] = static_cast<std::uint32_t>(nodes.size());
        const auto own = tree.own(index);
        nodes.push_back({tree.nodes[index].box, {}, {own.begin(), own.end()}});
    });
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        const BvhNode<3>& node = tree.nodes[index];
        if (!node.is_leaf())
            nodes[number[index]].children = {number[node.first], number[node.first + 1]};
    });
    return nodes;
}

/// Faults in how a tree lies in memory, and in what it says of itself.
template <int D>
std::vector<std::string> layout_faults(const BvhNodes<D>& tree) {
    std::vector<std::string> faults;
    if (tree.empty()) return faults;
    if (reinterpret_cast<std::uintptr_t>(tree.nodes.data()) % 64 != 0)
        faults.push_back("nodes do not begin with a cache line");
    if (tree.nodes.size() % 2 != 0) faults.push_back("an odd number of places");
    std::uint32_t next_pair = 2, next_reference = 0;
    std::size_t visited = 0;
    unsigned deepest = 0;
    tree.for_each_node([&](std::uint32_t index, unsigned depth) {
        const BvhNode<D>& node = tree.nodes[index];
        ++visited, deepest = std::max(deepest, depth);
        if (node.is_leaf()) {
            if (node.first != next_reference) faults.push_back(fmt::format("leaf {} skips", index));
            next_reference = node.first + node.count;
            return;
        }
        if (node.first != next_pair)
            faults.push_back(
                fmt::format("node {}: its pair is at {}, not {}", index, node.first, next_pair));
        next_pair += 2;
        BasicAabb<D> both = tree.nodes[node.first].box;
        both.extend(tree.nodes[node.first + 1].box);
        if (both != node.box) faults.push_back(fmt::format("node {}: not its children", index));
    });
    if (visited != tree.size()) faults.push_back("nodes that nothing leads to");
    if (next_reference != tree.references.size()) faults.push_back("references in no leaf");
    if (deepest != tree.depth)
        faults.push_back(fmt::format("depth {}, it says {}", deepest, tree.depth));
    return faults;
}

/// All faults of a tree whose leaves are to hold no more than this.
inline std::string faults_of(const BvhNodes<3>& tree, std::span<const Triangle> triangles,
                             std::size_t max_leaf_size) {
    auto faults = layout_faults(tree);
    const TreeRules rules{.tight = true, .max_leaf_size = max_leaf_size};
    for (std::string& fault : tree_faults(tree_nodes(tree), triangles, rules))
        faults.push_back(std::move(fault));
    return diagnosis(faults);
}

/// Calls test(name, build, max_leaf_size) for each builder, as it is and with other limits;
/// build(polygons) makes its tree.
template <int D = 3, class Test>
void for_each_builder(const Test& test) {
    const auto with = [&]<class Builder>(const char* name, Builder,
                                         const typename Builder::Config& config) {
        test(
            name,
            [=](std::span<const Simplex<D>> polygons) {
                return Builder::template build<D>(polygons, config);
            },
            config.max_leaf_size);
    };
    with("median", MedianBuilder{}, {});
    with("median, leaves of one", MedianBuilder{}, {.max_leaf_size = 1});
    with("middle", MiddleBuilder{}, {});
    with("middle, leaves of one", MiddleBuilder{}, {.max_leaf_size = 1});
    with("middle, shallow", MiddleBuilder{}, {.max_leaf_size = 2, .max_depth = 3});
    with("sweep", SweepBuilder{}, {});
    with("sweep, leaves of one", SweepBuilder{}, {.costs = {0.0, 1.0}, .max_leaf_size = 1});
    with("sweep, shallow", SweepBuilder{}, {.max_leaf_size = 3, .max_depth = 3});
    with("binned", BinnedBuilder{}, {});
    with("binned, leaves of one", BinnedBuilder{}, {.costs = {0.0, 1.0}, .max_leaf_size = 1});
    with("binned, two bins", BinnedBuilder{}, {.max_leaf_size = 3, .max_depth = 3, .bins = 2});
    with("spatial splits, none twice", SpatialSplitBuilder{}, {.max_growth = 1.0});
    with("morton", MortonBuilder{}, {});
    with("morton, leaves of one", MortonBuilder{}, {.max_leaf_size = 1});
    with("bottom-up", BottomUpBuilder{}, {});
    with("bottom-up, leaves of one", BottomUpBuilder{}, {.max_leaf_size = 1, .radius = 1});
    with("bottom-up, few rounds", BottomUpBuilder{}, {.max_leaf_size = 3, .max_rounds = 2});
    with("optimised", OptimisedBuilder{}, {});
    with("optimised, leaves of one", OptimisedBuilder{}, {.max_leaf_size = 1, .min_gain = 0.0});
}

}  // namespace space
