#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch04_kd_trees/measured/careless.hpp"
#include "chapters/ch04_kd_trees/measured/measurements.hpp"
#include "common/aimed_rays.hpp"
#include "common/parallel.hpp"
#include "common/program/progress.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <functional>

namespace space::ch04 {
namespace {

using Answers = std::vector<std::optional<Hit>>;

/// Each ray's answer by `ask`, on several threads.
template <class Ask>
Answers answers(const std::vector<Ray>& rays, unsigned threads, const Ask& ask) {
    Answers all(rays.size());
    parallel_for(rays.size(), threads, 64, [&](std::size_t i) { all[i] = ask(rays[i]); });
    return all;
}
Answers naive_answers(const std::vector<Triangle>& triangles, const std::vector<Ray>& rays,
                      unsigned threads) {
    const auto naive = Naive<FilteredExact>::build(triangles);
    return answers(rays, threads, [&](const Ray& ray) { return closest_hit(naive, ray); });
}
std::uint64_t differences(const Answers& a, const Answers& b) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
    return count;
}

// --- grades of care ---

/// A corner of a triangle's part in a leaf, as the SAH likes to have planes through them.
Point3 corner_of_part(const std::vector<Triangle>& triangles, const KdNodes<3>& tree,
                      Pcg32& random) {
    for (;;) {
        std::uint32_t index = 0;
        Aabb cell = tree.box;
        while (!tree.nodes[index].is_leaf()) {
            const KdNode node = tree.nodes[index];
            const auto [below, above] = halves(cell, {node.axis(), node.position()});
            const std::uint32_t child = random.below(2);
            cell = child == 0 ? below : above;
            index = node.below() + child;
        }
        const auto own = tree.own(index);
        if (own.empty()) continue;
        const Triangle& triangle = triangles[own[random.below(std::uint32_t(own.size()))]];
        ClippedPolygon<3> part;
        for (int corner = 0; corner < 3; ++corner) part.push_back(Double3(triangle[corner]));
        for (int axis = 0; axis < 3; ++axis)
            part = part.clipped(axis, cell.min[axis], -1.0).clipped(axis, cell.max[axis], 1.0);
        if (part.size > 0) return Point3(part.corners[random.below(std::uint32_t(part.size))]);
    }
}

/// Rays at what floats find hard: corners, points of edges, corners of parts in one tree's leaves
/// and in another's; half of them graze.
std::vector<Ray> aimed_rays(const std::vector<Triangle>& triangles, const KdNodes<3>& tree,
                            const KdNodes<3>& other, std::size_t count, std::uint64_t seed) {
    std::vector<Ray> rays = rays_from_around(triangles, count, seed);
    Pcg32 random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        Point3 aim;
        if (i % 4 < 2) {
            const auto which = random.below(static_cast<std::uint32_t>(triangles.size()));
            const Triangle& triangle = triangles[which];
            aim = triangle.a;
            if (i % 4 == 1) aim += random.uniform(0.0f, 1.0f) * (triangle.b - triangle.a);
        } else {
            aim = corner_of_part(triangles, i % 4 == 2 ? tree : other, random);
        }
        rays[i].direction = aim - rays[i].origin;
        if (i % 8 < 4) graze(rays[i], aim, random);
    }
    return rays;
}

/// A scene's grades, in the order of care_names.
std::vector<CarePoint> measure_grades(const std::string& scene,
                                      const std::vector<Triangle>& triangles,
                                      const Options& options) {
    const Limits limit = limits(options);
    const KdNodes<3> tree = KdBuilder<3>::build(triangles);
    const KdNodes<3> pieces =
        KdBuilder<3>::build(triangles, {.straddlers = KdTreeConfig::Straddlers::split});
    const std::vector<Ray> rays =
        aimed_rays(triangles, tree, pieces, limit.aimed_rays, options.seed);
    const Answers truth = naive_answers(triangles, rays, options.threads);
    std::vector<CarePoint> points;
    std::vector<std::function<void()>> runs;
    const auto add = [&](const auto& walk, const KdNodes<3>& nodes) {
        const auto ask = [&walk, &nodes, &triangles](const Ray& ray) {
            return nearest_by(walk, nodes, triangles, ray);
        };
        points.push_back({.scene = scene,
                          .care = std::string(care_names[points.size()]),
                          .triangles = triangles.size(),
                          .rays = rays.size(),
                          .lost = differences(answers(rays, options.threads, ask), truth)});
        runs.push_back([&rays, ask] {
            for (const Ray& ray : rays) do_not_optimize(ask(ray));
        });
    };
    constexpr WalkInFloat walk_in_float;
    constexpr WalkWithMargins walk_with_margins;
    add(walk_in_float, pieces);
    add(walk_in_float, tree);
    add(walk_with_margins, pieces);
    add(walk_with_margins, tree);
    if (limit.rounds == 0) return points;
    const auto trace_ms = interleaved_medians(runs, limit.rounds);
    for (std::size_t i = 0; i < points.size(); ++i) points[i].trace_ms = trace_ms[i];
    return points;
}

