#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/measurements.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_builder.hpp"
#include "chapters/ch06_quadtrees_and_octrees/simplex_overlap.hpp"
#include "common/program/progress.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace space::ch06 {
namespace {

/// Looks at what a build decides: of each triangle and child whether boxes overlap, and what the
/// triangle itself does.
struct OverlapCounter : NoObserver {
    std::span<const Triangle> triangles;
    OrthtreeFrame<3> frame;
    OverlapPoint& point;

    OverlapCounter(std::span<const Triangle> all, OverlapPoint& counted)
        : triangles(all), point(counted) {
        Aabb box;
        for (const Triangle& triangle : all) box.extend(bounds(triangle));
        frame = OrthtreeFrame<3>::around(box);
    }
    using NoObserver::observe;
    void observe(const SimplexOverlap<3>::Side& side) {
        ++point.signs;
        point.exact += !side.by_filter;
    }
    void observe(const OrthtreeBuilder<3>::Chosen& chosen) {
        if (!chosen.is_cut) return;
        for (const std::uint32_t triangle : chosen.polygons) {
            const Aabb box = bounds(triangles[triangle]);
            const SimplexOverlap<3> overlap(triangles[triangle]);
            for (std::uint32_t k = 0; k < orthants<3>; ++k) {
                const OrthtreeBox<3> cell = frame.box(chosen.cell.child(k));
                if (glm::any(glm::greaterThan(Double3(box.min), cell.max)) ||
                    glm::any(glm::lessThan(Double3(box.max), cell.min)))
                    continue;
                ++point.pairs;
                point.overlaps += overlap.overlaps(cell, *this);
            }
        }
    }
};

/// A plane p and a ray's axis: t - T times the direction, exactly.
Expansion<4> error_at(double t, double direction, double origin, double plane) {
    Expansion<1> parameter;
    parameter.push(t);
    const auto [high, low] = two_sum(plane, -origin);
    Expansion<2> distance;
    distance.push(low);
    distance.push(high);
    return parameter * direction - distance;
}

/// Counts one plane for all margins.
void meet(const Ray& ray, int axis, double plane, std::vector<PlanePoint>& points) {
    const double origin = ray.origin[axis], direction = ray.direction[axis];
    if (direction == 0.0 || plane == origin) return;
    const double t = KdRay<3>(ray).distance(axis, plane);
    const int sign = direction > 0.0 ? 1 : -1;
    const auto side_of_exact = [&](double moved) {
        return sign * error_at(moved, direction, origin, plane).sign();
    };
    constexpr double u = 0x1p-53;
    const double relative =
        std::abs(error_at(t, direction, origin, plane).value()) / std::abs(plane - origin);
    for (PlanePoint& point : points) {
        const double one = t * (1.0 - point.margin * u), other = t * (1.0 + point.margin * u);
        ++point.planes;
        point.wrong_side +=
            side_of_exact(std::min(one, other)) > 0 || side_of_exact(std::max(one, other)) < 0;
        point.largest_error = std::max(point.largest_error, relative / (3.0 * u));
    }
}

}  // namespace

std::vector<OverlapPoint> measure_overlaps(const Options& options) {
    std::vector<std::string> scenes{"soup:10000", "icosphere", "lattice:1", "stadium:4", "boxes"};
    if (options.small) scenes = {"soup:1000", "boxes:36"};
    std::vector<OverlapPoint> points;
    Progress progress("overlaps", scenes.size());
    for (const std::string& scene : scenes) {
        points.push_back({.scene = scene});
        const std::vector<Triangle> triangles = make_scene(scene, options.seed).mesh.triangles();
        OverlapCounter counter(triangles, points.back());
        OrthtreeBuilder<3>::build(triangles, {}, counter);
        progress.step();
    }
    return points;
}

std::vector<PlanePoint> measure_planes(const Options& options) {
    std::vector<PlanePoint> points;
    for (const double margin : {0.0, 1.0, 2.0, 3.0, 8.0}) points.push_back({.margin = margin});
    Pcg32 random(options.seed);
    const auto frame = OrthtreeFrame<3>::around({Point3(0.1f), Point3(0.9f)});
    for (std::size_t i = 0; i < (options.small ? 1'000u : 100'000u); ++i) {
        const Point3 origin = random_point(random, -1.0f, 2.0f),
                     in = random_point(random, 0.1f, 0.9f);
        const OrthtreeBox<3> cell = frame.box(frame.cell_of(in, 1 + random.below(12)));
        const Ray ray{.origin = origin, .direction = Point3(cell.min) - origin};
        for (int axis = 0; axis < 3; ++axis) meet(ray, axis, cell.min[axis], points);
    }
    return points;
}

}  // namespace space::ch06
