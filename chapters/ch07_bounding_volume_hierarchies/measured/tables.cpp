#include "chapters/ch07_bounding_volume_hierarchies/measured/outcome.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/series.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace space::ch07 {
namespace {

std::string millions(const RayCost& rays) {
    return rays.ms > 0.0 ? fixed(1e-6 * rays.per_second(), 2) : "";
}

// --- trees ---

Table trees_table(const std::vector<TreePoint>& trees, bool times) {
    TimedTable table(
        {"scene", "triangles", "builder", "nodes per triangle", "references per triangle",
         "bytes per triangle", "depth", "cost", "nodes per ray", "tests per ray", "wrong"},
        {"build, ms", "million camera rays/s", "shadow", "diffuse"}, times);
    for (const TreePoint& p : trees) {
        const bool tells = p.nodes > 0;
        const auto told = [&](double value, int digits) {
            return tells ? fixed(value, digits) : std::string();
        };
        table.row({p.scene, with_commas(p.n), std::string(p.builder),
                   told(p.nodes_per_triangle(), 2), told(p.references_per_triangle(), 2),
                   fixed(p.bytes_per_triangle(), 0), tells ? with_commas(p.depth) : "",
                   told(p.cost, 1), told(p.diffuse().nodes_per_ray(), 1),
                   told(p.diffuse().tests_per_ray(), 1), tells ? with_commas(p.wrong) : ""},
                  {fixed(p.build_ms, 1), millions(p.rays[camera_kind]),
                   millions(p.rays[shadow_kind]), millions(p.diffuse())});
    }
    return table.table();
}

Table targets_table(const std::vector<TreePoint>& trees) {
    Table table({"scene", "triangles", "build / Embree's", "camera rays/s / Embree's", "shadow",
                 "diffuse", "bytes per triangle", "spatial / binned, diffuse", "wanted"});
    for (const Target& t : targets(trees))
        table.row({t.scene, with_commas(t.n), fixed(t.build, 2), fixed(t.rays[camera_kind], 2),
                   fixed(t.rays[shadow_kind], 2), fixed(t.rays[diffuse_kind], 2), fixed(t.bytes, 0),
                   fixed(t.spatial_gain, 2), t.verdict()});
    return table;
}

Table growth_table(const std::vector<TreePoint>& growth, bool times) {
    TimedTable table(
        {"scene", "builder", "triangles", "nodes per triangle", "depth", "nodes per ray",
         "tests per ray", "slopes: nodes", "nodes per ray", "tests per ray"},
        {"build", "build, ms", "million diffuse rays/s"}, times);
    for (const std::string& scene : scenes_of(growth))
        for (const std::string_view builder : {by_median, by_morton, by_bins, by_sweep}) {
            const std::vector<TreePoint> series = grown(growth, scene, builder);
            const TreePoint& last = series.back();
            const auto nodes = [](const TreePoint& p) { return double(p.nodes); };
            table.row({scene, std::string(builder), with_commas(last.n),
                       fixed(last.nodes_per_triangle(), 2), with_commas(last.depth),
                       fixed(diffuse_nodes(last), 1), fixed(diffuse_tests(last), 1),
                       fixed(slope(series, nodes), 2), fixed(slope(series, diffuse_nodes), 2),
                       fixed(slope(series, diffuse_tests), 2)},
                      {times ? fixed(slope(series, build_ms), 2) : "", fixed(last.build_ms, 1),
                       millions(last.diffuse())});
        }
    return table.table();
}

/// All sizes of the binned builder.
Table sizes_table(const std::vector<TreePoint>& growth, bool times) {
    TimedTable table({"scene", "triangles", "nodes", "depth", "cost", "nodes per ray",
                      "tests per ray", "steps / log2 n"},
                     {"build, µs per triangle", "million camera rays/s", "diffuse"}, times);
    for (const TreePoint& p : growth)
        if (p.builder == by_bins)
            table.row({p.scene, with_commas(p.n), with_commas(p.nodes), with_commas(p.depth),
                       fixed(p.cost, 1), fixed(diffuse_nodes(p), 1), fixed(diffuse_tests(p), 1),
                       fixed(steps_per_log_n(p), 2)},
                      {fixed(1e-3 * p.build_ns(), 3), millions(p.rays[camera_kind]),
                       millions(p.diffuse())});
    return table.table();
}

// --- leaves ---

Table leaves_table(const std::vector<LeafPoint>& leaves, bool times) {
    TimedTable table(
        {"scene", "builder", "rule", "nodes per triangle", "inner nodes per ray", "tests per ray"},
        {"ns per ray"}, times);
    for (const LeafPoint& p : leaves)
        table.row({p.scene, std::string(p.builder),
                   p.builder == by_median ? fmt::format("at most {:g}", p.rule)
                                          : fmt::format("C_V = {:g} C_NS", p.rule),
                   fixed(p.nodes_per_triangle(), 2), fixed(p.inner_per_ray(), 1),
                   fixed(p.tests_per_ray(), 1)},
                  {fixed(p.ns_per_ray(), 0)});
    return table.table();
}

Table fits_table(const std::vector<LeafPoint>& leaves) {
    Table table({"scene", "ns per ray", "C_V: ns per inner node", "C_NS: ns per test", "C_V / C_NS",
                 "largest error"});
    for (const CostFit& fit : fit_costs(leaves))
        table.row({fit.scene, fixed(fit.ray_ns, 0), fixed(fit.node_ns, 1), fixed(fit.test_ns, 1),
                   fixed(fit.ratio(), 2), percent(fit.largest_error)});
    return table;
}

// --- the heuristic and the walk ---

Table candidates_table(const std::vector<CandidatePoint>& candidates) {
    Table table({"scene", "triangles", "nodes cut", "6 T", "at different places, of 6 T",
                 "different parts, of 6 T", "cuts tried, of 6 T"});
    for (const CandidatePoint& p : candidates)
        table.row({p.scene, with_commas(p.n), with_commas(p.nodes), with_commas(p.faces),
                   fixed(double(p.planes) / double(p.faces), 2),
                   fixed(double(p.partitions) / double(p.faces), 2),
                   fixed(double(p.cuts) / double(p.faces), 2)});
    return table;
}

Table sums_table(const std::vector<SumPoint>& sums, bool times) {
    TimedTable table({"scene", "areas", "nodes", "depth", "cost", "nodes per ray", "tests per ray"},
                     {"million diffuse rays/s"}, times);
    for (const SumPoint& p : sums)
        table.row({p.scene, p.has_counts ? "times counts" : "alone", with_commas(p.nodes),
                   with_commas(p.depth), fixed(p.cost, 1), fixed(p.rays.nodes_per_ray(), 1),
                   fixed(p.rays.tests_per_ray(), 1)},
                  {millions(p.rays)});
    return table.table();
}

Table walks_table(const std::vector<WalkPoint>& walks, bool times) {
    TimedTable table({"scene", "walk", "nodes per ray", "tests per ray"},
                     {"million diffuse rays/s"}, times);
    for (const WalkPoint& p : walks)
        table.row({p.scene, std::string(p.walk), fixed(p.rays.nodes_per_ray(), 1),
                   fixed(p.rays.tests_per_ray(), 1)},
                  {millions(p.rays)});
    return table.table();
}

Table variants_table(const std::vector<VariantPoint>& variants) {
    Table table({"scene", "builder", "references per triangle", "cost", "nodes per ray",
                 "tests per ray", "steps per ray"});
    for (const VariantPoint& p : variants)
        table.row({p.scene, p.variant, fixed(double(p.references) / double(p.n), 2),
                   fixed(p.cost, 1), fixed(p.rays.nodes_per_ray(), 1),
                   fixed(p.rays.tests_per_ray(), 1), fixed(p.rays.steps_per_ray(), 1)});
    return table;
}

// --- answers ---

Table accuracy_table(const std::vector<AccuracyPoint>& accuracy, bool times) {
    TimedTable table(
        {"scene", "triangles", "boxes", "triangle test", "rays", "wrong", "other triangle"},
        {"ns per ray"}, times);
    for (const AccuracyPoint& p : accuracy)
        table.row({p.scene, with_commas(p.n), std::string(p.margins), std::string(p.test),
                   with_commas(p.rays), with_commas(p.wrong), with_commas(p.other)},
                  {fixed(1e6 * p.ms / double(p.rays), 0)});
    return table.table();
}

Table exact_table(const std::vector<ExactPoint>& exact) {
    std::vector<std::string> headings{"builder"};
    for (const std::string& scene : scenes_of(exact)) headings.push_back(scene);
    headings.emplace_back("rays");
    Table table(std::move(headings));
    std::vector<std::string_view> builders;
    for (const ExactPoint& p : exact)
        if (std::ranges::count(builders, p.builder) == 0) builders.push_back(p.builder);
    for (const std::string_view builder : builders) {
        std::vector<std::string> row{std::string(builder)};
        std::uint64_t rays = 0;
        for (const ExactPoint& p : exact) {
            if (p.builder != builder) continue;
            row.push_back(with_commas(p.wrong));
            rays += p.rays;
        }
        row.push_back(with_commas(rays));
        table.row(std::move(row));
    }
    return table;
}

Table phases_table(const std::vector<PhasePoint>& phases) {
    Table table({"scene", "boxes", "nodes below 32 triangles", "32 to 1,023", "1,024 to 32,767",
                 "larger", "triangles copied", "ns per triangle", "bytes moved per triangle",
                 "GB/s", "of the machine's copy"});
    for (const PhasePoint& p : phases) {
        std::vector<std::string> row{p.scene, percent(p.boxes_ms / p.total_ms())};
        for (const double ms : p.nodes_ms) row.push_back(percent(ms / p.total_ms()));
        row.insert(
            row.end(),
            {percent(p.copy_ms / p.total_ms()), fixed(1e6 * p.total_ms() / double(p.n), 0),
             fixed(double(p.bytes_moved) / double(p.n), 0), fixed(1e-6 * p.bytes_per_ms(), 2),
             percent(p.bytes_per_ms() / p.copy_bytes_per_ms)});
        table.row(std::move(row));
    }
    return table;
}

}  // namespace

