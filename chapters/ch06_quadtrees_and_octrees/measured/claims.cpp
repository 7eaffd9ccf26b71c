#include "chapters/ch06_quadtrees_and_octrees/measured/outcome.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/series.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace space::ch06 {
namespace {

/// A quotient that grows with a smaller power than this does not grow.
constexpr double flat = 0.1;

/// In each kind of set both quotients with (d + 1) n must stay; and no set may have more cells than
/// the proof allows: an inner node holds two points, so each depth above the last has at most n / 2
/// inner nodes with 2^D children each, and there is the root.
ClaimAnswer answer_size(const std::vector<PointTree>& points,
                        const std::vector<SegmentTree>& segments) {
    std::vector<std::string> texts;
    std::size_t linear_growth = 0, within = 0;
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
    for (const PointTree& p : points)
        within += double(p.cells) <=
                  1.0 + double(1 << p.dimensions) * double(p.depth) * double(p.n) / 2.0;
    const auto most = std::ranges::max(points, {}, &PointTree::cells_share);
    const auto crossed = std::ranges::max(segments, {}, &SegmentTree::cells_share);
    const bool holds = linear_growth == series.size() && within == points.size();
    return {"P4",
            holds                                          ? Verdict::confirmed
            : within == points.size() || linear_growth > 0 ? Verdict::depends
                                                           : Verdict::refuted,
            fmt::format("slope of the cells of trees of points over (d + 1) n (of the build time): "
                        "{}. At most {:.2f} (d + 1) n cells, by {} for D = {}. An edge at depth i "
                        "is s/2^i, exactly. For segments in all cells that they meet it does not "
                        "hold: up to {:.0f} (d + 1) n cells",
                        fmt::join(texts, "; "), most.cells_share(), most.points, most.dimensions,
                        crossed.cells_share()),
            fmt::format("{} to {} points, one in a cell", points.front().n, points.back().n),
            "confirmed if both slopes are at most 1.1 for every kind of set and no tree has more "
            "than 1 + 2^D d n / 2 cells; refuted if all slopes are above and some tree is larger"};
}

}  // namespace

std::vector<ClaimAnswer> answer_claims(const Measurements& measured) {
    return {answer_size(measured.points, measured.segments)};
}

}  // namespace space::ch06
