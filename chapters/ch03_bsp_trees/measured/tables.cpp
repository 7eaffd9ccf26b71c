#include "chapters/ch03_bsp_trees/measured/outcome.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace space::ch03 {
namespace {

std::string ms_text(double ms) {
    return fmt::format("{:.{}f}", ms, ms < 100 ? 1 : 0);
}

/// Adds a row; its last cell, the time, only where times are shown.
void add_row(Table& table, std::vector<std::string> cells, bool times, const std::string& time) {
    if (times) cells.push_back(time);
    table.row(cells);
}
Table table_with(std::vector<std::string> headings, bool times, const char* heading) {
    if (times) headings.emplace_back(heading);
    return Table(headings);
}

std::vector<std::string> tree_cells(const TreePoint& p) {
    return {p.method,
            with_commas(p.nodes),
            with_commas(p.fragments),
            fmt::format("{:.2f}", p.per_polygon()),
            with_commas(p.most_pieces),
            with_commas(p.depth),
            fmt::format("{:.1f}", p.nodes_per_ray()),
            fmt::format("{:.1f}", p.tests_per_ray())};
}
const std::vector<std::string> tree_headings{"splitter",      "nodes",        "fragments",
                                             "per polygon",   "most of one",  "depth",
                                             "nodes per ray", "tests per ray"};

Table methods_table(const MethodTrees& all, bool times) {
    Table table = table_with(tree_headings, times, "build, ms");
    for (const TreePoint& point : all.trees)
        add_row(table, tree_cells(point), times, ms_text(point.build_ms));
    return table;
}

std::string slope_text(const std::optional<double>& slope) {
    return slope ? fmt::format("{:.2f}", *slope) : "-";
}

}  // namespace

void print_methods(const MethodTrees& all, bool times) {
    print_heading(fmt::format("{}: a tree for each choice of splitters", all.scene));
    if (!all.trees.empty()) {
        const TreePoint& any = all.trees.front();
        fmt::print("{} polygons; {} rays, each of which takes {} tests naively\n\n",
                   with_commas(any.polygons), with_commas(any.rays), with_commas(any.polygons));
        methods_table(all, times).print();
    }
    for (const std::string& line : all.given_up) fmt::print("Given up: {}.\n", line);
}

void print_scenes(const std::vector<TreePoint>& scenes, bool times) {
    print_heading("Scenes of one size");
    std::vector<std::string> headings{"scene", "polygons"};
    headings.insert(headings.end(), tree_headings.begin(), tree_headings.end());
    Table table = table_with(headings, times, "build, ms");
    for (const TreePoint& point : scenes) {
        std::vector<std::string> cells{point.scene, with_commas(point.polygons)};
        for (const std::string& cell : tree_cells(point)) cells.push_back(cell);
        add_row(table, cells, times, ms_text(point.build_ms));
    }
    table.print();
}

/// Why series ended before the largest size, those of one scene and reason together.
void print_ends(const std::vector<Growth>& growth) {
    const Growth* before = nullptr;
    for (const Growth& g : growth) {
        if (g.stopped.empty()) continue;
        const bool same = before && before->scene == g.scene && before->stopped == g.stopped;
        if (before && !same) fmt::print(": {}\n", before->stopped);
        if (!before) fmt::print("\nNo larger size:\n");
        if (same)
            fmt::print(", {}", g.method);
        else
            fmt::print("{} by {}", g.scene, g.method);
        before = &g;
    }
    if (before) fmt::print(": {}\n", before->stopped);
}

void print_growth(const std::vector<Growth>& growth, bool times) {
    print_heading(
        "Growth: the largest tree of each series, and slopes over all of it (log y over log n)");
    std::vector<std::string> headings{"scene",  "splitter",      "polygons",          "fragments",
                                      "depth",  "nodes per ray", "slopes: fragments", "depth",
                                      "placed", "nodes per ray"};
    if (times) headings.insert(headings.end(), {"build", "build, ms"});
    Table table(headings);
    for (const Growth& g : growth) {
        const TreePoint& last = g.points.back();
        std::vector<std::string> cells{
            g.scene,
            g.method,
            with_commas(last.polygons),
            with_commas(last.fragments),
            with_commas(last.depth),
            fmt::format("{:.1f}", last.nodes_per_ray()),
            slope_text(slope(g, [](const TreePoint& p) { return double(p.fragments); })),
            slope_text(slope(g, [](const TreePoint& p) { return double(p.depth); })),
            slope_text(slope(g, [](const TreePoint& p) { return double(p.placed); })),
            slope_text(slope(g, [](const TreePoint& p) { return p.nodes_per_ray(); }))};
        if (times) {
            cells.push_back(slope_text(slope(g, [](const TreePoint& p) { return p.build_ms; })));
            cells.push_back(ms_text(last.build_ms));
        }
        table.row(cells);
    }
    table.print();
    print_ends(growth);
}

