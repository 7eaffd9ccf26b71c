/// @file
/// What chapter 4 counts and times, as plain values: enough for its tables, charts and verdicts.
#pragma once

#include "chapters/ch04_kd_trees/measured/point_data.hpp"
#include "common/measure.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch04 {

// --- Lichter23's tree and its cures ---

/// Lichter23, tables 5 and 6: ray-triangle tests, intersections found on the way, milliseconds.
inline constexpr std::uint64_t published_naive_tests = 519'950'720, published_tests = 139'090'305,
                               published_naive_found = 35'290, published_found = 36'802;
inline constexpr double published_naive_ms = 9'742.1, published_ms = 2'407.8;
inline constexpr double published_factor = double(published_naive_tests) / double(published_tests),
                        published_speedup = published_naive_ms / published_ms;

/// One row: a scene by the naive loop, or by the tree with this cure and all before it.
struct CurePoint {
    std::string scene, cure;
    std::uint64_t triangles = 0, rays = 0, tests = 0, boxes = 0;  ///< boxes: ray-box tests
    std::uint64_t found = 0;    ///< hits nearer than all before: "intersections found"
    std::uint64_t lost = 0;     ///< rays with another answer than the naive loop's
    std::uint64_t dropped = 0;  ///< triangles that no node names
    double box_area = 0.0;      ///< of the root, as a part of the scene's
    double trace_ms = 0.0;

    double tests_per_ray() const { return double(tests) / double(rays); }
};
/// Of the rows' cures: without a tree, without a cure, with all of them, and another tree.
inline constexpr std::string_view no_tree = "no tree", no_cure = "as published",
                                  all_cures = "early end", other_tree = "SAH";

// --- trees by rules ---

/// The rules, from the plainest to the dearest; growing scenes take the first three.
inline constexpr std::string_view middle = "middle", median_rule = "median", sah = "SAH",
                                  sah_boxes = "SAH, boxes", sah_kept = "SAH, kept",
                                  sah_split = "SAH, split";
inline constexpr std::array rule_names{middle, median_rule, sah, sah_boxes, sah_kept, sah_split};

/// One tree, and what rays cost in it.
struct TreePoint {
    std::string scene, rule;
    std::uint64_t n = 0;  ///< triangles
    std::uint64_t nodes = 0, references = 0, depth = 0;
    double cost = 0.0;         ///< expected of a ray through the root, by the SAH
    std::uint64_t placed = 0;  ///< references in all nodes together: the build's work
    std::uint64_t candidates = 0, faces = 0;  ///< planes tried, and six for each box of their nodes
    std::uint64_t root_candidates = 0;
    std::uint64_t rays = 0, nodes_visited = 0, tests = 0;
    std::uint64_t tests_unmailed = 0;      ///< without mailboxes
    std::uint64_t checked = 0, wrong = 0;  ///< rays held against the naive loop's answers, which
                                           ///< split polygons alone may miss
    double build_ms = 0.0, trace_ms = 0.0;

    double per_triangle() const { return double(references) / double(n); }
    double nodes_per_ray() const { return double(nodes_visited) / double(rays); }
    double tests_per_ray() const { return double(tests) / double(rays); }
    double steps_per_ray() const { return nodes_per_ray() + tests_per_ray(); }
    double rays_per_second() const { return 1e3 * double(rays) / trace_ms; }
};

/// A scene as it grows, by one rule.
using Growth = std::vector<TreePoint>;

/// The least-squares slope of log y over log n.
template <class Value>
double slope(const Growth& growth, const Value& value) {
    std::vector<double> n, y;
    for (const TreePoint& point : growth) {
        n.push_back(double(point.n));
        y.push_back(value(point));
    }
    return log_log_slope(n, y);
}
/// What is O(n log n), O(log n) and O(log n) does not grow over it.
inline double placed_per_n_log_n(const TreePoint& p) {
    return double(p.placed) / (double(p.n) * std::log2(double(p.n)));
}
inline double tests_per_log_n(const TreePoint& p) {
    return p.tests_per_ray() / std::log2(double(p.n));
}

// --- what goes wrong without care ---

/// By what is in float and without a margin: planes' distances, and split triangles' corners.
inline constexpr std::array<std::string_view, 4> care_names{"float both", "float planes",
                                                            "float pieces", "careful"};

/// One tree by one grade of care, under rays that are aimed where it matters.
struct CarePoint {
    std::string scene, care;
    std::uint64_t triangles = 0, rays = 0;
    std::uint64_t lost = 0;  ///< rays with another answer than the naive loop's
    double trace_ms = 0.0;

    double lost_per_million() const { return 1e6 * double(lost) / double(rays); }
};

/// Triangles of one size in equal cells, and three ways to lose a hit or to keep it.
struct OverlapPoint {
    double edge = 0.0;  ///< of a triangle; the scene is a unit cube
    std::uint64_t triangles = 0, leaves = 0;
    std::uint64_t overlaps = 0;    ///< triangles in leaves, by clipping
    std::uint64_t by_corners = 0;  ///< of them, those with a corner in the leaf
    std::uint64_t by_boxes = 0;    ///< bounding boxes in leaves
    std::uint64_t rays = 0;
    std::uint64_t lost = 0;   ///< rays with another answer where corners decide
    std::uint64_t early = 0;  ///< and where the first leaf's hit is taken
    std::uint64_t wrong = 0;  ///< and by the tree as it should be
};

// --- points and planes ---

/// Nodes and buckets that a search for the nearest point goes into.
inline double visited(const PointSet& set) {
    return set.nearest[0].subtrees_per_query() + set.nearest[0].buckets_per_query();
}
/// Sets of one kind, by "uniform, D = 2".
inline std::map<std::string, std::vector<const PointSet*>> series_of(
    const std::vector<PointSet>& sets) {
    std::map<std::string, std::vector<const PointSet*>> series;
    for (const PointSet& set : sets)
        series[set.places + ", D = " + std::to_string(set.dimensions)].push_back(&set);
    return series;
}

/// Nanoseconds for one plane, across an axis and in any direction.
struct PlaneTimes {
    std::string where;
    double axis_ns = 0.0, general_ns = 0.0;
};

/// One scene by rays through a tree and without one.
struct PicturePoint {
    std::string method;
    std::uint64_t rays = 0, nodes = 0, tests = 0;
    std::uint64_t other_pixels = 0;  ///< unlike the naive loop's
};

/// All of it. With --counts every time is 0 or no number.
struct Measurements {
    std::vector<PicturePoint> pictures;
    std::vector<CurePoint> cures;
    std::vector<TreePoint> trees;
    std::vector<Growth> growth;
    std::vector<CarePoint> care;
    std::vector<OverlapPoint> overlaps;
    std::vector<PlaneTimes> planes = {};
    std::vector<PointSet> points = {};
};

/// Answers of whole trees that are not the naive loop's.
std::uint64_t wrong_answers(const Measurements& measured);

}  // namespace space::ch04
