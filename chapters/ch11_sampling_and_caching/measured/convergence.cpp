#include "chapters/ch11_sampling_and_caching/measured/convergence.hpp"

#include "chapters/ch11_sampling_and_caching/measured/judged_picture.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/photon_radiance.hpp"
#include "chapters/ch11_sampling_and_caching/progressive.hpp"
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"
#include "common/measure.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace space::ch11 {
namespace {

/// Two of a setting tell its bias.
constexpr int pictures_of_each = 2;

/// Where pictures are made, and what they are held against.
struct Judge {
    const TracedScene& scene;
    const References& references;
    Convergence& found;
    unsigned threads;

    /// Makes pictures by picture(seed, work), which counts its work, and adds what they show.
    template <class Picture>
    void add(std::string method, std::string setting, const Picture& picture) const {
        ErrorPoint point{.method = std::move(method), .setting = std::move(setting)};
        std::vector<Luminances> made;
        std::vector<double> seconds;
        for (int i = 0; i < pictures_of_each; ++i) {
            Stopwatch stopwatch;
            made.push_back(picture(static_cast<std::uint64_t>(i) + 1, point.work));
            seconds.push_back(stopwatch.lap().count() / 1e3);
        }
        point.seconds = median(seconds);
        found.points.push_back(judged_point(std::move(point), references, made));
    }

