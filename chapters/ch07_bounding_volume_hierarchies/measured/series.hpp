/// @file
/// What tables, charts and claims look up and fit.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/measured/data.hpp"
#include "common/measure.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch07 {

/// The scenes in their order, each once.
template <class Point>
std::vector<std::string> scenes_of(const std::vector<Point>& points) {
    std::vector<std::string> scenes;
    for (const Point& p : points)
        if (std::ranges::count(scenes, p.scene) == 0) scenes.push_back(p.scene);
    return scenes;
}

/// The scene's tree by that builder; null where there is none.
inline const TreePoint* tree_of(const std::vector<TreePoint>& trees, std::string_view scene,
                                std::string_view builder) {
    const auto found = std::ranges::find_if(
        trees, [&](const TreePoint& p) { return p.scene == scene && p.builder == builder; });
    return found == trees.end() ? nullptr : &*found;
}

/// A scene as it grows, by one builder.
inline std::vector<TreePoint> grown(const std::vector<TreePoint>& growth, std::string_view scene,
                                    std::string_view builder) {
    std::vector<TreePoint> some;
    for (const TreePoint& p : growth)
        if (p.scene == scene && p.builder == builder) some.push_back(p);
    return some;
}

/// The least-squares slope of log y over log n; 0 for fewer than two points.
template <class Value>
double slope(const std::vector<TreePoint>& series, const Value& value) {
    std::vector<double> n, y;
    for (const TreePoint& p : series) {
        n.push_back(double(p.n));
        y.push_back(value(p));
    }
    return n.size() < 2 ? 0.0 : log_log_slope(n, y);
}
inline double build_ms(const TreePoint& p) {
    return p.build_ms;
}
inline double diffuse_nodes(const TreePoint& p) {
    return p.diffuse().nodes_per_ray();
}
inline double diffuse_tests(const TreePoint& p) {
    return p.diffuse().tests_per_ray();
}
/// What is O(log n) does not grow over it.
inline double steps_per_log_n(const TreePoint& p) {
    return p.diffuse().steps_per_ray() / std::log2(double(p.n));
}

/// The binned builder on one scene beside Embree, and what the chapter wants of it.
struct Target {
    std::string scene;
    std::uint64_t n = 0;
    bool is_long = false, is_soup = false;
    double build = 0.0;                              ///< time over Embree's
    std::array<double, ray_kinds.size()> rays = {};  ///< per second, over Embree's
    double bytes = 0.0;                              ///< of a triangle
    double spatial_gain = 0.0;                       ///< of spatial splits, diffuse rays

    double least_diffuse() const { return is_soup ? 0.3 : 0.45; }
    bool is_built() const { return build <= 1.5; }
    bool is_seen() const { return rays[camera_kind] >= 0.6; }
    bool is_lit() const { return rays[diffuse_kind] >= least_diffuse(); }
    bool is_small() const { return bytes <= 60.0; }
    bool is_split() const { return !is_long || spatial_gain >= 1.25; }
    /// "met", or what falls short.
    std::string verdict() const;
};
std::vector<Target> targets(const std::vector<TreePoint>& trees);

/// Fits each scene's times; nothing where none were taken.
std::vector<CostFit> fit_costs(const std::vector<LeafPoint>& leaves);

}  // namespace space::ch07
