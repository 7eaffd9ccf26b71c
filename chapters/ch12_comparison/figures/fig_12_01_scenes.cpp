#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch12_comparison/figures.hpp"
#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch12 {
namespace {

constexpr int sheet_width = 204, sheet_height = 153, sheet_columns = 3;

/// The size that a picture shows best: the second, of some 10,000 triangles.
Scene pictured(const ComparedScene& compared, std::uint64_t seed) {
    const std::string& spec = compared.specs[1];
    if (!spec.starts_with("graph/")) return make_scene(spec, seed);
    Scene scene;
    for (const Triangle& triangle :
         make_subject(std::string(compared.name), spec, seed).triangles) {
        const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
        for (const Point3& corner : {triangle.a, triangle.b, triangle.c})
            scene.mesh.vertices.push_back(corner);
        scene.mesh.faces.push_back({first, first + 1, first + 2});
    }
    frame_mesh(scene);
    return scene;
}

}  // namespace

Svg fig_12_01(const Options& options) {
    std::vector<const ComparedScene*> made;
    for (const ComparedScene& compared : compared_scenes())
        if (compared.specs.size() > 1) made.push_back(&compared);
    constexpr double step_x = 214, step_y = sheet_height + 30;
    const std::size_t rows = (made.size() + sheet_columns - 1) / sheet_columns;
    Svg svg("The scenes that are made for the comparison, at some ten thousand triangles each", 640,
            4 + step_y * double(rows));
    for (std::size_t i = 0; i < made.size(); ++i) {
        const Scene scene = pictured(*made[i], options.seed);
        const auto bvh = Bvh<BinnedBuilder>::build(scene.mesh.triangles());
        const RenderSettings settings{
            .width = sheet_width, .height = sheet_height, .samples = 3, .threads = options.threads};
        const double x = 4 + step_x * double(i % sheet_columns),
                     y = 4 + step_y * double(i / sheet_columns);
        svg.picture(at(x, y), {sheet_width, sheet_height}, render(scene, bvh, settings).image);
        std::string name(made[i]->name);
        std::ranges::replace(name, '_', ' ');
        svg.text(at(x + 0.5 * sheet_width, y + sheet_height + 19), name, {.size = 16});
    }
    return svg;
}

}  // namespace space::ch12
