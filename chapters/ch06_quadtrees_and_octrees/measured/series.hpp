/// @file
/// What tables, charts and claims look up and fit.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/measured/data.hpp"
#include "common/measure.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch06 {

/// The scene's tree of that name, of n triangles if that is not 0.
inline const TreePoint& tree_of(const std::vector<TreePoint>& trees, std::string_view scene,
                                std::string_view name, std::uint64_t n = 0) {
    return *std::ranges::find_if(trees, [&](const TreePoint& p) {
        return p.scene == scene && p.tree == name && (n == 0 || p.n == n);
    });
}

inline double speed_beside_sah(const std::vector<TreePoint>& trees, std::string_view scene,
                               std::string_view name) {
    return tree_of(trees, scene, name).rays_per_second() /
           tree_of(trees, scene, sah).rays_per_second();
}
/// Of the chapter's trees the fastest.
inline double best_beside_sah(const std::vector<TreePoint>& trees, std::string_view scene) {
    double best = 0.0;
    for (const TreePoint& p : trees)
        if (p.scene == scene && p.tree != sah && p.tree != no_tree)
            best = std::max(best, speed_beside_sah(trees, scene, p.tree));
    return best;
}

/// Sets of points of one kind, by "even, D = 2".
inline std::map<std::string, std::vector<PointTree>> series_of(
    const std::vector<PointTree>& points) {
    std::map<std::string, std::vector<PointTree>> series;
    for (const PointTree& point : points)
        series[point.points + ", D = " + std::to_string(point.dimensions)].push_back(point);
    return series;
}

/// The least-squares slope of log y over log((d + 1) n).
template <class Value>
double slope(const std::vector<PointTree>& series, const Value& value) {
    std::vector<double> bound, y;
    for (const PointTree& point : series) {
        bound.push_back(point.bound());
        y.push_back(value(point));
    }
    return log_log_slope(bound, y);
}

}  // namespace space::ch06
