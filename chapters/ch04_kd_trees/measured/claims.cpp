#include "chapters/ch04_kd_trees/measured/outcome.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace space::ch04 {
namespace {

/// A quotient that grows with a smaller power of n than this does not grow.
constexpr double flat = 0.1;

const CurePoint& row(const std::vector<CurePoint>& cures, std::string_view scene,
                     std::string_view cure) {
    return *std::ranges::find_if(
        cures, [&](const CurePoint& p) { return p.scene == scene && p.cure == cure; });
}
/// The scenes, each once.
template <class Point>
std::vector<std::string> scenes_of(const std::vector<Point>& points) {
    std::vector<std::string> names;
    for (const Point& point : points)
        if (names.empty() || names.back() != point.scene) names.push_back(point.scene);
    return names;
}
const TreePoint& tree(const std::vector<TreePoint>& trees, std::string_view scene,
                      std::string_view rule) {
    return *std::ranges::find_if(
        trees, [&](const TreePoint& p) { return p.scene == scene && p.rule == rule; });
}

// --- Lichter23 ---

ClaimAnswer answer_gain(const std::vector<CurePoint>& cures) {
    const std::string& scene = cures.front().scene;
    const CurePoint &naive = row(cures, scene, no_tree), &plain = row(cures, scene, no_cure),
                    &cured = row(cures, scene, all_cures), &other = row(cures, scene, other_tree);
    const auto fewer = [&](const CurePoint& p) { return double(naive.tests) / double(p.tests); };
    const auto faster = [&](const CurePoint& p) { return naive.trace_ms / p.trace_ms; };
    const std::size_t agree =
        std::size_t{fewer(plain) >= published_factor} + (faster(plain) >= published_speedup);
    return {"L6", verdict_of(agree, 2),
            fmt::format("As published the tree needs {:.2f} times fewer tests than no tree and is "
                        "{:.1f} times faster; with all cures {:.0f} times fewer and {:.1f} times "
                        "faster; a tree by the surface area heuristic {:.0f} and {:.1f}",
                        fewer(plain), faster(plain), fewer(cured), faster(cured), fewer(other),
                        faster(other)),
            fmt::format("{}, {} triangles, closed; {} camera rays; MAX_TRIANGLES_PER_LEAF 8", scene,
                        naive.triangles, naive.rays),
            "confirmed if both are at least as much as published, refuted if neither"};
}

ClaimAnswer answer_order(const std::vector<CurePoint>& cures) {
    std::vector<std::string> texts;
    std::size_t changed = 0;
    const std::vector<std::string> scenes = scenes_of(cures);
    for (const std::string& scene : scenes) {
        const std::uint64_t naive = row(cures, scene, no_tree).found,
                            plain = row(cures, scene, "safe box test").found,
                            ordered = row(cures, scene, "near child first").found;
        changed += plain != naive && ordered != plain;
        texts.push_back(fmt::format("{}: {}, {} and {}", scene, naive, plain, ordered));
    }
    return {"L7", verdict_of(changed, scenes.size()),
            fmt::format("hits nearer than all before, by the list's order, by the tree's with the "
                        "left child first, and with the near child first: {}",
                        fmt::join(texts, "; ")),
            joined(scenes),
            "among trees that lose no hit; confirmed if each order finds another number on every "
            "scene, refuted if on none"};
}

ClaimAnswer answer_box(const std::vector<CurePoint>& cures) {
    std::vector<std::string> texts;
    bool large = false, small = false, vanished = false;
    for (const std::string& scene : scenes_of(cures)) {
        const CurePoint& p = row(cures, scene, no_cure);
        large = large || p.box_area > 1.0;
        small = small || p.box_area < 1.0;
        vanished = vanished || (p.dropped > 0 && p.lost > 0);
        texts.push_back(fmt::format("{}: {:.2f} times the area, {} and {} gone", scene, p.box_area,
                                    counted(p.dropped, "triangle"), counted(p.lost, "hit")));
    }
    return {"L10", verdict_of(std::size_t{large} + small + vanished, 3),
            fmt::format("the published box beside the scene's: {}", fmt::join(texts, "; ")),
            joined(scenes_of(cures)),
            "confirmed if there is a scene with too large a box, one with too small a box, and one "
            "that loses a triangle and hits, refuted if there is none of these"};
}

// --- rules ---

ClaimAnswer answer_planes(const std::vector<PlaneTimes>& planes) {
    std::vector<std::string> texts, where;
    std::size_t about = 0, less = 0;
    for (const PlaneTimes& p : planes) {
        const double ratio = p.general_ns / p.axis_ns;
        about += ratio >= 2.5 && ratio <= 3.5;
        less += ratio < 2.5;
        texts.push_back(fmt::format("{} {:.2f}", p.where, ratio));
        where.push_back(p.where);
    }
    return {
        "H8",
        about == planes.size()  ? Verdict::confirmed
        : less == planes.size() ? Verdict::refuted
                                : Verdict::depends,
        fmt::format("time of a general plane over that of one across an axis: {}",
                    fmt::join(texts, "; ")),
        "the planes of trees over soup, as numbers and as normals",
        "confirmed if the ratio is within 2.5 .. 3.5 everywhere, refuted if it is less everywhere"};
}

ClaimAnswer answer_median(const std::vector<TreePoint>& trees) {
    std::vector<std::string> texts;
    std::size_t faster = 0;
    const std::vector<std::string> scenes = scenes_of(trees);
    for (const std::string& scene : scenes) {
        const TreePoint &half = tree(trees, scene, median_rule), &mid = tree(trees, scene, middle),
                        &area = tree(trees, scene, sah);
        faster += half.trace_ms < mid.trace_ms;
        texts.push_back(fmt::format("{} {:.2f} ({:.2f})", scene, half.trace_ms / mid.trace_ms,
                                    area.trace_ms / mid.trace_ms));
    }
    return {"H9", verdict_of(faster, scenes.size()),
            fmt::format("time of rays in a tree cut at the median (by the surface area heuristic) "
                        "over that in one cut in the middle: {}",
                        joined(texts)),
            joined(scenes), "confirmed if below 1 on every scene, refuted if on none"};
}

ClaimAnswer answer_straddlers(const std::vector<TreePoint>& trees) {
    std::vector<std::string> texts;
    std::size_t better = 0;
    std::uint64_t lost = 0, checked = 0;
    const std::vector<std::string> scenes = scenes_of(trees);
    for (const std::string& scene : scenes) {
        const TreePoint &named = tree(trees, scene, sah_boxes), &clipped = tree(trees, scene, sah),
                        &kept = tree(trees, scene, sah_kept),
                        &split = tree(trees, scene, sah_split);
        better += clipped.steps_per_ray() < kept.steps_per_ray() &&
                  named.steps_per_ray() < kept.steps_per_ray();
        lost += split.wrong;
        checked += split.checked;
        texts.push_back(
            fmt::format("{} {:.2f}, {:.2f}, {:.2f} and {:.2f} references, and "
                        "{:.0f}, {:.0f}, {:.0f} and {:.0f} nodes and tests a ray",
                        scene, named.per_triangle(), clipped.per_triangle(), split.per_triangle(),
                        kept.per_triangle(), named.steps_per_ray(), clipped.steps_per_ray(),
                        split.steps_per_ray(), kept.steps_per_ray()));
    }
    return {
        "H10", verdict_of(better, scenes.size()),
        fmt::format("a triangle duplicated by its box, duplicated by its part in the cell, "
                    "split into rounded pieces, and kept in the inner node: {}. Split pieces "
                    "lose {} of {} rays, the others none",
                    fmt::join(texts, "; "), lost, checked),
        joined(scenes),
        "confirmed if duplicating takes fewer nodes and tests a ray than keeping on every scene, "
        "refuted if on none"};
}

ClaimAnswer answer_candidates(const std::vector<TreePoint>& trees) {
    std::vector<std::string> texts;
    std::size_t nearly = 0, more = 0;
    const std::vector<std::string> scenes = scenes_of(trees);
    for (const std::string& scene : scenes) {
        const TreePoint& p = tree(trees, scene, sah);
        const double root = double(p.root_candidates) / (6.0 * double(p.n)),
                     all = double(p.candidates) / double(p.faces);
        nearly += all >= 0.9 && all <= 1.0;
        more += all > 1.0;
        texts.push_back(fmt::format("{} {:.2f} ({:.2f})", scene, root, all));
    }
    return {
        "P6",
        more > 0                  ? Verdict::refuted
        : nearly == scenes.size() ? Verdict::confirmed
                                  : Verdict::depends,
        fmt::format("planes tried over 6 T at the root (over all nodes): {}. Faces at one "
                    "place are one plane, those at the cell's ends are none",
                    joined(texts)),
        joined(scenes),
        "confirmed if at least 0.9 of 6 T are tried over all nodes of every scene, refuted if more "
        "than 6 T of any, depends if fewer"};
}

// --- growth ---

ClaimAnswer answer_build(const std::vector<Growth>& growth) {
    std::vector<std::string> texts;
    std::size_t logarithmic = 0;
    for (const Growth& g : growth) {
        const double work = slope(g, [](const TreePoint& p) { return double(p.placed); });
        logarithmic += work < flat;
        texts.push_back(fmt::format("{} by {} {:.2f} ({:+.2f})", g[0].scene, g[0].rule, work,
                                    slope(g, placed_per_n_log_n)));
    }
    return {"P19", verdict_of(logarithmic, growth.size()),
            fmt::format("slope of the references placed in all nodes over n (and of their quotient "
                        "with n log n): {}",
                        joined(texts)),
            fmt::format("{} to {} triangles", growth[0].front().n, growth[0].back().n),
            "confirmed if the work grows with less than n^0.1 in every series, refuted if in none"};
}

ClaimAnswer answer_nearest(const std::vector<PointSet>& points) {
    std::vector<std::string> texts;
    std::size_t logarithmic = 0;
    const auto series = series_of(points);
    for (const auto& [name, sets] : series) {
        std::vector<double> n, quotient;
        for (const PointSet* set : sets) {
            n.push_back(double(set->points));
            quotient.push_back(visited(*set) / std::log2(n.back()));
        }
        const double fitted = n.size() > 1 ? log_log_slope(n, quotient) : 0.0;
        logarithmic += fitted <= flat;
        texts.push_back(fmt::format("{}: {:.1f} to {:.1f} ({:+.2f})", name, visited(*sets.front()),
                                    visited(*sets.back()), fitted));
    }
    return {"P5", verdict_of(logarithmic, series.size()),
            fmt::format("nodes and buckets that a search for the nearest point goes into (slope of "
                        "their quotient with log n): {}",
                        fmt::join(texts, "; ")),
            fmt::format("{} to {} points", points.front().points, points.back().points),
            "confirmed if the quotient's slope is at most 0.1 in every series, refuted if in none"};
}

}  // namespace

std::vector<ClaimAnswer> answer_claims(const Measurements& measured) {
    return {answer_gain(measured.cures),       answer_order(measured.cures),
            answer_box(measured.cures),        answer_planes(measured.planes),
            answer_median(measured.trees),     answer_straddlers(measured.trees),
            answer_candidates(measured.trees), answer_build(measured.growth),
            answer_nearest(measured.points)};
}

}  // namespace space::ch04