void print_crossings(const std::vector<Crossings>& crossings) {
    print_heading("Rays through the whole tree: where both subtrees are looked at");
    Table table({"scene", "rays", "nodes visited", "plane crossed in the cell",
                 "both subtrees there", "along the plane", "on one side of it"});
    for (const Crossings& c : crossings)
        table.row({c.scene, with_commas(c.rays), with_commas(c.visits), with_commas(c.crossed),
                   with_commas(c.both), with_commas(c.undecided), with_commas(c.contradicted)});
    table.print();
}

void print_grades(const std::vector<GradePoint>& grades, bool times) {
    print_heading("Four grades of care: do the fragments tile their polygons?");
    std::vector<std::string> headings{
        "scene",  "grade",         "nodes",   "fragments",    "worst area error", "edges cut",
        "cracks", "rays at edges", "slipped", "rays at cuts", "slipped"};
    Table table = table_with(headings, times, "build, ms");
    for (const GradePoint& g : grades)
        add_row(table,
                {g.scene, g.grade, with_commas(g.nodes), with_commas(g.fragments),
                 fmt::format("{:.2g}", g.area_error), with_commas(g.cuts), with_commas(g.cracks),
                 with_commas(g.edge_rays), with_commas(g.edge_slipped), with_commas(g.cut_rays),
                 with_commas(g.cut_slipped)},
                times, ms_text(g.build_ms));
    table.print();
}

