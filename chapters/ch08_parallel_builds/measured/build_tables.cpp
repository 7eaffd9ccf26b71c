#include "chapters/ch08_parallel_builds/measured/build_series.hpp"
#include "chapters/ch08_parallel_builds/measured/builds.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace space::ch08 {

const std::vector<PublishedBuild>& published_builds() {
    static const std::vector<PublishedBuild> all{
        {"Happy Buddha", "dragon_871k", 2, 41.87, {22.85, 22.81, 23.31}, {45.42, 45.52, 44.32}},
        {"Fairy Forest", "forest", 2, 6.04, {5.74, 5.77, 3.60}, {4.96, 4.47, 39.66}},
        {"Icosahedron", "icosphere:300", 2, 67.64, {40.68, 39.87, 40.07}, {39.85, 40.96, 40.67}},
        {"Conference", "conference", 2, 10.35, {6.37, 6.32, 5.93}, {38.69, 38.93, 42.66}},
        {"Soda Hall", "building:83", 2, 101.09, {94.94, 93.38, 92.46}, {8.56, 7.62, 8.53}},
        {"Happy Buddha", "dragon_871k", 4, 27.37, {10.37, 15.15, 11.67}, {62.11, 44.64, 57.36}},
        {"Fairy Forest", "forest", 4, 3.98, {2.69, 2.68, 2.06}, {32.41, 32.66, 48.24}},
        {"Icosahedron", "icosphere:300", 4, 44.50, {17.91, 22.52, 18.13}, {59.75, 49.39, 59.25}},
        {"Conference", "conference", 4, 6.79, {3.72, 3.61, 3.05}, {45.21, 46.83, 55.08}},
        {"Soda Hall", "building:83", 4, 66.51, {45.89, 45.80, 38.10}, {31.00, 31.13, 42.71}}};
    return all;
}

std::uint64_t other_trees(const BuildMeasurements& measured) {
    std::uint64_t other = 0;
    for (const SamePoint& point : measured.same) other += point.other;
    return other;
}

const BuildPoint* point_of(const std::vector<BuildPoint>& points, std::string_view scene,
                           std::string_view method, unsigned threads) {
    const auto found = std::ranges::find_if(points, [&](const BuildPoint& p) {
        return p.scene == scene && p.method == method && p.threads == threads;
    });
    return found == points.end() ? nullptr : &*found;
}

std::vector<std::string> scenes_of(const std::vector<BuildPoint>& points) {
    std::vector<std::string> scenes;
    for (const BuildPoint& p : points)
        if (std::ranges::count(scenes, p.scene) == 0) scenes.push_back(p.scene);
    return scenes;
}

std::vector<BuildGoal> build_goals(const std::vector<BuildPoint>& scenes) {
    std::vector<BuildGoal> goals;
    for (const std::string& scene : scenes_of(scenes)) {
        const BuildPoint *one = point_of(scenes, scene, ours, 1),
                         *two = point_of(scenes, scene, ours, 2),
                         *peer = point_of(scenes, scene, embree, 2);
        goals.push_back({scene, one->gain, two->gain,
                         peer ? std::optional(two->ms.median / peer->ms.median) : std::nullopt});
    }
    return goals;
}

double growth_slope(const std::vector<BuildPoint>& growth, std::string_view method,
                    unsigned threads) {
    std::vector<double> n, ms;
    for (const BuildPoint& p : growth) {
        if (p.method != method || p.threads != threads) continue;
        n.push_back(double(p.n));
        ms.push_back(p.ms.median);
    }
    return n.size() < 2 ? 0.0 : log_log_slope(n, ms);
}

