#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch11_sampling_and_caching/form_factors.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/measured/sampling.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/photon_map.hpp"
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"
#include "chapters/ch11_sampling_and_caching/radiosity.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/scenes/shapes.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace space::ch11 {
namespace {

using PlainTree = Bvh<BinnedBuilder>;

/// The mean of estimate(sampler), so many samples a seed.
template <class Estimate>
void add_reference(std::vector<ReferencePoint>& points, ReferencePoint point, std::uint64_t seeds,
                   std::uint32_t samples, const Estimate& estimate) {
    RunningMean mean;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Sampler sampler(SamplePattern::independent, samples, seed);
        double sum = 0.0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            sampler.start(0, i);
            sum += estimate(sampler);
        }
        mean.add(sum / samples);
    }
    point.mean = mean.mean;
    point.error = mean.error();
    point.seeds = seeds;
    points.push_back(std::move(point));
}

/// The surface straight below a point.
SurfacePoint below(const PlainTree& tree, const LitScene& lit, const Point3& point) {
    const Ray down{.origin = point, .direction = {0, -1, 0}};
    return surface_point(lit, down, *closest_hit(tree, down));
}

/// The irradiance from photons of all kinds, of traces with seeds of their own.
void add_photons_reference(std::vector<ReferencePoint>& points, ReferencePoint point,
                           std::uint64_t seeds, const PlainTree& tree, const LitScene& lit,
                           const SurfacePoint& at, float radius) {
    const LightTable lights(lit);
    std::uint64_t seed = 0;
    add_reference(points, std::move(point), seeds, 1, [&](Sampler&) {
        const PhotonTrace trace =
            trace_photons(tree, lit, lights, {.count = 2'000, .seed = ++seed});
        const PhotonMap map = PhotonMap::build(trace.photons);
        DensityEstimator density(map, {.k = 20, .largest_radius = radius});
        return luminance(density.irradiance(at.position, at.normal)) / std::numbers::pi;
    });
}

void add_furnace(std::vector<ReferencePoint>& points, std::uint64_t seeds) {
    const LitScene lit = make_lit_scene("furnace", 1, true);
    const LightTable lights(lit);
    const auto tree = PlainTree::build(lit.triangles);
    const PixelGrid pixels(lit.scene.camera, 16, 12);
    constexpr std::pair<Lighting, const char*> ways[] = {
        {Lighting::cosine, "paths, cosine"}, {Lighting::mis_solid_angle, "paths, both"}};
    for (const auto& [lighting, name] : ways)
        add_reference(points, {.what = "white furnace, radiance", .estimator = name, .exact = 1.0},
                      seeds, 16, [&](Sampler& sampler) {
                          const Double2 at = sampler.next_pair();
                          const Ray ray = pixels.ray_through(16.0 * at.x, 12.0 * at.y);
                          return luminance(path_radiance(tree, lit, lights, ray, sampler,
                                                         {.lighting = lighting}));
                      });
    add_photons_reference(
        points, {.what = "white furnace, irradiance / pi", .estimator = "photons", .exact = 1.0},
        seeds, tree, lit, below(tree, lit, {0.5f, 0.25f, 0.5f}), 0.25f);
}

/// Irradiance by the light above a floor; nothing stands between.
void add_rectangle(std::vector<ReferencePoint>& points, std::uint64_t seeds) {
    const LitScene lit = make_lit_scene("near", 1, true);
    const LightTable lights(lit);
    const auto tree = PlainTree::build(lit.triangles);
    const SurfacePoint at = below(tree, lit, {0.0625f, 0.03125f, 0.046875f});
    double exact = 0.0;
    for (const TriangleLight& light : lights.lights()) {
        const std::array<Double3, 3> corners{Double3(light.triangle.a), Double3(light.triangle.b),
                                             Double3(light.triangle.c)};
        exact += luminance(light.radiance) * polygon_irradiance(at.position, at.normal, corners);
    }
    constexpr std::pair<Lighting, const char*> ways[] = {
        {Lighting::uniform, "uniform"},     {Lighting::cosine, "cosine"},
        {Lighting::area, "area"},           {Lighting::solid_angle, "solid angle"},
        {Lighting::mis_area, "both, area"}, {Lighting::mis_solid_angle, "both, solid angle"}};
    for (const auto& [lighting, name] : ways)
        add_reference(
            points, {.what = "below a rectangle, irradiance", .estimator = name, .exact = exact},
            seeds, 64, [&](Sampler& sampler) {
                return luminance(direct_irradiance(tree, lit, lights, at, sampler, lighting));
            });
}

/// A closed room of grey walls whose ceiling shines, as rectangles.
std::vector<Wall> grey_room() {
    const Double3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    return {{{{0, 0, 0}, z, x}, 0.5, 0.0},  {{{0, 1, 0}, x, z}, 0.25, 1.0},
            {{{0, 0, 0}, x, y}, 0.75, 0.0}, {{{0, 0, 1}, y, x}, 0.75, 0.0},
            {{{0, 0, 0}, y, z}, 0.5, 0.0},  {{{1, 0, 0}, z, y}, 0.25, 0.0}};
}
/// The same of triangles.
LitScene lit_room(const std::vector<Wall>& walls) {
    Scene scene;
    std::vector<Color> emission;
    for (const Wall& wall : walls) {
        add(scene, parallelogram(wall.shape.corner, wall.shape.u, wall.shape.v),
            Color(static_cast<float>(wall.reflectance)));
        emission.resize(scene.mesh.faces.size(), Color(static_cast<float>(wall.emission)));
    }
    return lit(std::move(scene), std::move(emission));
}

void add_closed_room(std::vector<ReferencePoint>& points, std::uint64_t seeds, int cuts) {
    const std::vector<Wall> walls = grey_room();
    const LitScene lit = lit_room(walls);
    const LightTable lights(lit);
    const auto tree = PlainTree::build(lit.triangles);
    const SurfacePoint at = below(tree, lit, {0.40625f, 0.5f, 0.53125f});
    const auto irradiance_by = [&](int n) {
        const Patches patches = cut_walls(walls, n);
        return room_irradiance(patches, patch_radiances(patches, walls), at.position, at.normal);
    };
    const double coarse = irradiance_by(cuts), fine = irradiance_by(2 * cuts);
    const auto point = [&](const char* estimator, double over) {
        return ReferencePoint{.what = "closed room, irradiance / pi",
                              .estimator = estimator,
                              .exact = fine / over,
                              .exact_error = 2.0 * std::abs(fine - coarse) / over};
    };
    add_reference(points, point("paths", std::numbers::pi), seeds, 64, [&](Sampler& sampler) {
        const Double3 direction = cosine_hemisphere(at.normal, sampler.next_pair()).direction;
        return path_radiance(tree, lit, lights, ray_from(at, direction), sampler).x;
    });
    add_photons_reference(points, point("photons", std::numbers::pi), seeds, tree, lit, at, 0.09f);
    const double direct =
        polygon_irradiance(at.position, at.normal, walls[1].shape.corners()) * walls[1].emission;
    std::uint64_t seed = 0;
    add_reference(points, point("a cache's record", std::numbers::pi), seeds, 1, [&](Sampler&) {
        RadianceCacheConfig config{.grid = {6, 18}};
        config.seed = ++seed;
        const IrradianceRecord record =
            gather_record(tree, lit, lights, nullptr, at, 0, radius_limits(lit, config), config);
        return (record.irradiance.x + direct) / std::numbers::pi;
    });
}

}  // namespace

std::vector<ReferencePoint> measure_references(const Options& options) {
    std::vector<ReferencePoint> points;
    const std::uint64_t seeds = options.small ? 25 : 400;
    add_furnace(points, seeds);
    add_rectangle(points, seeds);
    add_closed_room(points, seeds, options.small ? 3 : 6);
    return points;
}

}  // namespace space::ch11
