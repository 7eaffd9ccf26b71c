#include "chapters/ch03_bsp_trees/measured/outcome.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace space::ch03 {
namespace {

/// A ratio that grows with a smaller power of n than this does not grow: what a bound leaves out
/// (small n, steps of whole levels) moves the fitted slopes by as much.
constexpr double flat = 0.1;

/// "5 of 6" and the scenes of the series where `value` outgrows `bound`.
struct Bounded {
    std::size_t within = 0, series = 0;
    std::vector<std::string> beyond;

    std::string text() const {
        return fmt::format("{} of {} series{}", within, series,
                           beyond.empty() ? "" : fmt::format(" (not {})", fmt::join(beyond, "; ")));
    }
};
template <class Value, class Bound>
Bounded bounded(const std::vector<Growth>& growth, const Value& value, const Bound& bound) {
    Bounded result;
    struct Scene {
        std::string name;
        std::vector<std::string> methods = {};
        double least = std::numeric_limits<double>::infinity(),
               most = -std::numeric_limits<double>::infinity();
        std::size_t series = 0;
    };
    std::vector<Scene> scenes;
    for (const Growth& g : growth) {
        const auto ratio = [&](const TreePoint& p) { return value(p) / bound(double(p.polygons)); };
        const std::optional<double> fitted = slope(g, ratio);
        if (!fitted) continue;
        if (scenes.empty() || scenes.back().name != g.scene) scenes.push_back({g.scene});
        Scene& scene = scenes.back();
        ++scene.series;
        ++result.series;
        result.within += *fitted <= flat;
        if (*fitted <= flat) continue;
        scene.methods.push_back(g.method);
        scene.least = std::min(scene.least, *fitted);
        scene.most = std::max(scene.most, *fitted);
    }
    for (const Scene& scene : scenes) {
        if (scene.methods.empty()) continue;
        const bool all = scene.methods.size() == scene.series;
        const bool one = scene.methods.size() == 1;
        result.beyond.push_back(
            fmt::format("{}{}: {:+.2f}{}", scene.name,
                        all ? "" : fmt::format(" by {}", fmt::join(scene.methods, ", ")),
                        scene.least, one ? "" : fmt::format(" to {:+.2f}", scene.most)));
    }
    return result;
}

std::vector<Growth> by_method(const std::vector<Growth>& growth, std::string_view method) {
    std::vector<Growth> some;
    for (const Growth& g : growth)
        if (g.method == method) some.push_back(g);
    return some;
}

std::string scenes_text(const std::vector<Growth>& growth) {
    std::vector<std::string> names;
    std::uint64_t least = ~std::uint64_t{0}, most = 0;
    for (const Growth& g : growth) {
        if (names.empty() || names.back() != g.scene) names.push_back(g.scene);
        least = std::min(least, g.points.front().polygons);
        most = std::max(most, g.points.back().polygons);
    }
    return fmt::format("{}; {} to {} polygons", joined(names), with_commas(least),
                       with_commas(most));
}

/// The least depth that a binary tree of so many nodes can have.
double least_depth(const TreePoint& p) {
    return std::floor(std::log2(double(p.nodes)));
}

ClaimAnswer answer_depth(const std::vector<Growth>& growth) {
    const std::vector<Growth> balanced = by_method(growth, "balanced");
    const auto log = [](double n) { return std::log2(n); };
    const auto depth = [](const TreePoint& p) { return double(p.depth); };
    const Bounded grows = bounded(balanced, depth, log);
    std::vector<Growth> halved;  // the claim's condition: splitters with about as much on each side
    std::vector<std::string> halved_scenes;
    for (const Growth& g : balanced)
        if (2 * g.points.back().placed_balanced >= g.points.back().placed) {
            halved.push_back(g);
            halved_scenes.push_back(g.scene);
        }
    const Bounded grows_halved = bounded(halved, depth, log);
    std::vector<std::string> depths;
    bool lower_bound = true;
    for (const Growth& g : balanced) {
        const TreePoint& last = g.points.back();
        depths.push_back(fmt::format("{} {} (log2 n {:.1f}, log2 nodes {:.1f})", g.scene,
                                     last.depth, std::log2(double(last.polygons)),
                                     std::log2(double(last.nodes))));
        for (const TreePoint& p : g.points)
            lower_bound = lower_bound && double(p.depth) >= least_depth(p);
    }
    const Verdict verdict = !lower_bound     ? Verdict::refuted
                            : halved.empty() ? Verdict::depends
                                             : verdict_of(grows_halved.within, grows_halved.series);
    return {
        "H4", verdict,
        fmt::format(
            "depth by the most balanced of some candidates, at the largest size: {}; depth / "
            "log n does not grow in {}. Most polygons are placed by splitters with at most two "
            "thirds of the set on a side, as the claim presumes, on {}: there in {}. {}",
            joined(depths), grows.text(),
            halved_scenes.empty() ? "no scene" : joined(halved_scenes), grows_halved.text(),
            lower_bound ? "No tree is shallower than log2 of its nodes"
                        : "Some tree is shallower than log2 of its nodes"),
        scenes_text(balanced),
        "confirmed if depth / log n has a log-log slope of at most 0.1 on every scene on which "
        "most "
        "polygons are placed by splitters that leave at most two thirds on a side, refuted if on "
        "none of these or if a depth is below log2 of the nodes; depends if there is no such "
        "scene"};
}

ClaimAnswer answer_chain(const std::vector<Growth>& growth) {
    std::vector<std::string> scenes;
    std::size_t chains = 0;
    for (const char* scene : {"stack", "icosphere"}) {
        std::vector<std::string> chain, other;
        for (const Growth& g : growth) {
            if (g.scene != scene) continue;
            const TreePoint& last = g.points.back();
            const bool is_chain = last.depth + 1 == last.polygons;
            (is_chain ? chain : other)
                .push_back(fmt::format("{} {} (n = {})", g.method, with_commas(last.depth),
                                       with_commas(last.polygons)));
        }
        chains += chain.size();
        scenes.push_back(fmt::format("{}: depth n - 1 by {}; not so by {}", scene, joined(chain),
                                     joined(other)));
    }
    return {"H5", chains ? Verdict::confirmed : Verdict::refuted,
            fmt::format("{}", fmt::join(scenes, ". ")),
            "a stack of parallel triangles, listed from back to front; a geodesic sphere, on which "
            "every "
            "polygon's plane has all others behind it",
            "confirmed if some choice of splitters gives depth n - 1"};
}

ClaimAnswer answer_pieces(const Measurements& measured) {
    std::size_t scenes = 0, increased = 0;
    std::vector<std::string> texts, names;
    std::vector<TreePoint> all = measured.methods.trees;
    all.insert(all.end(), measured.scenes.begin(), measured.scenes.end());
    for (const TreePoint& split : all) {
        if (split.method != "weighted") continue;
        const auto shared = std::find_if(all.begin(), all.end(), [&](const TreePoint& p) {
            return p.scene == split.scene && p.method == "shared";
        });
        if (shared == all.end()) continue;  // it was given up
        ++scenes;
        increased += split.fragments > split.polygons && shared->fragments > shared->polygons &&
                     shared->most_pieces > 1;
        names.push_back(split.scene);
        texts.push_back(fmt::format("{} {:.2f} and {:.2f} (up to {} and {})", split.scene,
                                    split.per_polygon(), shared->per_polygon(),
                                    with_commas(split.most_pieces),
                                    with_commas(shared->most_pieces)));
    }
    return {"H6", verdict_of(increased, scenes),
            fmt::format(
                "fragments per polygon where polygons are split, and subtrees per polygon where "
                "they are shared (most of one polygon): {}",
                joined(texts)),
            joined(names),
            "confirmed if both numbers are above 1 on every scene, refuted if on none"};
}

ClaimAnswer answer_crossings(const Measurements& measured) {
    const Crossings sum = all_crossings(measured);
    std::vector<std::string> names;
    for (const Crossings& c : measured.crossings) names.push_back(c.scene);
    std::uint64_t wrong = 0;
    for (const auto* points : {&measured.methods.trees, &measured.scenes})
        for (const TreePoint& p : *points) wrong += p.wrong;
    for (const Growth& g : measured.growth)
        for (const TreePoint& p : g.points) wrong += p.wrong;
    return {"H7", sum.contradicted == 0 && wrong == 0 ? Verdict::confirmed : Verdict::refuted,
            fmt::format(
                "{} rays visit {} nodes and cross the plane, within the node's cell, in {} of "
                "them ({:.0f} %); both subtrees are there in {} ({:.0f} %). In {} of these the ray "
                "stays on one side of the plane; {} run along it. Looking at one subtree "
                "elsewhere changes the answers of {} of {} rays",
                with_commas(sum.rays), with_commas(sum.visits), with_commas(sum.crossed),
                100.0 * double(sum.crossed) / double(sum.visits), with_commas(sum.both),
                100.0 * double(sum.both) / double(sum.visits), sum.contradicted,
                with_commas(sum.undecided), wrong, with_commas(checked_rays(measured))),
            joined(names),
            "confirmed if no ray that stays on one side needs both subtrees, and no answer differs "
            "from the naive loop's where one subtree alone was looked at"};
}

ClaimAnswer answer_bounds(const std::vector<Growth>& growth) {
    const auto n_log_n = [](double n) { return n * std::log2(n); };
    const auto n2_log_n = [](double n) { return n * n * std::log2(n); };
    const auto log_n = [](double n) { return std::log2(n); };
    const Bounded size = bounded(
        growth, [](const TreePoint& p) { return double(p.fragments); }, n_log_n);
    const Bounded build = bounded(
        growth, [](const TreePoint& p) { return double(p.placed); }, n2_log_n);
    const Bounded search = bounded(
        growth, [](const TreePoint& p) { return p.nodes_per_lookup(); }, log_n);
    const Bounded rays = bounded(
        growth, [](const TreePoint& p) { return p.nodes_per_ray(); }, log_n);
    return {
        "P3",
        verdict_of(size.within + build.within + search.within,
                   size.series + build.series + search.series),
        fmt::format("size O(n log n) holds in {}; build O(n^2 log n), in fragments placed, in {}; "
                    "look-up O(log n), in nodes on the way to a point's cell, in {}. Beside the "
                    "claim: nodes per ray are O(log n) in {}",
                    size.text(), build.text(), search.text(), rays.text()),
        scenes_text(growth),
        "a bound holds where the quotient of value and bound has a log-log slope over n of at most "
        "0.1; confirmed if all three hold in every series of a scene and a choice of splitters, "
        "refuted if in none"};
}

ClaimAnswer answer_printed(const std::vector<PrintedTree>& trees) {
    PrintedTree sum;
    std::vector<std::string> scenes;
    for (const PrintedTree& tree : trees) {
        sum.splitters += tree.splitters;
        sum.stored += tree.stored;
        sum.missing_children += tree.missing_children;
        sum.coplanar += tree.coplanar;
        scenes.push_back(tree.scene);
    }
    return {
        "H17",
        sum.stored < sum.splitters && sum.missing_children > 0 && sum.coplanar > 0
            ? Verdict::confirmed
            : Verdict::refuted,
        fmt::format("Algorithm 2 as printed chooses {} splitters, of which the tree holds {} in "
                    "the end; it goes down to {} children that nobody has made; {} polygons in "
                    "a splitter's plane, beside the splitters, come into no set",
                    with_commas(sum.splitters), sum.stored, with_commas(sum.missing_children),
                    with_commas(sum.coplanar)),
        joined(scenes),
        "confirmed if splitters are lost, children missing, and coplanar polygons left out"};
}

}  // namespace

std::vector<ClaimAnswer> answer_claims(const Measurements& measured) {
    return {answer_depth(measured.growth),    answer_chain(measured.growth),
            answer_pieces(measured),          answer_crossings(measured),
            answer_printed(measured.printed), answer_bounds(measured.growth)};
}

}  // namespace space::ch03
