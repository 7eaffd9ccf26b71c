// Birds and wires: what is thinner than a cell, and what is smaller.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/sampling_panels.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/sampled_scene.hpp"
#include "common/scenes/shapes.hpp"

#include <array>
#include <vector>

namespace space::ch06 {
namespace {

/// A wire from post to post, as deep as it sags in the middle, at x from -1 to 1.
Double3 on_wire(double height, double x) {
    return {4.2 * x, height - 0.45 * (1.0 - x * x), 0.0};
}

void add_bird(Scene& scene, const Double3& at) {
    const Color slate = srgb(0x3B4252);
    add(scene, ball(at, 0.13, 4), slate);
    add(scene, ball(at + Double3{0.11, 0.11, 0.0}, 0.08, 3), slate);
}

/// Two posts, three wires, birds on them, and some in the air.
Scene wires() {
    Scene scene;
    add(scene, parallelogram({-30, -2.2, 20}, {60, 0, 0}, {0, 0, -60}), srgb(0x8FA36B));
    const Color wood = srgb(0x7A5A3F);
    for (const double x : {-4.2, 4.2}) {
        add(scene, box({x - 0.12, -2.2, -0.12}, {x + 0.12, 3.1, 0.12}), wood);
        add(scene, box({x - 0.5, 2.55, -0.08}, {x + 0.5, 2.68, 0.08}), wood);
    }
    constexpr std::array heights{2.6, 1.85, 1.1};
    for (const double height : heights) {
        std::vector<TubePoint> path;
        for (int i = -12; i <= 12; ++i) path.push_back({on_wire(height, i / 12.0), 0.035});
        add(scene, tube(path, 6), srgb(0x2B2B2B));
    }
    for (const double x : {-0.62, -0.5, -0.06, 0.47})
        add_bird(scene, on_wire(heights[0], x) + Double3{0.0, 0.16, 0.0});
    for (const double x : {-0.3, 0.26, 0.36})
        add_bird(scene, on_wire(heights[1], x) + Double3{0.0, 0.16, 0.0});
    for (const Double3& in_air :
         {Double3{-1.62, 2.98, 0.0}, {1.1, 3.25, 0.0}, {1.86, 0.14, 0.0}, {-2.46, 0.2, 0.0}})
        add_bird(scene, in_air);
    scene.camera = {.eye = {0.5f, 0.4f, 8.6f}, .target = {0.0f, 1.3f, 0.0f}, .field_of_view = 46};
    scene.background = srgb(0xBFD9EA);
    add_light(scene, {30, 60, 40}, {0, 0, 0}, Color{0.95f, 0.90f, 0.80f});
    add_light(scene, {-20, 10, 60}, {0, 0, 0}, Color{0.25f, 0.28f, 0.32f});
    return scene;
}

}  // namespace

Image fig_06_13(const Options& options) {
    constexpr int width = 200, height = 150, scale = 2;
    const SampledScene scene(wires(), width, height);
    const auto sampled = [&](AdaptiveConfig::Evidence evidence) {
        return scene.by_objects(
            {.evidence = evidence, .first_cell = 8, .threads = options.threads});
    };
    const AdaptivePicture by_all = sampled(AdaptiveConfig::Evidence::all_samples);
    return four(enlarged(scene.full(), scale),
                enlarged(sampled(AdaptiveConfig::Evidence::corners).image, scale),
                enlarged(by_all.image, scale), enlarged(cells_of(by_all), scale));
}

}  // namespace space::ch06
