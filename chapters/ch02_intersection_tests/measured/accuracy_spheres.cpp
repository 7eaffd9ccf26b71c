#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/measured/chunks.hpp"
#include "chapters/ch02_intersection_tests/measured/exact_deciders.hpp"

namespace space::ch02 {
namespace {

/// Aimed at a point of the ball of radius 1.5 around the centre.
Ray ray_at(const Sphere& sphere, double distance, Pcg32& random) {
    const double from_centre = 1.5 * random.uniform_double();
    const Double3 target = Double3(sphere.centre) + from_centre * random_direction(random);
    const Point3 origin(Double3(sphere.centre) + distance * random_direction(random));
    return {.origin = origin, .direction = Point3(target) - origin};
}

}  // namespace

SphereAccuracy sphere_accuracy(double distance, std::uint64_t pairs, std::uint64_t seed,
                               unsigned threads) {
    struct Part : SphereAccuracy {
        std::array<std::vector<double>, sphere_test_count> ulps;
    };
    const auto parts =
        count_by_chunks<Part>(pairs, seed, threads, [&](Pcg32& random, std::uint64_t size) {
            Part part;
            for (std::uint64_t i = 0; i < size; ++i) {
                const Sphere sphere{random_vector(random), 1.0f};
                const Ray ray = ray_at(sphere, distance, random);
                const ExactQuadratic exact(ray, sphere);
                const bool hits = exactly_hits_ahead(exact);
                const double t = hits ? exact_first_t(exact) : 0.0;
                part.exact_hits += hits;
                for_each_named(sphere_tests, [&](std::size_t test, const auto& named) {
                    using Test = TestOf<decltype(named)>;
                    bool hit = false;
                    if constexpr (requires { Test::hits(ray, sphere); }) {
                        hit = Test::hits(ray, sphere);
                    } else if (const auto found = Test::intersect(ray, sphere)) {
                        hit = true;
                        if (hits) part.ulps[test].push_back(ulps(*found, t));
                    }
                    part.wrong[test].test = named.name;
                    ++part.wrong[test].decisions;
                    part.wrong[test].hits += hit && !hits;
                    part.wrong[test].misses += !hit && hits;
                });
            }
            return part;
        });
    SphereAccuracy sum;
    sum.distance = distance;
    sum.pairs = pairs;
    for (const Part& part : parts) {
        sum.exact_hits += part.exact_hits;
        for (std::size_t test = 0; test < sphere_test_count; ++test)
            sum.wrong[test].add(part.wrong[test]);
    }
    for (std::size_t test = 0; test < sphere_test_count; ++test) {
        std::vector<double> ulps;
        for (const Part& part : parts)
            ulps.insert(ulps.end(), part.ulps[test].begin(), part.ulps[test].end());
        sum.t[test] = summary(std::move(ulps));
    }
    return sum;
}

SpheresBehind spheres_behind(std::uint64_t rays, std::uint64_t seed) {
    Pcg32 random(seed);
    SpheresBehind result{.rays = rays};
    for (std::uint64_t i = 0; i < rays; ++i) {
        const Sphere sphere{random_vector(random), 1.0f};
        const Point3 origin(Double3(sphere.centre) + 3.0 * random_direction(random));
        const Ray ray{.origin = origin, .direction = Vector3(random_direction(random))};
        const ExactQuadratic exact(ray, sphere);
        const bool printed = SphereAsPrinted::hits(ray, sphere);
        result.exact_hits += exactly_hits_ahead(exact);
        result.printed_hits += printed;
        result.behind += printed && exact.discriminant.sign() >= 0 && exact.b.sign() > 0;
    }
    return result;
}

}  // namespace space::ch02
