#include "chapters/ch12_comparison/measured/comparison_views.hpp"

#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "common/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

namespace space::ch12 {
namespace {

/// Of each scene the block that `better` prefers, in the order of the scenes.
std::vector<Block> one_of_each(const Comparison& comparison,
                               const std::function<bool(Block, Block)>& better) {
    std::vector<Block> chosen;
    for (const Block block : blocks(comparison)) {
        const auto same = std::ranges::find_if(
            chosen, [&](Block other) { return other.front().scene == block.front().scene; });
        if (same == chosen.end())
            chosen.push_back(block);
        else if (better(block, *same))
            *same = block;
    }
    return chosen;
}

double triangles_of(Block block) {
    return double(block.front().triangles);
}

double size_off(Block block, double triangles) {
    return std::abs(std::log(triangles_of(block) / triangles));
}

/// Of each scene the block whose number of triangles is nearest, by ratio.
std::vector<Block> nearest_blocks(const Comparison& comparison, double triangles) {
    return one_of_each(comparison, [&](Block a, Block b) {
        return size_off(a, triangles) < size_off(b, triangles);
    });
}

}  // namespace

std::vector<Block> blocks_near(const Comparison& comparison, double triangles) {
    std::vector<Block> near = nearest_blocks(comparison, triangles);
    std::erase_if(near, [&](Block block) { return size_off(block, triangles) > std::log(3.0); });
    return near;
}

double compared_size(const Comparison& comparison) {
    return blocks_near(comparison, 1e5).size() > 3 ? 1e5 : 1e3;
}

std::vector<Block> smallest_blocks(const Comparison& comparison) {
    return one_of_each(comparison,
                       [](Block a, Block b) { return triangles_of(a) < triangles_of(b); });
}

std::vector<std::string> structure_names(const Comparison& comparison, bool with_peers) {
    std::vector<std::string> names;
    for (const ComparedRow& row : comparison.rows)
        if ((with_peers || !row.is_peer) && std::ranges::find(names, row.structure) == names.end())
            names.push_back(row.structure);
    return names;
}

double ray_cost(const ComparedRow& row, std::optional<RayKind> kind) {
    const double ns = kind ? row[*kind].ns_per_ray : row.mean_ns();
    if (!std::isnan(ns)) return ns;
    double work = 0.0, kinds = 0.0;
    for (const RayKind one : ray_kinds) {
        if ((kind && one != *kind) || row[one].rays == 0) continue;
        work += row[one].nodes_per_ray + row[one].tests_per_ray;
        ++kinds;
    }
    return work / kinds;
}

std::vector<const ComparedRow*> by_ray_cost(Block block, std::optional<RayKind> kind) {
    std::vector<const ComparedRow*> rows;
    for (const ComparedRow& row : block)
        if (row.stands() && !row.is_peer && !std::isnan(ray_cost(row, kind))) rows.push_back(&row);
    std::ranges::stable_sort(rows, {},
                             [&](const ComparedRow* row) { return ray_cost(*row, kind); });
    return rows;
}

std::vector<Factor> factors(std::span<const Block> blocks, std::string_view structure,
                            std::optional<RayKind> kind) {
    std::vector<Factor> all;
    for (const Block block : blocks) {
        const ComparedRow* const row = find(block, structure);
        const auto sorted = by_ray_cost(block, kind);
        if (!row || sorted.empty()) continue;
        const double factor = ray_cost(*row, kind) / ray_cost(*sorted.front(), kind);
        if (!std::isnan(factor)) all.push_back({row->scene, factor});
    }
    return all;
}

std::vector<Factor> ratios(std::span<const Block> blocks, std::string_view structure,
                           std::string_view other, std::optional<RayKind> kind) {
    std::vector<Factor> all;
    for (const Block block : blocks) {
        const ComparedRow *const a = find(block, structure), *const b = find(block, other);
        if (!a || !b) continue;
        const double ratio = ray_cost(*a, kind) / ray_cost(*b, kind);
        if (!std::isnan(ratio)) all.push_back({a->scene, ratio});
    }
    return all;
}

double median_factor(std::span<const Factor> factors) {
    std::vector<double> values;
    for (const Factor& one : factors) values.push_back(one.factor);
    return median(std::move(values));
}

const Factor& worst(std::span<const Factor> factors) {
    if (factors.empty()) throw std::out_of_range("no scene to compare on");
    return *std::ranges::max_element(factors, {}, &Factor::factor);
}

Growth growth(const Comparison& comparison, std::string_view structure) {
    std::map<std::string, std::vector<const ComparedRow*>> by_scene;
    for (const ComparedRow& row : comparison.rows)
        if (row.structure == structure && row.stands()) by_scene[row.scene].push_back(&row);
    Growth growth{.structure = std::string(structure)};
    for (const auto& [scene, rows] : by_scene) {
        if (rows.size() < 3) continue;
        const auto fit = [&](const auto& value, std::vector<double>& slopes) {
            std::vector<double> x, y;
            for (const ComparedRow* const row : rows) {
                x.push_back(double(row->triangles));
                y.push_back(value(*row));
            }
            const bool can_fit = std::ranges::all_of(y, [](double v) { return v > 0.0; });
            if (can_fit) slopes.push_back(log_log_slope(x, y));
        };
        fit([](const ComparedRow& row) { return row.ready_ms(); }, growth.build);
        fit([](const ComparedRow& row) { return double(row.bytes); }, growth.bytes);
        fit([](const ComparedRow& row) { return row[RayKind::diffuse].nodes_per_ray; },
            growth.nodes);
        fit([](const ComparedRow& row) { return row.mean_ns(); }, growth.ns);
    }
    return growth;
}

std::vector<OctreeDuel> octree_duels(const Comparison& comparison) {
    std::vector<OctreeDuel> duels;
    for (const Block block : nearest_blocks(comparison, compared_size(comparison))) {
        const ComparedRow* const bvh = find(block, "bvh-binned");
        const ComparedRow* best = nullptr;
        for (const char* name : {"octree", "octree-loose", "octree-linear"})
            if (const ComparedRow* const row = find(block, name))
                if (!best || ray_cost(*row) < ray_cost(*best)) best = row;
        if (bvh && best)
            duels.push_back({bvh->scene, best->structure, compared_scene(bvh->scene).is_even,
                             ray_cost(*bvh), ray_cost(*best)});
    }
    return duels;
}

std::optional<std::pair<double, double>> worth_it(Block block, std::string_view structure) {
    const std::vector<CostLine> lines = cost_lines(block, false);
    std::optional<std::pair<double, double>> range;
    for (const CheapestSpan& span : lower_envelope(lines, fewest_rays, most_rays)) {
        if (lines[span.line].name != structure) continue;
        if (!range) range = {span.from, span.to};
        range->second = span.to;
    }
    return range;
}

}  // namespace space::ch12
