#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/measured/sampling.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "chapters/ch11_sampling_and_caching/spherical_triangle.hpp"
#include "common/parallel.hpp"
#include "common/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace space::ch11 {
namespace {

constexpr std::pair<SamplePattern, std::string_view> all_patterns[] = {
    {SamplePattern::independent, "independent"},
    {SamplePattern::stratified, "stratified"},
    {SamplePattern::sobol, "Sobol', scrambled"}};

/// A triangle that shines down at the origin, and half of it behind a board whose edge runs along
/// none of its own.
LitScene one_triangle(bool with_board) {
    Scene scene;
    scene.mesh.vertices = {{-0.75f, 1, -0.5f}, {0.75f, 1, -0.375f}, {0.125f, 1, 0.875f}};
    scene.mesh.faces = {{0, 1, 2}};
    if (with_board) {
        scene.mesh.vertices.insert(scene.mesh.vertices.end(),
                                   {{-1, 0.5f, -0.21f}, {1, 0.5f, 0.32f}, {0, 0.5f, 3}});
        scene.mesh.faces.push_back({3, 4, 5});
    }
    std::vector<Color> emission(scene.mesh.faces.size(), Color(0.0f));
    emission[0] = Color(1.0f);
    return lit(std::move(scene), std::move(emission));
}

/// The irradiance at the origin by so many samples, one estimate for each seed.
std::vector<double> estimates(const LitScene& scene, SamplePattern pattern, std::uint32_t samples,
                              std::size_t seeds, unsigned threads) {
    const LightTable lights(scene);
    const auto tree = Bvh<BinnedBuilder>::build(scene.triangles);
    const SurfacePoint surface{.position = Double3(0.0),
                               .normal = {0, 1, 0},
                               .origin = Point3(0.0f),
                               .triangle = 0,
                               .front = true};
    std::vector<double> all(seeds);
    parallel_for(seeds, threads, 1, [&](std::size_t seed) {
        Sampler sampler(pattern, samples, seed + 1);
        for (std::uint32_t i = 0; i < samples; ++i) {
            sampler.start(0, i);
            all[seed] +=
                irradiance_from_lights(tree, lights, surface, sampler, Lighting::area).x / samples;
        }
    });
    return all;
}

/// The solid angle as the sum of the angles between a spherical triangle's sides, minus pi (Girard
/// 1629).
double solid_angle_by_angles(const Double3& a, const Double3& b, const Double3& c) {
    const auto angle = [](const Double3& at, const Double3& p, const Double3& q) {
        const Double3 u = glm::normalize(glm::cross(at, p)), v = glm::normalize(glm::cross(at, q));
        return std::acos(std::clamp(glm::dot(u, v), -1.0, 1.0));
    };
    return angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - std::numbers::pi;
}

/// As SphericalTriangle has it, in extended precision.
long double exact_solid_angle(const Triangle& triangle, const Double3& point) {
    using Long3 = glm::vec<3, long double>;
    const Long3 from(point), first(triangle.a), second(triangle.b), third(triangle.c);
    const Long3 a = first - from, b = second - from, c = third - from;
    const long double volume = glm::dot(a, glm::cross(second - first, third - first));
    const long double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2.0L * std::atan2(std::abs(volume), la * lb * lc + glm::dot(a, b) * lc +
                                                   glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

}  // namespace

std::vector<PatternPoint> measure_patterns(const Options& options) {
    const std::uint32_t most = options.small ? 256 : 16'384;
    const std::size_t seeds = options.small ? 16 : 64;
    std::vector<PatternPoint> points;
    for (const bool edge : {false, true}) {
        const LitScene scene = one_triangle(edge);
        // The best of the patterns at the most samples, over all seeds.
        RunningMean reference;
        for (const double e : estimates(scene, SamplePattern::sobol, most, seeds, options.threads))
            reference.add(e);
        for (const auto& [pattern, name] : all_patterns)
            for (std::uint32_t samples = 4; samples <= most; samples *= 4) {
                double squares = 0.0;
                for (const double e : estimates(scene, pattern, samples, seeds, options.threads))
                    squares += (e / reference.mean - 1.0) * (e / reference.mean - 1.0);
                points.push_back({edge ? "half shadow" : "smooth", name, samples,
                                  std::sqrt(squares / double(seeds))});
            }
    }
    return points;
}

std::vector<SphericalTrianglePoint> measure_spherical_triangles(const Options& options) {
    std::vector<SphericalTrianglePoint> points;
    Pcg32 random(options.seed);
    for (int exponent = 1; exponent <= 7; ++exponent) {
        SphericalTrianglePoint worst{.size = std::pow(10.0, -exponent)};
        const auto size = static_cast<float>(worst.size);
        for (int i = 0; i < 1'000; ++i) {
            Triangle triangle;
            for (Point3* corner : {&triangle.a, &triangle.b, &triangle.c})
                *corner = size * random_vector(random);
            const Double3 point = random_direction(random);
            const SphericalTriangle seen(triangle, point);
            const auto exact = static_cast<double>(exact_solid_angle(triangle, point));
            // Neither slivers nor triangles seen edge-on: those are hard for other reasons.
            if (exact < 0.1 * worst.size * worst.size) continue;
            const auto raise = [&](double& error, double value) {
                error = std::max(error, std::abs(value / exact - 1.0));
            };
            raise(worst.by_angles, solid_angle_by_angles(seen.a, seen.b, seen.c));
            raise(worst.by_volume, seen.solid_angle);
        }
        points.push_back(worst);
    }
    return points;
}

}  // namespace space::ch11
