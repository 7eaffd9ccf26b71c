#include "chapters/ch12_comparison/measured/break_even.hpp"

#include <algorithm>
#include <cmath>

namespace space::ch12 {
namespace {

/// So few rays may miss everything, and say nothing of what a lazy tree's first rays cost.
constexpr double too_few_rays = 10.0;

}  // namespace

std::vector<CostLine> cost_lines(std::span<const ComparedRow> block, bool with_peers,
                                 std::optional<RayKind> kind) {
    std::vector<CostLine> lines;
    for (const ComparedRow& row : block) {
        if (!row.stands() || (row.is_peer && !with_peers)) continue;
        const double ns = kind ? row[*kind].ns_per_ray : row.mean_ns();
        if (std::isnan(ns) || std::isnan(row.build_ms)) continue;  // nothing was timed
        double made_ms = 0.0;
        for (const NodesMade& made : row.made_later) {
            made_ms = std::max(made_ms, made.ms);  // more rays never make less: what falls is noise
            if (made.rays > too_few_rays && &made != &row.made_later.back())
                lines.push_back({row.structure, 1e6 * (row.build_ms + made_ms), ns, made.rays});
        }
        // Of a lazy tree the last one goes on: what later rays make is little.
        lines.push_back({row.structure, 1e6 * row.ready_ms(), ns});
    }
    return lines;
}

}  // namespace space::ch12
