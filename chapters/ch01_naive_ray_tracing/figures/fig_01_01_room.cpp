#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/parallel.hpp"
#include "common/program/progress.hpp"

#include <algorithm>

namespace space::ch01 {
namespace {

/// How far apart two colours are, in the channel where they differ most.
float difference(const Color& a, const Color& b) {
    const Color d = glm::abs(a - b);
    return std::max({d.r, d.g, d.b});
}

/// Whether one of the pixels around it has another colour, as at the edges of things and shadows.
bool at_an_edge(const Image& image, int x, int y) {
    constexpr float hardly_seen = 0.01f;  // of full brightness
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, image.height() - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, image.width() - 1); ++i)
            if (difference(image.at(x, y), image.at(i, j)) > hardly_seen) return true;
    return false;
}

}  // namespace

/// One ray a pixel; where that would leave a stair, two by two in its place.
Image fig_01_01(const Options& options) {
    const Scene scene = make_scene("room:5");
    const auto naive = Naive<>::build(scene.mesh.triangles());
    const RenderSettings settings{.width = 640, .height = 480, .threads = options.threads};
    const auto rows = static_cast<std::size_t>(settings.height);
    Progress progress("the room", 2 * rows);
    const Image centres = render<NoCounts>(scene, naive, settings, &progress).image;

    const PixelGrid grid(scene.camera, settings.width, settings.height);
    Image image = centres;
    parallel_for(rows, settings.threads, 1, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < settings.width; ++x) {
            if (!at_an_edge(centres, x, y)) continue;
            RenderCounts rays;
            NoCounts tests;
            Color sum{0.0f};
            for (int i = 0; i < 4; ++i)
                sum += color_of_ray(scene, naive,
                                    grid.ray_through(x + (i % 2 + 0.5) / 2, y + (i / 2 + 0.5) / 2),
                                    rays, tests);
            image.at(x, y) = sum / 4.0f;
        }
        progress.step();
    });
    return image;
}

}  // namespace space::ch01
