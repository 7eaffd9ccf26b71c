#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/interleaved.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/packets.hpp"
#include "chapters/ch10_fast_traversal/sorted_stream.hpp"
#include "common/pcg32.hpp"

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

/// A way to trace rays: `run(rays, put)`, where put is any callable.
template <class Run>
void add_mode(const TracedScene& scene, std::string name, const Run& run, std::span<const Ray> rays,
              RayKind kind, const Answers& wanted, std::vector<ModePoint>& points,
              std::vector<std::function<void()>>& runs) {
    Answers got(rays.size());
    ModePoint point{.scene = scene.name,
                    .mode = std::move(name),
                    .kind = kind,
                    .triangles = scene.triangles.size(),
                    .rays = rays.size()};
    point.nodes = run(rays, [&](std::size_t i, const std::optional<Hit>& hit) { got[i] = hit; });
    point.differ = differences(got, wanted, query_of(kind));
    points.push_back(std::move(point));
    runs.push_back([run, rays] {
        run(rays, [](std::size_t, const std::optional<Hit>& hit) { do_not_optimize(hit); });
    });
}

/// All modes for rays of a kind. The nodes that are counted are those of packets.
void add_modes(const TracedScene& scene, const FastBvh<>& tree, RayKind kind,
               std::span<const Ray> rays, const Answers& wanted, const std::string& suffix,
               int rounds, FastMeasurements& measured) {
    const ManyQuery query = query_of(kind);
    const Aabb& box = tree.tree().box;
    std::vector<ModePoint> points;
    std::vector<std::function<void()>> runs;
    const auto add = [&](const std::string& name, const auto& run) {
        add_mode(scene, name + suffix, run, rays, kind, wanted, points, runs);
    };
    const auto singly = [&tree, query](std::span<const Ray> some, const auto& put) {
        trace_singly(tree, some, query, put);
        return std::uint64_t{0};
    };
    const auto packets = [&tree, query](std::size_t size) {
        return [&tree, query, size](std::span<const Ray> some, const auto& put) {
            return trace_in_packets(tree, some, size, query, put).nodes;
        };
    };
    const auto interleaved = [&tree, query](unsigned together) {
        return [&tree, query, together](std::span<const Ray> some, const auto& put) {
            trace_interleaved(tree, some, together, query, put);
            return std::uint64_t{0};
        };
    };
    const auto sorted = [&box](const auto& trace) {
        return [&box, trace](std::span<const Ray> some, const auto& put) {
            std::uint64_t nodes = 0;
            trace_sorted(
                some, box,
                [&](std::span<const Ray> in_order, const auto& answer) {
                    nodes = trace(in_order, answer);
                },
                put);
            return nodes;
        };
    };
    add("single", singly);
    for (const unsigned together : {4u, 8u, 16u})
        add("interleaved " + std::to_string(together), interleaved(together));
    if (kind == camera_kind)
        for (const std::size_t size : {16, 64})
            add("packets " + std::to_string(size), packets(size));
    if (kind == diffuse_kind) {
        add("sorted, single", sorted(singly));
        add("sorted, packets 16", sorted(packets(16)));
        add("sorted, interleaved 8", sorted(interleaved(8)));
    }
    if (rounds > 0) {
        const std::vector<double> ms = thread_medians(runs, rounds, true);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i].ns = 1e6 * ms[i] / double(rays.size());
            points[i].single_ns = 1e6 * ms[0] / double(rays.size());
        }
    }
    for (ModePoint& point : points) {
        point.bytes = tree.tree().bytes();
        measured.modes.push_back(std::move(point));
    }
}

/// Rays in an order by chance, as they come after a few bounces.
void shuffle(std::vector<Ray>& rays, Answers& answers) {
    Pcg32 random(9);
    for (auto i = static_cast<std::uint32_t>(rays.size()); i-- > 1;) {
        const std::uint32_t j = random.below(i + 1);
        std::swap(rays[i], rays[j]);
        std::swap(answers[i], answers[j]);
    }
}

}  // namespace

void measure_modes(const TracedScene& scene, const FastEffort& effort, FastMeasurements& measured) {
    const FastBvh<> tree = FastBvh<>::build(scene.triangles);
    for (const RayKind kind : {camera_kind, shadow_kind, diffuse_kind})
        if (!scene.rays[kind].empty())
            add_modes(scene, tree, kind, scene.rays[kind], scene.answers[kind], "", effort.rounds,
                      measured);
    std::vector<Ray> rays = scene.rays[diffuse_kind];
    Answers answers = scene.answers[diffuse_kind];
    shuffle(rays, answers);
    if (!rays.empty())
        add_modes(scene, tree, diffuse_kind, rays, answers, ", by chance", effort.rounds, measured);
}

}  // namespace space::ch10
