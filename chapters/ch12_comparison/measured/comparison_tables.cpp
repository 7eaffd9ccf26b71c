#include "chapters/ch12_comparison/measured/comparison_tables.hpp"

#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "chapters/ch12_comparison/measured/comparison_views.hpp"
#include "common/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace space::ch12 {
namespace {

constexpr const char* none = "-";

std::string number(double value, int digits) {
    return std::isfinite(value) ? fixed(value, digits) : none;
}
/// Three digits or more, never more than one after the point of what is large.
std::string three_digits(double value) {
    return number(value, value >= 100.0 ? 0 : value >= 10.0 ? 1 : 2);
}
std::string middle(const std::vector<double>& values, int digits) {
    return values.empty() ? none : number(median(values), digits);
}
/// "0.95 .. 1.10"
std::string spread(const std::vector<double>& values) {
    if (values.empty()) return none;
    const auto [least, most] = std::ranges::minmax(values);
    return fmt::format("{:.2f} .. {:.2f}", least, most);
}

/// The geometric mean of what the blocks' rows of this structure have; NaN where none has it.
double mean_over(std::span<const Block> blocks, std::string_view structure,
                 const std::function<double(const ComparedRow&)>& value) {
    double sum = 0.0, count = 0.0;
    for (const Block block : blocks)
        if (const ComparedRow* const row = find(block, structure))
            if (const double one = value(*row); one > 0.0) {
                sum += std::log(one);
                ++count;
            }
    return count > 0.0 ? std::exp(sum / count) : unknown;
}

std::vector<Block> of_the_large(const Comparison& comparison) {
    return blocks_near(comparison, compared_size(comparison));
}

/// "1", "1,000", "10^5".
std::string rays_text(double rays) {
    return rays <= 1e3 ? with_commas(static_cast<std::uint64_t>(rays))
                       : fmt::format("10^{:.0f}", std::log10(rays));
}
/// "1 .. 4·10^5", as a range of whole rays.
std::string range_text(const std::pair<double, double>& range) {
    const auto text = [](double rays) {
        return rays < 1e4 ? with_commas(static_cast<std::uint64_t>(rays)) : power_of_ten(rays);
    };
    return range.first == range.second ? text(range.first)
                                       : text(range.first) + " .. " + text(range.second);
}

Table scenes_table(const Comparison& comparison) {
    Table table({"scene", "kind", "even", "triangles"});
    for (const ComparedScene& scene : compared_scenes()) {
        std::string sizes;
        for (const Block block : blocks(comparison))
            if (block.front().scene == scene.name)
                sizes += (sizes.empty() ? "" : "; ") + with_commas(block.front().triangles);
        if (!sizes.empty())
            table.row({std::string(scene.name), std::string(scene.kind),
                       scene.is_even ? "yes" : "no", sizes});
    }
    return table;
}

Table structures_table(const Comparison& comparison) {
    const std::vector<Block> large = of_the_large(comparison);
    Table table({"structure", "scenes", "build ms", "bytes a triangle", "nodes per ray",
                 "tests per ray", "camera ns", "shadow ns", "diffuse ns", "any ns", "wrong"});
    for (const std::string& name : structure_names(comparison, true)) {
        std::uint64_t wrong = 0, scenes = 0;
        for (const Block block : large)
            if (const ComparedRow* const row = find(block, name)) wrong += row->wrong(), ++scenes;
        if (scenes == 0) continue;
        const auto mean = [&](const auto& value) { return mean_over(large, name, value); };
        const auto of_rays = [&](RayKind kind, double TracedKind::*field) {
            return mean([&](const ComparedRow& row) { return row[kind].*field; });
        };
        const auto ns = [&](RayKind kind) {
            return number(of_rays(kind, &TracedKind::ns_per_ray), 0);
        };
        table.row({name, with_commas(scenes),
                   three_digits(mean([](const ComparedRow& row) { return row.ready_ms(); })),
                   number(mean([](const ComparedRow& row) {
                              return double(row.bytes) / double(row.triangles);
                          }),
                          0),
                   number(of_rays(RayKind::diffuse, &TracedKind::nodes_per_ray), 1),
                   number(of_rays(RayKind::diffuse, &TracedKind::tests_per_ray), 1),
                   ns(RayKind::camera), ns(RayKind::shadow), ns(RayKind::diffuse), ns(RayKind::any),
                   with_commas(wrong)});
    }
    return table;
}

Table winners_table(const Comparison& comparison) {
    Table table({"scene", "camera", "shadow", "diffuse", "any", "diffuse ns", "second, diffuse",
                 "beside the best", "Embree beside the best"});
    for (const Block block : of_the_large(comparison)) {
        std::vector<std::string> cells{block.front().scene};
        for (const RayKind kind : ray_kinds) {
            const auto sorted = by_ray_cost(block, kind);
            cells.push_back(sorted.empty() ? none : sorted.front()->structure);
        }
        const auto sorted = by_ray_cost(block, RayKind::diffuse);
        if (sorted.size() < 2) continue;
        const double best = ray_cost(*sorted[0], RayKind::diffuse);
        const ComparedRow* const embree = find(block, "embree");
        cells.push_back(number(best, 0));
        cells.push_back(sorted[1]->structure);
        cells.push_back(number(ray_cost(*sorted[1], RayKind::diffuse) / best, 2));
        cells.push_back(embree ? number(ray_cost(*embree, RayKind::diffuse) / best, 2) : none);
        table.row(cells);
    }
    return table;
}

Table regret_table(const Comparison& comparison) {
    const std::vector<Block> large = of_the_large(comparison);
    std::vector<std::string> headings{"structure"};
    for (const Block block : large) headings.push_back(block.front().scene);
    Table table(headings);
    for (const std::string& name : structure_names(comparison, true)) {
        std::vector<std::string> cells{name};
        bool stands = false;
        for (const Block& block : large) {
            const auto beside = factors(std::span(&block, 1), name, RayKind::diffuse);
            cells.push_back(beside.empty() ? none : number(beside.front().factor, 1));
            stands = stands || !beside.empty();
        }
        if (stands) table.row(cells);
    }
    return table;
}

Table by_ray_table(const Comparison& comparison) {
    const std::vector<Block> large = of_the_large(comparison);
    Table table({"structure", "camera", "shadow", "diffuse", "any"});
    for (const std::string& name : structure_names(comparison, true)) {
        std::vector<std::string> cells{name};
        for (const RayKind kind : ray_kinds)
            cells.push_back(number(median_factor(factors(large, name, kind)), 2));
        if (cells[1] != none) table.row(cells);
    }
    return table;
}

Table growth_table(const Comparison& comparison) {
    Table table({"structure", "scenes", "build time", "over scenes", "bytes", "nodes per ray",
                 "over the scenes", "time per ray"});
    for (const std::string& name : structure_names(comparison, true)) {
        const Growth grown = growth(comparison, name);
        if (grown.bytes.empty()) continue;
        table.row({name, with_commas(grown.bytes.size()), middle(grown.build, 2),
                   spread(grown.build), middle(grown.bytes, 2), middle(grown.nodes, 2),
                   spread(grown.nodes), middle(grown.ns, 2)});
    }
    return table;
}

Table break_even_table(const Comparison& comparison) {
    std::vector<double> counts{1.0};
    for (int power = 3; power <= 10; ++power) counts.push_back(std::pow(10.0, power));
    std::vector<std::string> headings{"scene", "triangles"};
    for (const double rays : counts) headings.push_back(rays_text(rays));
    Table table(headings);
    for (const Block block : of_the_large(comparison)) {
        const std::vector<CostLine> lines = cost_lines(block, false);
        if (lines.empty()) continue;
        std::vector<std::string> cells{block.front().scene, with_commas(block.front().triangles)};
        for (const double rays : counts) cells.push_back(lines[cheapest(lines, rays)].name);
        table.row(cells);
    }
    return table;
}

Table lazy_table(const Comparison& comparison) {
    Table table({"scene", "kd-lazy is cheapest, rays", "its build, ms", "with its nodes, ms",
                 "kd-sah's build, ms"});
    for (const Block block : of_the_large(comparison)) {
        const ComparedRow* const lazy = find(block, "kd-lazy");
        if (!lazy) continue;
        const auto range = worth_it(block, "kd-lazy");
        const ComparedRow* const whole = find(block, "kd-sah");
        table.row({block.front().scene, range ? range_text(*range) : "never",
                   three_digits(lazy->build_ms), three_digits(lazy->ready_ms()),
                   whole ? three_digits(whole->build_ms) : none});
    }
    return table;
}

Table octrees_table(const Comparison& comparison) {
    Table table({"scene", "even", "bvh-binned, ns", "best octree", "its ns", "ratio"});
    for (const OctreeDuel& duel : octree_duels(comparison))
        table.row({duel.scene, duel.is_even ? "yes" : "no", number(duel.bvh_cost, 0), duel.octree,
                   number(duel.octree_cost, 0), number(duel.ratio(), 2)});
    return table;
}

Table features_table(const Comparison& comparison) {
    const std::vector<Block> large = of_the_large(comparison);
    struct Feature {
        const char *structure, *split_by, *children, *overlap;
    };
    constexpr Feature features[] = {
        {"bvh-binned", "objects", "2", "boxes do"},
        {"fast", "objects", "8", "boxes do"},
        {"octree", "space", "8", "no"},
        {"octree-loose", "space, cells twice as wide", "8", "cells do"},
        {"octree-linear", "space, objects by code", "up to 8", "boxes do"},
        {"kd-sah", "space", "2", "no"},
        {"bvh-spatial", "objects or space", "2", "boxes do, less"},
    };
    Table table({"structure", "split by", "children", "overlap", "references a triangle",
                 "nodes a triangle", "depth over log2 n", "bytes a triangle"});
    for (const auto& [name, split_by, children, overlap] : features) {
        const auto a_triangle = [&](const auto& value, int digits) {
            return number(mean_over(large, name,
                                    [&](const ComparedRow& row) {
                                        return double(value(row)) / double(row.triangles);
                                    }),
                          digits);
        };
        table.row({name, split_by, children, overlap,
                   a_triangle([](const ComparedRow& row) { return row.references; }, 2),
                   a_triangle([](const ComparedRow& row) { return row.nodes; }, 2),
                   number(mean_over(large, name,
                                    [](const ComparedRow& row) {
                                        return row.depth / std::log2(double(row.triangles));
                                    }),
                          1),
                   a_triangle([](const ComparedRow& row) { return row.bytes; }, 0)});
    }
    return table;
}

Table robust_table(const Comparison& comparison) {
    const std::vector<Block> large = of_the_large(comparison);
    Table table({"structure", "median beside the best", "worst", "where", "gave up on"});
    for (const std::string& name : structure_names(comparison, true)) {
        const auto beside = factors(large, name);
        if (beside.empty()) continue;
        const Factor& most = worst(beside);
        const auto gave_up = std::ranges::count_if(large, [&](Block block) {
            const auto row = std::ranges::find(block, name, &ComparedRow::structure);
            return row != block.end() && !row->stands() && !row->gave_up.starts_with("not tried");
        });
        table.row({name, number(median_factor(beside), 2), number(most.factor, 1), most.scene,
                   with_commas(static_cast<std::uint64_t>(gave_up))});
    }
    return table;
}

Table answers_table(const Comparison& comparison) {
    Table table({"structure", "from", "rays", "wrong"});
    for (const std::string& name : structure_names(comparison, true)) {
        std::uint64_t rays = 0, wrong = 0;
        std::string home;
        for (const ComparedRow& row : comparison.rows)
            if (row.structure == name) rays += row.rays(), wrong += row.wrong(), home = row.home;
        table.row({name, home, with_commas(rays), with_commas(wrong)});
    }
    return table;
}

Table gave_up_table(const Comparison& comparison) {
    Table table({"scene", "triangles", "structure", "why"});
    for (const ComparedRow& row : comparison.rows)
        if (!row.stands() && !row.gave_up.starts_with("not tried"))
            table.row({row.scene, with_commas(row.triangles), row.structure, row.gave_up});
    return table;
}

struct NamedTable {
    const char* name;
    Table (*make)(const Comparison&);
};
constexpr NamedTable timed_tables[] = {
    {"scenes", scenes_table},         {"comparison", structures_table},
    {"winners", winners_table},       {"regret", regret_table},
    {"by_ray", by_ray_table},         {"growth", growth_table},
    {"break_even", break_even_table}, {"lazy", lazy_table},
    {"octrees", octrees_table},       {"features", features_table},
    {"robust", robust_table},         {"answers", answers_table},
    {"gave_up", gave_up_table},
};

}  // namespace

