#include "chapters/ch06_quadtrees_and_octrees/measured/adaptive.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/outcome.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/series.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <limits>

namespace space::ch06 {
namespace {

std::string share(std::uint64_t part, std::uint64_t whole) {
    const double of_all = double(part) / double(whole);
    return part > 0 && of_all < 0.001 ? fmt::format("{:.4f} %", 100.0 * of_all) : percent(of_all);
}

// --- trees over triangles ---

Table trees_table(const std::vector<TreePoint>& trees, bool times) {
    TimedTable table({"scene", "tree", "nodes", "per triangle", "depth", "bytes per triangle",
                      "nodes per ray", "tests per ray", "wrong"},
                     {"build, ms", "million rays/s"}, times);
    for (const TreePoint& p : trees)
        table.row({p.scene, std::string(p.tree), with_commas(p.nodes), fixed(p.per_triangle(), 2),
                   with_commas(p.depth), fixed(p.bytes_per_triangle(), 0),
                   fixed(p.nodes_per_ray(), 1), fixed(p.tests_per_ray(), 1), with_commas(p.wrong)},
                  {fixed(p.build_ms, 1), fixed(1e-6 * p.rays_per_second(), 3)});
    return table.table();
}

/// Some of the trees, of all scenes or of those that begin so.
Table some_trees(const std::vector<TreePoint>& trees, std::initializer_list<std::string_view> names,
                 std::string_view scene = "") {
    Table table({"scene", "triangles", "tree", "nodes", "depth", "references per triangle",
                 "nodes per ray", "tests per ray"});
    for (const TreePoint& p : trees)
        if (std::ranges::count(names, p.tree) > 0 && p.scene.starts_with(scene))
            table.row({p.scene, with_commas(p.n), std::string(p.tree), with_commas(p.nodes),
                       with_commas(p.depth), fixed(p.per_triangle(), 2),
                       fixed(p.nodes_per_ray(), 1), fixed(p.tests_per_ray(), 1)});
    return table;
}

Table layouts_table(const std::vector<TreePoint>& trees, bool times) {
    TimedTable table({"scene", "layout", "bytes a node", "nodes", "bytes per triangle"},
                     {"rays/s, blocks = 1"}, times);
    for (const TreePoint& p : trees) {
        if (p.node_bytes == 0) continue;
        const TreePoint& blocks = tree_of(trees, p.scene, octree);
        table.row(
            {p.scene,
             p.tree == octree     ? "blocks with a mask"
             : p.tree == pointers ? "pointers"
                                  : "linear, with boxes",
             with_commas(p.node_bytes), with_commas(p.nodes), fixed(p.bytes_per_triangle(), 0)},
            {fixed(blocks.trace_ms / p.trace_ms, 2)});
    }
    return table.table();
}

Table walks_table(const std::vector<TreePoint>& trees, bool times) {
    TimedTable table({"scene", "nodes per ray", "planes per ray: plain", "parametric"},
                     {"time, plain = 1"}, times);
    for (const TreePoint& p : trees) {
        if (p.tree != octree) continue;
        const TreePoint& plain = tree_of(trees, p.scene, plain_walk);
        const auto planes = [](const TreePoint& q) {
            return fixed(double(q.planes) / double(q.rays), 1);
        };
        table.row({p.scene, fixed(p.nodes_per_ray(), 1), planes(plain), planes(p)},
                  {fixed(p.trace_ms / plain.trace_ms, 2)});
    }
    return table.table();
}

/// Speeds beside the k-d tree's.
Table rays_table(const std::vector<TreePoint>& trees) {
    Table table({"scene", "filled", "octree", "plain walk", "kept", "loose", "linear", "best",
                 "no tree", "SAH k-d tree, million rays/s"});
    for (const TreePoint& p : trees) {
        if (p.tree != sah) continue;
        const auto beside = [&](std::string_view name) {
            const double speed = speed_beside_sah(trees, p.scene, name);
            return speed < 0.01 ? fmt::format("{:.1g}", speed) : fixed(speed, 2);
        };
        table.row({p.scene, p.is_even ? "evenly" : "unevenly", beside(octree), beside(plain_walk),
                   beside(kept), beside(loose), beside(linear),
                   fixed(best_beside_sah(trees, p.scene), 2), beside(no_tree),
                   fixed(1e-6 * p.rays_per_second(), 2)});
    }
    return table;
}

Table builds_table(const std::vector<TreePoint>& growth) {
    Table table({"scene", "triangles", "octree, ms", "linear, ms", "SAH k-d tree, ms",
                 "linear / k-d tree"});
    for (const TreePoint& p : growth) {
        if (p.tree != sah) continue;
        const TreePoint &in_cells = tree_of(growth, p.scene, octree, p.n),
                        &sorted = tree_of(growth, p.scene, linear, p.n);
        table.row({p.scene, with_commas(p.n), fixed(in_cells.build_ms, 1),
                   fixed(sorted.build_ms, 2), fixed(p.build_ms, 1),
                   fixed(sorted.build_ms / p.build_ms, 3)});
    }
    return table;
}

Table depths_table(const std::vector<TreePoint>& depths, bool times) {
    TimedTable table({"scene", "depth limit", "nodes", "references per triangle",
                      "bytes per triangle", "nodes per ray", "tests per ray"},
                     {"build, ms", "µs per ray"}, times);
    for (const TreePoint& p : depths)
        table.row({p.scene, with_commas(p.depth_limit), with_commas(p.nodes),
                   fixed(p.per_triangle(), 2), fixed(p.bytes_per_triangle(), 0),
                   fixed(p.nodes_per_ray(), 1), fixed(p.tests_per_ray(), 1)},
                  {fixed(p.build_ms, 1), fixed(1e3 * p.trace_ms / double(p.rays), 2)});
    return table.table();
}

// --- points and segments ---

Table points_table(const std::vector<PointTree>& points, bool times) {
    TimedTable table({"D", "points", "n", "depth d", "nodes", "cells", "cells / (d + 1) n"},
                     {"build, ms", "ns / (d + 1) n"}, times);
    for (const PointTree& p : points)
        table.row({std::to_string(p.dimensions), p.points, with_commas(p.n), with_commas(p.depth),
                   with_commas(p.nodes), with_commas(p.cells), fixed(p.cells_share(), 2)},
                  {fixed(p.build_ms, 2), fixed(p.ns_share(), 1)});
    return table.table();
}

Table segments_table(const std::vector<SegmentTree>& segments) {
    Table table({"segments n", "depth d", "cells", "references", "cells / (d + 1) n"});
    for (const SegmentTree& p : segments)
        table.row({with_commas(p.n), with_commas(p.depth), with_commas(p.cells),
                   with_commas(p.references), fixed(p.cells_share(), 1)});
    return table;
}

Table codes_table(const std::vector<CodePoint>& codes) {
    Table table({"edge c", "points", "distinct points", "codes of 30 bits", "codes of 63 bits"});
    for (const CodePoint& p : codes)
        table.row({p.exponent == 0 ? "1" : fmt::format("10^{}", p.exponent), with_commas(p.points),
                   with_commas(p.distinct_points), with_commas(p.codes_30),
                   with_commas(p.codes_63)});
    return table;
}

Table sorts_table(const std::vector<SortTimes>& sorts) {
    Table table({"items", "passes", "codes, ms", "sort, ms", "GB/s moved", "copy, GB/s",
                 "sort / estimate", "codes and sort / estimate"});
    for (const SortTimes& p : sorts)
        table.row({with_commas(p.items), with_commas(p.passes), fixed(p.codes_ms, 2),
                   fixed(p.sort_ms, 2), fixed(1e-6 * double(p.bytes_moved) / p.sort_ms, 2),
                   fixed(1e-6 * p.copy_bytes_per_ms, 2), fixed(p.of_estimate(), 2),
                   fixed(p.codes_of_estimate(), 2)});
    return table;
}

Table searches_table(const std::vector<SearchPoint>& searches, bool times) {
    TimedTable table({"D", "n", "tree", "inner nodes per search", "leaves", "points compared"},
                     {"µs"}, times);
    const auto each = [](const SearchPoint& p, std::uint64_t sum) {
        return fixed(double(sum) / double(p.queries), 1);
    };
    for (const SearchPoint& p : searches)
        table.row({std::to_string(p.dimensions), with_commas(p.n), std::string(p.tree),
                   each(p, p.inner), each(p, p.leaves), each(p, p.compared)},
                  {fixed(p.microseconds, 2)});
    return table.table();
}

Table overlaps_table(const std::vector<OverlapPoint>& overlaps) {
    Table table({"scene", "boxes in cells", "triangles in cells", "named by the box alone", "signs",
                 "by exact arithmetic"});
    for (const OverlapPoint& p : overlaps)
        table.row({p.scene, with_commas(p.pairs), with_commas(p.overlaps),
                   share(p.pairs - p.overlaps, p.pairs), with_commas(p.signs),
                   share(p.exact, p.signs)});
    return table;
}

Table planes_table(const std::vector<PlanePoint>& planes) {
    Table table({"margin", "planes met", "on the wrong side", "share"});
    for (const PlanePoint& p : planes)
        table.row({p.margin == 0.0 ? "none" : fmt::format("{} u |t|", p.margin),
                   with_commas(p.planes), with_commas(p.wrong_side),
                   share(p.wrong_side, p.planes)});
    return table;
}

}  // namespace

void print_trees(const std::vector<TreePoint>& trees, bool times) {
    print_heading("Trees by scene");
    trees_table(trees, times).print();
    print_heading("Two walks");
    walks_table(trees, times).print();
    print_heading("Layouts");
    layouts_table(trees, times).print();
    if (!times) return;
    print_heading("Rays per second, beside the SAH k-d tree's");
    rays_table(trees).print();
}
void print_growth(const std::vector<TreePoint>& growth, bool times) {
    print_heading("Scenes as they grow");
    trees_table(growth, times).print();
    if (!times) return;
    print_heading("Builds");
    builds_table(growth).print();
}
void print_depths(const std::vector<TreePoint>& depths, bool times) {
    print_heading("Limits of depth");
    depths_table(depths, times).print();
}
void print_points(const std::vector<PointTree>& points, bool times) {
    print_heading("Points, one in a cell: cells beside (d + 1) n");
    points_table(points, times).print();
}
void print_segments(const std::vector<SegmentTree>& segments) {
    print_heading("Segments across the square, in all cells that they meet");
    segments_table(segments).print();
}
void print_codes(const std::vector<CodePoint>& codes) {
    print_heading("Codes of points in a cube of edge c");
    codes_table(codes).print();
}
void print_sorts(const std::vector<SortTimes>& sorts) {
    print_heading("Codes and their sort, beside what moving the bytes takes");
    sorts_table(sorts).print();
}
void print_searches(const std::vector<SearchPoint>& searches, bool times) {
    print_heading("The nearest of n points");
    searches_table(searches, times).print();
}
void print_overlaps(const std::vector<OverlapPoint>& overlaps) {
    print_heading("Triangles and the cells that their boxes meet");
    overlaps_table(overlaps).print();
}
void print_planes(const std::vector<PlanePoint>& planes) {
    print_heading(fmt::format(
        "Where rays meet cells' planes: off by up to {:.2f} gamma(3) |T|, with u = 2^-53",
        planes.front().largest_error));
    planes_table(planes).print();
}

namespace {

void quote_trees(const std::vector<TreePoint>& trees, bool times, Numbers& numbers) {
    numbers.count_table("trees", trees_table(trees, false));
    numbers.count_table("stadium", some_trees(trees, {octree, loose, linear, sah}, "stadium"));
    numbers.count_table("straddlers", some_trees(trees, {octree, kept, loose}));
    numbers.count_table("layouts_counts", layouts_table(trees, false));
    numbers.count_table("walks_counts", walks_table(trees, false));
    if (!times) return;
    numbers.time_table("layouts", layouts_table(trees, true));
    numbers.time_table("walks", walks_table(trees, true));
    numbers.time_table("rays", rays_table(trees));
    double even = std::numeric_limits<double>::infinity(), uneven = even;
    for (const TreePoint& p : trees) {
        if (p.tree != sah) continue;
        double& least = p.is_even ? even : uneven;
        least = std::min(least, best_beside_sah(trees, p.scene));
    }
    numbers.time("even_least", even, fixed(even, 2));
    numbers.time("uneven_least", uneven, fixed(uneven, 2));
}

void quote_growth(const std::vector<TreePoint>& growth, bool times, Numbers& numbers) {
    numbers.count_table("scenes", some_trees(growth, {octree}));
    numbers.count_table("growth", trees_table(growth, false));
    if (!times) return;
    numbers.time_table("builds", builds_table(growth));
    double most = 0.0;
    for (const TreePoint& p : growth)
        if (p.tree == sah)
            most = std::max(most, tree_of(growth, p.scene, linear, p.n).build_ms / p.build_ms);
    numbers.time("linear_build_share", most, fixed(most, 2));
}

void quote_points(const std::vector<PointTree>& points, bool times, Numbers& numbers) {
    numbers.count_table("points_counts", points_table(points, false));
    for (const int dimensions : {2, 3}) {
        double most = 0.0;
        for (const PointTree& p : points)
            if (p.dimensions == dimensions) most = std::max(most, p.cells_share());
        numbers.count(dimensions == 2 ? "points_most" : "points_most_3", most, fixed(most, 2));
    }
    if (!times) return;
    numbers.time_table("points", points_table(points, true));
    const auto [least, most] = std::ranges::minmax(points, {}, &PointTree::ns_share);
    numbers.time("points_time_spread", most.ns_share() / least.ns_share(),
                 fixed(most.ns_share() / least.ns_share(), 1));
}

}  // namespace

Numbers quoted(const Measurements& measured, bool times) {
    Numbers numbers;
    numbers.count_table("codes", codes_table(measured.codes));
    numbers.count_table("overlap", overlaps_table(measured.overlaps));
    numbers.count_table("objects", segments_table(measured.segments));
    numbers.count_table("margin", planes_table(measured.planes));
    const double largest = measured.planes.front().largest_error;
    numbers.count("walk_largest", largest, fixed(largest, 2));
    double most = 0.0;
    for (const SegmentTree& p : measured.segments) most = std::max(most, p.cells_share());
    numbers.count("objects_most", most, fixed(most, 0));
    if (measured.trees.empty()) return numbers;  // --counts --quick
    quote_adaptive(measured.adaptive, times, numbers);
    quote_trees(measured.trees, times, numbers);
    quote_growth(measured.growth, times, numbers);
    quote_points(measured.points, times, numbers);
    numbers.count_table("depths_counts", depths_table(measured.depths, false));
    numbers.count_table("searches_counts", searches_table(measured.searches, false));
    if (!times) return numbers;
    numbers.time_table("depths", depths_table(measured.depths, true));
    numbers.time_table("searches", searches_table(measured.searches, true));
    numbers.time_table("sort", sorts_table(measured.sorts));
    return numbers;
}

}  // namespace space::ch06