void print_trees(const std::vector<TreePoint>& trees, bool times) {
    print_heading("Builders by scene; nodes and tests are a diffuse ray's");
    trees_table(trees, times).print();
    if (targets(trees).empty()) return;
    print_heading("The binned builder beside Embree");
    targets_table(trees).print();
}
void print_growth(const std::vector<TreePoint>& growth, bool times) {
    print_heading("Growth: the largest trees, and slopes from 1,000 triangles (log y over log n)");
    growth_table(growth, times).print();
    print_heading("Growth of the binned tree");
    sizes_table(growth, times).print();
}
void print_leaves(const std::vector<LeafPoint>& leaves, bool times) {
    print_heading("Leaves by count and by cost");
    leaves_table(leaves, times).print();
    if (!times) return;
    print_heading("What a node and a test cost: time of a ray = constant + C_V nodes + C_NS tests");
    fits_table(leaves).print();
}
void print_heuristics(const TreeMeasurements& measured, bool times) {
    print_heading("Planes at the faces of boxes, and cuts of the sweep");
    candidates_table(measured.candidates).print();
    print_heading("Areas with counts and without");
    sums_table(measured.sums, times).print();
    print_heading("Two walks of the sweep's tree");
    walks_table(measured.walks, times).print();
    print_heading("Spatial splits");
    variants_table(measured.spatial).print();
    print_heading("From the leaves up, beside the binned tree");
    variants_table(measured.from_below).print();
}
void print_answers(const TreeMeasurements& measured, bool times) {
    print_heading("Rays at edges and vertices: answers that are not exact arithmetic's");
    accuracy_table(measured.accuracy, times).print();
    print_heading(
        "By the exact test through every builder's tree: answers unlike the naive loop's");
    exact_table(measured.exact).print();
}
void print_phases(const std::vector<PhasePoint>& phases) {
    print_heading("Where the time of a binned build goes");
    phases_table(phases).print();
}

