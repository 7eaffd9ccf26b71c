#include "chapters/ch07_bounding_volume_hierarchies/measured/outcome.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <map>
#include <utility>

namespace space::ch07 {
namespace {

/// What grows with a smaller power of n than this does not grow.
constexpr double flat = 0.1;

ClaimAnswer answer_over_bsp(const TreeMeasurements& measured) {
    std::vector<std::string> texts;
    std::uint64_t wrong = 0, rays = 0, trees = 0;
    for (const ExactPoint& p : measured.exact) {
        if (p.builder != by_bsp) continue;
        ++trees;
        wrong += p.wrong;
        rays += p.rays;
    }
    for (const TreePoint& p : measured.trees) {
        if (p.builder != by_bsp) continue;
        const TreePoint* const bins = tree_of(measured.trees, p.scene, by_bins);
        wrong += p.wrong;
        ++trees;
        texts.push_back(
            fmt::format("{} {:.2f} references a triangle, {:.2f} times the steps of "
                        "the binned tree",
                        p.scene, p.references_per_triangle(),
                        p.diffuse().steps_per_ray() / bins->diffuse().steps_per_ray()));
    }
    return {"H13",
            trees == 0   ? Verdict::depends
            : wrong == 0 ? Verdict::confirmed
                         : Verdict::refuted,
            fmt::format("{} trees, boxes merged along the BSP tree from its leaves up; {} wrong "
                        "answers to {} aimed rays and more. {}",
                        trees, wrong, rays, fmt::join(texts, "; ")),
            joined(scenes_of(measured.exact)),
            "confirmed if all such trees answer as the naive loop does"};
}

/// Camera rays of one picture, in nanoseconds or where nothing was timed in steps.
double camera_time(const TreePoint& p) {
    const RayCost& rays = p.rays[camera_kind];
    return rays.ms > 0.0 ? 1e6 * rays.ms / double(rays.rays) : rays.steps_per_ray();
}

ClaimAnswer answer_large(const std::vector<TreePoint>& growth) {
    constexpr double large_share = 0.24;  // the two largest sizes, about 0.5 and 1 million on
    std::vector<std::string> texts;
    std::size_t still = 0;
    const std::vector<std::string> scenes = scenes_of(growth);
    for (const std::string& scene : scenes) {
        const std::vector<TreePoint> all = grown(growth, scene, by_bins);
        std::vector<TreePoint> large = all;
        std::erase_if(large, [&](const TreePoint& p) {
            return double(p.n) < large_share * double(all.back().n);
        });
        const double fitted = slope(large, camera_time);
        still += fitted <= flat;
        texts.push_back(fmt::format("{} {:.4g} to {:.4g} for {} to {} triangles ({:+.2f}; {:+.2f})",
                                    scene, camera_time(large.front()), camera_time(large.back()),
                                    large.front().n, large.back().n, fitted,
                                    slope(all, camera_time)));
    }
    return {"P2", verdict_of(still, scenes.size()),
            fmt::format("time of a camera ray in ns, or its steps where nothing is timed (power of "
                        "n; and over all sizes): {}",
                        fmt::join(texts, "; ")),
            "a picture of one size; each scene's largest sizes, binned builder",
            "confirmed if time grows with at most n^0.1 in every scene, refuted if in none"};
}

ClaimAnswer answer_candidates(const std::vector<CandidatePoint>& candidates) {
    std::vector<std::string> texts;
    std::size_t nearly = 0, half = 0;
    for (const CandidatePoint& p : candidates) {
        const double planes = double(p.planes) / double(p.faces),
                     partitions = double(p.partitions) / double(p.faces);
        nearly += partitions >= 0.9;
        half += partitions <= 0.5;
        texts.push_back(fmt::format("{} {:.2f}, {:.2f} and {:.2f}", p.scene, planes, partitions,
                                    double(p.cuts) / double(p.faces)));
    }
    return {
        "P6",
        nearly == candidates.size() ? Verdict::confirmed
        : half == candidates.size() ? Verdict::refuted
                                    : Verdict::depends,
        fmt::format("of 6 T planes at the boxes' faces, over all nodes: at different places, "
                    "parting the triangles differently, and 3 (T - 1) cuts of the sorted "
                    "middles, which are all that these planes can make: {}",
                    fmt::join(texts, "; ")),
        joined(scenes_of(candidates)),
        "confirmed if at least 0.9 of 6 T are different candidates on every scene, refuted if "
        "at most a half on each: each triangle stays whole, so two planes with the same middles "
        "below are one cut"};
}

ClaimAnswer answer_nodes(const std::vector<LeafPoint>& leaves) {
    constexpr double least = 0.51, most = 0.66;
    std::map<std::pair<std::string_view, double>, std::vector<double>> rules;
    for (const LeafPoint& p : leaves) rules[{p.builder, p.rule}].push_back(p.nodes_per_triangle());
    std::vector<std::string> inside, outside;
    for (const auto& [rule, shares] : rules) {
        const auto [low, high] = std::ranges::minmax(shares);
        const bool is_inside = low >= least && high <= most;
        (is_inside ? inside : outside)
            .push_back(
                fmt::format("{} {:g}: {:.2f} to {:.2f}", rule.first, rule.second, low, high));
    }
    return {
        "P7",
        outside.empty()  ? Verdict::confirmed
        : inside.empty() ? Verdict::refuted
                         : Verdict::depends,
        fmt::format("nodes per triangle by the leaf rule, median with most triangles in a leaf, "
                    "binned with C_V / C_NS. As published on all scenes: {}. Not: {}",
                    inside.empty() ? "by none" : joined(inside), fmt::join(outside, "; ")),
        joined(scenes_of(leaves)),
        "confirmed if within 0.51 .. 0.66 by every rule on every scene, refuted if by none on "
        "all scenes"};
}

ClaimAnswer answer_logarithm(const std::vector<TreePoint>& growth) {
    std::vector<std::string> texts;
    std::size_t logarithmic = 0;
    const std::vector<std::string> scenes = scenes_of(growth);
    for (const std::string& scene : scenes) {
        const std::vector<TreePoint> series = grown(growth, scene, by_bins);
        const double fitted = slope(series, steps_per_log_n);
        logarithmic += fitted <= flat;
        texts.push_back(fmt::format("{} {:.1f} to {:.1f} ({:+.2f})", scene,
                                    series.front().diffuse().steps_per_ray(),
                                    series.back().diffuse().steps_per_ray(), fitted));
    }
    return {
        "O9", verdict_of(logarithmic, scenes.size()),
        fmt::format("nodes and tests of a diffuse ray (power with which their quotient by log n "
                    "grows): {}. Without a tree there are n tests",
                    fmt::join(texts, "; ")),
        fmt::format("{} to {} triangles, binned builder", growth.front().n, growth.back().n),
        "confirmed if the quotient grows with at most n^0.1 in every scene, refuted if in none"};
}

ClaimAnswer answer_halving(const std::vector<TreePoint>& trees) {
    std::vector<std::string> texts;
    std::size_t better = 0;
    const std::vector<std::string> scenes = scenes_of(trees);
    for (const std::string& scene : scenes) {
        const TreePoint &half = *tree_of(trees, scene, by_median),
                        &sweep = *tree_of(trees, scene, by_sweep),
                        &bins = *tree_of(trees, scene, by_bins);
        const auto time = [](const TreePoint& p) {
            return p.diffuse().ms > 0.0 ? p.diffuse().ms
                                        : double(p.diffuse().nodes + p.diffuse().tests);
        };
        better += time(sweep) < time(half) && time(bins) < time(half);
        texts.push_back(fmt::format("{} {:.2f} ({:.2f})", scene, time(half) / time(sweep),
                                    time(half) / time(bins)));
    }
    return {"O10", verdict_of(better, scenes.size()),
            fmt::format("time of diffuse rays, or their steps where nothing is timed, in a tree "
                        "whose longest axis is halved, over that in one by the sweep (by bins): {}",
                        joined(texts)),
            joined(scenes), "confirmed if both are above 1 on every scene, refuted if on none"};
}

ClaimAnswer answer_sums(const std::vector<SumPoint>& sums) {
    std::vector<std::string> texts;
    std::size_t worse = 0;
    for (std::size_t i = 0; i + 1 < sums.size(); i += 2) {
        const SumPoint &with = sums[i], &without = sums[i + 1];
        const double steps = without.rays.steps_per_ray() / with.rays.steps_per_ray();
        worse += steps > 1.0;
        texts.push_back(
            fmt::format("{} cost {:.1f} and {:.1f}, tests {:.1f} and {:.1f}, steps "
                        "{:.2f} times, depth {} and {}",
                        with.scene, with.cost, without.cost, with.rays.tests_per_ray(),
                        without.rays.tests_per_ray(), steps, with.depth, without.depth));
    }
    return {"O15", verdict_of(worse, sums.size() / 2),
            fmt::format("cuts by areas times counts and by areas alone, leaves of at most 4 by "
                        "both: {}",
                        fmt::join(texts, "; ")),
            joined(scenes_of(sums)),
            "confirmed, that leaving out the counts is an error, if rays take more steps on every "
            "scene, refuted if on none"};
}

}  // namespace

std::vector<ClaimAnswer> answer_claims(const TreeMeasurements& measured) {
    return {answer_over_bsp(measured),
            answer_large(measured.growth),
            answer_candidates(measured.candidates),
            answer_nodes(measured.leaves),
            answer_logarithm(measured.growth),
            answer_halving(measured.trees),
            answer_sums(measured.sums)};
}

}  // namespace space::ch07
