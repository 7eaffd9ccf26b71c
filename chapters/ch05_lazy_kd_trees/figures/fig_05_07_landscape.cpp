// A view of a landscape, and which of its patches the view has made.

#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch05_lazy_kd_trees/figures.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_geometry.hpp"
#include "chapters/ch05_lazy_kd_trees/measured/landscape.hpp"
#include "common/scenes/shapes.hpp"

#include <algorithm>
#include <cmath>

namespace space::ch05 {
namespace {

constexpr std::uint32_t cells = 4'096;
constexpr int height = 384, width = 480;

/// Grass below, snow above, and rock where it is steep.
Color ground(double up, double level) {
    const Color grass = srgb(0x6F8F4E), heath = srgb(0xA39A62), rock = srgb(0x8C7B68),
                snow = srgb(0xF2F2F0);
    const auto share = [](double from, double to, double x) {
        return float(std::clamp((x - from) / (to - from), 0.0, 1.0));
    };
    const Color flat =
        glm::mix(glm::mix(grass, heath, share(0.42, 0.52, level)), snow, share(0.56, 0.62, level));
    return glm::mix(rock, flat, share(0.8, 0.88, up));
}

/// The colour at a place, lit by the sun and a little by the sky.
Color lit(const Heightfield& field, double x, double z) {
    const auto at = [](double place) {
        return std::uint32_t(std::clamp(place, 1.0, double(cells) - 1.0));
    };
    const std::uint32_t i = at(x), j = at(z);
    const auto level = [&](std::uint32_t a, std::uint32_t b) {
        return double{field.point(a, b).y};
    };
    const Double3 n = glm::normalize(
        Double3{level(i - 1, j) - level(i + 1, j), 2.0, level(i, j - 1) - level(i, j + 1)});
    const Double3 sun = glm::normalize(Double3{-0.75, 0.42, 0.3});
    const double light = 0.2 + 1.05 * std::max(0.0, glm::dot(n, sun));
    return float(light) * ground(n.y, level(i, j) / (0.125 * cells));
}

Image view_of(const LazyGeometry<Heightfield>& geometry, const Options& options) {
    const Heightfield& field = geometry.source();
    const Color sky = srgb(0xBFD7EA);
    return render_pixels(
               from_a_hill(field),
               {.width = width, .height = height, .samples = 2, .threads = options.threads},
               nullptr,
               [&](const Ray& ray, RenderCounts&) {
                   const auto hit = closest_hit(geometry, ray);
                   if (!hit) return sky;
                   const Double3 p = Double3(ray.origin) + double{hit->t} * Double3(ray.direction);
                   const auto haze = float(1.0 - std::exp(-0.4 * double{hit->t} / cells));
                   return glm::mix(lit(field, p.x, p.z), sky, haze);
               })
        .image;
}

/// From above, three pixels a patch; what is made is orange, and the eye a black dot.
Image map_of(const LazyGeometry<Heightfield>& geometry) {
    const Heightfield& field = geometry.source();
    const std::uint32_t along = cells / field.config().patch_cells;
    const int scale = height / int(along);
    Image image(height, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < height; ++x) {
            const std::uint32_t patch = std::uint32_t(y / scale) * along + std::uint32_t(x / scale);
            const double in_cells = double(cells) / height;
            const Color shade = lit(field, (x + 0.5) * in_cells, (y + 0.5) * in_cells);
            const float grey = 0.3f + 0.5f * (shade.r + shade.g + shade.b) / 3.0f;
            image.at(x, y) = geometry.is_made(patch) ? grey * 1.2f * srgb(0xE69F00) : Color(grey);
        }
    const Point3 eye = from_a_hill(field).eye;
    const float to_pixels = float(height) / float(cells);
    for (int y = -4; y <= 4; ++y)
        for (int x = -4; x <= 4; ++x)
            if (x * x + y * y <= 16)
                image.at(int(eye.x * to_pixels) + x, int(eye.z * to_pixels) + y) = Color(0.0f);
    return image;
}

}  // namespace

Image fig_05_07(const Options& options) {
    const auto geometry = LazyGeometry<Heightfield>::build(landscape(cells));
    const Image view = view_of(geometry, options);
    return side_by_side({view, map_of(geometry)});
}

}  // namespace space::ch05
