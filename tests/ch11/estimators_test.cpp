// Every estimator of the chapter against light that is known in closed form, and wrong ones, which
// the same comparison must find.
//
// An estimator is run with 100 seeds (sanitized: 20), many samples each. The means of the seeds are
// independent and nearly normal, so their mean's distance from the true value, in its own standard
// error, has Student's distribution with 99 degrees of freedom: more than 5 has the
// probability 2.5e-6. Here are some 300 comparisons: with other seeds one of a thousand runs would
// fail without a fault. The seeds are fixed, so none does. What is found must also be worth it:
// five standard errors are at most a few percent of the value, and each wrong estimator is farther
// off than that.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch11_sampling_and_caching/form_factors.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance.hpp"
#include "chapters/ch11_sampling_and_caching/lit_stage.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/photon_radiance.hpp"
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"
#include "chapters/ch11_sampling_and_caching/radiosity.hpp"
#include "common/scenes/shapes.hpp"
#include "tests/ch11/statistics.hpp"
#include "tests/ch11/up.hpp"
#include "tests/check.hpp"

#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int seeds = sized(100, 20);

struct Surface {
    Rectangle shape;
    Color reflectance{0.0f}, emission{0.0f};
    bool is_mirror = false;
};

/// A scene with all that it takes to ask for light in it.
struct World {
    LitScene lit;
    LightTable lights;
    Naive<FilteredExact> tracer;

    explicit World(LitScene scene)
        : lit(std::move(scene)), lights(lit), tracer(Naive<FilteredExact>::build(lit.triangles)) {}

    /// What a ray sees that comes to this point from before it.
    Ray ray_to(const Double3& point, const Double3& normal) const {
        return {.origin = Point3(point + 0.125 * normal), .direction = Vector3(-normal)};
    }
    SurfacePoint at(const Double3& point, const Double3& normal) const {
        const Ray ray = ray_to(point, normal);
        return surface_point(lit, ray, closest_hit(tracer, ray).value());
    }
};

World world(std::span<const Surface> surfaces, const Color& sky = Color(0.0f)) {
    LitStage stage;
    std::vector<Color> emission;
    std::vector<std::uint8_t> mirror;
    for (const Surface& s : surfaces) {
        stage.add(parallelogram(s.shape.corner, s.shape.u, s.shape.v), s.reflectance);
        emission.insert(emission.end(), 2, s.emission);
        mirror.insert(mirror.end(), 2, s.is_mirror);
    }
    stage.scene.background = sky;
    return World(lit(stage.scene, emission, mirror));
}

/// Red, green and blue over all seeds.
using Means = std::array<Mean, 3>;

/// `estimate(sampler)`, so many times for each seed.
template <class Estimate>
Means over_seeds(int samples, const Estimate& estimate,
                 SamplePattern pattern = SamplePattern::sobol) {
    Means means;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Sampler sampler(pattern, static_cast<std::uint32_t>(samples), seed);
        Double3 sum{0.0};
        for (int i = 0; i < samples; ++i) {
            sampler.start(0, static_cast<std::uint32_t>(i));
            sum += estimate(sampler) / static_cast<double>(samples);
        }
        for (int c = 0; c < 3; ++c) means[std::size_t(c)].add(sum[c]);
    }
    return means;
}

/// Whether each colour may be the exact one, which is known within `bound`. Not NaN.
bool agree(const Means& means, const Double3& exact, const Double3& bound = Double3(0.0)) {
    for (std::size_t c = 0; c < 3; ++c) {
        const double off = std::abs(means[c].mean() - exact[int(c)]);
        const double rounding = 1e-12 * exact[int(c)];
        if (!(off <= 5.0 * means[c].error() + bound[int(c)] + rounding)) return false;
    }
    return true;
}

/// That they agree, and that a part of `seen` more or less would not have been overlooked.
void check(const std::string& what, const Means& means, const Double3& exact,
           const Double3& bound = Double3(0.0), double seen = 0.05) {
    const Double3 is{means[0].mean(), means[1].mean(), means[2].mean()};
    const Double3 error{means[0].error(), means[1].error(), means[2].error()};
    CAPTURE(what, is, exact, error, bound);
    CHECK(agree(means, exact, bound));
    if (!is_sanitized) CHECK(glm::all(glm::lessThan(5.0 * error + bound, seen * exact)));
}

constexpr Lighting all_ways[] = {Lighting::uniform,  Lighting::cosine,
                                 Lighting::area,     Lighting::solid_angle,
                                 Lighting::mis_area, Lighting::mis_solid_angle};
constexpr const char* way_names[] = {"uniform",     "cosine",   "area",
                                     "solid angle", "mis area", "mis solid angle"};

