// More than a thousand million triangles: spheres on spheres, and twice a part of them that is 27
// times smaller.
#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/graph_picture.hpp"
#include "chapters/ch09_instancing_and_motion/measured/nesting.hpp"
#include "chapters/ch09_instancing_and_motion/nested_scenes.hpp"
#include "common/scenes/shapes.hpp"

#include <cmath>
#include <string>

namespace space::ch09 {
namespace {

/// A sphere's level by the length that its matrix gives to an axis: each has a third of that above.
int level_of(const Affine& to_world) {
    const double size = glm::length(to_world.vector({1, 0, 0}));
    return static_cast<int>(std::lround(-std::log(size) / std::log(3.0)));
}

Color sphere_color(const Located& at, std::uint64_t) {
    static const Color colors[] = {srgb(0xE9C46A), srgb(0xE08E45), srgb(0xC8553D), srgb(0x8C4A5E),
                                   srgb(0x4F5D8A), srgb(0x3E8E8C), srgb(0xB5C99A), srgb(0xF1E3B8)};
    return colors[level_of(at.to_world) % 8];
}

/// Three levels down, at the same child each time.
Affine part_of(const SceneGraph& graph, std::uint32_t object, std::size_t child) {
    Affine map;
    for (int level = 0; level < 3; ++level) {
        const Instance& instance = graph.object(object).instances[child];
        map = composed(map, instance.to_parent);
        object = instance.object;
    }
    return map;
}

/// The camera stands to the part as it did to the whole.
Camera moved_with(const Affine& part, const Camera& camera) {
    return {.eye = Point3(part.point(Double3(camera.eye))),
            .target = Point3(part.point(Double3(camera.target))),
            .up = Vector3(glm::normalize(part.vector(Double3(camera.up)))),
            .field_of_view = camera.field_of_view};
}

struct Panel {
    double left, top;
    int width, height;
};

/// A ring around the part in the picture, where the next one looks.
void mark(Svg& svg, const Panel& panel, const Camera& camera, const Affine& part) {
    const CameraFrame frame(camera);
    const auto pixel = [&](const Double3& p) {
        const Double3 v = p - Double3(camera.eye);
        const double scale = 0.5 * panel.height / (frame.tan_half_fov * -glm::dot(v, frame.back));
        return at(panel.left + 0.5 * panel.width + scale * glm::dot(v, frame.right),
                  panel.top + 0.5 * panel.height - scale * glm::dot(v, frame.up));
    };
    const Double3 centre = part.point({0, 0, 0});
    const double radius = glm::length(part.vector({1, 0, 0}));
    const Point2 middle = pixel(centre), edge = pixel(centre + radius * frame.right);
    svg.circle(middle, std::max(7.0, double(glm::length(edge - middle))), {.stroke = Ink::ink});
}

}  // namespace

Svg fig_09_11(const Options& options) {
    const SceneGraph graph = nested_sphereflake(7);
    const InstancedTrees trees = InstancedTrees::build(graph);
    Svg svg(
        "A sphere with nine smaller ones on it, each with nine smaller ones, and so on, and two "
        "parts of it enlarged",
        640, 720);
    constexpr Panel panels[] = {{0, 0, 640, 420}, {0, 452, 316, 240}, {324, 452, 316, 240}};
    const char* const names[] = {"the whole", "27 times nearer", "729 times nearer"};
    Affine place;
    std::uint32_t object = graph.root();
    for (std::size_t i = 0; i < 3; ++i) {
        const Panel& panel = panels[i];
        const Camera camera = moved_with(place, nested_camera("sphereflake"));
        const GraphPicture picture{.graph = graph,
                                   .trees = trees,
                                   .camera = camera,
                                   .to_sun = place.vector({4, 3, 5}),
                                   .sun = {1.4f, 1.3f, 1.12f},
                                   .sky = {0.46f, 0.50f, 0.58f},
                                   .ground = {0.20f, 0.17f, 0.15f},
                                   .haze = srgb(0xCFE0EA),
                                   .color = sphere_color,
                                   .samples = 2};
        svg.picture(at(panel.left, panel.top), at(panel.width, panel.height),
                    render(picture, panel.width, panel.height, options.threads),
                    "view-" + std::to_string(i + 1));
        svg.text(at(panel.left + 0.5 * panel.width, panel.top + panel.height + 21), names[i],
                 {.size = 17});
        if (i == 2) break;
        const Affine part = composed(place, part_of(graph, object, i == 0 ? 7 : 4));
        mark(svg, panel, camera, part);
        place = part;
        object -= 3;
    }
    return svg;
}

}  // namespace space::ch09
