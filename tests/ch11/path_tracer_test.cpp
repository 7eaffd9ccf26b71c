#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "common/camera.hpp"
#include "common/parallel.hpp"
#include "common/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace space {
namespace test {
extern std::atomic<std::ptrdiff_t> allocations_left;  // tests/ch05/allocations.cpp
}
namespace {

using Tree = Bvh<BinnedBuilder>;

constexpr std::array every_lighting{Lighting::uniform,  Lighting::cosine,
                                    Lighting::area,     Lighting::solid_angle,
                                    Lighting::mis_area, Lighting::mis_solid_angle};

/// A scene with what estimators need besides.
struct Lit {
    LitScene scene;
    LightTable table;
    Tree tree;

    explicit Lit(LitScene lit_scene)
        : scene(std::move(lit_scene)), table(scene), tree(Tree::build(scene.triangles)) {}

    Double3 path(const Ray& ray, Sampler& sampler, const PathConfig& config = {}) const {
        return path_radiance(tree, scene, table, ray, sampler, config);
    }
};

/// A surface of a scene of our own.
struct Part {
    TriangleMesh mesh;
    Color reflectance;
    Color emission = Color(0.0f);
    bool mirror = false;
};

Lit scene_of(const std::vector<Part>& parts, const Color& sky = Color(0.0f)) {
    Scene scene;
    scene.background = sky;
    std::vector<Color> emission;
    std::vector<std::uint8_t> mirror;
    for (const Part& part : parts) {
        scene.mesh.append(part.mesh);
        scene.colors.resize(scene.mesh.faces.size(), part.reflectance);
        emission.resize(scene.mesh.faces.size(), part.emission);
        mirror.resize(scene.mesh.faces.size(), part.mirror);
    }
    return Lit(lit(std::move(scene), std::move(emission), std::move(mirror)));
}

/// A closed room in which E = 1 - rho, so that radiance is 1 everywhere, in all directions.
Lit furnace(float reflectance) {
    return scene_of({{turned_inside_out(box({-1, -1, -1}, {1, 1, 1})), Color(reflectance),
                      Color(1.0f - reflectance)},
                     {box({-0.4, -0.9, -0.3}, {0.2, 0.1, 0.3}), Color(reflectance),
                      Color(1.0f - reflectance)}});
}

const Ray into_the_room{.origin = {0.3f, 0.4f, 0.8f}, .direction = {-0.5f, -0.9f, -0.8f}};

/// The mean over `seeds` seeds of the mean of `samples` paths of one pixel, red.
Mean mean_over_seeds(const Lit& lit, const Ray& ray, const PathConfig& config,
                     SamplePattern pattern, int seeds, std::uint32_t samples) {
    Mean mean;
    for (int seed = 0; seed < seeds; ++seed) {
        Sampler sampler(pattern, samples, static_cast<std::uint64_t>(seed));
        double sum = 0.0;
        for (std::uint32_t i = 0; i < samples; ++i) {
            sampler.start(0, i);
            sum += lit.path(ray, sampler, config).x;
        }
        mean.add(sum / samples);
    }
    return mean;
}

TEST_CASE("in a white furnace every way of lighting and every pattern finds radiance 1") {
    const Lit lit = furnace(0.5f);
    for (const SamplePattern pattern :
         {SamplePattern::independent, SamplePattern::stratified, SamplePattern::sobol})
        for (const Lighting lighting : every_lighting) {
            CAPTURE(static_cast<int>(pattern), static_cast<int>(lighting));
            const Mean mean = mean_over_seeds(lit, into_the_room, {.lighting = lighting}, pattern,
                                              sized(128, 100), sized(32u, 4u));
            CAPTURE(mean.mean(), mean.error());
            CHECK(mean.agrees_with(1.0));
            CHECK(mean.error() < sized(0.06, 0.4));
        }
}

TEST_CASE("a white body under a white sky is as bright as the sky, with every single path") {
    const Lit lit = scene_of({{box({-1, -1, -1}, {1, 1, 1}), Color(1.0f)}}, Color(1.0f));
    Sampler sampler(SamplePattern::sobol, 1, 1);
    for (std::uint32_t i = 0; i < 1'000; ++i) {
        sampler.start(0, i);
        const Ray ray{.origin = {3, 2, 4}, .direction = {-3, -2, -4}};
        for (const Lighting lighting : {Lighting::cosine, Lighting::area, Lighting::mis_area})
            REQUIRE(std::abs(lit.path(ray, sampler, {.lighting = lighting}).x - 1.0) < 1e-12);
    }
}

TEST_CASE("Russian roulette changes no mean, from whichever reflection on") {
    const Lit lit = furnace(0.75f);
    for (const int from : {0, 1, 3, 8}) {
        CAPTURE(from);
        const Mean mean = mean_over_seeds(lit, into_the_room,
                                          {.lighting = Lighting::cosine, .roulette_from = from},
                                          SamplePattern::independent, 200, sized(64u, 4u));
        CAPTURE(mean.mean(), mean.error());
        CHECK(mean.agrees_with(1.0));
    }
    // Without an end by chance a path here is certain: E (1 + rho + .. + rho^most_bounces).
    for (const int bounces : {0, 1, 5, 100}) {
        Sampler sampler(SamplePattern::independent, 1, 5);
        const double found =
            lit.path(
                   into_the_room, sampler,
                   {.lighting = Lighting::cosine, .roulette_from = 1'000, .most_bounces = bounces})
                .x;
        CHECK(found == Approx(1.0 - std::pow(0.75, bounces + 1)).epsilon(1e-12));
    }
}

TEST_CASE("a path between white walls ends") {
    const Lit lit = scene_of({{turned_inside_out(box({-1, -1, -1}, {1, 1, 1})), Color(1.0f)}});
    const Lit mirrors = scene_of(
        {{turned_inside_out(box({-1, -1, -1}, {1, 1, 1})), Color(1.0f), Color(0.0f), true}});
    Sampler sampler(SamplePattern::independent, 1, 5);
    for (std::uint32_t i = 0; i < 100; ++i) {
        sampler.start(0, i);
        CHECK(lit.path(into_the_room, sampler) == Double3(0.0));
        CHECK(mirrors.path(into_the_room, sampler) == Double3(0.0));
    }
}

/// Irradiance of a polygon of radiance 1 on a surface at p with normal n that sees it whole
/// (Lambert 1760): half the sum of the edges' angles times their planes' normals along n.
double lambert_irradiance(const Double3& p, const Double3& n, const std::vector<Double3>& polygon) {
    Double3 sum{0.0};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Double3 a = glm::normalize(polygon[i] - p),
                      b = glm::normalize(polygon[(i + 1) % polygon.size()] - p);
        const Double3 across = glm::cross(a, b);
        sum += std::atan2(glm::length(across), glm::dot(a, b)) * glm::normalize(across);
    }
    return 0.5 * std::abs(glm::dot(sum, n));
}

/// A floor of reflectance 1 / 2 under a square light of radiance 3, 2 h wide, at this height.
Lit lamp(double h, double height) {
    return scene_of({{parallelogram({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}), Color(0.5f)},
                     {parallelogram({-h, height, -h}, {2 * h, 0, 0}, {0, 0, 2 * h}), Color(0.0f),
                      Color(3.0f)}});
}

TEST_CASE("every way of lighting finds Lambert's irradiance below a square light") {
    struct Case {
        double h, height, x;
    };
    for (const Case& c : {Case{0.5, 1.0, 0.3}, Case{2.0, 0.25, -0.6}, Case{0.125, 0.5, 1.0}}) {
        const Lit lit = lamp(c.h, c.height);
        const Double3 p{c.x, 0.0, 0.1};
        const double exact = 3.0 * lambert_irradiance(p, {0, 1, 0},
                                                      {{-c.h, c.height, -c.h},
                                                       {c.h, c.height, -c.h},
                                                       {c.h, c.height, c.h},
                                                       {-c.h, c.height, c.h}});
        const Ray down{.origin = Point3(p + Double3(0.0, 0.125, 0.0)), .direction = {0, -1, 0}};
        for (const Lighting lighting : every_lighting) {
            CAPTURE(c.h, c.height, static_cast<int>(lighting));
            const Mean mean = mean_over_seeds(lit, down, {.lighting = lighting, .most_bounces = 1},
                                              SamplePattern::independent, 150, sized(256u, 64u));
            CAPTURE(mean.mean(), mean.error(), 0.5 * exact / std::numbers::pi);
            CHECK(mean.agrees_with(0.5 * exact / std::numbers::pi, 1e-6));
        }
    }
}

TEST_CASE("an irradiance whose density is a wrong one is caught") {
    const Lit lit = lamp(0.5, 1.0);
    const Double3 p{0.3, 0.0, 0.1}, n{0, 1, 0};
    const double exact =
        3.0 *
        lambert_irradiance(p, n, {{-0.5, 1, -0.5}, {0.5, 1, -0.5}, {0.5, 1, 0.5}, {-0.5, 1, 0.5}});
    Mean right, wrong;
    Sampler sampler(SamplePattern::independent, 1, 3);
    for (std::uint32_t i = 0; i < sized(40'000u, 10'000u); ++i) {
        sampler.start(0, i);
        const Double2 u = sampler.next_pair();
        const DirectionSample uniform = uniform_hemisphere(n, u), cosine = cosine_hemisphere(n, u);
        const auto found = [&](const DirectionSample& s, double pdf) {
            const Ray ray{.origin = Point3(p), .direction = Vector3(s.direction), .tmin = 0.01f};
            return closest_hit(lit.tree, ray) ? 3.0 * glm::dot(n, s.direction) / pdf : 0.0;
        };
        right.add(found(uniform, uniform.pdf));
        wrong.add(found(cosine, uniform.pdf));
    }
    CHECK(right.agrees_with(exact));
    CHECK_FALSE(wrong.agrees_with(exact));
}

TEST_CASE("all ways of lighting find the same light where it comes by mirrors and walls") {
    const Lit lit = scene_of(
        {{turned_inside_out(box({-1, -1, -1}, {1, 1, 1})), Color(0.5f)},
         {parallelogram({-0.5, 0.9, -0.5}, {1, 0, 0}, {0, 0, 1}), Color(0.25f), Color(2.0f)},
         {box({-0.6, -0.95, -0.5}, {0.1, -0.4, 0.3}), Color(0.875f), Color(0.0f), true}});
    Mean reference;
    for (const Lighting lighting : every_lighting) {
        const Mean mean = mean_over_seeds(lit, into_the_room, {.lighting = lighting},
                                          SamplePattern::sobol, 128, sized(128u, 16u));
        if (lighting == Lighting::uniform) reference = mean;
        CAPTURE(static_cast<int>(lighting), mean.mean(), reference.mean());
        CHECK(std::abs(mean.mean() - reference.mean()) <
              5.0 * std::hypot(mean.error(), reference.error()));
        CHECK(mean.error() < sized(0.1, 0.5) * mean.mean());
    }
}

TEST_CASE("a mirror shows a light in full and once, with every way of lighting") {
    const Lit lit = scene_of(
        {{parallelogram({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}), Color(0.5f), Color(0.0f), true},
         {parallelogram({-1, 2, -1}, {2, 0, 0}, {0, 0, 2}), Color(0.25f), Color(4.0f)}});
    Sampler sampler(SamplePattern::independent, 1, 1);
    const Ray ray{.origin = {0.0f, 1.0f, 0.5f}, .direction = {0.0f, -1.0f, -0.25f}};
    for (const Lighting lighting : every_lighting) {
        CHECK(lit.path(ray, sampler, {.lighting = lighting, .most_bounces = 1}) == Double3(2.0));
        CHECK(lit.path(ray, sampler, {.lighting = lighting, .most_bounces = 0}) == Double3(0.0));
    }
    const Ray up{.origin = {0.0f, 1.0f, 0.5f}, .direction = {0.0f, 1.0f, -0.25f}};
    CHECK(lit.path(up, sampler, {.most_bounces = 0}) == Double3(4.0));
    CHECK(lit.path(up, sampler, {.most_bounces = 0, .sees_lights = false}) == Double3(0.0));
    CHECK(lit.path(ray, sampler, {.most_bounces = 1, .sees_lights = false}) == Double3(2.0));
}

TEST_CASE("a light's back is dark, and what leaves the scene finds the sky") {
    const Lit lit =
        scene_of({{parallelogram({-1, 0, -1}, {2, 0, 0}, {0, 0, 2}), Color(0.0f), Color(4.0f)}},
                 Color(0.25f, 0.5f, 0.75f));
    Sampler sampler(SamplePattern::independent, 1, 1);
    CHECK(lit.path({.origin = {0, -1, 0}, .direction = {0, 1, 0}}, sampler) == Double3(4.0));
    CHECK(lit.path({.origin = {0, 1, 0}, .direction = {0, -1, 0}}, sampler) == Double3(0.0));
    CHECK(lit.path({.origin = {0, 1, 0}, .direction = {0, 1, 0}}, sampler) ==
          Double3(0.25, 0.5, 0.75));
}

TEST_CASE("no path takes memory from the heap") {
    const Lit lit{make_lit_scene("box", 1, true)};
    const Ray ray = PixelGrid(lit.scene.scene.camera, 1, 1).ray(0, 0);
    for (const SamplePattern pattern : {SamplePattern::stratified, SamplePattern::sobol})
        for (const Lighting lighting : every_lighting) {
            Sampler sampler(pattern, 64, 3);
            double sum = 0.0;
            test::allocations_left = 0;  // the next one throws
            for (std::uint32_t i = 0; i < 64; ++i) {
                sampler.start(0, i);
                sum += lit.path(ray, sampler, {.lighting = lighting}).x;
            }
            test::allocations_left = -1;
            CHECK(sum > 0.0);
        }
}

TEST_CASE("a picture of paths has the same bytes for any number of threads") {
    const LitScene scene = make_lit_scene("box", 1, true);
    const Lit lit{scene};
    const PixelGrid grid(scene.scene.camera, 24, 18);
    const auto picture = [&](SamplePattern pattern, unsigned threads) {
        std::vector<Double3> pixels(24 * 18);
        parallel_for(pixels.size(), threads, 5, [&](std::size_t i) {
            Sampler sampler(pattern, 4, 7);
            Double3 sum{0.0};
            for (std::uint32_t sample = 0; sample < 4; ++sample) {
                sampler.start(i, sample);
                const Double2 at = Double2(i % 24, i / 24) + sampler.next_pair();
                sum += lit.path(grid.ray_through(at.x, at.y), sampler);
            }
            pixels[i] = sum;
        });
        return pixels;
    };
    for (const SamplePattern pattern :
         {SamplePattern::independent, SamplePattern::stratified, SamplePattern::sobol}) {
        const std::vector<Double3> one = picture(pattern, 1);
        CHECK(std::any_of(one.begin(), one.end(), [](const Double3& p) { return p.x > 0.0; }));
        CHECK(picture(pattern, 2) == one);
        CHECK(picture(pattern, 7) == one);
    }
}

}  // namespace
}  // namespace space
