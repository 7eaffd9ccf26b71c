#include "chapters/ch06_quadtrees_and_octrees/measured/outcome.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace space::ch06 {
namespace {

/// A quotient that grows with a smaller power than this does not grow.
constexpr double flat = 0.1;

/// As many cells as the proof allows for n points: an inner node holds two of them, so each depth
/// above the last has at most n / 2 inner nodes with 2^D children each, and there is the root.
template <class Tree>
bool has_few_cells(const Tree& tree, int dimensions) {
    return double(tree.cells) <=
           1.0 + std::ldexp(0.5, dimensions) * double(tree.depth) * double(tree.n);
}

/// The source says it of objects. Segments are such, too; and for points both quotients with
/// (d + 1) n must stay.
ClaimAnswer answer_size(const std::vector<PointTree>& points,
                        const std::vector<SegmentTree>& segments) {
    std::vector<std::string> texts;
    std::size_t linear_growth = 0;
    const auto series = series_of(points);
    for (const auto& [name, sets] : series) {
        const double cells = slope(sets, [](const PointTree&p) { return double(p.cells); }),
                     time = sets[0].build_ms > 0.0
                                ? slope(sets, [](const PointTree&p) { return p.build_ms; })
                                : 0.0;
        linear_growth += cells <= 1.0 + flat && time <= 1.0 + flat;
        texts.push_back(sets[0].build_ms > 0.0
                            ? fmt::format("{}: {:.2f} ({:.2f})", name, cells, time)
                            : fmt::format("{}: {:.2f}", name, cells));
    }
    const bool points_fit = std::ranges::all_of(
                   points, [](const PointTree&p) { return has_few_cells(p, p.dimensions); }),
               segments_fit = std::ranges::all_of(
                   segments, [](const SegmentTree&p) { return has_few_cells(p, 2); });
    const auto most = std::ranges::max(points, {}, &PointTree::cells_share);
    const auto crossed = std::ranges::max(segments, {}, &SegmentTree::cells_share);
    const bool holds = points_fit && segments_fit && linear_growth == series.size();
    return {"P4",
            holds        ? Verdict::confirmed
            : points_fit ? Verdict::depends
                         : Verdict::refuted,
            fmt::format("slope of the cells of trees of points over (d + 1) n (of the build time): "
                        "{}. At most {:.2f} (d + 1) n cells, by {} for D = {}. An edge at depth i "
                        "is s/2^i, exactly. For segments in all cells that they meet it does not "
                        "hold: up to {:.0f} (d + 1) n cells",
                        fmt::join(texts, "; "), most.cells_share(), most.points, most.dimensions,
                        crossed.cells_share()),
            fmt::format("{} to {} points, one in a cell", points.front().n, points.back().n),
            "confirmed if no tree of points or segments has more than 1 + 2^D d n / 2 cells, and "
            "both slopes are at most 1.1 for every kind of set of points; refuted if a tree of "
            "points has more cells"};
}

}  // namespace

std::vector<ClaimAnswer> answer_claims(const Measurements& measured) {
    return {answer_size(measured.points, measured.segments)};
}

}  // namespace space::ch06