    /// So many samples a pixel by what `row_estimator` gives.
    template <class RowEstimator>
    Luminances picture(std::uint32_t samples, std::uint64_t seed,
                       const RowEstimator& row_estimator) const {
        Film film(scene.width, scene.height);
        const Sampler numbers(SamplePattern::sobol, samples, seed);
        for (std::uint32_t i = 0; i < samples; ++i)
            add_pass(film, scene.lit.scene.camera, numbers, threads, row_estimator);
        return luminances(film);
    }
};

void add_paths(const Judge& judge, std::uint32_t fewest_samples, std::uint32_t most_samples) {
    const TracedScene& s = judge.scene;
    for (std::uint32_t samples = fewest_samples; samples <= most_samples; samples *= 4)
        judge.add("paths", fmt::format("{} a pixel", samples),
                  [&](std::uint64_t seed, std::uint64_t& work) {
                      work = samples;
                      return judge.picture(samples, seed, [&] {
                          return [&](const Ray& ray, Sampler& sampler) {
                              return path_radiance(s.tree, s.lit, s.lights, ray, sampler);
                          };
                      });
                  });
}

/// How a picture by photons is made.
struct PhotonSetting {
    std::uint32_t count, aimed = 0;  ///< photons
    std::size_t caustic_k = 30, indirect_k = 50;
    int gather_rays = 0;
    std::uint32_t samples = 1;  ///< a pixel
};

void add_photons(const Judge& judge, const std::string& method, const std::string& setting,
                 const PhotonSetting& photons) {
    const TracedScene& s = judge.scene;
    judge.add(method, setting, [&](std::uint64_t seed, std::uint64_t& work) {
        const PhotonConfig config{.count = photons.count, .seed = seed, .threads = judge.threads};
        const auto maps = PhotonMaps::build(s.tree, s.lit, s.lights, config, photons.aimed);
        work = maps.caustic.photons.size() + maps.indirect.photons.size();
        const PhotonLookupConfig asked{.caustic = {.k = photons.caustic_k, .largest_radius = 0.1f},
                                       .indirect = {.k = photons.indirect_k},
                                       .gather_rays = photons.gather_rays};
        return judge.picture(photons.samples, seed, [&] {
            return
                [&, lookup = PhotonLookup(maps, asked)](const Ray& ray, Sampler& sampler) mutable {
                    return photon_radiance(s.tree, s.lit, s.lights, lookup, ray, sampler);
                };
        });
    });
}

void add_cache(const Judge& judge, const std::string& method, const RadianceCacheConfig& config,
               std::uint32_t samples) {
    const TracedScene& s = judge.scene;
    judge.add(method,
              fmt::format("{}, {} rays, {} a pixel", config.accuracy,
                          with_commas(static_cast<std::uint64_t>(config.grid.cells())), samples),
              [&](std::uint64_t seed, std::uint64_t& work) {
                  RadianceCacheConfig seeded = config;
                  seeded.seed = seed;
                  const IrradianceCache cache =
                      fill_cache(s.tree, s.lit, s.lights, s.pixels(), seeded, judge.threads);
                  work = cache.records().size();
                  return judge.picture(samples, seed, [&] {
                      return [&](const Ray& ray, Sampler& sampler) {
                          return cache_radiance(s.tree, s.lit, s.lights, cache, ray, sampler);
                      };
                  });
              });
}

/// How finely a cache is filled, and how many points of lights are asked for each pixel beside it.
struct CacheSetting {
    double accuracy;
    HemisphereGrid grid;  ///< of a record's rays
    std::uint32_t samples;
    bool constant = true;  ///< also without gradients
};
/// How much of everything, by how much a run may take.
struct ConvergenceSizes {
    int caustic_width, room_width;
    std::uint32_t reference_samples;              ///< a pixel, twice
    std::uint32_t reference_photons, batches;     ///< twice
    std::uint32_t caustic_samples, room_samples;  ///< the most for paths
    std::vector<std::uint32_t> photons;
    std::uint32_t indirect_photons;  ///< beside those of a caustic
    std::vector<CacheSetting> caches;
    std::vector<int> gather_rays;
    std::uint32_t samples;  ///< a pixel, where photons are asked
};
ConvergenceSizes sizes_of(const Options& options) {
    switch (options.amount()) {
        case Amount::small:
            return {.caustic_width = 24,
                    .room_width = 24,
                    .reference_samples = 8,
                    .reference_photons = 10'000,
                    .batches = 1,
                    .caustic_samples = 16,
                    .room_samples = 4,
                    .photons = {1'000, 3'000},
                    .indirect_photons = 1'000,
                    .caches = {{0.8, {4, 12}, 4}},
                    .gather_rays = {1},
                    .samples = 1};
        case Amount::quick:
            return {.caustic_width = 80,
                    .room_width = 64,
                    .reference_samples = 64,
                    .reference_photons = 500'000,
                    .batches = 2,
                    .caustic_samples = 64,
                    .room_samples = 16,
                    .photons = {10'000, 100'000},
                    .indirect_photons = 10'000,
                    .caches = {{0.8, {24, 72}, 16}, {0.4, {24, 72}, 64}},
                    .gather_rays = {1},
                    .samples = 2};
        case Amount::full:
            break;
    }
    return {.caustic_width = 160,
            .room_width = 128,
            .reference_samples = 512,
            .reference_photons = 1'000'000,
            .batches = 4,
            .caustic_samples = 256,
            .room_samples = 64,
            .photons = {10'000, 30'000, 100'000, 300'000, 1'000'000, 3'000'000},
            .indirect_photons = 20'000,
            .caches = {{0.8, {24, 72}, 64},
                       {0.4, {24, 72}, 128},
                       {0.2, {48, 144}, 128},
                       {0.15, {48, 144}, 256, false}},
            .gather_rays = {1, 2},
            .samples = 8};
}

TracedScene traced(const std::string& name, const Options& options, int width) {
    return {name, make_lit_scene(name, options.seed, options.small), width, width * 3 / 4};
}

Convergence begun(const TracedScene& scene, const References& references, double target) {
    return {.scene = scene.name,
            .width = scene.width,
            .height = scene.height,
            .judged = references.judged.size(),
            .target = target,
            .resolution = references.resolution(),
            .points = {}};
}

Convergence measure_caustic(const Options& options) {
    const ConvergenceSizes sizes = sizes_of(options);
    const TracedScene scene = traced("ring", options, sizes.caustic_width);
    const References references =
        caustic_references(scene, sizes.reference_samples / 8, sizes.reference_photons,
                           sizes.batches, options.threads);
    Convergence found = begun(scene, references, 0.05);
    const Judge judge{scene, references, found, options.threads};
    add_paths(judge, 16, sizes.caustic_samples);
    // Of few photons many are too far away.
    for (const std::uint32_t k : {30u, 100u, 300u})
        for (const std::uint32_t aimed : sizes.photons)
            if (aimed >= 600 * k || (options.small && k == 30))
                add_photons(judge, fmt::format("photons, k = {}", k),
                            fmt::format("{} aimed", with_commas(aimed)),
                            {.count = sizes.indirect_photons,
                             .aimed = aimed,
                             .caustic_k = k,
                             .samples = sizes.samples});
    for (const std::uint32_t count : sizes.photons)
        if (count <= 1'000'000)
            add_photons(judge, "photons to all sides, k = 30",
                        fmt::format("{} emitted", with_commas(count)),
                        {.count = count, .samples = sizes.samples});
    return found;
}

Convergence measure_room(const std::string& name, int width, const ConvergenceSizes& sizes,
                         const Options& options) {
    const TracedScene scene = traced(name, options, width);
    const References references = path_references(scene, sizes.reference_samples, options.threads);
    Convergence found = begun(scene, references, 0.02);
    const Judge judge{scene, references, found, options.threads};
    add_paths(judge, 1, sizes.room_samples);
    for (const std::uint32_t k : {50u, 200u})
        for (const std::uint32_t count : sizes.photons)
            if ((count >= 400 * k || (options.small && k == 50)) && count <= 1'000'000)
                add_photons(judge, fmt::format("photons, k = {}", k),
                            fmt::format("{} emitted", with_commas(count)),
                            {.count = count, .indirect_k = k, .samples = sizes.samples});
    for (const int rays : sizes.gather_rays)
        add_photons(judge, "photons, gathered", counted(static_cast<std::uint64_t>(rays), "ray"),
                    {.count = std::min(100'000u, sizes.photons.back()),
                     .indirect_k = 100,
                     .gather_rays = rays,
                     .samples = 2 * sizes.samples});  // or noise hides the bias
    for (const bool gradients : {false, true})
        for (const CacheSetting& cache : sizes.caches)
            if (gradients || cache.constant)
                add_cache(judge, gradients ? "cache, gradients" : "cache, constant",
                          {.accuracy = cache.accuracy, .grid = cache.grid, .gradients = gradients},
                          cache.samples);
    return found;
}

}  // namespace

std::vector<Convergence> measure_convergence(const Options& options) {
    std::vector<Convergence> all;
    if (options.counts) return all;
    all.push_back(measure_caustic(options));
    ConvergenceSizes sizes = sizes_of(options);
    all.push_back(measure_room("interior", sizes.room_width, sizes, options));
    if (options.amount() == Amount::full) {  // the dearest tells no more, nor do more rays
        sizes.caches.pop_back();
        sizes.caches.back() = {0.2, {24, 72}, 128};
    }
    all.push_back(measure_room("box", sizes.room_width * 3 / 5, sizes, options));
    return all;
}

}  // namespace space::ch11
