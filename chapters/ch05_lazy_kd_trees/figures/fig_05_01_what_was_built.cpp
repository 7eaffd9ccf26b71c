// One picture, and which part of the scene's tree it has made.

#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/figures.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/views.hpp"
#include "common/scenes/shapes.hpp"

#include <vector>

namespace space::ch05 {
namespace {

const RenderSettings settings{.width = 440, .height = 330, .samples = 2};

RenderSettings with_threads(unsigned threads) {
    RenderSettings all = settings;
    all.threads = threads;
    return all;
}

/// Triangles that leaves name which stand have a colour, the others are grey.
void color_what_stands(Scene& scene, const LazyKdTree<>& tree) {
    scene.colors.assign(scene.mesh.faces.size(), srgb(0x9A9A9A));
    const auto& nodes = tree.nodes();
    nodes.for_each_cell([&](const auto& cell) {
        if (cell.state != LazyKdTree<>::Nodes::State::leaf) return;
        for (const std::uint32_t triangle : nodes.own(cell.node))
            scene.colors[triangle] = srgb(0xE69F00);
    });
}

}  // namespace

Image fig_05_01(const Options& options) {
    const ViewedScene field = plants(7, 1);
    const Scene near = field.seen(field.views.back());
    const std::vector<Triangle> triangles = near.mesh.triangles();
    const auto tree = LazyKdTree<>::build(triangles, {.at_once = 0});
    const Image seen = render(near, tree, with_threads(options.threads)).image;
    Scene all = field.scene;
    color_what_stands(all, tree);
    all.camera = {.eye = {2.1f, 5.2f, 8.4f}, .target = {2.1f, 0.2f, 2.3f}, .field_of_view = 42};
    const auto eager = KdTree<>::build(triangles);
    return side_by_side({seen, render(all, eager, with_threads(options.threads)).image});
}

}  // namespace space::ch05