// --- CATALOGUE K1, K2 ---

/// Equilateral triangles whose centres lie in the unit cube.
std::vector<Triangle> triangles_of_edge(double edge, std::size_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < count; ++i) {
        const Double3 centre(random_point(random, 0.0f, 1.0f));
        const Double3 normal = random_direction(random);
        const Double3 u = glm::normalize(glm::cross(normal, random_direction(random))),
                      v = glm::cross(normal, u);
        const double radius = edge / std::sqrt(3.0);
        triangles.push_back({Point3(centre + radius * u),
                             Point3(centre + radius * (-0.5 * u + std::sqrt(0.75) * v)),
                             Point3(centre + radius * (-0.5 * u - std::sqrt(0.75) * v))});
    }
    return triangles;
}

OverlapPoint measure_overlap(double edge, const Options& options) {
    const bool small = options.small;
    const auto triangles = triangles_of_edge(edge, small ? 500 : 5'000, options.seed);
    const KdNodes<3> tree = KdBuilder<3>::build(
        triangles, {.rule = KdTreeConfig::Rule::middle, .max_straddling = 1.0, .max_depth = 9});
    const SortedAnew by_corners(
        tree, triangles, [](const Triangle& triangle, const Aabb& box, const Aabb& cell) {
            const bool has_corner =
                cell.contains(triangle.a) || cell.contains(triangle.b) || cell.contains(triangle.c);
            return has_corner ? box : Aabb::empty();
        });
    const SortedAnew by_boxes(tree, triangles,
                              [](const Triangle&, const Aabb& box, const Aabb&) { return box; });
    const auto rays = rays_from_around(
        triangles, std::min<std::size_t>(limits(options).rays, 5'000), options.seed);
    const Answers truth = naive_answers(triangles, rays, options.threads);
    const auto differ = [&](const KdNodes<3>& nodes, bool first_leaf = false) {
        const auto ask = [&](const Ray& ray) {
            return nearest_by(WalkWithMargins(), nodes, triangles, ray, NoCounts(), first_leaf);
        };
        return differences(answers(rays, options.threads, ask), truth);
    };
    return {.edge = edge,
            .triangles = triangles.size(),
            .leaves = static_cast<std::uint64_t>(std::ranges::count_if(tree.nodes,
                                                                       &KdNode::is_leaf)) -
                      1,  // the gap
            .overlaps = tree.references.size(),
            .by_corners = by_corners.tree().references.size(),
            .by_boxes = by_boxes.tree().references.size(),
            .rays = rays.size(),
            .lost = differ(by_corners.tree()),
            .early = differ(tree, true),
            .wrong = differ(tree) + differ(by_boxes.tree())};
}

}  // namespace

std::vector<CarePoint> measure_care(const Options& options) {
    std::vector<CarePoint> all;
    Progress progress("grades of care", 3);
    for (const char* name : {"icosphere:8", "boxes:100", "lattice:1"}) {
        const Scene scene = make_scene(name, options.seed, options.small);
        for (CarePoint& point : measure_grades(name, scene.mesh.triangles(), options))
            all.push_back(point);
        progress.step();
    }
    return all;
}

std::vector<OverlapPoint> measure_overlaps(const Options& options) {
    std::vector<OverlapPoint> points;
    for (const double edge : {0.02, 0.1, 0.3, 1.0})
        points.push_back(measure_overlap(edge, options));
    return points;
}

}  // namespace space::ch04
