/// @file
/// What chapter 7 counts and times of trees, as plain values: enough for its tables, charts and
/// verdicts.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch07 {

// --- trees ---

inline constexpr std::string_view by_median = "median", by_middle = "middle", by_sweep = "sweep",
                                  by_bins = "binned", by_spatial = "spatial", by_morton = "morton",
                                  by_bottom_up = "bottom-up", by_bsp = "over BSP",
                                  by_optimiser = "optimised", bins_float = "binned, float test",
                                  embree = "Embree", embree_high = "Embree, high";

/// Three kinds of rays. Shadow rays ask whether there is any hit; diffuse ones leave surfaces in
/// all directions.
enum RayKind : std::size_t { camera_kind, shadow_kind, diffuse_kind };
inline constexpr std::array<std::string_view, 3> ray_kinds{"camera", "shadow", "diffuse"};

/// What rays of one kind cost in one tree.
struct RayCost {
    std::uint64_t rays = 0, nodes = 0, tests = 0;
    double ms = 0.0;

    double nodes_per_ray() const { return double(nodes) / double(rays); }
    double tests_per_ray() const { return double(tests) / double(rays); }
    double steps_per_ray() const { return nodes_per_ray() + tests_per_ray(); }
    double per_second() const { return 1e3 * double(rays) / ms; }
};

/// One tree. Embree does not tell its counts.
struct TreePoint {
    std::string scene;
    std::string_view builder;
    bool is_long = false;  ///< whether the scene has triangles as long as itself
    std::uint64_t n = 0;   ///< triangles
    std::uint64_t nodes = 0, leaves = 0, references = 0, depth = 0, bytes = 0;
    double cost = 0.0;  ///< expected of a ray through the root, by the default constants
    std::array<RayCost, ray_kinds.size()> rays = {};
    std::uint64_t checked = 0;  ///< rays held against the naive loop's answers
    std::uint64_t wrong = 0;    ///< of them, and of those held against another tree's
    double build_ms = 0.0;

    double nodes_per_triangle() const { return double(nodes) / double(n); }
    double references_per_triangle() const { return double(references) / double(n); }
    double bytes_per_triangle() const { return double(bytes) / double(n); }
    double build_ns() const { return 1e6 * build_ms / double(n); }  ///< of a triangle
    const RayCost& diffuse() const { return rays[diffuse_kind]; }
};

// --- what a node and a test cost, and leaves by any rule ---

/// A tree whose leaves are limited by count or by cost, and diffuse rays through it.
struct LeafPoint {
    std::string scene;
    std::string_view builder;
    double rule = 0.0;  ///< most triangles of a leaf, or C_V / C_NS
    std::uint64_t n = 0, nodes = 0, rays = 0, inner = 0, tests = 0;
    double ms = 0.0;

    double nodes_per_triangle() const { return double(nodes) / double(n); }
    double inner_per_ray() const { return double(inner) / double(rays); }
    double tests_per_ray() const { return double(tests) / double(rays); }
    double ns_per_ray() const { return 1e6 * ms / double(rays); }
};

/// Time of a ray = ray_ns + node_ns * inner nodes + test_ns * tests, fitted.
struct CostFit {
    std::string scene;
    double ray_ns = 0.0, node_ns = 0.0, test_ns = 0.0;
    double largest_error = 0.0;  ///< of the fitted time, as a share of the measured one

    double ratio() const { return node_ns / test_ns; }
};

// --- how the surface area heuristic is often told ---

/// Planes at the faces of triangles' boxes, and the cuts of a sweep, over all nodes that are cut.
struct CandidatePoint {
    std::string scene;
    std::uint64_t n = 0, nodes = 0;
    std::uint64_t faces = 0;       ///< 6 T a node
    std::uint64_t planes = 0;      ///< of them, at different places
    std::uint64_t partitions = 0;  ///< different ones that these planes make
    std::uint64_t cuts = 0;        ///< that the sweep tries: 3 (T - 1)
};

/// A tree whose cuts have the least sum of areas, with counts and without.
struct SumPoint {
    std::string scene;
    bool has_counts = false;
    std::uint64_t n = 0, nodes = 0, depth = 0;
    double cost = 0.0;
    RayCost rays = {};
};

inline constexpr std::string_view nearest_first = "nearest first", all_boxes = "all boxes";

/// One way to walk a tree.
struct WalkPoint {
    std::string scene;
    std::string_view walk;
    std::uint64_t n = 0;
    RayCost rays = {};
};

/// A builder with another Config.
struct VariantPoint {
    std::string scene, variant;
    std::uint64_t n = 0, references = 0;
    double cost = 0.0;
    RayCost rays = {};
};

// --- answers ---

/// Rays at edges, vertices and anywhere, by one box test and one triangle test.
struct AccuracyPoint {
    std::string scene;
    std::string_view margins, test;
    std::uint64_t n = 0, rays = 0;
    std::uint64_t wrong = 0;  ///< a hit where there is none, or none where there is one
    std::uint64_t other = 0;  ///< another triangle is hit
    double ms = 0.0;

    double wrong_per_million() const { return 1e6 * double(wrong) / double(rays); }
};
inline constexpr std::string_view conservative = "conservative", plain = "plain",
                                  exact_test = "filtered exact", float_test = "Möller-Trumbore",
                                  watertight_test = "watertight";

/// The same rays by the exact test through one builder's tree.
struct ExactPoint {
    std::string scene;
    std::string_view builder;
    std::uint64_t n = 0, rays = 0, wrong = 0;  ///< any bit of the answer
};

// --- where a build's time goes ---

inline constexpr std::array<std::uint64_t, 3> task_sizes{32, 1'024, 32'768};

/// One binned build in parts.
struct PhasePoint {
    std::string scene;
    std::uint64_t n = 0;
    double boxes_ms = 0.0;                                    ///< around all triangles
    std::array<double, task_sizes.size() + 1> nodes_ms = {};  ///< of fewer triangles than these
    double copy_ms = 0.0;                                     ///< triangles into the leaves' order
    std::uint64_t bytes_moved = 0;                            ///< read and written
    double copy_bytes_per_ms = 0.0;                           ///< of the machine, read and written

    double total_ms() const {
        double sum = boxes_ms + copy_ms;
        for (const double ms : nodes_ms) sum += ms;
        return sum;
    }
    double bytes_per_ms() const { return double(bytes_moved) / total_ms(); }
};

/// All of it but the volumes. With --counts every time is 0 or no number.
struct TreeMeasurements {
    std::vector<TreePoint> trees;
    std::vector<TreePoint> growth;  ///< scenes as they grow
    std::vector<LeafPoint> leaves;
    std::vector<CandidatePoint> candidates;
    std::vector<SumPoint> sums;
    std::vector<WalkPoint> walks;
    std::vector<VariantPoint> spatial, from_below;
    std::vector<AccuracyPoint> accuracy;
    std::vector<ExactPoint> exact;
    std::vector<PhasePoint> phases;  ///< none where nothing is timed
};

/// Answers that are not exact arithmetic's, of trees that promise it.
std::uint64_t wrong_answers(const TreeMeasurements& measured);

}  // namespace space::ch07