namespace {

void quote_pictures(const Measurements& measured, Numbers& numbers) {
    const Pictures& pictures = measured.pictures;
    if (pictures.pixels > 0) {
        const double rays = double(pictures.rays);
        numbers.count("pixels", pictures.pixels);
        numbers.count("picture_tests", double(pictures.tests) / rays,
                      fixed(double(pictures.tests) / rays, 0));
        numbers.count("picture_naive_tests",
                      static_cast<std::uint64_t>(double(pictures.naive_tests) / rays + 0.5));
        numbers.count("picture_same_depth", pictures.same_depth);
        numbers.count("picture_differ", pictures.other_pixels + pictures.painter_wrong);
    }
    numbers.count_table("splitters", methods_table(measured.methods, false));
    if (measured.methods.trees.empty()) return;
    numbers.count("splitters_polygons", measured.methods.trees.front().polygons);
    numbers.count("splitters_rays", measured.methods.trees.front().rays);
}

/// NAME_n, NAME_depth, NAME_nodes_per_ray and NAME_log2_nodes of the last tree of a series.
const TreePoint& quote_last(const std::vector<Growth>& growth, const char* scene,
                            const char* method, const std::string& name, Numbers& numbers) {
    const TreePoint& last = growth_of(growth, scene, method).points.back();
    numbers.count(name + "_n", last.polygons);
    numbers.count(name + "_depth", last.depth);
    numbers.count(name + "_nodes_per_ray", last.nodes_per_ray(),
                  with_commas(static_cast<std::uint64_t>(last.nodes_per_ray() + 0.5)));
    numbers.count(name + "_log2_nodes", std::log2(double(last.nodes)),
                  fixed(std::log2(double(last.nodes)), 0));
    return last;
}

void quote_growth(const std::vector<Growth>& growth, Numbers& numbers) {
    constexpr double none = std::numeric_limits<double>::infinity();
    double fewest = none, most = 0.0, least_slope = none, most_slope = 0.0;
    std::uint64_t least_n = ~std::uint64_t{0}, most_n = 0, deepest = 0, big_n = 0;
    for (const Growth& g : growth) {
        const bool big = g.scene == "big triangles", walls = g.scene == "boxes";
        if (big) {
            big_n = std::max(big_n, g.points.back().polygons);
            const double fitted =
                slope(g, [](const TreePoint& p) { return double(p.fragments); }).value_or(0.0);
            least_slope = std::min(least_slope, fitted);
            most_slope = std::max(most_slope, fitted);
        }
        for (const TreePoint& point : g.points) {
            deepest = std::max(deepest, point.depth);
            if (big || (walls && g.method == "first")) continue;
            fewest = std::min(fewest, point.per_polygon());
            most = std::max(most, point.per_polygon());
            least_n = std::min(least_n, point.polygons);
            most_n = std::max(most_n, point.polygons);
        }
    }
    numbers.count("big_slope_least", least_slope, fixed(least_slope, 1));
    numbers.count("big_slope_most", most_slope, fixed(most_slope, 1));
    numbers.count("big_n", big_n);
    numbers.count("deepest", deepest);
    numbers.count("pieces_least", fewest, fixed(fewest, 1));
    numbers.count("pieces_most", most, fixed(most, 1));
    numbers.count("pieces_from_n", least_n);
    numbers.count("pieces_to_n", most_n);

    const TreePoint chain = quote_last(growth, "icosphere", "weighted", "chain", numbers);
    const TreePoint cured = quote_last(growth, "icosphere", "free", "cured", numbers);
    const auto placed = slope(growth_of(growth, "icosphere", "weighted"),
                              [](const TreePoint& p) { return double(p.placed); });
    numbers.count("chain_slope", placed.value_or(0.0), fixed(placed.value_or(0.0), 2));
    numbers.count("cured_times", double(cured.polygons) / double(chain.polygons),
                  fixed(double(cured.polygons) / double(chain.polygons), 0));
    numbers.count("cured_pieces", cured.per_polygon(), fixed(cured.per_polygon(), 1));
    quote_last(growth, "soup", "balanced", "soup_balanced", numbers);
    quote_last(growth, "teapot", "balanced", "teapot_balanced", numbers);
    quote_last(growth, "teapot", "free", "teapot_free", numbers);
    quote_last(growth, "stack", "weighted", "stack", numbers);
    quote_last(growth, "soup", "weighted", "soup", numbers);
    const TreePoint& first = growth_of(growth, "soup", "weighted").points.front();
    numbers.count("soup_first_n", first.polygons);
    numbers.count("soup_first_nodes_per_ray", first.nodes_per_ray(),
                  fixed(first.nodes_per_ray(), 0));
}

/// The last of the scenes, which is the bunny in a full run.
void quote_grades(const std::vector<GradePoint>& grades, bool times, Numbers& numbers) {
    if (grades.empty()) return;
    const std::vector<GradePoint> last(grades.end() - grade_names.size(), grades.end());
    Table table({"grade", "worst area error", "edges cut", "cracks", "slipped at old edges",
                 "slipped at cuts"});
    for (const GradePoint& g : last)
        table.row({g.grade, power_of_ten(g.area_error), with_commas(g.cuts), with_commas(g.cracks),
                   with_commas(g.edge_slipped), with_commas(g.cut_slipped)});
    numbers.count_table("grades", table);
    numbers.count("grades_scene", double(last[0].polygons), last[0].scene);
    numbers.count("grades_polygons", last[0].polygons);
    numbers.count("grades_rays", last[0].edge_rays + last[0].cut_rays);
    const double saved = 1.0 - double(last[1].edge_slipped) / double(last[0].edge_slipped);
    numbers.count("grades_saved", saved, one_in(saved));
    if (!times) return;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    for (std::size_t i = 0; i < grades.size(); i += grade_names.size()) {
        const double exact = grades[i + 3].build_ms / grades[i + 2].build_ms;
        least = std::min(least, exact);
        most = std::max(most, exact);
    }
    numbers.time("exact_cost_least", least, fixed(least, 1));
    numbers.time("exact_cost_most", most, fixed(most, 1));
}

}  // namespace

Numbers quoted(const Measurements& measured, bool times) {
    Numbers numbers;
    quote_pictures(measured, numbers);
    numbers.count("worst_known_share", measured.worst_known_share,
                  fixed(measured.worst_known_share, 2));
    if (!measured.growth.empty()) quote_growth(measured.growth, numbers);
    quote_grades(measured.grades, times, numbers);
    const Crossings sum = all_crossings(measured);
    numbers.count("crossing_rays", sum.rays);
    numbers.count("crossing_visits", sum.visits);
    const double crossed = double(sum.crossed) / double(sum.visits),
                 both = double(sum.both) / double(sum.visits);
    numbers.count("crossed", crossed, percent(crossed));
    numbers.count("both_subtrees", both, percent(both));
    if (!measured.grades.empty()) numbers.count("checked_rays", checked_rays(measured));
    return numbers;
}

}  // namespace space::ch03
