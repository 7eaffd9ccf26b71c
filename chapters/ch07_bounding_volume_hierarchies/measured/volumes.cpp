#include "chapters/ch07_bounding_volume_hierarchies/measured/volumes.hpp"

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/oriented_box.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bounding_sphere.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/tight_box.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <type_traits>

namespace space::ch07 {
namespace {

/// A part of a scene, moved to the origin and scaled so that its smallest sphere is the unit one.
struct Part {
    std::vector<Triangle> triangles;
    std::vector<Point3> points;
};

/// visit(name, make) for each kind of volume, made around points.
template <class Visit>
void for_each_kind(const Visit& visit) {
    using Points = std::span<const Point3>;
    visit(box_kind, [](Points p) { return box_around<3>(p); });
    visit(ritter_kind, [](Points p) { return ritter_sphere<3>(p); });
    visit(sphere_kind, [](Points p) { return smallest_sphere<3>(p); });
    visit(principal_kind, [](Points p) { return principal_box<3>(p); });
    visit(tight_kind, [](Points p) { return tight_box<3>(p); });
    visit(dop14_kind, [](Points p) { return k_dop_around<14, 3>(p); });
    visit(dop18_kind, [](Points p) { return k_dop_around<18, 3>(p); });
    visit(dop26_kind, [](Points p) { return k_dop_around<26, 3>(p); });
}

// ---- parts ------------------------------------------------------------------------------------

/// The largest subtrees of at most `size` triangles, but of more than a quarter of that.
std::vector<std::vector<std::uint32_t>> subtrees(const BvhNodes<3>& tree, std::size_t size) {
    std::vector<std::vector<std::uint32_t>> found;
    const auto all_below = [&](std::uint32_t root) {
        std::vector<std::uint32_t> all, waiting{root};
        while (!waiting.empty()) {
            const std::uint32_t index = waiting.back();
            waiting.pop_back();
            for (const std::uint32_t triangle : tree.own(index)) all.push_back(triangle);
            if (tree.nodes[index].is_leaf()) continue;
            waiting.push_back(tree.nodes[index].first + 1);
            waiting.push_back(tree.nodes[index].first);
        }
        return all;
    };
    std::vector<std::uint32_t> waiting;
    if (!tree.empty()) waiting.push_back(0);
    while (!waiting.empty()) {
        const std::uint32_t index = waiting.back();
        waiting.pop_back();
        const std::vector<std::uint32_t> all = all_below(index);
        if (all.size() <= size && 4 * all.size() > size) found.push_back(all);
        if (all.size() <= size || tree.nodes[index].is_leaf()) continue;
        waiting.push_back(tree.nodes[index].first + 1);
        waiting.push_back(tree.nodes[index].first);
    }
    return found;
}

/// Nothing for a part that is a point.
Part unit_part(std::span<const Triangle> triangles, std::span<const std::uint32_t> indices) {
    Part part;
    for (const std::uint32_t i : indices) part.triangles.push_back(triangles[i]);
    const std::vector<Point3> corners = corners_of<3>(part.triangles);
    const BoundingSphere<3> sphere = smallest_sphere<3>(corners);
    if (!(sphere.radius > 0.0f)) return {};
    const auto unit = [&](const Point3& p) {
        return Point3((Double3(p) - Double3(sphere.centre)) / double{sphere.radius});
    };
    for (Triangle& t : part.triangles) t = {unit(t.a), unit(t.b), unit(t.c)};
    part.points = corners_of<3>(part.triangles);
    return part;
}

/// Some of them, evenly from all.
std::vector<Part> parts_of(std::span<const Triangle> triangles, const BvhNodes<3>& tree,
                           std::size_t size, std::size_t most) {
    const auto all = subtrees(tree, size);
    std::vector<Part> parts;
    const std::size_t count = std::min(all.size(), most);
    for (std::size_t i = 0; i < count; ++i) {
        Part part = unit_part(triangles, all[i * all.size() / count]);
        if (!part.points.empty()) parts.push_back(std::move(part));
    }
    return parts;
}

/// Every volume around a part is in it: a box that touches the unit ball from outside has its
/// corners at the distance of the root of 3, and Ritter's sphere is hardly a third too large.
constexpr double outer_radius = 2.0;

/// Lines through the outer ball: a direction, and a point of the disc at right angles to it.
std::vector<Ray> lines_through_ball(std::size_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const Frame<3> frame = frame_about(random_direction(random));
        const Double2 at(random_point<2>(random, {Point2(-1.0f), Point2(1.0f)}));
        if (glm::dot(at, at) > 1.0) continue;
        const Double3 from = outer_radius * (at.x * frame[0] + at.y * frame[1] - 2.0 * frame[2]);
        rays.push_back({.origin = Point3(from), .direction = Vector3(frame[2])});
    }
    return rays;
}
/// Those of them that meet the unit ball.
std::vector<Ray> through_unit_ball(std::span<const Ray> lines) {
    const BoundingSphere<3> ball{.radius = 1.0f};
    std::vector<Ray> rays;
    for (const Ray& ray : lines)
        if (meets(prepared_for(ray, ball), ball)) rays.push_back(ray);
    return rays;
}

// ---- counts -----------------------------------------------------------------------------------

std::uint64_t hits_of(const Part& part, std::span<const Ray> rays) {
    std::uint64_t hits = 0;
    for (const Ray& ray : rays)
        hits += std::ranges::any_of(part.triangles, [&](const Triangle& triangle) {
            return FilteredExact::intersect(ray, triangle).has_value();
        });
    return hits;
}

/// All kinds around the same parts, with lines of each part's own.
std::vector<VolumePoint> count_parts(const std::string& scene, std::size_t part_size,
                                     const std::vector<Part>& parts, std::size_t lines,
                                     std::uint64_t seed) {
    std::vector<VolumePoint> points;
    std::vector<std::vector<Ray>> rays;
    std::uint64_t hits = 0;
    for (const Part& part : parts) {
        rays.push_back(lines_through_ball(lines, seed + rays.size()));
        hits += hits_of(part, through_unit_ball(rays.back()));
    }
    std::vector<std::vector<double>> surfaces;  // by kind and part
    for_each_kind([&](std::string_view kind, const auto& make) {
        VolumePoint point{.scene = scene, .part_size = part_size, .kind = kind};
        point.parts = parts.size();
        point.rays = parts.size() * lines;
        point.hits = hits;
        std::vector<double>& all = surfaces.emplace_back();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const auto volume = make(parts[i].points);
            all.push_back(surface(volume));
            for (const Ray& ray : rays[i]) point.met += meets(prepared_for(ray, volume), volume);
        }
        points.push_back(point);
    });
    const auto tight = std::ranges::find(points, tight_kind, &VolumePoint::kind) - points.begin();
    const double ball = surface(BoundingSphere<3>{.radius = 1.0f});
    for (std::size_t i = 0; i < parts.size(); ++i) {
        double least = double{infinity};
        for (const auto& of_kind : surfaces) least = std::min(least, of_kind[i]);
        for (std::size_t k = 0; k < points.size(); ++k) {
            points[k].chance += surfaces[k][i] / ball / double(parts.size());
            points[k].least_chance += least / ball / double(parts.size());
            points[k].twice += surfaces[k][i] >= 2.0 * surfaces[std::size_t(tight)][i];
        }
    }
    return points;
}

