#include "chapters/ch04_kd_trees/measured/outcome.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace space::ch04 {
namespace {

// --- Lichter23's tree ---

std::vector<CurePoint> of_scene(const std::vector<CurePoint>& cures, std::string_view scene) {
    std::vector<CurePoint> some;
    std::ranges::copy_if(cures, std::back_inserter(some),
                         [&](const CurePoint& point) { return point.scene == scene; });
    return some;
}

/// The first scene, which is of Lichter23's kind, beside what he published.
Table cures_table(const std::vector<CurePoint>& cures, bool times) {
    TimedTable table(
        {"cure", "boxes per ray", "tests", "tests per ray", "times fewer", "found", "lost"},
        {"ms", "times faster"}, times);
    table.row({"[Lichter23], no tree", "", with_commas(published_naive_tests), "", "1.00",
               with_commas(published_naive_found), ""},
              {fixed(published_naive_ms, 1), "1.0"});
    table.row({"[Lichter23], k-d tree", "", with_commas(published_tests), "",
               fixed(published_factor, 2), with_commas(published_found), ""},
              {fixed(published_ms, 1), fixed(published_speedup, 1)});
    const std::vector<CurePoint> rows = of_scene(cures, cures.front().scene);
    for (const CurePoint& p : rows)
        table.row({p.cure, fixed(double(p.boxes) / double(p.rays), 1), with_commas(p.tests),
                   fixed(p.tests_per_ray(), 1), fixed(double(rows[0].tests) / double(p.tests), 2),
                   with_commas(p.found), with_commas(p.lost)},
                  {fixed(p.trace_ms, 1), fixed(rows[0].trace_ms / p.trace_ms, 1)});
    return table.table();
}

/// The other scenes, on which the published tree fails.
Table faults_table(const std::vector<CurePoint>& cures) {
    Table table(
        {"scene", "cure", "root's area", "triangles dropped", "tests per ray", "found", "lost"});
    for (const CurePoint& p : cures) {
        if (p.scene == cures.front().scene) continue;
        table.row({p.scene, p.cure, p.box_area > 0.0 ? fixed(p.box_area, 2) : "",
                   p.box_area > 0.0 ? with_commas(p.dropped) : "", fixed(p.tests_per_ray(), 1),
                   with_commas(p.found), with_commas(p.lost)});
    }
    return table;
}

// --- rules ---

Table trees_table(const std::vector<TreePoint>& trees, bool times) {
    TimedTable table({"scene", "rule", "nodes", "per triangle", "depth", "cost", "nodes per ray",
                      "tests per ray", "lost"},
                     {"build, ms", "million rays/s"}, times);
    for (const TreePoint& p : trees)
        table.row({p.scene, p.rule, with_commas(p.nodes), fixed(p.per_triangle(), 2),
                   with_commas(p.depth), fixed(p.cost, 1), fixed(p.nodes_per_ray(), 1),
                   fixed(p.tests_per_ray(), 1), with_commas(p.wrong)},
                  {fixed(p.build_ms, 1), fixed(1e-6 * p.rays_per_second(), 2)});
    return table.table();
}

double mail_saved(const TreePoint& p) {
    return 1.0 - double(p.tests) / double(p.tests_unmailed);
}

/// Mailboxes, where triangles are in several leaves.
Table mailbox_table(const std::vector<TreePoint>& trees) {
    Table table({"scene", "rule", "tests per ray without mailboxes", "with", "saved"});
    for (const TreePoint& p : trees)
        if (p.rule == sah || p.rule == sah_boxes)
            table.row({p.scene, p.rule, fixed(double(p.tests_unmailed) / double(p.rays), 2),
                       fixed(p.tests_per_ray(), 2), percent(mail_saved(p))});
    return table;
}

double candidates_tried(const TreePoint& p) {
    return double(p.candidates) / double(p.faces);
}

Table candidates_table(const std::vector<TreePoint>& trees) {
    Table table({"scene", "triangles", "planes tried at the root", "per 6 T", "at all nodes",
                 "per 6 T there"});
    for (const TreePoint& p : trees)
        if (p.rule == sah)
            table.row({p.scene, with_commas(p.n), with_commas(p.root_candidates),
                       fixed(double(p.root_candidates) / (6.0 * double(p.n)), 2),
                       with_commas(p.candidates), fixed(candidates_tried(p), 2)});
    return table;
}

// --- growth ---

Table growth_table(const std::vector<Growth>& growth, bool times) {
    TimedTable table(
        {"scene", "rule", "triangles", "per triangle", "depth", "nodes per ray", "tests per ray",
         "slopes: references", "placed", "nodes per ray", "tests per ray"},
        {"build", "build, ms", "million rays/s"}, times);
    for (const Growth& g : growth) {
        const TreePoint& last = g.back();
        table.row({last.scene, last.rule, with_commas(last.n), fixed(last.per_triangle(), 2),
                   with_commas(last.depth), fixed(last.nodes_per_ray(), 1),
                   fixed(last.tests_per_ray(), 1),
                   fixed(slope(g, [](const TreePoint& p) { return double(p.references); }), 2),
                   fixed(slope(g, [](const TreePoint& p) { return double(p.placed); }), 2),
                   fixed(slope(g, [](const TreePoint& p) { return p.nodes_per_ray(); }), 2),
                   fixed(slope(g, [](const TreePoint& p) { return p.tests_per_ray(); }), 2)},
                  {times ? fixed(slope(g, [](const TreePoint& p) { return p.build_ms; }), 2) : "",
                   fixed(last.build_ms, 1), fixed(1e-6 * last.rays_per_second(), 2)});
    }
    return table.table();
}

// --- care ---

Table care_table(const std::vector<CarePoint>& care, bool times) {
    TimedTable table({"scene", "grade", "triangles", "rays", "lost"}, {"ns per ray"}, times);
    for (const CarePoint& p : care)
        table.row(
            {p.scene, p.care, with_commas(p.triangles), with_commas(p.rays), with_commas(p.lost)},
            {fixed(1e6 * p.trace_ms / double(p.rays), 0)});
    return table.table();
}

Table overlaps_table(const std::vector<OverlapPoint>& overlaps) {
    Table table({"edge", "triangles", "leaves", "overlaps", "lost by corners", "more by boxes",
                 "rays that lose by corners", "by the first leaf's hit"});
    const auto share = [](std::uint64_t part, std::uint64_t whole) {
        return percent(double(part) / double(whole));
    };
    for (const OverlapPoint& p : overlaps)
        table.row({fmt::format("{}", p.edge), with_commas(p.triangles), with_commas(p.leaves),
                   with_commas(p.overlaps), share(p.overlaps - p.by_corners, p.overlaps),
                   share(p.by_boxes - p.overlaps, p.overlaps), share(p.lost, p.rays),
                   share(p.early, p.rays)});
    return table;
}

/// k = 1, 8 and 64 side by side.
Table points_table(const std::vector<PointSet>& sets, bool times) {
    TimedTable table({"points", "n", "k = 1: nodes", "buckets", "points compared", "k = 8: buckets",
                      "k = 64: buckets"},
                     {"build, ms", "nanoflann", "k = 1: µs", "nanoflann", "k = 8: µs", "nanoflann",
                      "k = 64: µs", "nanoflann"},
                     times);
    const auto peer = [](const std::optional<double>& time, int digits) {
        return time ? fixed(*time, digits) : "-";
    };
    for (const auto& [name, series] : series_of(sets))
        for (const PointSet* set : series) {
            const auto& nearest = set->nearest;
            std::vector<std::string> taken{fixed(set->build_ms, 1), peer(set->peer_build_ms, 1)};
            for (const NearestQueries& queries : nearest) {
                taken.push_back(fixed(queries.microseconds, 2));
                taken.push_back(peer(queries.peer_microseconds, 2));
            }
            table.row({name, with_commas(set->points), fixed(nearest[0].subtrees_per_query(), 1),
                       fixed(nearest[0].buckets_per_query(), 2),
                       fixed(nearest[0].compared_per_query(), 2),
                       fixed(nearest[1].buckets_per_query(), 2),
                       fixed(nearest[2].buckets_per_query(), 1)},
                      taken);
        }
    return table.table();
}

Table planes_table(const std::vector<PlaneTimes>& planes) {
    Table table({"planes", "across an axis, ns", "in general, ns", "ratio"});
    for (const PlaneTimes& p : planes)
        table.row({p.where, fixed(p.axis_ns, 2), fixed(p.general_ns, 2),
                   fixed(p.general_ns / p.axis_ns, 2)});
    return table;
}

Table pictures_table(const std::vector<PicturePoint>& pictures) {
    Table table({"rays and shadow rays", "nodes per ray", "tests per ray", "other pixels"});
    for (const PicturePoint& p : pictures)
        table.row({p.method, fixed(double(p.nodes) / double(p.rays), 1),
                   fixed(double(p.tests) / double(p.rays), 1), with_commas(p.other_pixels)});
    return table;
}

}  // namespace

