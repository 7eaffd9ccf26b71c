// The second pass: what photon maps show, beside exact values and beside paths; and where they show
// light that is none.
#include "chapters/ch11_sampling_and_caching/photon_radiance.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch11_sampling_and_caching/lit_stage.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "common/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace space {

namespace test {
extern std::atomic<std::ptrdiff_t> allocations_left;  // tests/ch05/allocations.cpp
}

namespace {

using Tree = Bvh<BinnedBuilder>;

/// A lit scene with all that tracing it takes.
struct LitTree {
    LitScene lit;
    LightTable lights;
    Tree tree;

    explicit LitTree(LitScene scene)
        : lit(std::move(scene)), lights(lit), tree(Tree::build(lit.triangles)) {}
    explicit LitTree(const std::string& name) : LitTree(make_lit_scene(name, 1, true)) {}

    PhotonMaps maps(const PhotonConfig& photons, std::uint32_t caustic_count) const {
        return PhotonMaps::build(tree, lit, lights, photons, caustic_count);
    }
    Double3 by_photons(PhotonLookup& lookup, const Ray& ray, Sampler& sampler) const {
        return photon_radiance(tree, lit, lights, lookup, ray, sampler);
    }
    Double3 by_path(const Ray& ray, Sampler& sampler) const {
        return path_radiance(tree, lit, lights, ray, sampler);
    }
};

/// Looks at a point from a third of a metre before it.
Ray look_at(const Double3& point, const Double3& normal) {
    const Double3 slant = normal.y == 0.0 ? Double3{0, 0.2, 0} : Double3{0.2, 0, 0};
    const Double3 from = point + 0.3 * normal + slant;
    return {.origin = Point3(from), .direction = Vector3(point - from)};
}

}  // namespace