namespace {

void quote_targets(const std::vector<TreePoint>& trees, Numbers& numbers) {
    const std::vector<Target> all = targets(trees);
    if (all.empty()) return;  // without Embree
    numbers.time_table("targets", targets_table(trees));
    double build = 0.0, diffuse = std::numeric_limits<double>::infinity(), camera = diffuse,
           gain = diffuse;
    std::size_t met = 0;
    for (const Target& t : all) {
        build = std::max(build, t.build);
        camera = std::min(camera, t.rays[camera_kind]);
        if (t.is_soup)
            numbers.time("soup_diffuse", t.rays[diffuse_kind], fixed(t.rays[diffuse_kind], 2));
        else
            diffuse = std::min(diffuse, t.rays[diffuse_kind]);
        if (t.is_long) gain = std::min(gain, t.spatial_gain);
        met += t.verdict() == "met";
    }
    numbers.time("build_most", build, fixed(build, 2));
    numbers.time("diffuse_least", diffuse, fixed(diffuse, 2));
    numbers.time("camera_least", camera, fixed(camera, 2));
    numbers.time("spatial_gain_least", gain, fixed(gain, 2));
    numbers.time("targets_met", double(met), fmt::format("{} of {}", met, all.size()));
}

void quote_fits(const std::vector<LeafPoint>& leaves, Numbers& numbers) {
    std::vector<double> nodes, tests, ratios;
    for (const CostFit& fit : fit_costs(leaves)) {
        nodes.push_back(fit.node_ns);
        tests.push_back(fit.test_ns);
        ratios.push_back(fit.ratio());
    }
    const auto quote = [&](const std::string& name, std::vector<double> values, int digits) {
        const double value = median(std::move(values));
        numbers.time(name, value, fixed(value, digits));
    };
    quote("node_ns", nodes, 1);
    quote("test_ns", tests, 1);
    quote("cost_ratio", ratios, 2);
    numbers.time_table("fits", fits_table(leaves));
}

void quote_heuristics(const TreeMeasurements& measured, Numbers& numbers) {
    numbers.count_table("candidates", candidates_table(measured.candidates));
    numbers.count_table("sums_counts", sums_table(measured.sums, false));
    numbers.count_table("walks_counts", walks_table(measured.walks, false));
    numbers.count_table("spatial_counts", variants_table(measured.spatial));
    numbers.count_table("from_below_counts", variants_table(measured.from_below));
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < measured.sums.size(); i += 2)
        worst = std::max(worst, measured.sums[i + 1].rays.steps_per_ray() /
                                    measured.sums[i].rays.steps_per_ray());
    numbers.count("sums_worst", worst, fixed(worst, 1));
}