void print_pictures(const std::vector<PicturePoint>& pictures) {
    pictures_table(pictures).print();
}
void print_cures(const std::vector<CurePoint>& cures, bool times) {
    const CurePoint& any = cures.front();
    print_heading(fmt::format("[Lichter23]'s tree and its cures: {}, {} triangles, {} rays",
                              any.scene, with_commas(any.triangles), with_commas(any.rays)));
    cures_table(cures, times).print();
    print_heading("Where it fails");
    faults_table(cures).print();
}
void print_trees(const std::vector<TreePoint>& trees, bool times) {
    print_heading("Where to cut, and what becomes of straddlers");
    trees_table(trees, times).print();
    print_heading("Mailboxes");
    mailbox_table(trees).print();
    print_heading("Planes that the sweep tries, beside six for each triangle");
    candidates_table(trees).print();
}
void print_growth(const std::vector<Growth>& growth, bool times) {
    print_heading("Growth: the largest trees, and slopes from 1,000 triangles (log y over log n)");
    growth_table(growth, times).print();
}
void print_care(const std::vector<CarePoint>& care, bool times) {
    print_heading("Grades of care: rays at corners, edges and splitting planes");
    care_table(care, times).print();
}
void print_overlaps(const std::vector<OverlapPoint>& overlaps) {
    print_heading("Corners decide where a triangle is, or the first leaf's hit is taken");
    overlaps_table(overlaps).print();
}
void print_points(const std::vector<PointSet>& points, bool times) {
    print_heading("The k nearest of n points: what a search goes into");
    points_table(points, times).print();
}
void print_planes(const std::vector<PlaneTimes>& planes) {
    print_heading("A ray and a plane");
    planes_table(planes).print();
}

