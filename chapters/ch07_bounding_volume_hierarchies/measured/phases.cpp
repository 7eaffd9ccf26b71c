#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/cache_line_allocator.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/measured/measurements.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <utility>

namespace space::ch07 {
namespace {

/// Gives the time since the node before to the nodes of that many triangles, and counts the bytes
/// that a node with a cut moves: the builder reads its references for the box around their middles,
/// for the bins and to part them, and parting writes them.
struct BuildClock : NoObserver {
    PhasePoint& point;
    Stopwatch stopwatch = {};

    explicit BuildClock(PhasePoint& timed) : point(timed) {}
    using NoObserver::observe;
    void observe(const BvhChosen<3>& chosen) {
        const std::uint64_t size = chosen.task.range.size();
        std::size_t kind = 0;
        while (kind < task_sizes.size() && size >= task_sizes[kind]) ++kind;
        double ms = stopwatch.lap().count();
        // The builder makes the boxes, too, before its first node.
        if (chosen.task.depth == 0) ms = std::max(0.0, ms - point.boxes_ms);
        point.nodes_ms[kind] += ms;
        constexpr std::uint64_t bytes = sizeof(BvhReference<3>);
        if (chosen.cut)
            point.bytes_moved += size * 4 * bytes;
        else
            point.bytes_moved += size * (bytes + sizeof(std::uint32_t) + 2 * sizeof(Triangle));
        point.bytes_moved += sizeof(BvhNode<3>);
    }
};

PhasePoint measure_phases_once(const std::string& name, std::span<const Triangle> triangles) {
    PhasePoint point{.scene = name, .n = triangles.size()};
    Stopwatch stopwatch;
    do_not_optimize(boxed<3>(triangles));
    point.boxes_ms = stopwatch.lap().count();
    point.bytes_moved = triangles.size() * (sizeof(Triangle) + sizeof(BvhReference<3>));
    BuildClock clock(point);
    const BvhNodes<3> nodes = BinnedBuilder::build<3>(triangles, {}, clock);
    stopwatch.lap();
    std::vector<Triangle, CacheLineAllocator<Triangle>> copies;
    copies.reserve(nodes.references.size());
    for (const std::uint32_t triangle : nodes.references) copies.push_back(triangles[triangle]);
    do_not_optimize(copies.data());
    point.copy_ms = stopwatch.lap().count();
    return point;
}

/// The median of each part over some builds.
PhasePoint measure_phases_of(const std::string& name, const Options& options) {
    const std::vector<Triangle> triangles = make_scene(name, options.seed).mesh.triangles();
    std::vector<PhasePoint> all;
    for (int round = 0; round < limits(options).rounds; ++round)
        all.push_back(measure_phases_once(name, triangles));
    const auto middle_of = [&](const auto& part) {
        std::vector<double> values;
        for (PhasePoint& point : all) values.push_back(part(point));
        return median(std::move(values));
    };
    PhasePoint point = all.front();
    point.boxes_ms = middle_of([](const PhasePoint& p) { return p.boxes_ms; });
    point.copy_ms = middle_of([](const PhasePoint& p) { return p.copy_ms; });
    for (std::size_t kind = 0; kind < point.nodes_ms.size(); ++kind)
        point.nodes_ms[kind] = middle_of([kind](const PhasePoint& p) { return p.nodes_ms[kind]; });
    return point;
}

/// What the machine moves, by copies much larger than its caches, as STREAM counts: read and
/// written.
double copy_bytes_per_ms(int rounds) {
    constexpr std::size_t size = std::size_t{1} << 27;
    const std::vector<char> from(size, 'a');
    std::vector<char> to(size);
    const std::function<void()> copy = [&] {
        std::memcpy(to.data(), from.data(), size);
        do_not_optimize(to.data());
    };
    return 2.0 * double(size) / interleaved_medians(std::span(&copy, 1), rounds).front();
}

}  // namespace

std::vector<PhasePoint> measure_phases(const Options& options) {
    std::vector<std::string> scenes{"soup:10000", "soup:100000", "soup:1000000", "icosphere:300"};
    if (options.quick) scenes = {"soup:10000"};
    const double copy = copy_bytes_per_ms(limits(options).rounds);
    std::vector<PhasePoint> points;
    Progress progress("parts of a build", scenes.size());
    for (const std::string& name : scenes) {
        points.push_back(measure_phases_of(name, options));
        points.back().copy_bytes_per_ms = copy;
        progress.step();
    }
    return points;
}

}  // namespace space::ch07
