// Caches filled for pictures: exact under an even sky and in a furnace, against the radiosity of a
// closed room, beside mirrors, behind a thin wall, and for any number of threads.
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/radiosity.hpp"
#include "common/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

namespace space {
namespace {

/// What it takes to fill and ask a cache.
struct CacheStage {
    LitScene lit;
    Bvh<BinnedBuilder> tree;
    LightTable table;

    explicit CacheStage(LitScene scene)
        : lit(std::move(scene)), tree(Bvh<BinnedBuilder>::build(lit.triangles)), table(lit) {}
    explicit CacheStage(std::string_view spec) : CacheStage(make_lit_scene(spec, 1, true)) {}

    PixelGrid pixels(int width, int height) const { return {lit.scene.camera, width, height}; }
    IrradianceCache fill(const PixelGrid& grid, const RadianceCacheConfig& config,
                         unsigned threads = 1) const {
        return fill_cache(tree, lit, table, grid, config, threads);
    }
    /// What the eye sees through the pixel's centre, as a surface.
    std::optional<SurfacePoint> seen(const PixelGrid& grid, int x, int y) const {
        Sampler sampler(SamplePattern::independent, 1, 9);
        return seen_through_mirrors(tree, lit, grid.ray(x, y), sampler).surface;
    }
};

RadianceCacheConfig quick(double accuracy) {
    RadianceCacheConfig config;
    config.accuracy = accuracy;
    config.grid = {.rings = sized(8, 4), .sectors = sized(24, 12)};
    config.coarsest = 8;
    return config;
}

/// A floor of reflectance 1/2, seen from above, and a sky.
LitScene floor_below_sky(const Color& sky) {
    Scene scene;
    add(scene, parallelogram({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}), Color(0.5f));
    scene.camera = {.eye = {0, 1, 0}, .target = {0, 0, 0}, .up = {0, 0, 1}};
    scene.background = sky;
    return lit(std::move(scene), {});
}

/// A closed room without anything in it, of walls with these reflectances and emissions.
std::vector<Wall> room_walls() {
    const Double3 x{2, 0, 0}, y{0, 1.5, 0}, z{0, 0, 3};
    return {{{{0, 0, 0}, z, x}, 0.5, 0.0},    // floor
            {{{0, 1.5, 0}, x, z}, 0.7, 0.0},  // ceiling
            {{{0, 0, 0}, y, z}, 0.6, 1.0},    // left: it shines
            {{{2, 0, 0}, z, y}, 0.3, 0.0},    // right
            {{{0, 0, 0}, x, y}, 0.8, 0.0},    // back
            {{{0, 0, 3}, y, x}, 0.4, 0.0}};   // front
}
LitScene room_of(const std::vector<Wall>& walls) {
    Scene scene;
    std::vector<Color> emission;
    for (const Wall& wall : walls) {
        add(scene, parallelogram(wall.shape.corner, wall.shape.u, wall.shape.v),
            Color(float(wall.reflectance)));
        emission.resize(scene.mesh.faces.size(), Color(float(wall.emission)));
    }
    scene.camera = {.eye = {1.9f, 1.2f, 2.9f}, .target = {0.6f, 0.4f, 0.6f}, .field_of_view = 70};
    return lit(std::move(scene), std::move(emission));
}

/// The root of the mean square of an error, in parts of the mean.
struct RelativeError {
    double squares = 0.0, sum = 0.0, count = 0.0;