// ------------------------------------------------------------------ direct light, by Lambert

const Rectangle ground{{-8, -8, 0}, {16, 0, 0}, {0, 16, 0}};
const Color lamp_colour{3, 2, 1};

/// A rectangle at this height that looks down.
Rectangle panel(double x, double y, double z, double width, double depth) {
    return {{x, y, z}, {0, depth, 0}, {width, 0, 0}};
}
Double3 lambert(const Rectangle& lamp, const Color& colour) {
    return polygon_irradiance(Double3(0.0), up, lamp.corners()) * Double3(colour);
}

/// A scene and the irradiance of its floor at the origin.
struct Known {
    const char* name;
    World world;
    Double3 irradiance;
};

Known below_a_lamp() {
    const Rectangle lamp = panel(-0.5, -0.25, 0.75, 1.5, 1);
    return {"below a lamp", world(std::array{Surface{ground}, Surface{lamp, {}, lamp_colour}}),
            lambert(lamp, lamp_colour)};
}
/// Half of it is below the horizon, and the floor before that half.
Known beside_a_lamp() {
    const Rectangle lamp{{1, -1, -1}, {0, 0, 2}, {0, 2, 0}};
    return {"beside a lamp that the horizon cuts",
            world(std::array{Surface{ground}, Surface{lamp, {}, lamp_colour}}),
            lambert(lamp, lamp_colour)};
}
/// Lamps of different power and colour, of which one shows its back.
Known among_lamps() {
    const Rectangle left = panel(-2, -1, 1, 1, 2), right = panel(0.5, 0, 2, 2, 2);
    const Rectangle away{{-0.5, -3, 1.5}, {1, 0, 0}, {0, 1, 0}};
    const Color red{4, 0.5f, 0.25f}, blue{0.25f, 0.5f, 6}, white{2};
    return {"among lamps",
            world(std::array{Surface{ground}, Surface{left, {}, red}, Surface{right, {}, blue},
                             Surface{away, {}, white}}),
            lambert(left, red) + lambert(right, blue)};
}
/// A board keeps the left half of the lamp's light away.
Known in_a_shadow() {
    const Rectangle lamp = panel(-1, -0.5, 1, 2, 1), seen = panel(0, -0.5, 1, 1, 1);
    return {"in a half shadow",
            world(std::array{Surface{ground}, Surface{lamp, {}, lamp_colour},
                             Surface{panel(-3, -3, 0.5, 3, 6)}}),
            lambert(seen, lamp_colour)};
}

std::vector<Known> known() {
    std::vector<Known> all;
    all.push_back(below_a_lamp());
    all.push_back(beside_a_lamp());
    all.push_back(among_lamps());
    all.push_back(in_a_shadow());
    return all;
}

}  // namespace

TEST_CASE("direct light: every way of lighting has Lambert's irradiance for its mean") {
    for (const Known& scene : known()) {
        const SurfacePoint floor = scene.world.at(Double3(0.0), up);
        for (std::size_t way = 0; way < 6; ++way)
            check(std::string(scene.name) + ", " + way_names[way],
                  over_seeds(sized(512, 16),
                             [&](Sampler& sampler) {
                                 return direct_irradiance(scene.world.tracer, scene.world.lit,
                                                          scene.world.lights, floor, sampler,
                                                          all_ways[way]);
                             }),
                  scene.irradiance);
    }
}

TEST_CASE("direct light: and so with each pattern of samples") {
    const Known scene = in_a_shadow();
    const SurfacePoint floor = scene.world.at(Double3(0.0), up);
    for (const SamplePattern pattern :
         {SamplePattern::independent, SamplePattern::stratified, SamplePattern::sobol})
        for (std::size_t way = 0; way < 6; ++way)
            check(way_names[way],
                  over_seeds(
                      sized(1024, 16),
                      [&](Sampler& sampler) {
                          return direct_irradiance(scene.world.tracer, scene.world.lit,
                                                   scene.world.lights, floor, sampler,
                                                   all_ways[way]);
                      },
                      pattern),
                  scene.irradiance);
}

