#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/program/progress.hpp"

#include <fmt/format.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch01 {
namespace {

void add_pyramid(Scene& scene, const Point3& foot, float half, float height, const Color& color) {
    const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
    for (const auto& [x, z] : {std::pair{-half, half}, {half, half}, {half, -half}, {-half, -half}})
        scene.mesh.vertices.push_back(foot + Vector3(x, 0.0f, z));
    scene.mesh.vertices.push_back(foot + Vector3(0.0f, height, 0.0f));
    for (std::uint32_t side = 0; side < 4; ++side) {
        scene.mesh.faces.push_back({first + side, first + (side + 1) % 4, first + 4});
        scene.colors.push_back(color);
    }
}

/// Ten triangles: the ground, then two pyramids.
Scene two_pyramids() {
    Scene scene;
    scene.mesh.vertices = {{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}};
    scene.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    scene.colors = {{0.62f, 0.58f, 0.50f}, {0.62f, 0.58f, 0.50f}};
    add_pyramid(scene, {-0.9f, 0, -0.3f}, 1.0f, 1.9f, {0.05f, 0.30f, 0.60f});
    add_pyramid(scene, {1.2f, 0, 0.6f}, 0.8f, 1.4f, {0.80f, 0.25f, 0.03f});
    scene.camera = {
        .eye = {0.6f, 2.6f, 6.0f}, .target = {0.1f, 0.55f, 0.0f}, .field_of_view = 36.0f};
    scene.lights = {{{5.0f, 6.0f, 4.0f}, Color(150.0f)}, {{-4.0f, 5.0f, 6.0f}, Color(50.0f)}};
    scene.background = {0.72f, 0.82f, 0.88f};
    return scene;
}

/// The colour of a pixel's ray after each of the polygons: one pixel of the result for each.
template <class ColorOfRay>
Image states_of_the_loop(std::size_t polygons, const ColorOfRay& color_after) {
    Image states(static_cast<int>(polygons), 1);
    for (std::size_t count = 1; count <= polygons; ++count)
        states.at(static_cast<int>(count) - 1, 0) = color_after(count);
    return states;
}

/// The loop over the polygons for one ray, cut off after each of them.
void draw_states_of_the_loop(Svg& svg, const Scene& scene, std::span<const Triangle> triangles,
                             const Ray& ray) {
    const auto first = [&](std::size_t count) { return triangles.first(count); };
    const Image printed_states = states_of_the_loop(triangles.size(), [&](std::size_t count) {
        return color_of_ray_as_printed(scene, first(count), ray).value_or(scene.background);
    });
    const Image corrected_states = states_of_the_loop(triangles.size(), [&](std::size_t count) {
        RenderCounts rays;
        NoCounts none;
        return color_of_ray(scene, Naive<>::build(first(count)), ray, rays, none);
    });
    constexpr float left = 160, cell = 46;
    svg.text({left - 14, 334}, "polygon", {.anchor = Anchor::end});
    const auto strip = [&](float top, const char* name, const Image& states) {
        svg.text({left - 14, top + 26}, name, {.anchor = Anchor::end});
        svg.picture({left, top}, {cell * static_cast<float>(triangles.size()), 40}, states);
        for (std::size_t i = 0; i < triangles.size(); ++i)
            svg.rect({left + cell * static_cast<float>(i), top}, {cell, 40},
                     {.stroke = Ink::quiet});
    };
    strip(374, "as printed", printed_states);
    strip(424, "corrected", corrected_states);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const float x = left + cell * (static_cast<float>(i) + 0.5f);
        const bool hit = MollerTrumbore::intersect(ray, triangles[i]).has_value();
        svg.text({x, 334}, fmt::format("{}", i + 1),
                 {.ink = hit ? Ink::ink : Ink::quiet, .bold = hit});
        if (hit) svg.circle({x, 354}, 5, {.stroke = {}, .fill = Ink::ink});
    }
    svg.text({left - 14, 360}, "is hit", {.anchor = Anchor::end});
}

}  // namespace

Svg fig_01_05(const Options& options) {
    Svg svg(
        "Algorithm 1 as printed and corrected: two pictures, and one pixel's colour after each "
        "polygon",
        640, 474);
    constexpr int width = 40, height = 30, pixel_x = 14, pixel_y = 15;
    const Scene scene = two_pyramids();
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const RenderSettings settings{.width = width, .height = height, .threads = options.threads};
    const Rendering printed = algorithm1_as_printed(scene, triangles, settings);
    const Rendering corrected = render(scene, Naive<>::build(triangles), settings);

    constexpr float pixel = 7.5f;
    const auto panel = [&](float left, const char* name, const Rendering& rendering,
                           std::string id) {
        svg.begin_group(id);
        svg.text({left + 150, 24}, name, {.size = 18, .bold = true});
        svg.picture({left, 38}, {width * pixel, height * pixel}, rendering.image);
        svg.rect({left, 38}, {width * pixel, height * pixel}, {.stroke = Ink::quiet});
        svg.rect({left + pixel_x * pixel - 2, 38 + pixel_y * pixel - 2}, {pixel + 4, pixel + 4},
                 {.stroke = Ink::vermillion}, "pixel-" + id);
        svg.text({left + 150, 288},
                 fmt::format("{} of {} hits shown", rendering.counts.hits, corrected.counts.hits),
                 {});
        svg.end_group();
    };
    panel(10, "as printed", printed, "printed");
    panel(330, "corrected", corrected, "corrected");

    draw_states_of_the_loop(svg, scene, triangles,
                            PixelGrid(scene.camera, width, height).ray(pixel_x, pixel_y));
    return svg;
}

}  // namespace space::ch01
