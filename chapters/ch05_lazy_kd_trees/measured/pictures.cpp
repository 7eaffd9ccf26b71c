#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/views.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

namespace space::ch05 {
namespace {

/// A tree that is built and draws one picture; with the counts of both.
template <class Tree>
std::pair<Drawn, Image> draw(const Scene& scene, const Tree& tree, const RenderSettings& settings) {
    Rendering drawn = render(scene, tree, settings);
    const TreeShape shape = tree.shape();
    return {{.nodes = shape.nodes.value_or(0),
             .bytes = shape.bytes,
             .visited = drawn.counts.traversal.nodes_visited,
             .tests = drawn.counts.traversal.triangles_tested,
             .hits = drawn.counts.hits + drawn.counts.occluded},
            std::move(drawn.image)};
}

template <class Tree>
double draw_ms(const Scene& scene, const Tree& tree, const RenderSettings& settings) {
    Stopwatch stopwatch;
    do_not_optimize(render<NoCounts>(scene, tree, settings));
    return stopwatch.lap().count();
}

/// All views once more, for the clock, both trees in turn, on one thread. The eager tree is the
/// same for all views, so each round builds it once.
void time_views(std::span<ViewPoint> points, const std::vector<Triangle>& triangles,
                const ViewedScene& viewed, RenderSettings settings, int rounds) {
    settings.threads = 1;
    const int most = triangles.size() > 500'000 ? 1 : triangles.size() > 300'000 ? 2 : rounds;
    rounds = std::min(rounds, most);  // seconds each
    std::vector<double> eager_build;
    std::vector<std::array<std::vector<double>, 3>> of_views(points.size());
    for (int round = 0; round < rounds; ++round) {
        Stopwatch stopwatch;
        const auto eager = KdTree<>::build(triangles);
        eager_build.push_back(stopwatch.lap().count());
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Scene scene = viewed.seen(viewed.views[i]);
            auto& [eager_total, lazy_build, lazy_total] = of_views[i];
            eager_total.push_back(eager_build.back() + draw_ms(scene, eager, settings));
            stopwatch.lap();
            const auto lazy = LazyKdTree<>::build(triangles);
            lazy_build.push_back(stopwatch.lap().count());
            lazy_total.push_back(lazy_build.back() + draw_ms(scene, lazy, settings));
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [eager_total, lazy_build, lazy_total] = of_views[i];
        points[i].eager.build_ms = median(eager_build);
        points[i].eager.total_ms = median(eager_total);
        points[i].lazy.build_ms = median(lazy_build);
        points[i].lazy.total_ms = median(lazy_total);
    }
}

std::uint64_t differing_pixels(const Image& a, const Image& b) {
    std::uint64_t count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) count += a.at(x, y) != b.at(x, y);
    return count;
}

}  // namespace

// Counted without mailboxes: their slots go by a triangle's place in memory in one tree and by its
// number in the other, so they forget other ones.
std::vector<ViewPoint> measure_views(const Options& options) {
    const Limits limit = limits(options);
    const RenderSettings settings{
        .width = limit.width, .height = limit.height, .threads = options.threads};
    const std::vector<ViewedScene>& scenes = measured_once<viewed_scenes>(options);
    std::vector<ViewPoint> points;
    Progress progress("views", scenes.size());
    for (const ViewedScene& viewed : scenes) {
        const std::vector<Triangle> triangles = viewed.scene.mesh.triangles();
        const auto eager = KdTree<>::build(triangles, {.mailboxes = false});
        for (const View& view : viewed.views) {
            const Scene scene = viewed.seen(view);
            const auto lazy = LazyKdTree<>::build(triangles, {.mailboxes = false});
            const auto [eager_drawn, eager_image] = draw(scene, eager, settings);
            const auto [lazy_drawn, lazy_image] = draw(scene, lazy, settings);
            const auto singly = LazyKdTree<>::build(triangles, {.at_once = 0, .mailboxes = false});
            const auto [singly_drawn, singly_image] = draw(scene, singly, settings);
            points.push_back({.scene = scene.name,
                              .view = std::string(view.name),
                              .triangles = triangles.size(),
                              .rays = std::uint64_t(limit.width) * std::uint64_t(limit.height),
                              .eager = eager_drawn,
                              .lazy = lazy_drawn,
                              .nodes_singly = singly_drawn.nodes,
                              .other_pixels = differing_pixels(eager_image, lazy_image) +
                                              differing_pixels(eager_image, singly_image)});
        }
        if (!options.small)
            time_views(std::span(points).last(viewed.views.size()), triangles, viewed, settings,
                       limit.rounds);
        progress.step();
    }
    return points;
}

std::vector<MemoryPoint> measure_memory(const Options& options) {
    const Limits limit = limits(options);
    const ViewedScene& viewed = measured_once<viewed_scenes>(options).front();
    const std::vector<Triangle> triangles = viewed.scene.mesh.triangles();
    const std::uint64_t eager_bytes = KdTree<>::build(triangles).shape().bytes;
    const auto lazy = LazyKdTree<>::build(triangles);
    const PixelGrid grid(viewed.views.front().camera, limit.width, limit.height);
    constexpr int parts = 24;
    std::vector<MemoryPoint> points;
    for (int part = 0; part <= parts; ++part) {
        if (part > 0)
            for (int y = (part - 1) * limit.height / parts; y < part * limit.height / parts; ++y)
                for (int x = 0; x < limit.width; ++x)
                    do_not_optimize(closest_hit(lazy, grid.ray(x, y)));
        points.push_back({.picture = double(part) / parts,
                          .lazy_bytes = lazy.shape().bytes,
                          .eager_bytes = eager_bytes});
    }
    return points;
}

}  // namespace space::ch05