TEST_CASE("the sky: pi of it, in every way of lighting, and what a lamp adds and hides") {
    const Rectangle lamp = panel(-0.5, -0.25, 0.75, 1.5, 1);
    const Color sky{0.5f, 0.25f, 2};
    const World open =
        world(std::array{Surface{ground, Color(0.5f)}, Surface{lamp, {}, lamp_colour}}, sky);
    const SurfacePoint floor = open.at(Double3(0.0), up);
    const Double3 exact = lambert(lamp, lamp_colour) + pi * Double3(sky) - lambert(lamp, sky);
    for (std::size_t way = 0; way < 6; ++way) {
        check(way_names[way],
              over_seeds(sized(512, 16),
                         [&](Sampler& sampler) {
                             return direct_irradiance(open.tracer, open.lit, open.lights, floor,
                                                      sampler, all_ways[way]);
                         }),
              exact);
        // The lamp's front is black: no light is reflected twice.
        check(way_names[way],
              over_seeds(sized(512, 16),
                         [&](Sampler& sampler) {
                             return path_radiance(open.tracer, open.lit, open.lights,
                                                  open.ray_to(Double3(0.0), up), sampler,
                                                  {.lighting = all_ways[way]});
                         }),
              0.5 / pi * exact);
    }
}

TEST_CASE("a mirror: the lamp's image shines as if it stood behind it, dimmed") {
    // The mirror stands at x = -1 and is large enough for all of the image, at x - 2 ... below.
    const Rectangle lamp = panel(0.5, -0.5, 1, 1, 1), image = panel(-3.5, -0.5, 1, 1, 1);
    const Color dims{0.5f, 0.75f, 0.875f}, floor_colour{0.25f, 0.5f, 0.75f};
    const World hall =
        world(std::array{Surface{ground, floor_colour}, Surface{lamp, {}, lamp_colour},
                         Surface{{{-1, -6, 0}, {0, 12, 0}, {0, 0, 6}}, dims, {}, true}});
    const Double3 exact = lambert(lamp, lamp_colour) + Double3(dims) * lambert(image, lamp_colour);
    for (std::size_t way = 0; way < 6; ++way)
        check(way_names[way],
              over_seeds(sized(512, 16),
                         [&](Sampler& sampler) {
                             return path_radiance(hall.tracer, hall.lit, hall.lights,
                                                  hall.ray_to(Double3(0.0), up), sampler,
                                                  {.lighting = all_ways[way]});
                         }),
              Double3(floor_colour) / pi * exact);

    SECTION("photons: as much arrives on a part of the floor by way of the mirror") {
        const Rectangle part{{-1, -2, 0}, {2, 0, 0}, {0, 4, 0}};
        const Double3 flux = pi * Double3(dims) * Double3(lamp_colour) * exchange_area(image, part);
        for (const bool is_aimed : {false, true}) {
            Means means;
            for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
                const PhotonConfig config{
                    .count = sized(2'048u, 64u), .seed = seed, .pattern = SamplePattern::sobol};
                const PhotonTrace trace =
                    is_aimed ? trace_aimed_photons(hall.tracer, hall.lit, hall.lights, config)
                             : trace_photons(hall.tracer, hall.lit, hall.lights, config);
                Double3 sum{0.0};
                for (const Photon& photon : trace.photons)
                    if (photon.path == PhotonPath::caustic && photon.position.z < 0.01f &&
                        photon.position.x < 1.0f && std::abs(photon.position.y) < 2.0f)
                        sum += photon.power;
                for (int c = 0; c < 3; ++c) means[std::size_t(c)].add(sum[c]);
            }
            check(is_aimed ? "aimed" : "by chance", means, flux, Double3(0.0), 0.2);
        }
    }
}

TEST_CASE("what a mirror throws of light that a floor has reflected is no caustic") {
    // The lamp looks down; only the floor sends light to the mirror above.
    const World hall = world(std::array{Surface{ground, Color(0.9375f)},
                                        Surface{panel(-0.5, -0.5, 1, 1, 1), {}, lamp_colour},
                                        Surface{panel(-8, -8, 2, 16, 16), Color(1), {}, true}});
    const PhotonTrace trace = trace_photons(hall.tracer, hall.lit, hall.lights, {.count = 500});
    int direct = 0, caustic = 0, indirect = 0;
    for (const Photon& photon : trace.photons) {
        direct += photon.path == PhotonPath::direct;
        caustic += photon.path == PhotonPath::caustic;
        indirect += photon.path == PhotonPath::indirect;
    }
    CHECK(direct > 400);
    CHECK(indirect > 400);
    CHECK(caustic == 0);
}

// ------------------------------------------------------------------ all light of a closed room

namespace {

/// A room of 3 x 1.5 x 1.5 m: floor, four walls, and a ceiling of nine parts, the one in the middle
/// a lamp of radiance 8.
std::vector<Wall> room() {
    const Double3 x{3, 0, 0}, y{0, 1.5, 0}, z{0, 0, 1.5}, o{0.0};
    std::vector<Wall> walls{{{o, x, y}, 0.5},
                            {{o, y, z}, 0.75},
                            {{x, z, y}, 0.25},
                            {{o, z, x}, 0.5},
                            {{y, x, z}, 0.625}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const bool is_lamp = i == 1 && j == 1;
            walls.push_back({{z + double(j) * y / 3.0 + double(i) * x / 3.0, y / 3.0, x / 3.0},
                             is_lamp ? 0.0 : 0.75,
                             is_lamp ? 8.0 : 0.0});
        }
    return walls;
}
constexpr std::size_t lamp_of_room = 9;

World furnished(std::span<const Wall> walls) {
    std::vector<Surface> surfaces;
    for (const Wall& wall : walls)
        surfaces.push_back({wall.shape, Color(float(wall.reflectance)),
                            float(wall.emission) * Color(1.0f, 0.5f, 0.25f)});
    return world(surfaces);
}
const Double3 room_colour{1.0, 0.5, 0.25};

/// A ray to a point by chance of a wall.
Ray ray_to_wall(const World& world, const Rectangle& wall, Sampler& sampler) {
    const Double2 u = sampler.next_pair();
    const Double3 normal = glm::normalize(glm::cross(wall.u, wall.v));
    return world.ray_to(wall.corner + u.x * wall.u + u.y * wall.v, normal);
}

/// A furnace of coloured walls: all emit what they do not reflect.
World furnace() {
    std::vector<Surface> surfaces;
    const Color colours[] = {{0.75f, 0.5f, 0.25f}, {0.5f, 0.25f, 0.75f}, {0.25f, 0.75f, 0.5f}};
    std::size_t i = 0;
    for (const Wall& wall : room()) {
        const Color colour = colours[i++ % 3];
        surfaces.push_back({wall.shape, colour, Color(1.0f) - colour});
    }
    return world(surfaces);
}

/// All walls alike, and so white that roulette has to cut its probability down to 0.95.
std::vector<Surface> bright_furnace() {
    std::vector<Surface> surfaces;
    for (const Wall& wall : room())
        surfaces.push_back({wall.shape, Color(0.96875f), Color(0.03125f)});
    return surfaces;
}

}  // namespace

TEST_CASE("a furnace: radiance 1 in each colour, by paths in every way of lighting") {
    const World white = furnace();
    for (std::size_t way = 0; way < 6; ++way)
        for (const int roulette_from : {1, 3})
            check(way_names[way],
                  over_seeds(sized(128, 4),
                             [&](Sampler& sampler) {
                                 return path_radiance(
                                     white.tracer, white.lit, white.lights,
                                     white.ray_to({1, 0.5, 0}, up), sampler,
                                     {.lighting = all_ways[way], .roulette_from = roulette_from});
                             }),
                  Double3(1.0), Double3(0.0), 0.08);
}

TEST_CASE("a furnace that is nearly white, whose paths are long") {
    const World bright = world(bright_furnace());
    check("cosine",
          over_seeds(sized(32, 4),
                     [&](Sampler& sampler) {
                         return path_radiance(bright.tracer, bright.lit, bright.lights,
                                              bright.ray_to({1, 0.5, 0}, up), sampler,
                                              {.lighting = Lighting::cosine});
                     }),
          Double3(1.0), Double3(0.0), 0.3);
}

TEST_CASE("a furnace: irradiance pi by photons, where their disc lies on the floor") {
    const World white = furnace();
    const SurfacePoint floor = white.at({1.5, 0.75, 0}, up);
    for (const std::size_t k : {20u, 50u}) {
        Means means;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            const auto trace = trace_photons(white.tracer, white.lit, white.lights,
                                             {.count = sized(2'000u, 200u),
                                              .seed = seed,
                                              .pattern = SamplePattern::independent});
            const PhotonMap map = PhotonMap::build(trace.photons);
            DensityEstimator density(map, {.k = k, .largest_radius = 0.35f});
            Double3 sum{0.0};
            for (const double x : {0.5, 1.0, 1.5, 2.0, 2.5})
                for (const double y : {0.5, 1.0})
                    sum += density.irradiance({x, y, 0}, floor.normal) / 10.0;
            for (int c = 0; c < 3; ++c) means[std::size_t(c)].add(sum[c]);
        }
        check("k = " + std::to_string(k), means, Double3(pi), Double3(0.0), 0.05);
    }
}

TEST_CASE("a closed room: each wall's mean radiance is that of the radiosity system, by paths") {
    const std::vector<Wall> walls = room();
    const World lit_room = furnished(walls);
    const std::vector<WallRadiance> exact = wall_radiances(walls, sized(3, 2));
    for (std::size_t way = 0; way < 6; ++way)
        for (const std::size_t wall : {0u, 3u}) {  // the bounds of others are wider
            check(std::string(way_names[way]) + ", wall " + std::to_string(wall),
                  over_seeds(sized(256, 8),
                             [&](Sampler& sampler) {
                                 return path_radiance(
                                     lit_room.tracer, lit_room.lit, lit_room.lights,
                                     ray_to_wall(lit_room, walls[wall].shape, sampler), sampler,
                                     {.lighting = all_ways[way], .roulette_from = 1});
                             }),
                  exact[wall].radiance * room_colour, exact[wall].error * room_colour,
                  way < 2 ? 0.25 : 0.05);
        }
}

TEST_CASE("a closed room: as much light arrives at each wall in photons") {
    const std::vector<Wall> walls = room();
    const World lit_room = furnished(walls);
    const std::vector<WallRadiance> exact = wall_radiances(walls, sized(3, 2));
    std::vector<Means> means(walls.size());
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const PhotonTrace trace = trace_photons(
            lit_room.tracer, lit_room.lit, lit_room.lights,
            {.count = sized(1'024u, 64u), .seed = seed, .pattern = SamplePattern::sobol});
        std::vector<Double3> power(walls.size(), Double3(0.0));
        for (const Photon& photon : trace.photons)
            for (std::size_t wall = 0; wall < 5; ++wall) {  // which one its normal tells
                const Rectangle& shape = walls[wall].shape;
                if (glm::dot(Double3(photon.normal), glm::cross(shape.u, shape.v)) > 1.0)
                    power[wall] += photon.power;
            }
        for (std::size_t wall = 0; wall < 5; ++wall)
            for (int c = 0; c < 3; ++c) means[wall][std::size_t(c)].add(power[wall][c]);
    }
    for (std::size_t wall = 0; wall < 5; ++wall) {
        // What is reflected, over the reflectance: irradiance over pi.
        const double arriving = pi * walls[wall].shape.area() / walls[wall].reflectance;
        check("wall " + std::to_string(wall), means[wall],
              arriving * exact[wall].radiance * room_colour,
              arriving * exact[wall].error * room_colour, wall == 0 || wall == 3 ? 0.03 : 0.1);
    }
}

TEST_CASE("a closed room: what a record gathers is all light but the lamp's own") {
    const std::vector<Wall> walls = room();
    const World lit_room = furnished(walls);
    const Patches coarse = cut_walls(walls, sized(4, 2)), fine = cut_walls(walls, sized(8, 4));
    const std::vector<double> coarse_light = patch_radiances(coarse, walls),
                              fine_light = patch_radiances(fine, walls);
    const RadianceCacheConfig config{.grid = {sized(8, 3), sized(24, 8)}};
    for (const Double3& point : {Double3(1.5, 0.75, 0), Double3(0.5, 0.25, 0)}) {
        const auto indirect = [&](const Patches& patches, std::span<const double> light) {
            return room_irradiance(patches, light, point, up) -
                   8.0 * polygon_irradiance(point, up, walls[lamp_of_room].shape.corners());
        };
        const double exact = indirect(fine, fine_light);
        const double bound = std::abs(exact - indirect(coarse, coarse_light));
        Means means;
        for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
            RadianceCacheConfig seeded = config;
            seeded.seed = seed;
            const IrradianceRecord record = gather_record(
                lit_room.tracer, lit_room.lit, lit_room.lights, nullptr, lit_room.at(point, up), 7,
                radius_limits(lit_room.lit, config), seeded);
            for (int c = 0; c < 3; ++c) means[std::size_t(c)].add(record.irradiance[c]);
        }
        check("gathered", means, exact * room_colour, bound * room_colour, 0.06);
    }
}

// ------------------------------------------------------------------ wrong ones are found

namespace {

/// Direct light at a point, in a scene.
using Estimate = Double3 (*)(const World&, const SurfacePoint&, Sampler&);

bool is_seen(const World& w, const SurfacePoint& at, const LightSample& s) {
    return s.is_lit && glm::dot(at.normal, s.direction) > 0.0 &&
           !any_hit(w.tracer, ray_to_light(at.origin, s.light->triangle, s.point, s.light->normal));
}
LightSample by_area(const World& w, const SurfacePoint& at, Sampler& sampler) {
    const double choice = sampler.next();
    return sample_light_area(w.lights, Double3(at.origin), choice, sampler.next_pair());
}
LightSample by_solid_angle(const World& w, const SurfacePoint& at, Sampler& sampler) {
    const double choice = sampler.next();
    return sample_light_solid_angle(w.lights, Double3(at.origin), choice, sampler.next_pair());
}
double cosine_at(const SurfacePoint& at, const LightSample& s) {
    return glm::dot(at.normal, s.direction);
}
double cosine_of(const LightSample& s) {
    return -glm::dot(s.light->normal, s.direction);
}
Double3 none() {
    return Double3(0.0);
}
/// What a direction finds of lamps' fronts.
Double3 found(const World& w, const SurfacePoint& at, const Double3& direction) {
    const Ray ray = ray_from(at, direction);
    const std::optional<Hit> hit = closest_hit(w.tracer, ray);
    return hit ? w.lit.emitted(hit->triangle, seen_from_front(w.lit.triangles[hit->triangle], ray))
               : none();
}

struct Wrong {
    const char* name;
    Known (*scene)();
    Estimate estimate;
};
const Wrong wrong_ones[] = {
    {"area: without the cosine at the floor", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         return is_seen(w, at, s) ? s.radiance / s.pdf : none();
     }},
    {"area: without the cosine at the lamp", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         return is_seen(w, at, s) ? s.radiance * cosine_at(at, s) / (s.pdf * cosine_of(s)) : none();
     }},
    {"area: without the squared distance", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         return is_seen(w, at, s) ? s.radiance * cosine_at(at, s) * s.distance * s.distance / s.pdf
                                  : none();
     }},
    {"area: by the distance, not its square", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         return is_seen(w, at, s) ? s.radiance * cosine_at(at, s) * s.distance / s.pdf : none();
     }},
    {"area: without the chance of the lamp", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         return is_seen(w, at, s) ? s.radiance * cosine_at(at, s) * s.light->probability / s.pdf
                                  : none();
     }},
    {"area: as if lamps were chosen alike", among_lamps,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         const double alike = s.light ? 6.0 * s.light->probability : 1.0;
         return is_seen(w, at, s) ? s.radiance * cosine_at(at, s) * alike / s.pdf : none();
     }},
    {"area: without shadows", in_a_shadow,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         return s.is_lit && cosine_at(at, s) > 0.0 ? s.radiance * cosine_at(at, s) / s.pdf : none();
     }},
    {"area: lamps shine to both sides", among_lamps,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const TriangleLight& light = w.lights.choose(sampler.next());
         const Double3 way = uniform_point(light.triangle, sampler.next_pair()) - at.position;
         const double distance = glm::length(way);
         const Double3 to = way / distance;
         const double pdf = area_pdf(light, std::abs(glm::dot(light.normal, to)), distance);
         return light.radiance * std::max(0.0, glm::dot(at.normal, to)) / pdf;
     }},
    {"area: by the solid angle's density", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         if (!is_seen(w, at, s)) return none();
         const SphericalTriangle seen(s.light->triangle, Double3(at.origin));
         return s.radiance * cosine_at(at, s) / solid_angle_pdf(*s.light, seen);
     }},
    {"solid angle: by the area's density", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_solid_angle(w, at, sampler);
         return is_seen(w, at, s)
                    ? s.radiance * cosine_at(at, s) / area_pdf(*s.light, cosine_of(s), s.distance)
                    : none();
     }},
    {"solid angle: without the cosine", beside_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_solid_angle(w, at, sampler);
         return is_seen(w, at, s) ? s.radiance / s.pdf : none();
     }},
    {"solid angle: below the horizon as above", beside_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_solid_angle(w, at, sampler);
         return s.is_lit ? s.radiance * std::abs(cosine_at(at, s)) / s.pdf : none();
     }},
    {"solid angle: below the horizon less than nothing", beside_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_solid_angle(w, at, sampler);
         return s.is_lit ? s.radiance * cosine_at(at, s) / s.pdf : none();
     }},
    {"uniform: by the density of a whole sphere", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const DirectionSample s = uniform_hemisphere(at.normal, sampler.next_pair());
         return found(w, at, s.direction) * glm::dot(at.normal, s.direction) * (4.0 * pi);
     }},
    {"uniform: by the cosine's density", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const DirectionSample s = uniform_hemisphere(at.normal, sampler.next_pair());
         return found(w, at, s.direction) * pi;
     }},
    {"cosine: by the uniform density", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const DirectionSample s = cosine_hemisphere(at.normal, sampler.next_pair());
         return found(w, at, s.direction) * glm::dot(at.normal, s.direction) * (2.0 * pi);
     }},
    {"cosine: counted twice", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const DirectionSample s = cosine_hemisphere(at.normal, sampler.next_pair());
         return found(w, at, s.direction) * glm::dot(at.normal, s.direction) * pi;
     }},
    {"cosine: without pi", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         return found(w, at, cosine_hemisphere(at.normal, sampler.next_pair()).direction);
     }},
    {"cosine: the radius uniform, not its square", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const Double2 u = sampler.next_pair();
         return found(w, at, cosine_hemisphere(at.normal, {u.x * u.x, u.y}).direction) * pi;
     }},
    {"cosine: a normal that points down", beside_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         return found(w, at, cosine_hemisphere(-at.normal, sampler.next_pair()).direction) * pi;
     }},
    {"two ways: both in full", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         return direct_irradiance(w.tracer, w.lit, w.lights, at, sampler, Lighting::area) +
                direct_irradiance(w.tracer, w.lit, w.lights, at, sampler, Lighting::cosine);
     }},
    {"two ways: the density per area in the weight", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         const LightSample s = by_area(w, at, sampler);
         Double3 sum{0.0};
         if (is_seen(w, at, s)) {
             const double weight = power_heuristic(s.light->probability / s.light->area,
                                                   cosine_hemisphere_pdf(at.normal, s.direction));
             sum = weight * s.radiance * cosine_at(at, s) / s.pdf;
         }
         return sum + irradiance_from_direction(w.tracer, w.lit, w.lights, at, sampler,
                                                Lighting::mis_area);
     }},
    {"two ways: the weights of two different pairs", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         return irradiance_from_lights(w.tracer, w.lights, at, sampler, Lighting::mis_solid_angle) +
                irradiance_from_direction(w.tracer, w.lit, w.lights, at, sampler,
                                          Lighting::mis_area);
     }},
    {"two ways: only one of them weighted", below_a_lamp,
     [](const World& w, const SurfacePoint& at, Sampler& sampler) {
         return irradiance_from_lights(w.tracer, w.lights, at, sampler, Lighting::mis_area) +
                irradiance_from_direction(w.tracer, w.lit, w.lights, at, sampler, Lighting::cosine);
     }},
};