namespace {

/// NAME_least and NAME_most of a share over all scenes.
template <class Value>
void quote_range(Numbers& numbers, const std::string& name, const std::vector<TreePoint>& trees,
                 std::string_view rule, const Value& value) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const TreePoint& point : trees) {
        if (point.rule != rule) continue;
        least = std::min(least, value(point));
        most = std::max(most, value(point));
    }
    numbers.count(name + "_least", least, percent(least));
    numbers.count(name + "_most", most, percent(most));
}

void quote_cures(const std::vector<CurePoint>& cures, bool times, Numbers& numbers) {
    numbers.count_table("cures", cures_table(cures, false));
    numbers.count_table("faults", faults_table(cures));
    numbers.count("published_factor", published_factor, fixed(published_factor, 2));
    const std::vector<CurePoint> rows = of_scene(cures, cures.front().scene);
    numbers.count("cures_triangles", rows[0].triangles);
    numbers.count("cures_rays", rows[0].rays);
    const auto quote = [&](const std::string& name, const CurePoint& p) {
        const double fewer = double(rows[0].tests) / double(p.tests);
        numbers.count(name + "_factor", fewer, fixed(fewer, fewer < 100.0 ? 1 : 0));
        numbers.count(name + "_tests", p.tests_per_ray(), fixed(p.tests_per_ray(), 1));
        numbers.count(name + "_found", p.found);
        if (times)
            numbers.time(name + "_faster", rows[0].trace_ms / p.trace_ms,
                         fixed(rows[0].trace_ms / p.trace_ms, 1));
    };
    numbers.count("naive_found", rows[0].found);
    quote("as_published", rows[1]);
    quote("cured", rows[rows.size() - 2]);
    quote("sah", rows.back());
}

