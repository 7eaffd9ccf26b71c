/// @file
/// The comparison seen from several sides: beside the best, as it grows, by what is worth its
/// build.
#pragma once

#include "chapters/ch12_comparison/measured/break_even.hpp"
#include "chapters/ch12_comparison/measured/comparison_data.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch12 {

using Block = std::span<const ComparedRow>;

/// Of each scene the block that is nearest to so many triangles, by their ratio, where that is at
/// most 3.
std::vector<Block> blocks_near(const Comparison& comparison, double triangles);
/// The size at which scenes are compared: 100,000 triangles, or, of a smaller run, 1,000.
double compared_size(const Comparison& comparison);
/// The smallest block of each scene.
std::vector<Block> smallest_blocks(const Comparison& comparison);

/// Every structure's name, once, in the lab's order.
std::vector<std::string> structure_names(const Comparison& comparison, bool with_peers);

/// What a ray costs: its time, the mean over the kinds or of one kind; where nothing is timed, the
/// nodes that it visits and the triangles that it tests.
double ray_cost(const ComparedRow& row, std::optional<RayKind> kind = {});

/// The book's structures that stand, the one with the cheapest rays first.
std::vector<const ComparedRow*> by_ray_cost(Block block, std::optional<RayKind> kind = {});

/// A structure beside the best of the book's, on each of these scenes on which it stands.
struct Factor {
    std::string scene;
    double factor;
};
std::vector<Factor> factors(std::span<const Block> blocks, std::string_view structure,
                            std::optional<RayKind> kind = {});
/// The cost of rays in one structure over that in another, wherever both stand.
std::vector<Factor> ratios(std::span<const Block> blocks, std::string_view structure,
                           std::string_view other, std::optional<RayKind> kind = {});
double median_factor(std::span<const Factor> factors);
/// @throws std::out_of_range where there is none
const Factor& worst(std::span<const Factor> factors);

/// How a structure grows with the number of triangles: the slopes of logarithms, one for each scene
/// of three sizes or more.
struct Growth {
    std::string structure;
    std::vector<double> build = {}, bytes = {}, nodes = {}, ns = {};
};
Growth growth(const Comparison& comparison, std::string_view structure);

/// The best octree of chapter 6 beside bvh-binned on one scene, in the size that is nearest to the
/// compared one, however far: the ratio of what rays cost.
struct OctreeDuel {
    std::string scene, octree;
    bool is_even;
    double bvh_cost, octree_cost;
    double ratio() const { return octree_cost / bvh_cost; }
};
std::vector<OctreeDuel> octree_duels(const Comparison& comparison);

/// The numbers of rays for which the structure is the cheapest of the book's, build and rays
/// together; none where another always is. Of several ranges, from the first to the last.
std::optional<std::pair<double, double>> worth_it(Block block, std::string_view structure);

/// From 1 to 10^10 rays.
inline constexpr double fewest_rays = 1.0, most_rays = 1e10;

}  // namespace space::ch12
