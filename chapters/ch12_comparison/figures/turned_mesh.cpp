#include "chapters/ch12_comparison/figures/turned_mesh.hpp"

#include "common/program/heat.hpp"
#include "common/scenes/makers.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace space::ch12 {

Scene turned_mesh(TurnedMesh mesh) {
    Scene scene;
    switch (mesh) {
        case TurnedMesh::teapot:
            add(scene, teapot(6), srgb(0xC8553D));
            break;
        case TurnedMesh::head:
            make_scan(scene, 14, 1);
            break;
        case TurnedMesh::lattice:
            make_lattice(scene, 1, 1);
            break;
        case TurnedMesh::mountain:
            make_mount(scene, 5, 1);
            break;
        case TurnedMesh::tetrahedron:
            make_tetra(scene, 6, 1);
            break;
        case TurnedMesh::soup:
            make_soup(scene, 1'000, 1);
            break;
        case TurnedMesh::slivers:
            make_slivers(scene, 300, 1);
            break;
    }
    return scene;
}

void turn(Scene& scene, double turn, double tilt) {
    constexpr double degree = std::numbers::pi / 180.0, field_of_view = 32.0;
    const Aabb box = bounds(scene.mesh);
    const Double3 middle(box.centroid()), up = glm::normalize(Double3(scene.camera.up));
    double radius = 0.0;
    for (const Point3& vertex : scene.mesh.vertices)
        radius = std::max(radius, glm::length(Double3(vertex) - middle));
    const Double3 from = Double3(scene.camera.eye) - Double3(scene.camera.target);
    const Double3 ahead = glm::normalize(from - glm::dot(from, up) * up),
                  aside = glm::cross(up, ahead);
    const Double3 level = std::cos(turn * degree) * ahead + std::sin(turn * degree) * aside;
    const Double3 eye = std::cos(tilt * degree) * level + std::sin(tilt * degree) * up;
    const double distance = radius / std::sin(0.5 * field_of_view * degree);
    scene.camera = {.eye = Point3(middle + distance * eye),
                    .target = Point3(middle),
                    .up = Vector3(up),
                    .field_of_view = static_cast<float>(field_of_view)};
    scene.lights.clear();
    scene.background = srgb(0xDCE6EE);
    const CameraFrame frame(scene.camera);
    add_light(scene, middle + distance * (0.8 * frame.up - 0.9 * frame.right + 0.7 * frame.back),
              middle, Color{0.80f, 0.75f, 0.66f});
    add_eye_light(scene, Color{0.25f, 0.27f, 0.32f});
}

std::vector<Color> shown_colors() {
    std::vector<Color> colors;
    for (std::size_t count = 0; count <= most_shown; ++count)
        colors.push_back(heat(double(count) / double{most_shown}));
    return colors;
}

Svg turned_drawing(Shown shown) {
    const std::string_view name = shown_names[static_cast<std::size_t>(shown)];
    Svg svg(fmt::format("A mesh, by ray tracing: {}", name), 656, 524);
    svg.rect(turned_corner, turned_size, {.stroke = Ink::faint});
    svg.text(at(328, 512),
             shown == Shown::light
                 ? std::string(name)
                 : fmt::format("{}: dark, none; bright, {} or more", name, most_shown),
             {.size = 18});
    return svg;
}

}  // namespace space::ch12
