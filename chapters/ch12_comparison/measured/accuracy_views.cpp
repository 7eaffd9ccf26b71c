#include "chapters/ch12_comparison/measured/accuracy_data.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch12 {

bool stands_for_its_kind(const AccuracyPoint& point) {
    constexpr std::array<std::string_view, 7> shown{
        "naive", "bsp", "kd-sah", "octree", "bvh-binned", "fast", "fast-compressed"};
    return point.is_peer || std::ranges::find(shown, point.structure) != shown.end();
}

std::vector<AccuracyPoint> accuracy_points(std::span<const AccuracyRow> rows) {
    std::vector<AccuracyPoint> points;
    for (const AccuracyRow& row : rows) {
        const auto is_same = [&](const auto& other) {
            return other.structure == row.structure && other.test == row.test;
        };
        if (std::ranges::any_of(points, is_same)) continue;
        double logarithms = 0.0, wrong = 0.0, asked = 0.0;
        int scenes = 0;
        for (const AccuracyRow& other : rows)
            if (is_same(other)) {
                logarithms += std::log(other.ns_per_ray);
                ++scenes;
                wrong += double(other.wrong());
                asked += double(other.rays);
            }
        points.push_back({row.structure, row.test, row.home, row.is_peer,
                          std::exp(logarithms / scenes), 1e6 * wrong / asked});
    }
    return points;
}

void quote_accuracy(std::span<const AccuracyRow> rows, Numbers& numbers) {
    const std::vector<AccuracyPoint> points = accuracy_points(rows);
    Table table({"structure", "triangle test", "home", "ns per ray", "wrong per million"});
    double exact = 0.0, most = 0.0;
    for (const AccuracyPoint& point : points) {
        exact += point.per_million == 0.0;
        most = std::max(most, point.per_million);
        if (stands_for_its_kind(point))
            table.row({point.structure, point.test, point.home,
                       with_commas(static_cast<std::uint64_t>(std::lround(point.ns_per_ray))),
                       with_commas(static_cast<std::uint64_t>(std::lround(point.per_million)))});
    }
    // With others' code there are more of them: a machine's affair, as times are.
    std::set<std::string> scenes;
    for (const AccuracyRow& row : rows) scenes.insert(row.scene);
    const auto whole = [&](const std::string& name, double value) {
        numbers.time(name, value, with_commas(static_cast<std::uint64_t>(std::lround(value))));
    };
    whole("accuracy_points", double(points.size()));
    whole("accuracy_exact_points", exact);
    whole("accuracy_most", most);
    whole("accuracy_rays", double(rows.front().rays) * double(scenes.size()));
    whole("accuracy_scenes", double(scenes.size()));
    // What the exact test takes beside the plain one in float, in one and the same structure. (The
    // wide kernels of chapter 10 know the exact test alone.)
    std::vector<double> dearer;
    for (const AccuracyPoint& exact_one : points)
        for (const AccuracyPoint& plain : points)
            if (exact_one.structure == plain.structure && !plain.structure.starts_with("fast") &&
                exact_one.test == "filtered-exact" && plain.test == "moller-trumbore-float")
                dearer.push_back(exact_one.ns_per_ray / plain.ns_per_ray - 1.0);
    for (const auto& [name, value] :
         {std::pair("least", std::ranges::min(dearer)), {"most", std::ranges::max(dearer)}})
        numbers.time(fmt::format("accuracy_exact_dearer_{}", name), value, percent(value));
    numbers.time_table("accuracy", table);
}

}  // namespace space::ch12
