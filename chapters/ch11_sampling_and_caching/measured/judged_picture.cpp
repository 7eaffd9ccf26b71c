#include "chapters/ch11_sampling_and_caching/measured/judged_picture.hpp"

#include "chapters/ch11_sampling_and_caching/aimed_photons.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"
#include "chapters/ch11_sampling_and_caching/progressive.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/accelerator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace space::ch11 {
namespace {

/// Seeds that no measured picture has.
constexpr std::uint64_t reference_seed = 1'000;

Luminances by_paths(const TracedScene& scene, std::uint32_t samples, std::uint64_t seed,
                    const PathConfig& config, unsigned threads) {
    Film film(scene.width, scene.height);
    const Sampler numbers(SamplePattern::sobol, samples, seed);
    for (std::uint32_t i = 0; i < samples; ++i)
        add_pass(film, scene.lit.scene.camera, numbers, threads, [&] {
            return [&](const Ray& ray, Sampler& sampler) {
                return path_radiance(scene.tree, scene.lit, scene.lights, ray, sampler, config);
            };
        });
    return luminances(film);
}

/// Adds to each pixel what photons of one kind of path give to its light. A photon that arrives at
/// a floor at the angle t to its normal from the eye, at a distance d, and at the angle c to the
/// picture's, stands for (rho / pi) power times cos t / (d^2 cos^3 c) of the picture at distance 1
/// from the eye: no disc, no blur.
void put_photons(const TracedScene& scene, const PhotonTrace& trace, PhotonPath path,
                 Luminances& picture) {
    const Camera& camera = scene.lit.scene.camera;
    const CameraFrame frame(camera);
    const double half_height = frame.tan_half_fov,
                 half_width = half_height * scene.width / scene.height;
    const double pixel_area = 4.0 * half_width * half_height / (scene.width * scene.height);
    for (const Photon& photon : trace.photons) {
        if (photon.path != path) continue;
        const Double3 way = Double3(photon.position) - Double3(camera.eye), n(photon.normal);
        const double depth = -glm::dot(way, frame.back), facing = -glm::dot(way, n);
        if (!(depth > 0.0 && facing > 0.0)) continue;
        const double x = 0.5 * (1.0 + glm::dot(way, frame.right) / (depth * half_width)),
                     y = 0.5 * (1.0 - glm::dot(way, frame.up) / (depth * half_height));
        if (!(x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0)) continue;
        const Ray ray{.origin = camera.eye, .direction = Vector3(way)};
        const std::optional<Hit> hit = closest_hit(scene.tree, ray);
        // Surfaces of these scenes are farther apart than a thousandth of their distance.
        if (!hit || std::abs(hit->t - 1.0f) > 1e-3f) continue;
        const double seen = facing / (depth * depth * depth);  // cos t / (d^2 cos^3 c)
        const auto pixel =
            static_cast<std::size_t>(y * scene.height) * static_cast<std::size_t>(scene.width) +
            static_cast<std::size_t>(x * scene.width);
        picture[pixel] += seen / (std::numbers::pi * pixel_area) *
                          luminance(scene.lit.reflectance(hit->triangle) * photon.power);
    }
}

/// The mean of so many batches.
Luminances by_photons(const TracedScene& scene, PhotonPath path, PhotonConfig config,
                      std::uint32_t batches) {
    Luminances sum(static_cast<std::size_t>(scene.width * scene.height), 0.0);
    for (std::uint32_t batch = 0; batch < batches; ++batch, ++config.seed) {
        const PhotonTrace trace =
            path == PhotonPath::caustic
                ? trace_aimed_photons(scene.tree, scene.lit, scene.lights, config)
                : trace_photons(scene.tree, scene.lit, scene.lights, config);
        put_photons(scene, trace, path, sum);
    }
    for (double& value : sum) value /= batches;
    return sum;
}

/// The pixels for which `is_judged`(ray) holds at the centres of all 3 x 3 around.
template <class IsJudged>
std::vector<std::uint8_t> where_all_around(const TracedScene& scene, const IsJudged& is_judged) {
    std::vector<std::uint8_t> all(static_cast<std::size_t>(scene.width * scene.height), 1);
    const PixelGrid grid = scene.pixels();
    grid.for_each([&](int x, int y) {
        if (is_judged(closest_hit(scene.tree, grid.ray(x, y)))) return;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, scene.height - 1); ++v)
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, scene.width - 1); ++u)
                all[static_cast<std::size_t>(v * scene.width + u)] = 0;
    });
    return all;
}

}  // namespace

double References::resolution() const {
    double squares = 0.0;
    for (const std::size_t i : judged) squares += (first[i] - second[i]) * (first[i] - second[i]);
    const auto n = double(judged.size());
    // first - second has twice the variance v of each; their product's standard error is v / root n
    return std::sqrt(2.0 * (0.5 * squares / n) / std::sqrt(n)) / mean();
}

References path_references(const TracedScene& scene, std::uint32_t samples, unsigned threads) {
    References references{.first = by_paths(scene, samples, reference_seed, {}, threads),
                          .second = by_paths(scene, samples, reference_seed + 1, {}, threads),
                          .judged = {}};
    const auto all = where_all_around(scene, [&](const std::optional<Hit>& hit) {
        return hit && scene.lit.emitted(hit->triangle, true) == Double3(0.0);
    });
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i]) references.judged.push_back(i);
    return references;
}

References caustic_references(const TracedScene& scene, std::uint32_t samples,
                              std::uint32_t photons, std::uint32_t batches, unsigned threads) {
    std::vector<Luminances> caustics, pictures;
    for (std::uint64_t half = 0; half < 2; ++half) {
        const std::uint64_t seed = reference_seed * (half + 1);
        const PhotonConfig config{.count = photons, .seed = seed, .threads = threads};
        caustics.push_back(by_photons(scene, PhotonPath::caustic, config, batches));
        const Luminances indirect = by_photons(scene, PhotonPath::indirect, config, batches);
        Luminances all = by_paths(scene, samples, seed, {.most_bounces = 1}, threads);
        for (std::size_t i = 0; i < all.size(); ++i) all[i] += caustics[half][i] + indirect[i];
        pictures.push_back(std::move(all));
    }
    References references{pictures[0], pictures[1], {}};
    const auto straight = where_all_around(scene, [&](const std::optional<Hit>& hit) {
        return hit && !scene.lit.is_mirror(hit->triangle);
    });
    for (std::size_t i = 0; i < straight.size(); ++i)
        if (straight[i] &&
            caustics[0][i] + caustics[1][i] > 0.25 * (pictures[0][i] + pictures[1][i]))
            references.judged.push_back(i);
    return references;
}

ErrorPoint judged_point(ErrorPoint point, const References& references,
                        std::span<const Luminances> pictures) {
    double errors = 0.0, biases = 0.0;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        for (std::size_t j = 0; j < pictures.size(); ++j)
            (i == j ? errors : biases) += references.product(pictures[i], pictures[j]);
    const auto n = double(pictures.size());
    point.error = std::sqrt(std::max(errors / n, 0.0));
    point.bias = n > 1.0 ? std::sqrt(std::max(biases / (n * (n - 1.0)), 0.0)) : 0.0;
    return point;
}

}  // namespace space::ch11