    void add(double value, double exact) {
        squares += (value - exact) * (value - exact);
        sum += exact;
        ++count;
    }
    double value() const { return std::sqrt(squares / count) / (sum / count); }
};

}  // namespace

TEST_CASE("M5: under an even open sky the picture is exact, and one record is enough") {
    const CacheStage stage(floor_below_sky({0.5f, 0.25f, 1.0f}));
    const PixelGrid grid = stage.pixels(16, 16);
    const IrradianceCache cache = stage.fill(grid, quick(0.3));
    REQUIRE(cache.records().size() >= 1);
    for (const IrradianceRecord& record : cache.records()) {
        CHECK(std::isfinite(record.radius));
        CHECK(glm::length(record.irradiance - std::numbers::pi * Double3(0.5, 0.25, 1.0)) < 1e-13);
    }
    Sampler sampler(SamplePattern::independent, 1, 3);
    grid.for_each([&](int x, int y) {
        const Double3 radiance =
            cache_radiance(stage.tree, stage.lit, stage.table, cache, grid.ray(x, y), sampler);
        REQUIRE(glm::length(radiance - Double3(0.25, 0.125, 0.5)) < 1e-13);
    });
}

TEST_CASE("in a furnace the picture's mean is 1 in every colour") {
    const CacheStage stage("furnace");
    const PixelGrid grid = stage.pixels(16, 12);
    Mean red, green, blue;
    for (std::uint64_t seed = 1; seed <= sized(100u, 10u); ++seed) {
        RadianceCacheConfig config = quick(0.4);
        config.grid = {.rings = 4, .sectors = 12};
        config.seed = seed;
        const IrradianceCache cache = stage.fill(grid, config);
        Sampler sampler(SamplePattern::independent, 1, seed);
        Double3 sum{0.0};
        grid.for_each([&](int x, int y) {
            sum +=
                cache_radiance(stage.tree, stage.lit, stage.table, cache, grid.ray(x, y), sampler) /
                (16.0 * 12.0);
        });
        red.add(sum.x);
        green.add(sum.y);
        blue.add(sum.z);
    }
    for (const Mean& mean : {red, green, blue}) {
        CAPTURE(mean.mean(), mean.error());
        CHECK(mean.agrees_with(1.0));
        CHECK(mean.error() < sized(0.01, 0.05));
    }
}

TEST_CASE("in a closed room the cache nears the radiosity solution as the accuracy falls") {
    const std::vector<Wall> walls = room_walls();
    const Patches patches = cut_walls(walls, 6);
    const std::vector<double> radiance = patch_radiances(patches, walls);
    const CacheStage stage(room_of(walls));
    const PixelGrid grid = stage.pixels(sized(48, 16), sized(36, 12));

    const auto error_of = [&](const RadianceCacheConfig& config) {
        const IrradianceCache cache = stage.fill(grid, config);
        RelativeError error;
        grid.for_each([&](int x, int y) {
            const SurfacePoint at = stage.seen(grid, x, y).value();
            const auto interpolated = cache.irradiance(at.position, at.normal);
            if (!interpolated) return;
            const double all = room_irradiance(patches, radiance, at.position, at.normal);
            const double direct =
                polygon_irradiance(at.position, at.normal, walls[2].shape.corners());
            error.add(interpolated->x, all - direct);
        });
        return error.value();
    };
    RadianceCacheConfig coarse = quick(0.6), fine = quick(0.15);
    coarse.grid = fine.grid = {.rings = sized(16, 8), .sectors = sized(48, 24)};
    RadianceCacheConfig plain = coarse;
    plain.gradients = false;
    const double plain_error = error_of(plain), coarse_error = error_of(coarse);
    const double fine_error = error_of(fine);
    CAPTURE(plain_error, coarse_error, fine_error);
    CHECK(coarse_error < plain_error);
    CHECK(fine_error < coarse_error);
    CHECK(fine_error < sized(0.035, 0.1));
}

TEST_CASE("an empty cache leaves a path tracer with the same mean") {
    const CacheStage stage("box");
    const IrradianceCache empty(0.3);
    const Ray ray = stage.pixels(9, 9).ray(2, 6);
    Mean path, cached;
    Sampler one(SamplePattern::independent, 1, 1), other(SamplePattern::independent, 1, 2);
    for (int i = 0; i < sized(20'000, 2'000); ++i) {
        path.add(path_radiance(stage.tree, stage.lit, stage.table, ray, one).y);
        cached.add(cache_radiance(stage.tree, stage.lit, stage.table, empty, ray, other).y);
    }
    const double spread = std::hypot(path.error(), cached.error());
    CHECK(std::abs(path.mean() - cached.mean()) < 5.0 * spread);
    CHECK(spread < sized(0.02, 0.07) * path.mean());
}

TEST_CASE("a cache is the same, bit for bit, for any number of threads") {
    const CacheStage stage("box");
    const PixelGrid grid = stage.pixels(24, 18);
    const RadianceCacheConfig config = quick(0.3);
    const IrradianceCache one = stage.fill(grid, config, 1), three = stage.fill(grid, config, 3);
    REQUIRE(one.records().size() == three.records().size());
    for (std::size_t i = 0; i < one.records().size(); ++i) {
        const IrradianceRecord &a = one.records()[i], &b = three.records()[i];
        REQUIRE(a.position == b.position);
        REQUIRE(a.irradiance == b.irradiance);
        REQUIRE(a.radius == b.radius);
        REQUIRE(a.translation_gradient == b.translation_gradient);
        REQUIRE(a.rotation_gradient == b.rotation_gradient);
    }
}

TEST_CASE("each pixel's point is covered, what mirrors show as well") {
    for (const char* name : {"box", "mirror", "ring"}) {
        const CacheStage stage(name);
        const PixelGrid grid = stage.pixels(24, 18);
        RadianceCacheConfig config = quick(0.4);
        config.neighbour_clamping = false;  // it takes from records what they covered
        const IrradianceCache cache = stage.fill(grid, config);
        int covered = 0;
        grid.for_each([&](int x, int y) {
            const auto at = stage.seen(grid, x, y);
            if (!at || stage.lit.reflectance(at->triangle) == Double3(0.0)) return;
            CAPTURE(name, x, y);
            REQUIRE(cache.covers(at->position, at->normal));
            ++covered;
        });
        CHECK(covered > 100);
    }
}

TEST_CASE("lattices of pixels hold each pixel once, coarse to fine") {
    for (const int coarsest : {1, 2, 8}) {
        std::vector<int> times(7 * 5);
        int spacing = coarsest;
        for (const PixelLattice& lattice : coarse_to_fine(coarsest)) {
            CHECK(lattice.spacing <= spacing);
            spacing = lattice.spacing;
            for (const std::uint32_t pixel : lattice.pixels(7, 5)) ++times[pixel];
        }
        CHECK(times == std::vector<int>(7 * 5, 1));
    }
}

TEST_CASE("light leaks through a thin wall without neighbour clamping, and not with it") {
    const CacheStage stage("wall");
    const PixelGrid grid = stage.pixels(32, 24);
    const auto light_in_the_dark = [&](bool neighbour_clamping) {
        RadianceCacheConfig config = quick(0.5);
        config.neighbour_clamping = neighbour_clamping;
        config.smallest_radius = 0.002;
        config.gradients = false;
        config.reuse = false;
        const IrradianceCache cache = stage.fill(grid, config);
        double sum = 0.0;
        grid.for_each([&](int x, int y) {
            const auto at = stage.seen(grid, x, y);
            if (!at || at->position.x < 0.01) return;
            sum += cache.irradiance(at->position, at->normal).value_or(Double3(0.0)).y;
        });
        return sum;
    };
    const double plain = light_in_the_dark(false), clamped = light_in_the_dark(true);
    CAPTURE(plain, clamped);
    CHECK(plain > 1.0);
    CHECK(clamped < 0.01 * plain);
}

}  // namespace space
