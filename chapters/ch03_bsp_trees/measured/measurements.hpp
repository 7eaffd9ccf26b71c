/// @file
/// What chapter 3 counts and times: trees by splitter, their growth, rays through them, and how
/// exactly fragments tile their polygons.
#pragma once

#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "chapters/ch03_bsp_trees/tiling.hpp"
#include "common/measure.hpp"
#include "common/program/chart.hpp"
#include "common/program/options.hpp"
#include "common/program/results.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch03 {

using SplitterChoice = BspConfig::SplitterChoice;
using Straddlers = BspConfig::Straddlers;

/// How trees are built, by the names that tables and options use.
struct Method {
    std::string_view name;
    SplitterChoice splitter;
    Straddlers straddlers = Straddlers::split;
};
inline constexpr std::array methods{
    Method{"first", SplitterChoice::first},
    Method{"random", SplitterChoice::random},
    Method{"balanced", SplitterChoice::balanced},
    Method{"fewest", SplitterChoice::fewest_splits},
    Method{"weighted", SplitterChoice::weighted},
    Method{"free", SplitterChoice::free},
    Method{"shared", SplitterChoice::weighted, Straddlers::share},
};
inline constexpr std::array grade_names{
    std::pair{"thick float", Grade::thick_float}, std::pair{"ordered float", Grade::ordered_float},
    std::pair{"double", Grade::ordered_double}, std::pair{"exact", Grade::exact}};

/// How far measurements go.
struct Limits {
    std::size_t sizes;             ///< of each growing scene
    std::uint64_t max_classified;  ///< polygons against planes, in one build
    std::size_t max_fragments;
    std::size_t rays, edge_rays;  ///< through each tree; at edges and at cuts of a closed mesh
    int rounds;                   ///< of timed builds
};
Limits limits(Amount amount);
/// Some 2 GB, and half a minute: where the chapter gives a scene's tree up.
inline constexpr std::size_t max_scene_fragments = 5'000'000;
inline constexpr std::uint64_t max_scene_placed = 100'000'000;

/// Rays from all around at points of the scene's box.
std::vector<Ray> rays_from_around(std::span<const Triangle> triangles, std::size_t count,
                                  std::uint64_t seed);

/// One tree, and what rays cost in it.
struct TreePoint {
    std::string scene, method;
    std::uint64_t polygons = 0, nodes = 0, fragments = 0, depth = 0;
    std::uint64_t most_pieces = 0;  ///< that one polygon has, or subtrees that it is in
    std::uint64_t placed = 0;       ///< fragments placed in front of, behind or on a node's plane
    std::uint64_t rays = 0, nodes_visited = 0, triangles_tested = 0;
    std::uint64_t wrong = 0;  ///< rays with another answer than the naive loop's
    double build_ms = 0.0;

    double per_polygon() const { return double(fragments) / double(polygons); }
    double nodes_per_ray() const { return double(nodes_visited) / double(rays); }
    double tests_per_ray() const { return double(triangles_tested) / double(rays); }
};

/// What is built, and what the answers of the naive loop are.
struct TreeTask {
    std::string scene;
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
    std::vector<std::optional<Hit>> truth;

    TreeTask(std::string name, std::vector<Triangle> all, const Options& options);
};
/// @throws LimitError where the tree would have more than max_fragments
TreePoint measure_tree(const TreeTask& task, const Method& method, std::size_t max_fragments,
                       std::uint64_t max_placed = BspConfig{}.max_placed);

/// The trees of one scene, one for each method, and which were given up and why.
struct MethodTrees {
    std::string scene;
    std::vector<TreePoint> trees = {};
    std::vector<std::string> given_up = {};
};
MethodTrees measure_methods(const std::string& scene, const Options& options);
/// Scenes whose size is what it is, by three methods; those on this machine.
std::vector<TreePoint> measure_scenes(const Options& options);

/// Trees of a scene as it grows. A series ends early where the next tree would have too many
/// fragments or take too many classifications; `stopped` says so.
struct Growth {
    std::string scene, method;
    std::vector<TreePoint> points = {};
    std::string stopped = {};
};
std::vector<Growth> measure_growth(const Options& options);
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
};
std::vector<Crossings> measure_crossings(const Options& options);

/// A closed mesh cut in one of the four grades.
struct GradePoint {
    std::string scene, grade;
    std::uint64_t nodes = 0, fragments = 0;
    Tiling tiling;
    SlippedRays old_edges, cuts;
    double build_ms = 0.0;

    double slipped_per_million() const {
        return 1e6 * double(old_edges.slipped + cuts.slipped) / double(old_edges.rays + cuts.rays);
    }
};
std::vector<GradePoint> measure_grades(const Options& options);

/// What a run measures.
struct Measurements {
    MethodTrees methods;
    std::vector<TreePoint> scenes;
    std::vector<Growth> growth;
    std::vector<Crossings> crossings;
    std::vector<GradePoint> grades;
};
/// Rays with another answer than the naive loop's, planes crossed by rays that stay on one side,
/// and what the exact grade must not have: lost area, cracks, slipped rays.
std::uint64_t wrong_answers(const Measurements& measured);

Chart fragments_chart(const std::vector<Growth>& growth);
Chart build_chart(const std::vector<Growth>& growth);
Chart grades_chart(const std::vector<GradePoint>& grades);
Chart rays_chart(const std::vector<Growth>& growth);

/// H4, H5, H6, H7 and P3.
std::vector<ClaimAnswer> answer_claims(const Measurements& measured);

/// The trees' counts; times too, where they mean something.
void print_methods(const MethodTrees& all, bool times);
void print_scenes(const std::vector<TreePoint>& scenes, bool times);
void print_growth(const std::vector<Growth>& growth, bool times);
void print_crossings(const std::vector<Crossings>& crossings);
void print_grades(const std::vector<GradePoint>& grades, bool times);

}  // namespace space::ch03
