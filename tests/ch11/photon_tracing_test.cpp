// Photons on their way: none is lost, their powers add up to what arrives in truth, and those aimed
// at mirrors bring the same light as those that meet them by chance.
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch11_sampling_and_caching/aimed_photons.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace space {
namespace {

using Tree = Bvh<BinnedBuilder>;

/// A lit scene with all that tracing it takes.
struct LitTree {
    LitScene lit;
    LightTable lights;
    Tree tree;

    explicit LitTree(const std::string& name) : LitTree(make_lit_scene(name, 1, true)) {}
    explicit LitTree(LitScene scene)
        : lit(std::move(scene)), lights(lit), tree(Tree::build(lit.triangles)) {}

    PhotonTrace photons(const PhotonConfig& config) const {
        return trace_photons(tree, lit, lights, config);
    }
    PhotonTrace aimed(const PhotonConfig& config) const {
        return trace_aimed_photons(tree, lit, lights, config);
    }
};

/// The power of all photons that `counts(photon)`, RGB.
template <class Counts>
Double3 power_of(const PhotonTrace& trace, const Counts& counts) {
    Double3 sum{0.0};
    for (const Photon& photon : trace.photons)
        if (counts(photon)) sum += photon.power;
    return sum;
}
bool is_caustic(const Photon& photon) {
    return photon.path == PhotonPath::caustic;
}
double largest_power(const Photon& photon) {
    return std::max({photon.power.r, photon.power.g, photon.power.b});
}

/// Over many seeds, in each colour.
struct ColorMean {
    std::array<Mean, 3> channels;

    void add(const Double3& color) {
        for (int c = 0; c < 3; ++c) channels[std::size_t(c)].add(color[c]);
    }
    bool agrees_with(const Double3& exact) const {
        for (int c = 0; c < 3; ++c)
            if (!channels[std::size_t(c)].agrees_with(exact[c])) return false;
        return true;
    }
    /// Two means of the same, with errors of their own.
    bool agrees_with(const ColorMean& other) const {
        for (std::size_t c = 0; c < 3; ++c) {
            const double error = std::hypot(channels[c].error(), other.channels[c].error());
            if (!(std::abs(channels[c].mean() - other.channels[c].mean()) <= 5.0 * error))
                return false;
        }
        return true;
    }
    Double3 mean() const { return {channels[0].mean(), channels[1].mean(), channels[2].mean()}; }
    Double3 error() const {
        return {channels[0].error(), channels[1].error(), channels[2].error()};
    }
};

constexpr std::uint64_t traced_seeds = 100;
constexpr SamplePattern all_patterns[] = {SamplePattern::independent, SamplePattern::stratified,
                                          SamplePattern::sobol};

}  // namespace

TEST_CASE("every emitted photon is absorbed, leaves or is stopped") {
    for (const char* name : {"box", "wall", "ring", "mirror", "interior", "furnace"}) {
        const LitTree stage(name);
        for (const auto pattern : all_patterns) {
            const PhotonConfig config{.count = sized(5'000u, 500u), .pattern = pattern};
            for (const PhotonTrace& trace : {stage.photons(config), stage.aimed(config)}) {
                const PhotonCounts& n = trace.counts;
                CAPTURE(name, n.absorbed, n.left, n.stopped);
                CHECK(n.emitted == n.absorbed + n.left + n.stopped);
            }
            CHECK(stage.photons(config).counts.emitted == config.count);
            CHECK(stage.photons(config).counts.stopped == 0);
        }
    }
}

TEST_CASE("no photon leaves a closed scene") {
    for (const char* name : {"box", "interior", "furnace"}) {
        const PhotonTrace trace = LitTree(name).photons({.count = sized(50'000u, 1'000u)});
        CAPTURE(name);
        CHECK(trace.counts.left == 0);
        CHECK(trace.photons.size() >= trace.counts.emitted);
    }
}

TEST_CASE("the photons are the same, in the same order, for any number of threads") {
    for (const char* name : {"box", "ring"}) {
        const LitTree stage(name);
        PhotonConfig config{.count = 5'000};
        const PhotonTrace one = stage.photons(config), one_aimed = stage.aimed(config);
        for (const unsigned threads : {2u, 3u, 8u}) {
            config.threads = threads;
            const PhotonTrace many = stage.photons(config), many_aimed = stage.aimed(config);
            CHECK(many.photons == one.photons);
            CHECK(many.counts == one.counts);
            CHECK(many_aimed.photons == one_aimed.photons);
            CHECK(many_aimed.counts == one_aimed.counts);
        }
    }
}

TEST_CASE("roulette keeps the largest component, and in the mean passes on what is reflected") {
    Pcg32 random(3);
    for (int i = 0; i < 1000; ++i) {
        Double3 power, reflectance;
        for (int c = 0; c < 3; ++c) power[c] = random.uniform_double();
        for (int c = 0; c < 3; ++c) reflectance[c] = random.uniform_double();
        const auto largest = [](const Double3& v) { return std::max({v.x, v.y, v.z}); };
        const double chance = largest(power * reflectance) / largest(power);
        const auto on = reflected_power(power, reflectance, 0.0);
        REQUIRE(on.has_value());
        CHECK(largest(*on) == Approx(largest(power)).epsilon(1e-14));
        for (int c = 0; c < 3; ++c)
            CHECK(chance * (*on)[c] == Approx(reflectance[c] * power[c]).epsilon(1e-14));
        CHECK(reflected_power(power, reflectance, std::nextafter(chance, 0.0)) == on);
        CHECK_FALSE(reflected_power(power, reflectance, chance).has_value());
    }
    CHECK_FALSE(reflected_power(Double3(1.0), Double3(0.0), 0.0).has_value());
    CHECK_FALSE(reflected_power(Double3(0.0), Double3(1.0), 0.0).has_value());
}

TEST_CASE("in a scene 2^67 times as large, or 2^-67, photons are the same but for size and power") {
    const LitTree plain("box");
    const PhotonConfig config{.count = 2'000};
    const PhotonTrace expected = plain.photons(config);
    for (const int exponent : {67, -67}) {
        CAPTURE(exponent);
        LitScene scaled = make_lit_scene("box", 1, true);
        for (Point3& vertex : scaled.scene.mesh.vertices)
            vertex *= std::ldexp(1.0f, exponent);  // exact
        const LitTree large(lit(scaled.scene, scaled.emission, scaled.mirror));
        const PhotonTrace trace = large.photons(config);
        REQUIRE(trace.photons.size() == expected.photons.size());
        for (std::size_t i = 0; i < trace.photons.size(); ++i) {
            const Photon &one = expected.photons[i], &other = trace.photons[i];
            REQUIRE(other.position == one.position * std::ldexp(1.0f, exponent));
            for (int c = 0; c < 3; ++c)
                REQUIRE(other.power[c] == Approx(std::ldexp(one.power[c], 2 * exponent)));
        }
    }
}

TEST_CASE("a photon is as strong after many reflections as at first") {
    const PhotonTrace trace = LitTree("box").photons({.count = 2'000});
    const double first = largest_power(trace.photons.front());
    std::size_t indirect = 0;
    for (const Photon& photon : trace.photons) {
        CHECK(largest_power(photon) == Approx(first).epsilon(1e-5));
        indirect += photon.path == PhotonPath::indirect;
    }
    CHECK(indirect > 2'000);
}

TEST_CASE("in a furnace pi times the area arrives, in each colour") {
    const LitTree stage("furnace");
    double area = 0.0;
    for (const Triangle& triangle : stage.lit.triangles)
        area += 0.5 * glm::length(normal(triangle));
    for (const auto pattern : all_patterns) {
        ColorMean arrived, direct;
        for (std::uint64_t seed = 1; seed <= traced_seeds; ++seed) {
            const PhotonTrace trace =
                stage.photons({.count = sized(1'000u, 100u), .seed = seed, .pattern = pattern});
            arrived.add(power_of(trace, [](const Photon&) { return true; }));
            direct.add(power_of(
                trace, [](const Photon& photon) { return photon.path == PhotonPath::direct; }));
        }
        CAPTURE(arrived.mean() / area, arrived.error() / area);
        CHECK(arrived.agrees_with(Double3(std::numbers::pi * area)));
        CHECK(direct.agrees_with(stage.lights.flux()));
    }
}

TEST_CASE("as much light arrives at floor and walls as paths find there") {
    const LitTree stage("box");
    /// A wall of the box, by its corner, two edges and the normal into the room.
    struct Wall {
        Double3 corner, a, b, normal;
    };
    const Wall walls[] = {{{-1, 0, -1}, {2, 0, 0}, {0, 0, 2.5}, {0, 1, 0}},
                          {{-1, 0, -1}, {0, 2, 0}, {0, 0, 2.5}, {1, 0, 0}},
                          {{1, 0, -1}, {0, 2, 0}, {0, 0, 2.5}, {-1, 0, 0}},
                          {{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}}};
    std::array<ColorMean, std::size(walls)> photons, paths;
    for (std::uint64_t seed = 1; seed <= traced_seeds; ++seed) {
        const PhotonTrace trace = stage.photons({.count = sized(1'000u, 100u), .seed = seed});
        for (std::size_t i = 0; i < std::size(walls); ++i)
            photons[i].add(power_of(trace, [&](const Photon& photon) {
                const Double3 from_corner = Double3(photon.position) - walls[i].corner;
                return glm::dot(Double3(photon.normal), walls[i].normal) > 0.999 &&
                       std::abs(glm::dot(from_corner, walls[i].normal)) < 1e-6;
            }));
    }
    for (std::size_t i = 0; i < std::size(walls); ++i) {
        Sampler sampler(SamplePattern::independent, 1, i);
        for (std::uint32_t n = 0; n < sized(20'000u, 1'000u); ++n) {
            sampler.start(i, n);
            const Double2 u = sampler.next_pair();
            const Double3 at = walls[i].corner + u.x * walls[i].a + u.y * walls[i].b;
            const Double3 to = cosine_hemisphere(walls[i].normal, sampler.next_pair()).direction;
            const Ray ray{.origin = Point3(at + 1e-5 * walls[i].normal), .direction = Vector3(to)};
            paths[i].add(std::numbers::pi * glm::length(glm::cross(walls[i].a, walls[i].b)) *
                         path_radiance(stage.tree, stage.lit, stage.lights, ray, sampler));
        }
        CAPTURE(i, photons[i].mean(), photons[i].error(), paths[i].mean(), paths[i].error());
        CHECK(photons[i].agrees_with(paths[i]));
    }
}

TEST_CASE("photons aimed at mirrors bring the caustic that photons bring by chance") {
    for (const char* name : {"ring", "mirror"}) {
        const LitTree stage(name);
        for (const auto pattern : all_patterns) {
            ColorMean chance, aimed;
            // Inside the ring, too, where it gathers.
            ColorMean chance_inside, aimed_inside;
            const auto inside = [](const Photon& photon) {
                return is_caustic(photon) && glm::length(photon.position) < 0.4f;
            };
            std::size_t by_chance = 0, by_aim = 0, other = 0;
            for (std::uint64_t seed = 1; seed <= traced_seeds; ++seed) {
                const PhotonConfig config{
                    .count = sized(2'000u, 200u), .seed = seed, .pattern = pattern};
                const PhotonTrace a = stage.photons(config), b = stage.aimed(config);
                chance.add(power_of(a, is_caustic));
                aimed.add(power_of(b, is_caustic));
                chance_inside.add(power_of(a, inside));
                aimed_inside.add(power_of(b, inside));
                by_chance += std::size_t(std::ranges::count_if(a.photons, is_caustic));
                by_aim += std::size_t(std::ranges::count_if(b.photons, is_caustic));
                other +=
                    b.photons.size() - std::size_t(std::ranges::count_if(b.photons, is_caustic));
            }
            CAPTURE(name, int(pattern), by_chance, by_aim);
            CAPTURE(chance.mean(), chance.error(), aimed.mean(), aimed.error());
            CAPTURE(chance_inside.mean(), aimed_inside.mean(), aimed_inside.error());
            CHECK(chance.agrees_with(aimed));
            CHECK(chance_inside.agrees_with(aimed_inside));
            CHECK(other == 0);
            // In the ring they are 13 times as many, with the same photons emitted.
            CHECK(by_aim > (name == std::string("ring") ? 10 : 1) * by_chance);
            for (int c = 0; c < 3; ++c) CHECK(aimed.error()[c] < chance.error()[c]);
        }
    }
}

TEST_CASE("without mirrors none is aimed, without lights none is emitted") {
    const LitTree stage("box");
    CHECK(stage.aimed({.count = 100}).photons.empty());
    LitScene dark = stage.lit;
    dark.lights.clear();
    const LightTable none(dark);
    CHECK(trace_photons(stage.tree, dark, none, {.count = 100}).counts.emitted == 0);
    CHECK(trace_aimed_photons(stage.tree, dark, none, {.count = 100}).counts.emitted == 0);
}

TEST_CASE("after the last reflection that is allowed a photon is stopped, and counted so") {
    const LitTree stage("furnace");
    const PhotonTrace trace = stage.photons({.count = 1'000, .most_bounces = 1});
    CHECK(trace.photons.size() == 1'000);
    CHECK(trace.counts.stopped > 0);
    CHECK(trace.counts.stopped + trace.counts.absorbed == 1'000);
}

}  // namespace space
