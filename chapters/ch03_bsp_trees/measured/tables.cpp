#include "chapters/ch03_bsp_trees/measured/measurements.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

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
        Table table = table_with(tree_headings, times, "build, ms");
        for (const TreePoint& point : all.trees)
            add_row(table, tree_cells(point), times, ms_text(point.build_ms));
        table.print();
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

void print_growth(const std::vector<Growth>& growth, bool times) {
    print_heading(
        "Growth: the largest tree of each series, and slopes over all of it (log y over log n)");
    std::vector<std::string> headings{"scene",  "splitter",      "polygons",          "fragments",
                                      "depth",  "nodes per ray", "slopes: fragments", "depth",
                                      "placed", "nodes per ray"};
    if (times) headings.insert(headings.end(), {"build", "build, ms"});
    headings.emplace_back("ended, because");
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
        cells.push_back(g.stopped);
        table.row(cells);
    }
    table.print();
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
                 fmt::format("{:.2g}", g.tiling.area_error), with_commas(g.tiling.cuts),
                 with_commas(g.tiling.cracks), with_commas(g.old_edges.rays),
                 with_commas(g.old_edges.slipped), with_commas(g.cuts.rays),
                 with_commas(g.cuts.slipped)},
                times, ms_text(g.build_ms));
    table.print();
}

}  // namespace space::ch03