/// A path by cosine-weighted directions and solid angles, with one thing wrong.
enum class Fault {
    none,
    no_division,         ///< roulette: what goes on is not divided
    divided_uncapped,    ///< roulette: divided by the largest share, also above 0.95
    cut_off,             ///< ends after four surfaces
    counted_twice,       ///< lamps that are hit count though they were asked for
    never_seen,          ///< nor does the lamp that the ray itself meets
    no_pi,               ///< direct light: reflectance times irradiance
    reflected_too_late,  ///< direct light by the throughput before the reflection
};

Double3 path_with(Fault fault, const World& w, Ray ray, Sampler& sampler) {
    Double3 radiance{0.0}, throughput{1.0};
    for (int bounce = 0;; ++bounce) {
        const std::optional<Hit> hit = closest_hit(w.tracer, ray);
        if (!hit) return radiance;
        const SurfacePoint at = surface_point(w.lit, ray, *hit);
        const bool counts =
            bounce == 0 ? fault != Fault::never_seen : fault == Fault::counted_twice;
        if (counts) radiance += throughput * w.lit.emitted(at.triangle, at.front);
        const Double3 before = throughput;
        throughput *= w.lit.reflectance(at.triangle);
        radiance += (fault == Fault::reflected_too_late ? before : throughput) *
                    (fault == Fault::no_pi ? 1.0 : 1.0 / pi) *
                    irradiance_from_lights(w.tracer, w.lights, at, sampler, Lighting::solid_angle);
        ray = ray_from(at, cosine_hemisphere(at.normal, sampler.next_pair()).direction);
        if (fault == Fault::cut_off && bounce == 3) return radiance;
        const double largest = std::max({throughput.x, throughput.y, throughput.z});
        const double goes_on = survival(throughput);
        if (sampler.next() >= goes_on) return radiance;
        if (fault == Fault::no_division) continue;
        throughput /= fault == Fault::divided_uncapped ? largest : goes_on;
    }
}

}  // namespace

