/// @file
/// What a ray must at least cost on a machine: from its nodes, its tests and the lines that it
/// fetches, and what each of these takes.
#pragma once

#include <array>
#include <cstddef>

namespace space {

inline constexpr std::size_t cache_levels = 3;

/// What a machine takes, in nanoseconds, measured by small loops.
struct MachineCosts {
    /// A node, a block of triangles where each waits for the one before it, and where none does.
    double node_latency = 0.0, block_latency = 0.0, node_throughput = 0.0, block_throughput = 0.0;
    /// More than from the nearest cache: of a line from the second one, the last one, memory.
    std::array<double, cache_levels> line_latency = {};
    /// The same where many are under way.
    std::array<double, cache_levels> line_throughput = {};
};

/// What a ray does, on average.
struct RayWork {
    double nodes = 0.0, blocks = 0.0;
    /// Lines that were in none of the caches up to this one, as the cache model counts them.
    std::array<double, cache_levels> misses = {};
};

// [ray_bounds]
/// Of a ray's lines those that each level serves, times what it takes there.
inline double lines_ns(const RayWork& work, const std::array<double, cache_levels>& of_a_line) {
    double ns = 0.0;
    for (std::size_t i = 0; i < cache_levels; ++i) {
        const double beyond = i + 1 < cache_levels ? work.misses[i + 1] : 0.0;
        ns += (work.misses[i] - beyond) * of_a_line[i];
    }
    return ns;
}

/// One ray after the other, each step after the one before it: a node tells which one is next. A
/// node or a block is several lines, and all but the first come in the shadow of the first: so many
/// count as one.
inline double latency_bound_ns(const RayWork& work, const MachineCosts& costs,
                               double lines_at_once) {
    return work.nodes * costs.node_latency + work.blocks * costs.block_latency +
           lines_ns(work, costs.line_latency) / lines_at_once;
}

/// Many rays at once hide each other's waits; then the longer of these two is left: to compute, and
/// to fetch.
inline double compute_bound_ns(const RayWork& work, const MachineCosts& costs) {
    return work.nodes * costs.node_throughput + work.blocks * costs.block_throughput;
}
inline double fetch_bound_ns(const RayWork& work, const MachineCosts& costs) {
    return lines_ns(work, costs.line_throughput);
}
// [ray_bounds]

}  // namespace space
