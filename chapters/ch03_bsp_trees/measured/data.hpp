/// @file
/// What chapter 3 counts and times, as plain values: enough for its tables, charts and verdicts.
#pragma once

#include "common/measure.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch03 {

/// The four grades of care, from the least to the most.
inline constexpr std::array<std::string_view, 4> grade_names{"thick float", "ordered float",
                                                             "double", "exact"};

/// One scene by rays through its tree and by the painter, beside the same without a tree.
struct Pictures {
    std::uint64_t pixels = 0, rays = 0;  ///< shadow rays too
    std::uint64_t nodes = 0, tests = 0, naive_tests = 0;
    std::uint64_t other_pixels = 0;   ///< of the rays' picture, unlike the naive one's
    std::uint64_t painter_wrong = 0;  ///< another triangle than the z-buffer's
    std::uint64_t same_depth = 0;     ///< or one of two at the same depth
};

/// One tree, and what rays cost in it.
struct TreePoint {
    std::string scene, method;
    std::uint64_t polygons = 0, nodes = 0, fragments = 0, depth = 0;
    std::uint64_t most_pieces = 0;  ///< that one polygon has, or subtrees that it is in
    std::uint64_t placed = 0;       ///< fragments placed in front of, behind or on a node's plane
    /// Placed where no side of the node's plane got more than two thirds of the set.
    std::uint64_t placed_balanced = 0;
    std::uint64_t lookups = 0, lookup_nodes = 0;  ///< of points of the scene's box, from the root
    std::uint64_t rays = 0, nodes_visited = 0, triangles_tested = 0;
    std::uint64_t wrong = 0;  ///< rays with another answer than the naive loop's
    double build_ms = 0.0;

    double per_polygon() const { return double(fragments) / double(polygons); }
    double nodes_per_lookup() const { return double(lookup_nodes) / double(lookups); }
    double nodes_per_ray() const { return double(nodes_visited) / double(rays); }
    double tests_per_ray() const { return double(triangles_tested) / double(rays); }
};

/// The trees of one scene, one for each method, and which were given up and why.
struct MethodTrees {
    std::string scene;
    std::vector<TreePoint> trees = {};
    std::vector<std::string> given_up = {};
};

/// Trees of a scene as it grows. A series ends early where the next tree would have too many
/// fragments or take too many classifications; `stopped` says so.
struct Growth {
    std::string scene, method;
    std::vector<TreePoint> points = {};
    std::string stopped = {};
};
/// @throws std::out_of_range
const Growth& growth_of(const std::vector<Growth>& growths, std::string_view scene,
                        std::string_view method);

/// The least-squares slope of log y over log n; nothing for fewer than three sizes.
template <class Value>
std::optional<double> slope(const Growth& growth, const Value& value) {
    if (growth.points.size() < 3) return std::nullopt;
    std::vector<double> n, y;
    for (const TreePoint& point : growth.points) {
        n.push_back(double(point.polygons));
        y.push_back(value(point));
    }
    return log_log_slope(n, y);
}

/// Rays through the whole tree, none ended by a hit.
struct Crossings {
    std::string scene;
    std::uint64_t rays = 0, visits = 0;
    std::uint64_t crossed = 0;    ///< visits with the plane crossed in the node's cell
    std::uint64_t both = 0;       ///< of them, those with two subtrees
    std::uint64_t undecided = 0;  ///< the ray runs so nearly along the plane that double can't tell
    std::uint64_t contradicted = 0;  ///< of the crossed: the ray's line stays on one side

    Crossings& operator+=(const Crossings& other) {
        rays += other.rays;
        visits += other.visits;
        crossed += other.crossed;
        both += other.both;
        undecided += other.undecided;
        contradicted += other.contradicted;
        return *this;
    }
};

/// A closed mesh cut in one of the four grades (tiling.hpp).
struct GradePoint {
    std::string scene, grade;
    std::uint64_t polygons = 0, nodes = 0, fragments = 0;
    double area_error = 0.0;  ///< of the worst polygon, as a part of its area
    std::uint64_t cuts = 0, cracks = 0;
    std::uint64_t edge_rays = 0, edge_slipped = 0;  ///< at old edges
    std::uint64_t cut_rays = 0, cut_slipped = 0;    ///< at cuts
    double build_ms = 0.0;

    double slipped_per_million() const {
        return 1e6 * double(edge_slipped + cut_slipped) / double(edge_rays + cut_rays);
    }
};

/// What Algorithm 2 does as it is printed.
struct PrintedTree {
    std::string scene;
    std::uint64_t polygons = 0;
    std::uint64_t splitters = 0;         ///< chosen
    std::uint64_t stored = 0;            ///< of them, those that the tree holds in the end
    std::uint64_t missing_children = 0;  ///< gone down to, and never made
    std::uint64_t coplanar = 0;  ///< polygons in a splitter's plane, which no set takes; the
                                 ///< splitters themselves left out
};

/// All of it. With --counts every time is 0 or no number.
struct Measurements {
    Pictures pictures;
    MethodTrees methods;
    std::vector<TreePoint> scenes;
    std::vector<Growth> growth;
    std::vector<Crossings> crossings;
    std::vector<GradePoint> grades;
    std::vector<PrintedTree> printed = {};
    double worst_known_share = 0.0;  ///< of the bound for sides, by an error
};
/// Rays with another answer than the naive loop's, planes crossed by rays that stay on one side,
/// and what the exact grade must not have: lost area, cracks, slipped rays.
std::uint64_t wrong_answers(const Measurements& measured);
/// Crossings of all scenes together.
Crossings all_crossings(const Measurements& measured);
/// Rays whose answers were held against the naive loop's.
std::uint64_t checked_rays(const Measurements& measured);

}  // namespace space::ch03
