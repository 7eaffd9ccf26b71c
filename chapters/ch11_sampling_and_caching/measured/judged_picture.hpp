/// @file
/// Pictures, and how wrong they are: two references, each noisy but without bias and independent of
/// the other, tell an error exactly in the mean.
#pragma once

#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch11_sampling_and_caching/film.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/measured/convergence_data.hpp"
#include "common/camera.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch11 {

/// The luminance of each pixel, row by row.
using Luminances = std::vector<double>;

inline Luminances luminances(const Film& film) {
    Luminances all;
    for (const Double3& sum : film.sums) all.push_back(luminance(sum) / film.samples);
    return all;
}

/// A scene, ready for rays.
struct TracedScene {
    std::string name;
    LitScene lit;
    LightTable lights;
    FastBvh<> tree;
    int width, height;

    TracedScene(std::string of, LitScene scene, int w, int h)
        : name(std::move(of)),
          lit(std::move(scene)),
          lights(lit),
          tree(FastBvh<>::build(lit.triangles)),
          width(w),
          height(h) {}
    PixelGrid pixels() const { return {lit.scene.camera, width, height}; }
};

/// What a picture is held against.
struct References {
    Luminances first, second;
    std::vector<std::size_t> judged;  ///< pixels

    double mean() const {
        double sum = 0.0;
        for (const std::size_t i : judged) sum += 0.5 * (first[i] + second[i]);
        return sum / double(judged.size());
    }
    /// The mean of (a - truth) (b - truth) over the judged pixels, over the square of their mean:
    /// without bias, for each difference is taken from a reference of its own. For a = b the square
    /// of the relative error; for independent pictures of one setting that of the bias.
    double product(const Luminances& a, const Luminances& b) const {
        double sum = 0.0;
        for (const std::size_t i : judged)
            sum += 0.5 * ((a[i] - first[i]) * (b[i] - second[i]) +
                          (a[i] - second[i]) * (b[i] - first[i]));
        return sum / (double(judged.size()) * mean() * mean());
    }
    /// The smallest relative error that is told from none: that of twice the product's standard
    /// error by the references' own noise.
    double resolution() const;
};

/// Paths as the reference; judged: where no light is seen, nor by a pixel beside.
References path_references(const TracedScene& scene, std::uint32_t samples, unsigned threads);

/// Where a caustic is more than a quarter of the light, on a surface that is seen straight: paths
/// for the lights' direct light, photons that are put into the pixels that see them for all other
/// light.
References caustic_references(const TracedScene& scene, std::uint32_t samples,
                              std::uint32_t photons, std::uint32_t batches, unsigned threads);

/// Several pictures of one setting, with seeds of their own.
ErrorPoint judged_point(ErrorPoint point, const References& references,
                        std::span<const Luminances> pictures);

}  // namespace space::ch11
