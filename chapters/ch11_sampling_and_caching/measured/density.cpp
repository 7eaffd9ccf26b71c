#include "chapters/ch11_sampling_and_caching/measured/density.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch11_sampling_and_caching/aimed_photons.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/measured/sampling_data.hpp"
#include "chapters/ch11_sampling_and_caching/photon_map.hpp"
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace space::ch11 {
namespace {

using PhotonTree = Bvh<BinnedBuilder>;

/// Photons spread evenly over a square of 2 x 2: so many, of irradiance 1 together.
PhotonMap even_photons(std::uint32_t count, Pcg32& random) {
    std::vector<Photon> photons(count);
    for (Photon& photon : photons) {
        photon.position.x = random.uniform(-1.0f, 1.0f);
        photon.position.z = random.uniform(-1.0f, 1.0f);
        photon.normal = {0, 1, 0};
        photon.power = Double3(4.0 / static_cast<double>(count));
    }
    return PhotonMap::build(photons);
}

std::vector<DensityPoint> measure_densities(const Options& options) {
    std::vector<DensityPoint> points;
    for (const std::size_t k : {3u, 5u, 10u, 50u, 200u}) {
        Pcg32 random(options.seed);
        RunningMean all_of_k, less_one;
        for (int map = 0; map < (options.small ? 5 : 200); ++map) {
            const PhotonMap photons = even_photons(4'000, random);
            DensityEstimator density(photons, {.k = k});
            for (int i = 0; i < 20; ++i) {
                Point3 at{0.0f};
                at.x = random.uniform(-0.5f, 0.5f);
                at.z = random.uniform(-0.5f, 0.5f);
                all_of_k.add(plain_density(photons, at, k, infinity).x);
                less_one.add(density.irradiance(Double3(at), {0, 1, 0}).x);
            }
        }
        points.push_back(
            {k, less_one.count, all_of_k.mean, less_one.mean, std::sqrt(less_one.variance())});
    }
    return points;
}

/// Means over seeds of both estimates at a point of a floor.
struct FloorLight {
    RunningMean plain, own_surface;

    void add(const PhotonMap& map, const Double3& at) {
        constexpr std::size_t k = 50;
        DensityEstimator density(map, {.k = k});
        plain.add(luminance(plain_density(map, Point3(at), k, infinity)));
        own_surface.add(luminance(density.irradiance(at, {0, 1, 0})));
    }
};

/// Calls use(map) for maps of all photons of a scene, of seeds of their own.
template <class Use>
void for_each_map(const LitScene& lit, const Options& options, const Use& use) {
    const LightTable lights(lit);
    const auto tree = PhotonTree::build(lit.triangles);
    const std::uint64_t seeds = options.small ? 3 : 100;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        use(PhotonMap::build(
            trace_photons(tree, lit, lights,
                          {.count = 10'000, .seed = seed, .threads = options.threads})
                .photons));
}

/// In the white furnace the irradiance is pi everywhere; behind the thin wall there is none.
std::vector<PhotonLeakPoint> measure_photon_leaks(const Options& options) {
    const std::pair<std::string_view, Double3> places[] = {{"middle of a floor", {0.5, 0, 0.5}},
                                                           {"edge", {-0.99, 0, 0.5}},
                                                           {"corner", {-0.99, 0, -0.99}}};
    std::vector<FloorLight> found(std::size(places));
    for_each_map(make_lit_scene("furnace", 1, true), options, [&](const PhotonMap& map) {
        for (std::size_t i = 0; i < found.size(); ++i) found[i].add(map, places[i].second);
    });
    std::vector<PhotonLeakPoint> points;
    for (std::size_t i = 0; i < found.size(); ++i)
        points.push_back({places[i].first, 1.0, found[i].plain.mean / std::numbers::pi,
                          found[i].own_surface.mean / std::numbers::pi});

    FloorLight dark, bright;
    for_each_map(make_lit_scene("wall", 1, true), options, [&](const PhotonMap& map) {
        dark.add(map, {0.02, 0, 0});
        bright.add(map, {-0.02, 0, 0});
    });
    points.push_back({"dark foot of a thin wall, lit one = 1", 0.0,
                      dark.plain.mean / bright.plain.mean,
                      dark.own_surface.mean / bright.own_surface.mean});
    return points;
}

std::vector<PhotonCountPoint> measure_photon_counts(const Options& options) {
    std::vector<PhotonCountPoint> points;
    for (const char* scene : {"box", "interior", "ring"}) {
        const LitScene lit = make_lit_scene(scene, options.seed, options.small);
        const LightTable lights(lit);
        const auto tree = PhotonTree::build(lit.triangles);
        const PhotonConfig config{.count = options.small ? 2'000u : 100'000u,
                                  .seed = options.seed,
                                  .threads = options.threads};
        const PhotonTrace trace = trace_photons(tree, lit, lights, config),
                          aimed = trace_aimed_photons(tree, lit, lights, config);
        PhotonCountPoint point{.scene = scene, .emitted = trace.counts.emitted};
        for (const Photon& photon : trace.photons)
            ++(photon.path == PhotonPath::direct    ? point.direct
               : photon.path == PhotonPath::caustic ? point.caustic
                                                    : point.indirect);
        point.aimed = aimed.counts.emitted;
        point.aimed_stored = aimed.photons.size();
        for (const PhotonCounts& c : {trace.counts, aimed.counts})
            point.lost += c.emitted - c.absorbed - c.left - c.stopped;
        point.bytes =
            double(PhotonMap::build(trace.photons).bytes()) / double(trace.photons.size());
        points.push_back(point);
    }
    return points;
}

}  // namespace

DensityMeasurements measure_density(const Options& options) {
    return {.densities = measure_densities(options),
            .photon_leaks = measure_photon_leaks(options),
            .photons = measure_photon_counts(options),
            .cache_leaks = measure_cache_leaks(options),
            .records = measure_cache_counts(options)};
}

}  // namespace space::ch11