void quote_trees(const std::vector<TreePoint>& trees, bool all, Numbers& numbers) {
    std::vector<TreePoint> first = trees;
    std::erase_if(first, [&](const TreePoint& p) { return p.scene != trees.front().scene; });
    numbers.count_table("rules", trees_table(first, false));
    if (!all) return;  // of the first scene only
    numbers.count_table("rules_all", trees_table(trees, false));
    numbers.count_table("mailboxes", mailbox_table(trees));
    numbers.count_table("candidates", candidates_table(trees));
    quote_range(numbers, "mail_boxes", trees, sah_boxes, mail_saved);
    quote_range(numbers, "mail_clipped", trees, sah, mail_saved);
    quote_range(numbers, "candidates", trees, sah, candidates_tried);
}

/// The counts at 10,000 triangles, and if `all` have been grown the slopes.
void quote_growth(const std::vector<Growth>& growth, bool times, Numbers& numbers) {
    for (const Growth& g : growth) {
        if (g.front().rule != sah) continue;
        const TreePoint &at = g[2], &last = g.back();
        const std::string name = at.scene;
        numbers.count(name + "_n", at.n);
        numbers.count(name + "_tests", at.tests_per_ray(), fixed(at.tests_per_ray(), 1));
        const double share = at.tests_per_ray() / double(at.n);
        numbers.count(name + "_of_naive", share, one_in(share));
        numbers.count(name + "_last_n", last.n);
        numbers.count(name + "_last_tests", last.tests_per_ray(), fixed(last.tests_per_ray(), 1));
        numbers.count(name + "_last_nodes", last.nodes_per_ray(), fixed(last.nodes_per_ray(), 1));
        numbers.count(name + "_tests_slope", slope(g, tests_per_log_n),
                      fixed(slope(g, tests_per_log_n), 2));
        numbers.count(name + "_placed_slope", slope(g, placed_per_n_log_n),
                      fixed(slope(g, placed_per_n_log_n), 2));
        if (times) {
            const double fitted = slope(g, [](const TreePoint& p) { return p.build_ms; });
            numbers.time(name + "_build_slope", fitted, fixed(fitted, 2));
        }
    }
    numbers.count_table("growth", growth_table(growth, false));
}

void quote_points(const std::vector<PointSet>& points, bool times, Numbers& numbers) {
    numbers.count_table("points", points_table(points, false));
    numbers.count("points_n", points.back().points);
    if (!times) return;
    numbers.time_table("points_times", points_table(points, true));
    double least = std::numeric_limits<double>::infinity();
    for (const PointSet& set : points)
        for (const NearestQueries& queries : set.nearest)
            least = std::min(least, queries.speedup().value_or(least));
    numbers.time("nanoflann_least", least, fixed(least, 2));
}

}  // namespace

Numbers quoted(const Measurements& measured, bool times) {
    Numbers numbers;
    const bool all = !measured.care.empty();
    if (all) numbers.count_table("pictures", pictures_table(measured.pictures));
    quote_cures(measured.cures, times, numbers);
    quote_trees(measured.trees, all, numbers);
    if (all) quote_growth(measured.growth, times, numbers);
    numbers.count_table("overlaps", overlaps_table(measured.overlaps));
    if (!all) return numbers;
    numbers.count_table("care", care_table(measured.care, false));
    quote_points(measured.points, times, numbers);
    if (times) numbers.time_table("planes", planes_table(measured.planes));
    return numbers;
}

}  // namespace space::ch04