/// A square bar of length 1 along (1, 1, 1).
NeedlePoint needle(double thickness) {
    const Frame<3> frame = frame_about(Double3(1.0));
    std::vector<Point3> corners;
    for (unsigned k = 0; k < 8; ++k)
        corners.push_back(
            Point3(double(k & 1) * frame[2] +
                   thickness * (double(k >> 1 & 1) * frame[0] + double(k >> 2) * frame[1])));
    return {thickness, surface(box_around<3>(corners)), surface(tight_box<3>(corners))};
}

// ---- times ------------------------------------------------------------------------------------

/// Every ray against every volume.
template <class Make>
std::function<void()> all_tests(const std::vector<Part>& parts, std::span<const Ray> rays,
                                const Make& make, VolumeTest& test) {
    using Volume = std::decay_t<decltype(make(parts[0].points))>;
    std::vector<Volume> volumes;
    for (const Part& part : parts) volumes.push_back(make(part.points));
    test.bytes = sizeof(Volume);
    return [volumes, rays, &test] {
        std::uint64_t met = 0;
        for (const Ray& ray : rays) {
            const auto way = prepared_for(ray, volumes[0]);
            for (const Volume& volume : volumes) met += meets(way, volume);
        }
        do_not_optimize(met);
        test.chance = double(met) / double(rays.size() * volumes.size());
    };
}