TEST_CASE("a wrong density, a missing cosine, a light counted twice: each is found") {
    for (const Wrong& wrong : wrong_ones) {
        const Known scene = wrong.scene();
        const SurfacePoint floor = scene.world.at(Double3(0.0), up);
        const Means means = over_seeds(sized(256, 32), [&](Sampler& sampler) {
            return wrong.estimate(scene.world, floor, sampler);
        });
        CAPTURE(wrong.name, means[0].mean(), means[0].error(), scene.irradiance.x);
        CHECK(!agree(means, scene.irradiance));
    }
}

TEST_CASE("a wrong path is found, in one of three rooms, the same without a fault in none") {
    const std::vector<Wall> walls = room();
    const World white = furnace(), lit_room = furnished(walls);
    const World bright = world(bright_furnace());
    const WallRadiance floor = wall_radiances(walls, 2)[0];
    const auto is_found = [&](Fault fault) {
        const auto agrees = [&](const World& w, int samples, const Double3& exact,
                                const Double3& bound) {
            return agree(over_seeds(samples,
                                    [&](Sampler& sampler) {
                                        const Ray ray = ray_to_wall(w, walls[0].shape, sampler);
                                        return path_with(fault, w, ray, sampler);
                                    }),
                         exact, bound);
        };
        return !agrees(white, 128, Double3(1.0), Double3(0.0)) ||
               !agrees(bright, 32, Double3(1.0), Double3(0.0)) ||
               !agrees(lit_room, 128, floor.radiance * room_colour, floor.error * room_colour);
    };
    CHECK(!is_found(Fault::none));
    for (const Fault fault :
         {Fault::no_division, Fault::divided_uncapped, Fault::cut_off, Fault::counted_twice,
          Fault::never_seen, Fault::no_pi, Fault::reflected_too_late}) {
        CAPTURE(int(fault));
        CHECK(is_found(fault));
    }
}

