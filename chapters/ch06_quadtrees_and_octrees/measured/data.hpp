/// @file
/// What chapter 6 counts and times, as plain values: enough for its tables, charts and verdicts.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive_data.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch06 {

// --- trees over triangles ---

inline constexpr std::string_view octree = "octree", plain_walk = "octree, plain walk",
                                  pointers = "octree, pointers", kept = "octree, kept",
                                  loose = "loose octree", linear = "linear octree",
                                  sah = "SAH k-d tree", no_tree = "no tree";

/// One tree, and what rays cost in it.
struct TreePoint {
    std::string scene;
    std::string_view tree;
    bool is_even = false;  ///< whether triangles of about one size fill the scene evenly
    std::uint64_t n = 0;   ///< triangles
    std::uint64_t depth_limit = 0;
    std::uint64_t nodes = 0, references = 0, depth = 0, bytes = 0, node_bytes = 0;
    std::uint64_t rays = 0, nodes_visited = 0, tests = 0;
    std::uint64_t planes = 0;              ///< whose parameters the walk computes below the root
    std::uint64_t checked = 0, wrong = 0;  ///< rays held against the naive loop's answers
    double build_ms = 0.0, trace_ms = 0.0;

    double per_triangle() const { return double(references) / double(n); }
    double bytes_per_triangle() const { return double(bytes) / double(n); }
    double nodes_per_ray() const { return double(nodes_visited) / double(rays); }
    double tests_per_ray() const { return double(tests) / double(rays); }
    double rays_per_second() const { return 1e3 * double(rays) / trace_ms; }
};

// --- trees of points and of segments ---

/// A tree that is cut while two points share a cell.
struct PointTree {
    std::string points;  ///< what kind of set
    int dimensions = 0;
    std::uint64_t n = 0, depth = 0, nodes = 0;
    std::uint64_t cells = 0;  ///< nodes, and children without one, which are empty
    double build_ms = 0.0;

    double bound() const { return double(depth + 1) * double(n); }
    double cells_share() const { return double(cells) / bound(); }
    double ns_share() const { return 1e6 * build_ms / bound(); }
};

/// A quadtree over long segments with a limit of depth.
struct SegmentTree {
    std::uint64_t n = 0, depth = 0, cells = 0, references = 0;

    double cells_share() const { return double(cells) / (double(depth + 1) * double(n)); }
};

/// Points in a cube of this edge within the unit cube, and their codes.
struct CodePoint {
    int exponent = 0;  ///< the edge is 10^exponent
    std::uint64_t points = 0, distinct_points = 0, codes_30 = 0, codes_63 = 0;
};

/// Codes and their sort, beside a copy of the machine's.
struct SortTimes {
    std::uint64_t items = 0, passes = 0, bytes_moved = 0;
    double codes_ms = 0.0, sort_ms = 0.0;
    double copy_bytes_per_ms = 0.0;  ///< read and written

    double estimated_ms() const { return double(bytes_moved) / copy_bytes_per_ms; }
    double of_estimate() const { return sort_ms / estimated_ms(); }
    double codes_of_estimate() const { return (codes_ms + sort_ms) / estimated_ms(); }
};

/// Searches for the nearest of n points.
struct SearchPoint {
    std::string_view tree;
    int dimensions = 0;
    std::uint64_t n = 0, queries = 0, inner = 0, leaves = 0, compared = 0;
    std::uint64_t differs = 0;  ///< answers that are not chapter 4's tree's
    double microseconds = 0.0;
};

// --- overlaps and planes ---

/// Pairs of a triangle and a child's cell that a build looks at.
struct OverlapPoint {
    std::string scene;
    std::uint64_t pairs = 0;     ///< of them, the triangle's box and the cell overlap
    std::uint64_t overlaps = 0;  ///< the triangle and the cell do
    std::uint64_t signs = 0;     ///< sides of planes and lines that were asked for
    std::uint64_t exact = 0;     ///< of them, not decided by the filter
};

/// Where rays meet the planes of cells: computed parameters t beside exact ones.
struct PlanePoint {
    double margin = 0.0;  ///< in units of 2^-53 |t|
    std::uint64_t planes = 0;
    std::uint64_t wrong_side = 0;  ///< of the exact one, once moved by the margin
    double largest_error = 0.0;    ///< in gamma(3) |T|
};

/// All of it. With --counts every time is 0 or no number.
struct Measurements {
    std::vector<TreePoint> trees;
    std::vector<TreePoint> growth;  ///< scenes as they grow
    std::vector<TreePoint> depths;  ///< octrees with limits of depth
    std::vector<PointTree> points;
    std::vector<SegmentTree> segments;
    std::vector<CodePoint> codes;
    std::vector<SortTimes> sorts;
    std::vector<SearchPoint> searches;
    std::vector<OverlapPoint> overlaps;
    std::vector<PlanePoint> planes;
    std::vector<AdaptivePoint> adaptive;
};

/// Answers that are not the naive loop's, chapter 4's or the full picture's.
std::uint64_t wrong_answers(const Measurements& measured);

}  // namespace space::ch06