/// Chapter 2's test of a turned box, in floats and without margins.
struct PlainBox {
    OrientedBox box;
};
PlainBox plain_box(std::span<const Point3> points) {
    const OrientedBounds<3> tight = tight_box<3>(points);
    PlainBox plain;
    Double3 middle(0.0);
    for (const Double3& corner : corners(tight)) middle += 0.125 * corner;
    plain.box.centre = Point3(middle);
    plain.box.half = Vector3(0.5 * edges(tight));
    for (int i = 0; i < 3; ++i) plain.box.axes[i] = tight.axes[std::size_t(i)];
    return plain;
}
const Ray& prepared_for(const Ray& ray, const PlainBox&) {
    return ray;
}
bool meets(const Ray& ray, const PlainBox& plain) {
    return intersect(ray, plain.box).has_value();
}

std::vector<VolumeTest> time_tests(const std::vector<Part>& parts, std::span<const Ray> rays,
                                   int rounds) {
    std::vector<VolumeTest> tests;
    tests.reserve(9);  // the candidates hold references
    std::vector<std::function<void()>> candidates;
    const auto add = [&](std::string_view kind, const auto& make) {
        tests.push_back({.kind = kind});
        candidates.push_back(all_tests(parts, rays, make, tests.back()));
    };
    for_each_kind(add);
    add("oriented box, chapter 2's test", plain_box);
    const std::vector<double> ms = interleaved_medians(candidates, rounds);
    for (std::size_t i = 0; i < tests.size(); ++i)
        tests[i].ns = 1e6 * ms[i] / double(parts.size() * rays.size());
    return tests;
}

}  // namespace

VolumeMeasurements measure_volumes(const Options& options) {
    const Amount amount = options.amount();
    std::vector<std::string> scenes{"soup:20000", "slivers:2000", "tree:9",    "mount:6",
                                    "boxes:400",  "building:3",   "lattice:2", "sphereflake:2"};
    if (amount == Amount::small) scenes = {"slivers:200", "boxes:36"};
    const std::size_t most = amount == Amount::small ? 8 : amount == Amount::quick ? 40 : 160;
    const std::size_t lines = amount == Amount::small ? 64 : 256;
    VolumeMeasurements measured;
    std::vector<Part> timed;
    Progress progress("volumes", scenes.size());
    for (const std::string& scene : scenes) {
        const std::vector<Triangle> triangles = make_scene(scene, options.seed).mesh.triangles();
        const BvhNodes<3> tree = BinnedBuilder::build(triangles);
        for (const std::size_t size : {4u, 64u, 1024u}) {
            const auto parts = parts_of(triangles, tree, size, size > 64 ? most / 4 : most);
            if (parts.empty()) continue;
            const auto counted = count_parts(scene, size, parts, lines, options.seed);
            measured.points.insert(measured.points.end(), counted.begin(), counted.end());
            if (size == 64) timed.insert(timed.end(), parts.begin(), parts.end());
        }
        progress.step();
    }
    for (const double thickness : {1.0, 0.1, 0.01, 0.001})
        measured.needles.push_back(needle(thickness));
    if (amount != Amount::small && !options.counts)
        measured.tests =
            time_tests(timed, through_unit_ball(lines_through_ball(lines, options.seed)), 9);
    return measured;
}

}  // namespace space::ch07
