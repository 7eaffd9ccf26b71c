/// @file
/// From how many rays on is a structure worth its build? A structure costs what its build takes and
/// then so much a ray: a line over the number of rays. The cheapest for any number is the lower
/// envelope of these lines.
#pragma once

#include "chapters/ch12_comparison/measured/comparison_data.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space::ch12 {

/// What a structure costs in all: fixed_ns + rays ns_per_ray, up to most_rays. A structure whose
/// cost is not a straight line has several, each as good as an upper bound up to its end.
struct CostLine {
    std::string name;
    double fixed_ns = 0.0, ns_per_ray = 0.0;
    double most_rays = std::numeric_limits<double>::infinity();

    double cost(double rays) const {
        return rays <= most_rays ? fixed_ns + rays * ns_per_ray
                                 : std::numeric_limits<double>::infinity();
    }
};

// [cheapest]
/// The line that is lowest at so many rays; of equal ones that which grows least, then the first.
/// One must reach that far.
inline std::size_t cheapest(std::span<const CostLine> lines, double rays) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const double cost = lines[i].cost(rays), least = lines[best].cost(rays);
        if (cost < least || (cost == least && lines[i].ns_per_ray < lines[best].ns_per_ray))
            best = i;
    }
    return best;
}
// [cheapest]

/// From so many rays to so many a line is the lowest.
struct CheapestSpan {
    std::size_t line;
    double from, to;
};

// [lower_envelope]
/// The cheapest lines from `from` to `to` rays, one after the other. A line is overtaken by one
/// that grows less, by the first that crosses it; where it ends, the lowest there takes over.
inline std::vector<CheapestSpan> lower_envelope(std::span<const CostLine> lines, double from,
                                                double to) {
    std::vector<CheapestSpan> spans;
    if (lines.empty()) return spans;
    std::size_t line = cheapest(lines, from);
    while (true) {
        const CostLine& now = lines[line];
        double end = std::min(to, now.most_rays);
        std::size_t next = line;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (!(lines[i].ns_per_ray < now.ns_per_ray)) continue;
            const double gained = now.ns_per_ray - lines[i].ns_per_ray;
            const double crossing = std::max(from, (lines[i].fixed_ns - now.fixed_ns) / gained);
            if (crossing >= end || crossing > lines[i].most_rays) continue;
            end = crossing;
            next = i;
        }
        // A line that ends where it begins has been the lowest for this one number.
        if (end > from || next == line) spans.push_back({line, from, end});
        if (end >= to) return spans;
        from = next != line ? end : std::nextafter(end, to);
        line = next != line ? next : cheapest(lines, from);
    }
}
// [lower_envelope]

/// A block's structures as lines, by the mean over the kinds of rays or by one of them. Of a lazy
/// tree: for each number of rays up to which the making of its nodes was timed one line, with all
/// that they made.
std::vector<CostLine> cost_lines(std::span<const ComparedRow> block, bool with_peers,
                                 std::optional<RayKind> kind = {});

}  // namespace space::ch12
