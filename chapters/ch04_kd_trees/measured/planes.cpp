#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/measured/measurements.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <functional>

namespace space::ch04 {
namespace {

/// A plane in any direction, stored in float as KdNode's position is.
struct GeneralPlane {
    Vector3 normal;
    float offset;  ///< normal . p

    explicit GeneralPlane(const KdSplit& split) : normal(0.0f), offset(split.position) {
        normal[split.axis] = 1.0f;
    }
};

/// Where a ray meets a plane, and whether it comes to the half above last.
struct Crossing {
    double t;
    bool far_above;
};
Crossing cross_across(const KdRay<3>& ray, int axis, float position) {
    return {ray.distance(axis, position), ray.far[static_cast<std::size_t>(axis)] == 1};
}
Crossing cross_general(const Ray& ray, const GeneralPlane& plane) {
    const Double3 normal(plane.normal);
    const double slope = glm::dot(normal, Double3(ray.direction));
    return {(double{plane.offset} - glm::dot(normal, Double3(ray.origin))) / slope, slope > 0.0};
}

/// The nodes of a k-d tree that a ray's line meets, by any function that crosses a node's plane.
template <class Cross>
std::uint64_t count_visits(const KdNodes<3>& tree, const RayPart& whole, const Cross& cross) {
    std::array<KdVisit, max_kd_depth + 1> waiting;
    std::size_t size = 0;
    waiting[size++] = {0, whole};
    std::uint64_t visits = 0;
    while (size > 0) {
        auto [index, part] = waiting[--size];
        for (;; ++visits) {
            const KdNode node = tree.nodes[index];
            if (node.is_leaf()) break;
            const auto [t, far_above] = cross(index, node);
            const std::uint32_t far = node.below() + far_above;
            if (t < part.enter) {
                index = far;
                continue;
            }
            index = far ^ 1;
            if (t > part.leave) continue;
            waiting[size] = {far, part};
            waiting[size++].part.begin_at(t);
            part.end_at(t);
        }
    }
    return visits;
}

/// Both planes' times in nanoseconds from runs over as many crossings each.
PlaneTimes timed(const std::string& where, std::uint64_t crossings, int rounds,
                 const std::function<void()>& axis, const std::function<void()>& general) {
    const auto ms = interleaved_medians(std::array{axis, general}, 2 * rounds + 1);
    return {where, 1e6 * ms[0] / double(crossings), 1e6 * ms[1] / double(crossings)};
}

PlaneTimes measure_alone(const std::vector<Ray>& rays, const KdNodes<3>& tree, int rounds) {
    std::vector<KdSplit> splits;
    std::vector<GeneralPlane> planes;
    for (const KdNode& node : tree.nodes) {
        if (node.is_leaf() || splits.size() == 1'000) continue;
        splits.push_back({node.axis(), node.position()});
        planes.emplace_back(splits.back());
    }
    const auto axis = [&] {
        for (const Ray& ray : rays) {
            const KdRay<3> prepared(ray);
            double sum = 0.0;
            for (const KdSplit& split : splits)
                sum += cross_across(prepared, split.axis, split.position).t;
            do_not_optimize(sum);
        }
    };
    const auto general = [&] {
        for (const Ray& ray : rays) {
            double sum = 0.0;
            for (const GeneralPlane& plane : planes) sum += cross_general(ray, plane).t;
            do_not_optimize(sum);
        }
    };
    return timed("alone", rays.size() * splits.size(), rounds, axis, general);
}

PlaneTimes measure_walk(const std::string& where, const std::vector<Ray>& rays,
                        const KdNodes<3>& tree, int rounds) {
    std::vector<GeneralPlane> planes;
    for (const KdNode& node : tree.nodes)
        planes.emplace_back(node.is_leaf() ? KdSplit{0, 0.0f}
                                           : KdSplit{node.axis(), node.position()});
    const auto axis = [&] {
        std::uint64_t visits = 0;
        for (const Ray& ray : rays) {
            const KdRay<3> prepared(ray);
            if (const auto part = part_in(tree.box, prepared, RayPart::all_of(ray)))
                visits += count_visits(tree, *part, [&](std::uint32_t, const KdNode& node) {
                    return cross_across(prepared, node.axis(), node.position());
                });
        }
        return visits;
    };
    const auto general = [&] {
        std::uint64_t visits = 0;
        for (const Ray& ray : rays)
            if (const auto part = part_in(tree.box, KdRay<3>(ray), RayPart::all_of(ray)))
                visits += count_visits(tree, *part, [&](std::uint32_t index, const KdNode&) {
                    return cross_general(ray, planes[index]);
                });
        return visits;
    };
    return timed(
        where, axis(), rounds, [&] { do_not_optimize(axis()); },
        [&] { do_not_optimize(general()); });
}

}  // namespace

std::vector<PlaneTimes> measure_planes(const Options& options) {
    std::vector<PlaneTimes> times;
    const Limits limit = limits(options);
    for (const std::uint32_t size : {1'000u, 100'000u}) {
        if (options.small && size > 1'000) break;
        const auto triangles =
            make_scene(fmt::format("soup:{}", size), options.seed).mesh.triangles();
        const auto rays = rays_from_around(triangles, limit.rays, options.seed);
        const KdNodes<3> tree = KdBuilder<3>::build(triangles);
        if (times.empty()) times.push_back(measure_alone(rays, tree, limit.rounds));
        times.push_back(
            measure_walk(fmt::format("in a walk through {} nodes", tree.nodes.size() - 1), rays,
                         tree, limit.rounds));
    }
    return times;
}

}  // namespace space::ch04
