/// @file
/// Heinonen16's Algorithm 1, RAY_TRACING, twice: corrected, for any accelerator, and as the thesis
/// prints it.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch01_naive_ray_tracing/shading.hpp"
#include "common/parallel.hpp"
#include "common/program/image.hpp"
#include "common/program/progress.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace space {

/// What the caller chooses about a picture.
struct RenderSettings {
    int width = 640, height = 480;
    int samples =
        1;  ///< rays per pixel and axis: samples x samples on a regular grid, 1: the pixel's centre
    unsigned threads = 1;  ///< the picture has the same bytes for any number
};

/// The work of one picture; the same for any number of threads.
struct RenderCounts {
    std::uint64_t camera_rays = 0;
    std::uint64_t hits = 0;          ///< camera rays that hit something
    std::uint64_t shadow_rays = 0;   ///< one per hit and light on the eye's side of the surface
    std::uint64_t occluded = 0;      ///< shadow rays that did not reach their light
    TraversalCounts traversal = {};  ///< of all rays; zero where nothing was counted

    RenderCounts& operator+=(const RenderCounts& other) {
        camera_rays += other.camera_rays;
        hits += other.hits;
        shadow_rays += other.shadow_rays;
        occluded += other.occluded;
        traversal += other.traversal;
        return *this;
    }
    bool operator==(const RenderCounts&) const = default;
};

/// A picture, and what it took to make it.
struct Rendering {
    Image image;
    RenderCounts counts;
};

/// Calls color(ray, counts) for every sample of every pixel, rows on several threads, and averages.
template <class ColorOfRay>
Rendering render_pixels(const Camera& camera, const RenderSettings& settings, Progress* progress,
                        const ColorOfRay& color_of_ray) {
    const PixelGrid grid(camera, settings.width, settings.height);
    const int n = settings.samples;
    Image image(settings.width, settings.height);
    std::vector<RenderCounts> row_counts(static_cast<std::size_t>(settings.height));
    parallel_for(row_counts.size(), settings.threads, 1, [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < settings.width; ++x) {
            Color sum{0.0f};
            for (int sample = 0; sample < n * n; ++sample) {
                const double sub_x = x + (sample % n + 0.5) / n, sub_y = y + (sample / n + 0.5) / n;
                ++row_counts[row].camera_rays;
                sum += color_of_ray(grid.ray_through(sub_x, sub_y), row_counts[row]);
            }
            image.at(x, y) = sum / static_cast<float>(n * n);
        }
        if (progress) progress->step();
    });
    RenderCounts counts;
    for (const RenderCounts& row : row_counts) counts += row;
    return {std::move(image), counts};
}

// [color_of_ray]
/// One ray of the corrected algorithm: the nearest hit first; then one shadow ray for each light,
/// which asks whether anything lies between; only then the shading. The background where nothing
/// was hit at all.
template <class Counts, Accelerator A>
Color color_of_ray(const Scene& scene, const A& accelerator, const Ray& ray, RenderCounts& rays,
                   Counts& counts) {
    const std::optional<Hit> hit = accelerator.closest_hit(ray, counts);
    if (!hit) return scene.background;
    ++rays.hits;
    return shade(scene, ray, *hit, [&](const Ray& shadow) {
        const bool occluded = accelerator.any_hit(shadow, counts);
        ++rays.shadow_rays;
        rays.occluded += occluded;
        return !occluded;
    });
}
// [color_of_ray]

/// Algorithm 1, corrected, with any structure over scene.mesh.triangles(). render<NoCounts>(...)
/// counts rays but no tests.
template <class Counts = TraversalCounts, Accelerator A>
Rendering render(const Scene& scene, const A& accelerator, const RenderSettings& settings,
                 Progress* progress = nullptr) {
    return render_pixels(scene.camera, settings, progress, [&](const Ray& ray, RenderCounts& rays) {
        Counts counts;
        const Color color = color_of_ray(scene, accelerator, ray, rays, counts);
        if constexpr (std::same_as<Counts, TraversalCounts>) rays.traversal += counts;
        return color;
    });
}

// [as_printed]
/// One ray of Algorithm 1 as printed; nothing stands for the background.
inline std::optional<Color> color_of_ray_as_printed(const Scene& scene,
                                                    std::span<const Triangle> triangles,
                                                    const Ray& ray) {
    const Ray line{ray.origin, ray.direction, -infinity, infinity};  // fault 3: any t, also t < 0
    std::optional<Color> color;
    float nearest = infinity;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        std::optional<Hit> hit = MollerTrumbore::intersect(line, triangles[i]);
        if (hit && hit->t < nearest) {
            nearest = hit->t;
            hit->triangle = i;
            color = shade(scene, ray, *hit, [](const Ray&) { return true; });  // fault 2: no shadow
        } else {
            color.reset();  // fault 1: missed, or hit farther away
        }
    }
    return color;
}
// [as_printed]

/// Algorithm 1 as the thesis prints it; counted as hits are those that were not erased.
inline Rendering algorithm1_as_printed(const Scene& scene, std::span<const Triangle> triangles,
                                       const RenderSettings& settings,
                                       Progress* progress = nullptr) {
    return render_pixels(scene.camera, settings, progress, [&](const Ray& ray, RenderCounts& rays) {
        const std::optional<Color> color = color_of_ray_as_printed(scene, triangles, ray);
        rays.hits += color.has_value();
        rays.traversal.triangles_tested += triangles.size();
        return color.value_or(scene.background);
    });
}

}  // namespace space
