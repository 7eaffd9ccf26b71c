// Scenes that are made where rays go: how much of them a picture needs, and how soon it stands.

#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/heightfield.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_geometry.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/landscape.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/measurements.hpp"
#include "chapters/ch05_lazy_kd_trees/subdivided_mesh.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/scenes/shapes.hpp"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace space::ch05 {
namespace {

using Answers = std::vector<std::optional<Hit>>;

template <class Tree>
Answers trace(const Tree& tree, const std::vector<Ray>& rays) {
    Answers answers;
    for (const Ray& ray : rays) answers.push_back(closest_hit(tree, ray));
    return answers;
}

template <PatchSource Source>
std::vector<Triangle> all_triangles(const Source& source) {
    std::vector<Triangle> all;
    for (std::uint32_t patch = 0; patch < source.patches(); ++patch) {
        const std::vector<Triangle> triangles = source.triangles(patch);
        all.insert(all.end(), triangles.begin(), triangles.end());
    }
    return all;
}

/// One view, by lazy geometry; by an eager tree, too, where all triangles are few enough.
template <PatchSource Source>
GeometryPoint measure_source(std::string name, std::string view, const Source& source,
                             const std::vector<Ray>& rays, double bytes_each) {
    Stopwatch stopwatch;
    const auto lazy = LazyGeometry<Source>::build(source);
    const double build_ms = stopwatch.lap().count();
    const Answers answers = trace(lazy, rays);
    const double rays_ms = stopwatch.lap().count();
    const auto made = lazy.made();
    GeometryPoint point{.source = std::move(name),
                        .view = std::move(view),
                        .patches = source.patches(),
                        .triangles = std::uint64_t{source.patches()} * source.patch_triangles(),
                        .made_patches = made.patches,
                        .made_triangles = made.triangles,
                        .nodes = made.nodes,
                        .bytes = made.bytes,
                        .rays = rays.size(),
                        .build_ms = build_ms,
                        .total_ms = build_ms + rays_ms};
    point.bytes_if_all = bytes_each * double(point.triangles);
    for (const auto& hit : answers) point.hits += hit.has_value();
    constexpr std::uint64_t most_for_eager = 400'000;
    if (point.triangles <= most_for_eager) {
        const auto eager = KdTree<>::build(all_triangles(source));
        point.different = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            *point.different += answers[i] != closest_hit(eager, rays[i]);
    }
    return point;
}

/// Bytes for a triangle in an eager tree over a small source of the kind.
template <PatchSource Source>
double bytes_per_triangle(const Source& source) {
    const std::vector<Triangle> triangles = all_triangles(source);
    return double(KdTree<>::build(triangles).shape().bytes) / double(triangles.size());
}

SubdividedMesh bumpy_ball(std::uint32_t frequency, std::uint32_t levels) {
    return SubdividedMesh(icosphere(frequency),
                          {.levels = levels, .height = 0.12, .wave = 0.5, .waves = 6});
}
Camera ball_camera(double away) {
    return {.eye = {0.0f, 0.35f * float(away), float(away)},
            .target = {0.0f, 0.3f, 0.0f},
            .field_of_view = 45};
}

}  // namespace

std::vector<GeometryPoint> measure_geometry(const Options& options) {
    const Limits limit = limits(options);
    const auto rays_of = [&](const Camera& camera) {
        return camera_rays(PixelGrid(camera, limit.width, limit.height));
    };
    std::vector<GeometryPoint> points;
    Progress progress("lazy geometry", 5);
    const double field_bytes = bytes_per_triangle(landscape(options.small ? 64 : 256));
    for (const std::uint32_t cells : {256u, limit.field_cells}) {
        if (cells == 256 && limit.field_cells == 256 && !points.empty()) break;
        const Heightfield field = landscape(cells);
        const std::string name =
            "landscape, " + std::to_string(cells) + " x " + std::to_string(cells);
        points.push_back(
            measure_source(name, "from a hill", field, rays_of(from_a_hill(field)), field_bytes));
        points.push_back(
            measure_source(name, "downwards", field, rays_of(downwards(field)), field_bytes));
        progress.step(2);
    }
    const double ball_bytes = bytes_per_triangle(bumpy_ball(2, 4));
    const SubdividedMesh ball = bumpy_ball(options.small ? 3 : 12, limit.ball_levels);
    points.push_back(
        measure_source("bumpy ball", "whole", ball, rays_of(ball_camera(3.6)), ball_bytes));
    points.push_back(
        measure_source("bumpy ball", "close-up", ball, rays_of(ball_camera(1.35)), ball_bytes));
    progress.step();
    return points;
}

std::vector<FirstPicture> measure_first_pictures(const Options& options) {
    const Limits limit = limits(options);
    const std::uint32_t levels = limit.picture_levels;
    const std::uint32_t frequency = options.small ? 2 : 6;
    const std::vector<Ray> rays =
        camera_rays(PixelGrid(ball_camera(1.35), limit.width, limit.height));
    std::vector<FirstPicture> pictures;
    Answers truth;
    const auto compare = [&](std::string way, std::uint32_t level, std::uint64_t triangles,
                             const Answers& answers, double ms) {
        if (truth.empty()) truth = answers;
        FirstPicture picture{.way = std::move(way),
                             .levels = level,
                             .triangles = triangles,
                             .rays = rays.size(),
                             .ms = ms};
        std::uint64_t both = 0;
        for (std::size_t i = 0; i < answers.size(); ++i) {
            picture.missed += answers[i].has_value() != truth[i].has_value();
            if (!answers[i] || !truth[i]) continue;
            picture.error += std::abs(double{answers[i]->t} - truth[i]->t) / double{truth[i]->t};
            ++both;
        }
        picture.error /= double(std::max<std::uint64_t>(1, both));
        pictures.push_back(picture);
    };
    Progress progress("first pictures", levels + 2);
    for (std::uint32_t level = levels + 1; level-- > 0;) {
        Stopwatch stopwatch;
        const SubdividedMesh ball = bumpy_ball(frequency, level);
        const std::vector<Triangle> triangles = all_triangles(ball);
        const auto tree = KdTree<>::build(triangles);
        const Answers answers = trace(tree, rays);
        compare("eager", level, triangles.size(), answers, stopwatch.lap().count());
        progress.step();
    }
    Stopwatch stopwatch;
    const auto lazy = LazyGeometry<SubdividedMesh>::build(bumpy_ball(frequency, levels));
    const Answers answers = trace(lazy, rays);
    compare("lazy", levels, lazy.made().triangles, answers, stopwatch.lap().count());
    return pictures;
}

}  // namespace space::ch05