namespace {

std::string gain_text(const Spread& gain) {
    return fixed(gain.median, 2);
}
/// What half of the rounds lie between.
std::string range_text(const Spread& gain) {
    return fmt::format("{:.2f}–{:.2f}", gain.low, gain.high);
}
std::string gain_and_range(const Spread& gain) {
    return fmt::format("{} ({})", gain_text(gain), range_text(gain));
}

/// In the published table's units, with digits for what is quick.
std::string seconds(const Spread& ms) {
    return fmt::format("{:.4f}", 1e-3 * ms.median);
}

Table same_table(const std::vector<SamePoint>& same) {
    Table table({"scene", "triangles", "method", "threads", "nodes", "depth", "cost", "builds",
                 "other trees"});
    for (const SamePoint& p : same)
        table.row({p.scene, with_commas(p.n), std::string(p.method),
                   fmt::format("{}", fmt::join(p.threads, ", ")), with_commas(p.nodes),
                   with_commas(p.depth), fixed(p.cost, 1), with_commas(p.builds),
                   with_commas(p.other)});
    return table;
}

/// Table 3 anew: what [BvhThesis13] measured with 2 threads beside ours. (Table 4 is the
/// schedules'.)
Table builds_table(const std::vector<BuildPoint>& scenes) {
    Table table({"scene", "method", "1 thread, s", "2 threads, s", "gain", "middle half",
                 "time falls by", "published"});
    for (const std::string& scene : scenes_of(scenes)) {
        const BuildPoint& alone = *point_of(scenes, scene, sequential, 1);
        table.row({scene, std::string(sequential), seconds(alone.ms), "", "", "", "", ""});
        for (const std::string_view method : {symmetric, asymmetric, by_queue, ours}) {
            const BuildPoint *one = point_of(scenes, scene, method, 1),
                             *two = point_of(scenes, scene, method, 2);
            table.row({scene, std::string(method), one ? seconds(one->ms) : "", seconds(two->ms),
                       gain_text(two->gain), range_text(two->gain),
                       percent(1.0 - 1.0 / two->gain.median), published_fall(scene, method, 2)});
        }
    }
    return table;
}

Table goals_table(const BuildMeasurements& measured) {
    Table table({"scene", "ours, 2 threads", "at least 1.9", "two builds at once", "ours, 1 thread",
                 "not slower", "beside Embree, 2 threads", "at most 1.2"});
    const auto word = [](bool is_met) { return std::string(is_met ? "met" : "short"); };
    for (const BuildGoal& goal : build_goals(measured.scenes)) {
        const auto ceiling = std::ranges::find(measured.ceilings, goal.scene, &CeilingPoint::scene);
        table.row({goal.scene, gain_and_range(goal.two), word(goal.is_twice()),
                   ceiling == measured.ceilings.end() ? "" : gain_and_range(ceiling->gain),
                   gain_and_range(goal.one), word(goal.is_not_slower()),
                   goal.beside_embree ? fixed(*goal.beside_embree, 2) : "",
                   goal.beside_embree ? word(goal.is_near_embree()) : ""});
    }
    return table;
}

Table embree_table(const std::vector<BuildPoint>& scenes) {
    Table table({"scene", "Embree, 1 thread, s", "2 threads, s", "its gain", "ours, 1 thread / its",
                 "ours, 2 threads / its"});
    for (const std::string& scene : scenes_of(scenes)) {
        const BuildPoint *one = point_of(scenes, scene, embree, 1),
                         *two = point_of(scenes, scene, embree, 2);
        if (!one || !two) continue;
        const double ours_one = point_of(scenes, scene, ours, 1)->ms.median,
                     ours_two = point_of(scenes, scene, ours, 2)->ms.median;
        table.row({scene, seconds(one->ms), seconds(two->ms),
                   fixed(one->ms.median / two->ms.median, 2), fixed(ours_one / one->ms.median, 2),
                   fixed(ours_two / two->ms.median, 2)});
    }
    return table;
}

Table build_growth_table(const std::vector<BuildPoint>& growth) {
    Table table({"triangles", "sequential, ms", "ours, 1 thread", "ours, 2 threads",
                 "queue, 2 threads", "gain, ours", "gain, queue"});
    for (const BuildPoint& p : growth) {
        if (p.method != sequential) continue;
        const auto at = [&](std::string_view method, unsigned threads) -> const BuildPoint& {
            return *std::ranges::find_if(growth, [&](const BuildPoint& q) {
                return q.n == p.n && q.method == method && q.threads == threads;
            });
        };
        table.row({with_commas(p.n), fixed(p.ms.median, 2), fixed(at(ours, 1).ms.median, 2),
                   fixed(at(ours, 2).ms.median, 2), fixed(at(by_queue, 2).ms.median, 2),
                   gain_and_range(at(ours, 2).gain), gain_and_range(at(by_queue, 2).gain)});
    }
    return table;
}

Table ceilings_table(const std::vector<CeilingPoint>& ceilings) {
    Table table({"scene", "triangles", "one build, ms", "two at once, ms", "gain",
                 "gain of two copies at once"});
    for (const CeilingPoint& p : ceilings)
        table.row({p.scene, with_commas(p.n), fixed(p.alone_ms.median, 1),
                   fixed(p.both_ms.median, 1), gain_and_range(p.gain),
                   gain_and_range(p.copy_gain)});
    return table;
}

Table quality_table(const std::vector<BuildPoint>& scenes) {
    Table table({"builder", "threads", "scenes", "build time, sequential = 1", "cost, binned = 1"});
    for (const QualityPoint& p : qualities(scenes))
        table.row({std::string(p.method), std::to_string(p.threads), std::to_string(p.scenes),
                   fixed(p.time, 2), fixed(p.cost, 3)});
    return table;
}

}  // namespace