TEST_CASE("light that is sent out evenly, or k photons for k - 1: wrong photons are found") {
    const std::vector<Wall> walls = room();
    const World lit_room = furnished(walls), white = furnace();
    const double to_floor = 8.0 * pi * exchange_area(walls[lamp_of_room].shape, walls[0].shape);
    Means even, right, all_k;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        PhotonConfig config{.count = 1'000, .seed = seed, .most_bounces = 1};
        const auto on_floor = [&](bool is_even) {
            const PhotonTrace trace =
                trace_each(config, photon_stream, [&](Sampler& sampler, PhotonTrace& one) {
                    const TriangleLight& light = lit_room.lights.choose(sampler.next());
                    const Double3 from = uniform_point(light.triangle, sampler.next_pair());
                    const Double2 u = sampler.next_pair();
                    const Double3 to = is_even ? uniform_hemisphere(light.normal, u).direction
                                               : cosine_hemisphere(light.normal, u).direction;
                    const double weight = pi * light.area / (light.probability * config.count);
                    trace_photon(lit_room.tracer, lit_room.lit, photon_ray(light, from, to),
                                 weight * light.radiance, sampler, config, one);
                });
            Double3 sum{0.0};
            for (const Photon& photon : trace.photons)
                if (photon.normal.z > 0.5f) sum += photon.power;
            return sum;
        };
        const Double3 wrong_flux = on_floor(true), flux = on_floor(false);
        PhotonConfig many{.count = 2'000, .seed = seed};
        const PhotonMap map =
            PhotonMap::build(trace_photons(white.tracer, white.lit, white.lights, many).photons);
        Double3 density{0.0};
        for (int i = 0; i < 9; ++i)
            for (const float y : {0.5f, 0.75f, 1.0f})
                density +=
                    plain_density(map, Point3(0.5f + 0.25f * float(i), y, 0), 10, 0.35f) / 27.0;
        for (std::size_t c = 0; c < 3; ++c) {
            even[c].add(wrong_flux[int(c)]);
            right[c].add(flux[int(c)]);
            all_k[c].add(density[int(c)]);
        }
    }
    check("by Lambert's law", right, to_floor * room_colour);
    CHECK(!agree(even, to_floor * room_colour));
    if (!is_sanitized) CHECK(!agree(all_k, Double3(pi)));  // 20 seeds do not tell 10 of 9
}

// Weights that are exchanged add up to 1 as well: the mean is right, and only the variance tells.
TEST_CASE("two ways together are never much worse than the better one, as Veach's bound has it") {
    for (const Known& scene : known()) {
        const SurfacePoint floor = scene.world.at(Double3(0.0), up);
        const auto variance = [&](Lighting lighting) {
            Mean values;
            for (int i = 0; i < sized(40'000, 2'000); ++i) {
                Sampler sampler(SamplePattern::independent, 1, 1);
                sampler.start(1, static_cast<std::uint32_t>(i));
                values.add(direct_irradiance(scene.world.tracer, scene.world.lit,
                                             scene.world.lights, floor, sampler, lighting)
                               .x);
            }
            return values.variance();
        };
        const double cosine = variance(Lighting::cosine);
        // With one sample of each: 1 - 1/2 of the mean's square (theorem 9.2 of his thesis).
        const double allowance = 0.5 * scene.irradiance.x * scene.irradiance.x;
        CAPTURE(scene.name, cosine, allowance);
        CHECK(variance(Lighting::mis_area) <
              std::min(cosine, variance(Lighting::area)) + allowance);
        CHECK(variance(Lighting::mis_solid_angle) <
              std::min(cosine, variance(Lighting::solid_angle)) + allowance);
    }
}

}  // namespace space
