#include "chapters/ch12_comparison/measured/break_even.hpp"

#include <cmath>
#include <limits>

namespace space::ch12 {

std::vector<CostLine> cost_lines(std::span<const ComparedRow> block, bool with_peers,
                                 std::optional<RayKind> kind) {
    std::vector<CostLine> lines;
    for (const ComparedRow& row : block) {
        if (!row.stands() || (row.is_peer && !with_peers)) continue;
        const double ns = kind ? row[*kind].ns_per_ray : row.mean_ns();
        if (std::isnan(ns) || std::isnan(row.build_ms)) continue;  // nothing was timed
        for (const auto& [rays, ms] : row.made_later)
            lines.push_back({row.structure, 1e6 * (row.build_ms + ms), ns, rays});
        // Of a lazy tree the last one goes on: what later rays make is little.
        if (row.made_later.empty())
            lines.push_back({row.structure, 1e6 * row.build_ms, ns});
        else
            lines.back().most_rays = std::numeric_limits<double>::infinity();
    }
    return lines;
}

}  // namespace space::ch12