Table work_table(const Comparison& comparison) {
    std::vector<Block> small = smallest_blocks(comparison);
    std::erase_if(small, [](Block block) {
        return compared_scene(block.front().scene).specs.size() == 1;  // of a file
    });
    Table table({"structure", "scenes", "camera nodes", "camera tests", "shadow nodes",
                 "shadow tests", "diffuse nodes", "diffuse tests", "any nodes", "any tests",
                 "wrong"});
    for (const std::string& name : structure_names(comparison, false)) {
        std::uint64_t scenes = 0, wrong = 0;
        for (const Block block : small)
            if (const ComparedRow* const row = find(block, name)) ++scenes, wrong += row->wrong();
        std::vector<std::string> cells{name, with_commas(scenes)};
        for (const RayKind kind : ray_kinds)
            for (const auto field : {&TracedKind::nodes_per_ray, &TracedKind::tests_per_ray})
                cells.push_back(
                    number(mean_over(small, name,
                                     [&](const ComparedRow& row) { return row[kind].*field; }),
                           1));
        cells.push_back(with_commas(wrong));
        table.row(cells);
    }
    return table;
}

void print_comparison(const Comparison& comparison, bool times) {
    print_heading("Work behind a ray, the geometric mean over the smallest size of each scene");
    work_table(comparison).print();
    if (!times) return;
    print_heading(fmt::format("About {} triangles, the geometric mean over scenes",
                              with_commas(std::uint64_t(compared_size(comparison)))));
    structures_table(comparison).print();
    print_heading("The fastest of ours");
    winners_table(comparison).print();
    print_heading("The cheapest of ours for so many rays, with its build");
    break_even_table(comparison).print();
    print_heading("Growth with the number of triangles: powers");
    growth_table(comparison).print();
    print_heading("What gave up");
    gave_up_table(comparison).print();
}

void quote_tables(const Comparison& comparison, bool times, Numbers& numbers) {
    numbers.count_table("work", work_table(comparison));
    if (!times) return;
    for (const NamedTable& table : timed_tables)
        numbers.time_table(table.name, table.make(comparison));
}

std::uint64_t wrong_answers(const Comparison& comparison, bool of_peers) {
    std::uint64_t wrong = 0;
    for (const ComparedRow& row : comparison.rows)
        if (row.is_peer == of_peers) wrong += row.wrong();
    return wrong;
}

}  // namespace space::ch12
