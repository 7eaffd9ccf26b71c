// A forest of a hundred thousand trees.
#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/graph_picture.hpp"
#include "chapters/ch09_instancing_and_motion/forest.hpp"
#include "chapters/ch09_instancing_and_motion/measured/nesting.hpp"
#include "common/pcg32.hpp"
#include "common/scenes/shapes.hpp"

#include <cstddef>
#include <string_view>

namespace space::ch09 {
namespace {

/// The tree that holds a triangle, as a number from 0 on.
std::size_t tree_of(const SceneGraph& graph, std::uint64_t triangle) {
    std::size_t first = 0, last = graph.object(graph.root()).instances.size();
    while (last - first > 1) {
        const std::size_t middle = first + (last - first) / 2;
        (graph.first_triangle(graph.root(), middle) <= triangle ? first : last) = middle;
    }
    return first;
}

/// Each tree has a shade of its own, and every eighth broad-leaved one is yellow or red.
Color forest_color(const SceneGraph& graph, const Located& at, std::uint64_t triangle) {
    const std::string_view name = graph.object(at.mesh).name;
    if (name == "ground") return srgb(0x6B6A3A);
    if (name == "trunk") return srgb(0x5A4030);
    Pcg32 random(tree_of(graph, triangle));
    const float shade = random.uniform();
    const bool is_turning = random.below(8) == 0;
    if (name == "bough") return glm::mix(srgb(0x2F5233), srgb(0x52733F), shade);
    if (name != "twig") return srgb(0x6B4A33);  // branches
    return is_turning ? glm::mix(srgb(0xC98A2B), srgb(0xB5562B), shade)
                      : glm::mix(srgb(0x55802F), srgb(0x86A03C), shade);
}

}  // namespace

Image fig_09_01(const Options& options) {
    const SceneGraph graph = make_forest_graph(320);
    const InstancedTrees trees = InstancedTrees::build(graph);
    const GraphPicture picture{
        .graph = graph,
        .trees = trees,
        .camera = nested_camera("forest"),
        .to_sun = {-4, -1.5, 2.6},
        .sun = {2.3f, 2.0f, 1.5f},
        .sky = {0.36f, 0.44f, 0.56f},
        .ground = {0.12f, 0.12f, 0.09f},
        .haze = srgb(0xCFE0EA),
        .clear = 1100,
        .color = [&](const Located& at,
                     std::uint64_t triangle) { return forest_color(graph, at, triangle); },
        .samples = 2};
    return render(picture, 720, 420, options.threads);
}

}  // namespace space::ch09
