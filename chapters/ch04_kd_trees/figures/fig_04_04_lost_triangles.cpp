// What becomes of a scene's first triangle in the published tree.

#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch04_kd_trees/figures.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch04_kd_trees/published_kd_tree.hpp"
#include "common/scenes/shapes.hpp"

#include <vector>

namespace space::ch04 {
namespace {

constexpr Color lost{0.665f, 0.112f, 0.0f};  // the palette's vermillion, linear

/// Balls on a ground, and a sail over them as the first triangle.
Scene under_sail(const Point3& low_corner) {
    Scene scene;
    const Point3 high{-1.6f, -0.9f, 1.9f}, right{-0.9f, 1.5f, 1.6f};
    add(scene, {.vertices = {high, low_corner, right}, .faces = {{0, 1, 2}}}, srgb(0xE7DBC3));
    add(scene, parallelogram({-6, -6, 0}, {12, 0, 0}, {0, 12, 0}), srgb(0xB9B2A3));
    add(scene, ball({-0.3, 0.0, 0.5}, 0.5, 6), srgb(0xE9C46A));
    add(scene, ball({0.55, -0.5, 0.25}, 0.25, 4), srgb(0xC8553D));
    add(scene, ball({0.4, 0.65, 0.2}, 0.2, 4), srgb(0x3E8E8C));
    add(scene, ball({-0.7, 0.85, 0.3}, 0.3, 4), srgb(0x4F5D8A));
    scene.camera = {.eye = {4.2f, 1.7f, 1.5f},
                    .target = {-0.2f, 0.0f, 0.75f},
                    .up = {0, 0, 1},
                    .field_of_view = 34};
    scene.background = srgb(0xCFE0EA);
    add_light(scene, {2, 3, 5}, {0, 0, 0}, Color{0.75f, 0.70f, 0.62f});
    add_eye_light(scene, Color{0.3f, 0.3f, 0.33f});
    return scene;
}

/// The tree's picture; marked is what it does not see.
Image tree_picture(const Scene& scene, const PublishedKdTreeConfig& config,
                   const Options& options) {
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const auto tree = PublishedKdTree<>::build(triangles, config);
    const auto truth = KdTree<>::build(triangles);
    const RenderSettings settings{
        .width = 300, .height = 240, .samples = 2, .threads = options.threads};
    return render_pixels(scene.camera, settings, nullptr,
                         [&](const Ray& ray, RenderCounts& counts) {
                             NoCounts none;
                             if (closest_hit(tree, ray) != closest_hit(truth, ray)) return lost;
                             return color_of_ray(scene, tree, ray, counts, none);
                         })
        .image;
}

}  // namespace

Image fig_04_04(const Options& options) {
    const Scene outside = under_sail({1.0f, -1.0f, 1.2f}), inside = under_sail({1.0f, -1.0f, 0.6f});
    return side_by_side({tree_picture(outside, {}, options), tree_picture(inside, {}, options),
                         tree_picture(inside, {.whole_scene_box = true}, options)});
}

}  // namespace space::ch04