std::string published_fall(std::string_view scene, std::string_view method, unsigned threads) {
    for (const PublishedBuild& row : published_builds())
        for (std::size_t i = 0; i < published_methods.size(); ++i)
            if (row.stand_in == scene && row.threads == threads && published_methods[i] == method)
                return percent(row.fall(i));
    return "";
}

std::vector<QualityPoint> qualities(const std::vector<BuildPoint>& scenes) {
    std::vector<QualityPoint> all;
    for (const BuildPoint& p : scenes) {
        const bool is_known = std::ranges::any_of(all, [&](const QualityPoint& q) {
            return q.method == p.method && q.threads == p.threads;
        });
        if (is_known || p.cost == 0.0) continue;
        std::vector<double> times, costs;
        for (const BuildPoint& q : scenes) {
            if (q.method != p.method || q.threads != p.threads) continue;
            times.push_back(1.0 / q.gain.median);
            costs.push_back(q.cost / point_of(scenes, q.scene, sequential, 1)->cost);
        }
        all.push_back({p.method, p.threads, times.size(), median(times), median(costs)});
    }
    return all;
}

void print_builds(const BuildMeasurements& measured, bool times) {
    const auto print = [](const std::string& heading, const Table& table) {
        print_heading(heading);
        table.print();
    };
    print("The same tree, whoever builds", same_table(measured.same));
    if (!times) return;
    print(
        "Table 3 of [BvhThesis13] anew (gains: medians, and what half of the rounds "
        "lie between)",
        builds_table(measured.scenes));
    print("What was wanted", goals_table(measured));
    print("Beside Embree", embree_table(measured.scenes));
    print("Two builds at once: what two threads can gain", ceilings_table(measured.ceilings));
    print("Growth of build time (icosphere)", build_growth_table(measured.growth));
    print("Build time and the tree's cost (medians over the scenes)",
          quality_table(measured.scenes));
}

void quote_builds(const BuildMeasurements& measured, bool times, Numbers& numbers) {
    std::uint64_t builds = 0;
    for (const SamePoint& p : measured.same) builds += p.builds;
    numbers.count("same_builds", builds);
    numbers.count("other_trees", other_trees(measured));
    numbers.count_table("same", same_table(measured.same));
    if (!times) return;
    numbers.time_table("builds", builds_table(measured.scenes));
    numbers.time_table("goals", goals_table(measured));
    numbers.time_table("embree", embree_table(measured.scenes));
    numbers.time_table("ceilings", ceilings_table(measured.ceilings));
    numbers.time_table("build_growth", build_growth_table(measured.growth));
    numbers.time_table("quality", quality_table(measured.scenes));
    quote_build_goals(measured, numbers);
}

}  // namespace space::ch08
