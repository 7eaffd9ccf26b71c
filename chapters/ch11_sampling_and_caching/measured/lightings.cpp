#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/measured/sampling.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/camera.hpp"
#include "common/measure.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace space::ch11 {
namespace {

constexpr std::pair<Lighting, std::string_view> all_lightings[] = {
    {Lighting::uniform, "uniform"},     {Lighting::cosine, "cosine"},
    {Lighting::area, "area"},           {Lighting::solid_angle, "solid angle"},
    {Lighting::mis_area, "both, area"}, {Lighting::mis_solid_angle, "both, solid angle"}};

/// Rays through the centres of those pixels that show a diffuse surface.
std::vector<Ray> rays_to_diffuse(const FastBvh<>& tree, const LitScene& lit,
                                 const PixelGrid& pixels) {
    std::vector<Ray> rays;
    for (const Ray& ray : camera_rays(pixels)) {
        const std::optional<Hit> hit = closest_hit(tree, ray);
        if (hit && !lit.is_mirror(hit->triangle) &&
            lit.emitted(hit->triangle, true) == Double3(0.0))
            rays.push_back(ray);
    }
    return rays;
}

/// Direct light on what the eye sees; before a mirror also the light that comes by way of it.
void measure_lightings_of(const std::string& name, const Options& options,
                          std::vector<LightingPoint>& points) {
    const LitScene lit = make_lit_scene(name, options.seed, options.small);
    const LightTable lights(lit);
    const auto tree = FastBvh<>::build(lit.triangles);
    const int width = options.small ? 12 : options.quick ? 24 : 32;
    const std::vector<Ray> rays =
        rays_to_diffuse(tree, lit, {lit.scene.camera, width, width * 3 / 4});
    constexpr std::uint32_t rounds = 4;
    const std::uint32_t a_round = options.small ? 4 : options.quick ? 64 : 256;
    std::array<std::vector<RunningMean>, std::size(all_lightings)> means;
    std::array<std::vector<double>, std::size(all_lightings)> times;
    for (auto& of : means) of.resize(rays.size());
    for (std::uint32_t round = 0; round < rounds; ++round)
        for (std::size_t w = 0; w < std::size(all_lightings); ++w) {
            const PathConfig config{.lighting = all_lightings[w].first,
                                    .most_bounces = name == "mirror" ? 2 : 1};
            Sampler sampler(SamplePattern::independent, 1, options.seed + 1 + w);
            Stopwatch stopwatch;
            for (std::size_t i = 0; i < rays.size(); ++i)
                for (std::uint32_t s = round * a_round; s < (round + 1) * a_round; ++s) {
                    sampler.start(i, s);
                    means[w][i].add(
                        luminance(path_radiance(tree, lit, lights, rays[i], sampler, config)));
                }
            times[w].push_back(1e6 * stopwatch.lap().count() / (double(rays.size()) * a_round));
        }
    for (std::size_t w = 0; w < std::size(all_lightings); ++w) {
        LightingPoint point{.scene = name, .lighting = all_lightings[w].second};
        double variance = 0.0;
        for (const RunningMean& mean : means[w]) {
            point.mean += mean.mean / double(rays.size());
            variance += mean.variance() / double(rays.size());
        }
        point.mean_error = std::sqrt(variance / (double(rays.size()) * rounds * a_round));
        point.variance = variance / (point.mean * point.mean);
        point.ns = median(times[w]);
        points.push_back(point);
    }
}

/// Counts what is asked of a tree.
struct CountedRays {
    const FastBvh<>& tree;
    std::uint64_t& path_rays;
    std::uint64_t& shadow_rays;

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        ++path_rays;
        return tree.closest_hit(ray, counts);
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        ++shadow_rays;
        return tree.any_hit(ray, counts);
    }
    TreeShape shape() const { return tree.shape(); }
};

}  // namespace

std::vector<LightingPoint> measure_lightings(const Options& options) {
    std::vector<LightingPoint> points;
    for (const char* scene : {"near", "far", "large", "corner", "mirror"})
        measure_lightings_of(scene, options, points);
    return points;
}

std::vector<PathWorkPoint> measure_path_work(const Options& options) {
    std::vector<PathWorkPoint> points;
    for (const char* scene : {"far", "mirror", "ring", "box", "interior"}) {
        const LitScene lit = make_lit_scene(scene, options.seed, options.small);
        const LightTable lights(lit);
        const auto tree = FastBvh<>::build(lit.triangles);
        PathWorkPoint point{.scene = scene};
        const CountedRays counted{tree, point.path_rays, point.shadow_rays};
        const int width = options.small ? 16 : 80;
        const std::vector<Ray> rays =
            camera_rays(PixelGrid(lit.scene.camera, width, width * 3 / 4));
        Sampler sampler(SamplePattern::sobol, 16, options.seed);
        for (std::size_t i = 0; i < rays.size(); ++i)
            for (std::uint32_t s = 0; s < (options.small ? 4u : 16u); ++s, ++point.samples) {
                sampler.start(i, s);
                path_radiance(counted, lit, lights, rays[i], sampler);
            }
        points.push_back(point);
    }
    return points;
}

}  // namespace space::ch11
