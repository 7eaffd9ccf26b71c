#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/interleaved.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

/// One build, in milliseconds.
template <class Build>
double built_in_ms(const Build& build) {
    const double before = process_ms();
    do_not_optimize(build());
    return process_ms() - before;
}

using Config = FastBvh<>::Config;
const Config larger_leaves{.binary = {.max_leaf_size = 4}},
    greedily{.collapse = {.way = CollapseConfig::Way::greedy}},
    only_halves{.binary = {.max_depth = 0}};

/// Ways to be quicker at the default tree, and the parts that it consists of.
void cure_builds(const TracedScene& scene, int rounds, std::vector<CurePoint>& cures) {
    const auto with = [&](const Config& config) {
        return [&scene, config] { return FastBvh<>::build(scene.triangles, config); };
    };
    const BvhNodes<3> binary = QuickBuilder::build<3>(scene.triangles);
    const auto bins = [&] { return WideBvh<8, BinnedBuilder>::build(scene.triangles); };
    const auto tree = [&] { return QuickBuilder::build<3>(scene.triangles); };
    const auto wide = [&] { return FastBvh<>::over(binary, scene.triangles); };
    std::vector<std::vector<double>> times(7);
    for (int round = 0; round < rounds; ++round) {
        std::size_t i = 0;
        const auto time = [&](const auto& build) { times[i++].push_back(built_in_ms(build)); };
        time(with({}));
        time(bins);
        time(with(larger_leaves));
        time(with(greedily));
        time(with(only_halves));
        time(tree);
        time(wide);
    }
    std::vector<double> ms;
    for (auto& series : times) ms.push_back(median(std::move(series)));
    const auto add = [&](const char* cure, double gain) {
        cures.push_back({.goal = "build", .cure = cure, .scene = scene.name, .gain = gain});
    };
    add("the quick builder, beside chapter 7's bins", ms[1] / ms[0]);
    add("leaves of up to four made by the builder", ms[0] / ms[2]);
    add("a greedy collapse", ms[0] / ms[3]);
    add("no cuts sought at all, only halves", ms[0] / ms[4]);
    add("the binary tree alone", ms[0] / ms[5]);
    add("the collapse and the blocks alone", ms[0] / ms[6]);
}

/// What rays say of trees that were built more quickly.
void ask_their_rays(const TracedScene& scene, int rounds, std::vector<CurePoint>& cures) {
    std::vector<Tracer> trees;
    for (const Config& config : {Config{}, larger_leaves, greedily, only_halves})
        trees.push_back(our_tracer("", FastBvh<>::build(scene.triangles, config)));
    for (const RayKind kind : {camera_kind, shadow_kind, diffuse_kind}) {
        const std::vector<double> ns = ray_times(trees, scene, kind, rounds);
        const auto add = [&](const char* cure, double other_ns) {
            cures.push_back({.goal = "build",
                             .cure = cure,
                             .scene = scene.name,
                             .gain = other_ns > 0.0 ? ns[0] / other_ns : 0.0});
        };
        add("rays through leaves of up to four", ns[1]);
        add("rays through a greedy collapse", ns[2]);
        add("rays through halves", ns[3]);
    }
}

/// Ways for two threads to share the rays.
void cure_two_threads(const TracedScene& scene, int rounds, std::vector<CurePoint>& cures) {
    const FastBvh<> tree = FastBvh<>::build(scene.triangles);
    for (const RayKind kind : {camera_kind, diffuse_kind}) {
        const std::span<const Ray> rays = scene.rays[kind];
        if (rays.empty()) continue;
        const auto put = [](std::size_t, const std::optional<Hit>& hit) { do_not_optimize(hit); };
        const auto singly = [&](std::span<const Ray> some) {
            trace_singly(tree, some, query_of(kind), put);
        };
        const auto by_turns = [&](std::span<const Ray> some) {
            trace_interleaved(tree, some, 8, query_of(kind), put);
        };
        const auto shared = [rays](const auto& trace, std::size_t piece) {
            return [rays, trace, piece] {
                parallel_for((rays.size() + piece - 1) / piece, 2, 1, [&](std::size_t i) {
                    trace(rays.subspan(i * piece, std::min(piece, rays.size() - i * piece)));
                });
            };
        };
        const std::vector<std::function<void()>> runs{
            [&] { singly(rays); }, [&] { by_turns(rays); }, shared(singly, 512),
            shared(singly, 64),    shared(singly, 4096),    shared(singly, (rays.size() + 1) / 2),
            shared(by_turns, 512)};
        const std::vector<double> ms = interleaved_medians(runs, rounds);
        const auto add = [&](const char* cure, double gain) {
            cures.push_back(
                {.goal = "two threads", .cure = cure, .scene = scene.name, .gain = gain});
        };
        add("512 rays at a time, beside one thread", ms[0] / ms[2]);
        add("64 rays at a time", ms[0] / ms[3]);
        add("4096 rays at a time", ms[0] / ms[4]);
        add("half of the rays for each", ms[0] / ms[5]);
        add("eight rays by turns in each, beside one thread that does so", ms[1] / ms[6]);
    }
}

}  // namespace

void measure_cures(const TracedScene& scene, const FastEffort& effort, FastMeasurements& measured) {
    if (effort.rounds == 0) return;
    if (scene.triangles.size() <= effort.most_high) {
        cure_builds(scene, effort.rounds, measured.cures);
        ask_their_rays(scene, effort.rounds, measured.cures);
    }
    cure_two_threads(scene, effort.rounds, measured.cures);
}

}  // namespace space::ch10
