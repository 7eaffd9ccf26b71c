#include "chapters/ch02_intersection_tests/measurements.hpp"

#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/progress.hpp"
#include "common/scene.hpp"

namespace space {

Amounts amounts(const Options& options) {
    if (options.small)
        return {.pairs = 4096, .leak_rays = 4096, .root_stride = 1021, .root_samples = 64, .boxes = 20'000, .spheres = 4096,
                .bounces = 1000, .rounds = 1};
    if (options.quick)
        return {.pairs = 100'000, .leak_rays = 100'000, .root_stride = 17, .root_samples = 1000, .boxes = 1'000'000,
                .spheres = 50'000, .bounces = 100'000, .rounds = 15};
    return {.pairs = 1'000'000, .leak_rays = 1'000'000, .root_stride = 1, .root_samples = 20'000, .boxes = 10'000'000,
            .spheres = 200'000, .bounces = 1'000'000, .rounds = 51};
}

Measurements measure(const Options& options) {
    const Amounts amount = amounts(options);
    const std::uint64_t seed = options.seed;
    const unsigned threads = options.threads;
    Measurements measured;

    const std::vector<int> leak_shifts{0, 3, 6};
    const std::vector<double> distances{3.0, 300.0, 3e3, 3e4, 3e6}, places{1.0, 1e3, 1e5};
    Progress counting("counting wrong decisions", triangle_inputs().size() + leak_shifts.size() + root_forms().size() + 1 +
                                                      distances.size() + places.size() * origin_ways().size());
    for (const TriangleInput& input : triangle_inputs()) {
        measured.triangles.push_back(triangle_accuracy(input, amount.pairs, seed, threads));
        counting.step();
    }
    for (const int shift : leak_shifts) {
        measured.leaks.push_back(closed_mesh_leaks(3, shift, amount.leak_rays, seed, threads));
        counting.step();
    }
    for (const RootForm& form : root_forms()) {
        measured.roots.push_back(root_accuracy(form, amount.root_stride, amount.root_samples));
        counting.step();
    }
    measured.lattice = lattice_box_accuracy();
    measured.boxes = box_accuracy(amount.boxes, seed, threads);
    measured.from_inside = rays_from_inside(amount.spheres, seed);
    measured.oriented = oriented_box_accuracy(amount.spheres, seed);
    counting.step();
    for (const double distance : distances) {
        measured.spheres.push_back(sphere_accuracy(distance, amount.spheres, seed, threads));
        counting.step();
    }
    measured.behind = spheres_behind(amount.spheres, seed);
    std::size_t filtered_exact = 0;
    for_each_named(triangle_tests, [&](std::size_t i, const auto& named) {
        if (named.name == "filtered-exact") filtered_exact = i;
    });
    for (const double place : places)
        for (const OriginWay& way : origin_ways()) {
            measured.bounces.push_back({way.name, place, bounces(way, filtered_exact, place, amount.bounces, seed, threads)});
            counting.step();
        }

    const std::vector<std::string> scenes{"soup:20000", "room", "sphereflake:3", "mount", "boxes"};
    Progress timing("timing", scenes.size() + std::size(patterns) + 2);
    const auto time_leaves = [&](const Leaves& leaves) {
        measured.triangle_times.push_back(
            {leaves.scene, time_triangle_tests(leaves, amount.rounds), time_lichter_tests(leaves, amount.rounds)});
        timing.step();
    };
    time_leaves(random_leaves(64, seed));
    for (const std::string& name : scenes) {
        const Scene scene = make_scene(options.small ? name.substr(0, name.find(':')) : name, seed, options.small);
        time_leaves(make_leaves(name, scene.mesh.triangles(), 64, seed));
    }
    for (const Pattern pattern : patterns) {
        measured.pattern_times.push_back(
            {pattern, time_box_tests(pattern, amount.rounds), time_orders(pattern, amount.rounds)});
        timing.step();
    }
    measured.root_times = time_roots(amount.rounds);
    measured.sphere_times = time_sphere_tests(amount.rounds);
    measured.plane_times = time_planes(amount.rounds);
    timing.step();
    return measured;
}

double relative_time(const SceneTimes& scene, std::string_view test) {
    return ns_of(scene.tests, test) / ns_of(scene.tests, "moller-trumbore-float");
}

}  // namespace space