TEST_CASE("in a furnace every wall's radiance is 1, in each colour") {
    const LitTree furnace("furnace");
    const std::pair<Double3, Double3> walls[] = {{{1, 1, 0}, {-1, 0, 0}}, {{-1, 1, 0}, {1, 0, 0}},
                                                 {{0, 1, -1}, {0, 0, 1}}, {{0, 1, 1}, {0, 0, -1}},
                                                 {{0, 2, 0}, {0, -1, 0}}, {{0, 0, 0}, {0, 1, 0}}};
    for (const int gather_rays : {0, 4}) {
        Mean channels[3];
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            const PhotonMaps maps = furnace.maps(
                {.count = sized(2'000u, 200u), .seed = seed, .pattern = SamplePattern::independent},
                0);
            PhotonLookup lookup(maps, {.indirect = {.k = 10}, .gather_rays = gather_rays});
            Sampler sampler(SamplePattern::independent, 1, seed);
            for (const auto& [point, normal] : walls) {
                const Double3 radiance =
                    furnace.by_photons(lookup, look_at(point, normal), sampler);
                for (int c = 0; c < 3; ++c) channels[c].add(radiance[c]);
            }
        }
        for (const Mean& channel : channels) {
            CAPTURE(gather_rays, channel.mean(), channel.error());
            // What is gathered comes from edges and corners, too, which the map shows too dark.
            CHECK(channel.mean() ==
                  Approx(1.0).margin(5.0 * channel.error() + (gather_rays > 0 ? 0.03 : 0.0)));
        }
    }
}

TEST_CASE("photons show what paths show: the box, and light by way of a mirror") {
    for (const char* name : {"box", "mirror"}) {
        const LitTree scene(name);
        const PhotonMaps maps = scene.maps({.count = sized(50'000u, 5'000u)}, 50'000);
        constexpr int size = 16, samples = sized(64, 4);
        const PixelGrid grid(scene.lit.scene.camera, size, size);
        for (const int gather_rays : {0, 1}) {
            PhotonLookup lookup(maps, {.gather_rays = gather_rays});
            Sampler sampler(SamplePattern::sobol, samples, 1);
            Mean photons, paths;
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x)
                    for (std::uint32_t i = 0; i < samples; ++i) {
                        const Ray ray = grid.ray_through(x + 0.5, y + 0.5);
                        sampler.start(std::uint64_t(y * size + x), i);
                        photons.add(luminance(scene.by_photons(lookup, ray, sampler)));
                        sampler.start(std::uint64_t(y * size + x), i);
                        paths.add(luminance(scene.by_path(ray, sampler)));
                    }
            CAPTURE(name, gather_rays, photons.mean(), photons.error(), paths.mean());
            CHECK(photons.mean() == Approx(paths.mean()).epsilon(sized(0.03, 0.1)));
        }
    }
}

TEST_CASE("a ray allocates no memory, also where it gathers") {
    for (const char* name : {"box", "ring"}) {
        const LitTree scene(name);
        const PhotonMaps maps = scene.maps({.count = 5'000}, 5'000);
        const PixelGrid grid(scene.lit.scene.camera, 16, 16);
        for (const int gather_rays : {0, 2}) {
            PhotonLookup lookup(maps, {.gather_rays = gather_rays});
            Sampler sampler(SamplePattern::stratified, 1, 1);
            test::allocations_left = 0;  // the next one throws
            for (int i = 0; i < 256; ++i) {
                sampler.start(std::uint64_t(i), 0);
                scene.by_photons(lookup, grid.ray_through(i % 16 + 0.5, i / 16 + 0.5), sampler);
            }
            const std::ptrdiff_t left = test::allocations_left.exchange(-1);
            CHECK(left == 0);
        }
    }
}

TEST_CASE("behind a thin wall light leaks as far as the largest disc, and less when gathered") {
    const LitTree scene("wall");
    const PhotonMaps maps = scene.maps({.count = sized(20'000u, 2'000u)}, 0);
    constexpr float reach = 0.25f;
    constexpr int points = 200;
    /// Of points on the dark room's floor, left to right, those that are lit, and the sum.
    struct Leak {
        int lit_points = 0;
        double light = 0.0, farthest = 0.0;
    };
    const auto leak_of = [&](const PhotonLookupConfig& config, bool on_wall) {
        PhotonLookup lookup(maps, config);
        Sampler sampler(SamplePattern::independent, 1, 1);
        Leak leak;
        for (int i = 0; i < points; ++i) {
            const double along = (i + 0.5) / points;
            const Ray ray = on_wall ? look_at({0.0078125, 0.3 + along, -0.2}, {1, 0, 0})
                                    : look_at({0.0078125 + along, 0, -0.2}, {0, 1, 0});
            sampler.start(std::uint64_t(i), 0);
            const double light = luminance(scene.by_photons(lookup, ray, sampler));
            leak.lit_points += light > 0.0;
            leak.light += light;
            if (light > 0.0) leak.farthest = along;
        }
        return leak;
    };
    const DensityConfig plain{.largest_radius = reach, .only_own_surface = false};
    const DensityConfig own{.largest_radius = reach};
    const Leak wall_plain = leak_of({.indirect = plain}, true),
               wall = leak_of({.indirect = own}, true);
    const Leak foot = leak_of({.indirect = own}, false);
    const Leak gathered = leak_of({.indirect = own, .gather_rays = 16}, false);
    CAPTURE(wall_plain.light, foot.light, foot.farthest, gathered.light);
    CHECK(wall_plain.lit_points == points);
    CHECK(wall.lit_points == 0);  // photons of the other side are told by their normals
    CHECK(foot.lit_points > 0);   // those of the floor beyond the wall are not
    CHECK(foot.farthest <= reach);
    CHECK(gathered.light < 0.5 * foot.light);
}

TEST_CASE("between mirrors the way ends by roulette, and the light's mean stays") {
    LitStage stage;
    stage.add_mirror(parallelogram({0, 0, 0}, {0, 0, 1}, {0, 1, 0}), Color(0.75f));
    stage.add_mirror(parallelogram({1, 0, 0}, {0, 1, 0}, {0, 0, 1}), Color(0.75f));
    stage.scene.background = Color(1.0f);
    const LitTree scene(lit(stage.scene, stage.emission, stage.mirror));
    Sampler sampler(SamplePattern::independent, 1, 1);
    Mean mean;
    // From the left one, a sixteenth upwards each time: on its way out it meets mirrors 8 times.
    const Ray ray{.origin = {0.5f, 0.484375f, 0.25f}, .direction = {1.0f, 0.0625f, 0.0f}};
    for (std::uint32_t i = 0; i < sized(20'000u, 2'000u); ++i) {
        sampler.start(0, i);
        const SeenSurface seen = seen_through_mirrors(scene.tree, scene.lit, ray, sampler);
        CHECK_FALSE(seen.surface.has_value());
        mean.add(seen.radiance.x);
    }
    CAPTURE(mean.mean(), mean.error(), std::pow(0.75, 8));
    CHECK(mean.agrees_with(std::pow(0.75, 8)));
}

TEST_CASE("the sky is seen, straight and in a mirror, and lights a floor") {
    LitStage stage;
    stage.add(parallelogram({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}), Color(0.5f));
    stage.add_mirror(parallelogram({2, 0, -1}, {0, 0, 2}, {2, 0, 0}), Color(0.5f));
    stage.scene.background = {0.25f, 0.5f, 1.0f};
    const LitTree scene(lit(stage.scene, stage.emission, stage.mirror));
    const PhotonMaps maps = scene.maps({.count = 100}, 100);
    PhotonLookup lookup(maps);
    Sampler sampler(SamplePattern::independent, 1, 1);
    const Double3 sky(stage.scene.background);
    CHECK(scene.by_photons(lookup, {{0, 1, 0}, {0, 1, 0}}, sampler) == sky);
    CHECK(scene.by_photons(lookup, {{3, 1, 0}, {0, -1, 0}}, sampler) == 0.5 * sky);
    const Double3 floor = scene.by_photons(lookup, {{0, 1, 0}, {0, -1, 0}}, sampler);
    for (int c = 0; c < 3; ++c) CHECK(floor[c] == Approx(0.5 * sky[c]));
}

}  // namespace space