void quote_answers(const TreeMeasurements& measured, Numbers& numbers) {
    numbers.count_table("accuracy_counts", accuracy_table(measured.accuracy, false));
    numbers.count_table("exact", exact_table(measured.exact));
    std::uint64_t rays = 0, wrong = 0;
    for (const ExactPoint& p : measured.exact) rays += p.rays, wrong += p.wrong;
    numbers.count("exact_rays", rays);
    numbers.count("exact_wrong", wrong);
}

}  // namespace

void quote_trees(const TreeMeasurements& measured, bool times, Numbers& numbers) {
    quote_heuristics(measured, numbers);
    if (measured.trees.empty()) return;  // --counts --quick
    quote_answers(measured, numbers);
    numbers.count_table("leaves_counts", leaves_table(measured.leaves, false));
    std::vector<TreePoint> ours = measured.trees;
    std::erase_if(ours, [](const TreePoint& p) { return p.nodes == 0 || p.builder == bins_float; });
    numbers.count_table("trees_counts", trees_table(ours, false));
    numbers.count_table("growth_counts", growth_table(measured.growth, false));
    numbers.count_table("sizes_counts", sizes_table(measured.growth, false));
    double bytes = 0.0;
    for (const TreePoint& p : ours)
        if (p.builder == by_bins) bytes = std::max(bytes, p.bytes_per_triangle());
    numbers.count("bytes_most", bytes, fixed(bytes, 0));
    if (!times) return;
    numbers.time_table("trees", trees_table(measured.trees, true));
    numbers.time_table("growth", growth_table(measured.growth, true));
    numbers.time_table("sizes", sizes_table(measured.growth, true));
    numbers.time_table("leaves", leaves_table(measured.leaves, true));
    numbers.time_table("sums", sums_table(measured.sums, true));
    numbers.time_table("walks", walks_table(measured.walks, true));
    numbers.time_table("accuracy", accuracy_table(measured.accuracy, true));
    numbers.time_table("phases", phases_table(measured.phases));
    quote_targets(measured.trees, numbers);
    quote_fits(measured.leaves, numbers);
}

}  // namespace space::ch07
