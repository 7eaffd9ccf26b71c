#include "chapters/ch02_intersection_tests/measured/measurements.hpp"

#include "chapters/ch02_intersection_tests/measured/signs.hpp"
#include "chapters/ch02_intersection_tests/triangle_tests.hpp"
#include "common/program/progress.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

namespace space::ch02 {

Sizes sizes(Amount amount) {
    switch (amount) {
        case Amount::small:
            return {.pairs = 4096,
                    .leak_rays = 4096,
                    .volumes = 4096,
                    .root_stride = 1021,
                    .root_samples = 64,
                    .boxes = 20'000,
                    .spheres = 4096,
                    .bounces = 1000,
                    .rounds = 1};
        case Amount::quick:
            return {.pairs = 100'000,
                    .leak_rays = 100'000,
                    .volumes = 100'000,
                    .root_stride = 17,
                    .root_samples = 1000,
                    .boxes = 1'000'000,
                    .spheres = 50'000,
                    .bounces = 100'000,
                    .rounds = 15};
        default:
            return {.pairs = 1'000'000,
                    .leak_rays = 1'000'000,
                    .volumes = 1'000'000,
                    .root_stride = 1,
                    .root_samples = 20'000,
                    .boxes = 2'000'000,
                    .spheres = 200'000,
                    .bounces = 200'000,
                    .rounds = 51};
    }
}

namespace {

/// Whether of the counts only those are wanted that the text quotes.
bool is_brief(const Options& options) {
    return options.counts && options.quick;
}

}  // namespace

void count_triangles(const Options& options, Measurements& measured) {
    std::vector<TriangleInput> inputs = triangle_inputs();
    constexpr std::array in_the_text{"random", "near", "edges", "vertices", "uneven"};
    if (is_brief(options))
        std::erase_if(inputs, [&](const TriangleInput& input) {
            return std::ranges::count(in_the_text, input.name) == 0;
        });
    Progress progress("triangles: wrong decisions", inputs.size());
    for (const TriangleInput& input : inputs) {
        measured.triangles.push_back(
            triangle_accuracy(input, sizes(options.amount()).pairs, options.seed, options.threads));
        progress.step();
    }
}

void count_signs(const Options& options, Measurements& measured) {
    measured.sign_example = sign_example();
    measured.signs = lost_signs(sizes(options.amount()).volumes, options.seed);
    measured.worst_known_share = worst_known_share();
}

void count_leaks(const Options& options, Measurements& measured) {
    if (is_brief(options)) return;
    const std::vector<int> shifts{0, 3, 6};
    Progress progress("triangles: leaks", shifts.size());
    for (const int shift : shifts) {
        measured.leaks.push_back(closed_mesh_leaks(3, shift, sizes(options.amount()).leak_rays,
                                                   options.seed, options.threads));
        progress.step();
    }
}

void count_roots(const Options& options, Measurements& measured) {
    std::vector<RootForm> forms = root_forms();
    constexpr std::array in_the_text{"Newton 2", "Newton 3", "Newton 4", "library"};
    std::uint32_t samples = sizes(options.amount()).root_samples;
    if (is_brief(options)) {
        std::erase_if(forms, [&](const RootForm& form) {
            return std::ranges::count(in_the_text, form.name) == 0;
        });
        samples = 1;  // of numbers beyond [1, 4)
    }
    Progress progress("square roots", forms.size());
    for (const RootForm& form : forms) {
        measured.roots.push_back(root_accuracy(form, sizes(options.amount()).root_stride, samples));
        progress.step();
    }
}

void count_boxes(const Options& options, Measurements& measured) {
    measured.lattice = lattice_box_accuracy();
    measured.boxes = box_accuracy(sizes(options.amount()).boxes, options.seed, options.threads);
    measured.from_inside = rays_from_inside(sizes(options.amount()).spheres, options.seed);
    measured.in_faces = rays_in_faces(sizes(options.amount()).spheres, options.seed);
    measured.oriented = oriented_box_accuracy(sizes(options.amount()).spheres, options.seed);
}

void count_spheres(const Options& options, Measurements& measured) {
    for (const double distance : {3.0, 300.0, 3e3, 3e4, 3e6})
        measured.spheres.push_back(sphere_accuracy(distance, sizes(options.amount()).spheres,
                                                   options.seed, options.threads));
    measured.behind = spheres_behind(sizes(options.amount()).spheres, options.seed);
}

void count_bounces(const Options& options, Measurements& measured) {
    std::size_t filtered_exact = 0;
    for_each_named(triangle_tests, [&](std::size_t i, const auto& named) {
        if (named.name == "filtered-exact") filtered_exact = i;
    });
    const std::vector<double> places{1.0, 1e3, 1e5};
    Progress progress("origins of secondary rays", places.size() * origin_ways().size());
    for (const double place : places)
        for (const OriginWay& way : origin_ways()) {
            measured.bounces.push_back(
                {way.name, place,
                 bounces(way, filtered_exact, place, sizes(options.amount()).bounces, options.seed,
                         options.threads)});
            progress.step();
        }
}

void time_triangles(const Options& options, Measurements& measured) {
    const std::vector<std::string> scenes{"soup:20000", "room", "sphereflake:3", "mount", "boxes"};
    const int rounds = sizes(options.amount()).rounds;
    Progress progress("timing triangles", scenes.size() + 1);
    const auto time_leaves = [&](const Leaves& leaves) {
        measured.triangle_times.push_back({leaves.scene, time_triangle_tests(leaves, rounds),
                                           time_lichter_tests(leaves, rounds)});
        progress.step();
    };
    const Leaves random = random_leaves(64, options.seed);
    measured.stage_times = time_stages(random, rounds);
    time_leaves(random);
    for (const std::string& name : scenes) {
        const Scene scene = make_scene(options.small ? name.substr(0, name.find(':')) : name,
                                       options.seed, options.small);
        time_leaves(make_leaves(name, scene.mesh.triangles(), 64, options.seed));
    }
}

void time_patterns(const Options& options, Measurements& measured) {
    const int rounds = sizes(options.amount()).rounds;
    for (const Pattern pattern : patterns)
        measured.pattern_times.push_back(
            {pattern, time_box_tests(pattern, rounds), time_orders(pattern, rounds)});
}

void time_others(const Options& options, Measurements& measured) {
    const int rounds = sizes(options.amount()).rounds;
    measured.root_times = time_roots(rounds);
    measured.sphere_times = time_sphere_tests(rounds);
    measured.plane_times = time_planes(rounds);
}

const Measurements& measure(const Options& options, std::initializer_list<Part> parts) {
    static Measurements measured;
    static std::vector<Part> done;
    for (const Part part : parts)
        if (std::ranges::find(done, part) == done.end()) {
            part(options, measured);
            done.push_back(part);
        }
    return measured;
}

const Measurements& measure_all(const Options& options) {
    const Measurements& measured =
        measure(options, {count_triangles, count_signs, count_leaks, count_roots, count_boxes,
                          count_spheres, count_bounces});
    if (options.counts) return measured;
    return measure(options, {time_triangles, time_patterns, time_others});
}

std::uint64_t wrong_answers(const Measurements& measured) {
    std::uint64_t wrong = measured.signs.certain_wrong;
    for_each_named(box_tests, [&](std::size_t i, const auto& named) {
        if (std::is_same_v<TestOf<decltype(named)>, SlabConservative>)
            wrong += measured.lattice.wrong[i].misses + measured.boxes.wrong[i].misses +
                     measured.from_inside.rejected[i];
    });
    return wrong;
}

}  // namespace space::ch02
