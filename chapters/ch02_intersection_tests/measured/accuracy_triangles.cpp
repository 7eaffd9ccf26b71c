#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/measured/chunks.hpp"
#include "common/measure.hpp"

#include <algorithm>
#include <cmath>

namespace space::ch02 {
namespace {

double exact_t(const Ray& ray, const Triangle& triangle) {
    const auto volumes = expansion_volumes(ray, triangle);
    return volumes.t.value() / volumes.det.value();
}

}  // namespace

double ulps(float value, double exact) {
    const float nearest = std::abs(static_cast<float>(exact));
    const double ulp =
        nearest < infinity ? double{std::nextafter(nearest, infinity)} - nearest : 0x1p104;
    return std::abs(value - exact) / ulp;
}

UlpError summary(std::vector<double> ulps) {
    if (ulps.empty()) return {};
    const double worst = *std::max_element(ulps.begin(), ulps.end());
    return {.values = ulps.size(), .median = median(std::move(ulps)), .worst = worst};
}

TriangleAccuracy triangle_accuracy(const TriangleInput& input, std::uint64_t pairs,
                                   std::uint64_t seed, unsigned threads) {
    struct Part : TriangleAccuracy {
        std::array<std::vector<double>, triangle_test_count> ulps;
    };
    const auto parts =
        count_by_chunks<Part>(pairs, seed, threads, [&](Pcg32& random, std::uint64_t count) {
            Part part;
            for (std::uint64_t i = 0; i < count; ++i) {
                const RayAndTriangle pair = make_pair(input, random);
                const Ray& ray = pair.ray;
                const Triangle& triangle = pair.triangle;
                const bool hits = FilteredExact::intersect(ray, triangle, part.stages).has_value();
                const double t = hits ? exact_t(ray, triangle) : 0.0;
                part.exact_hits += hits;
                for_each_named(triangle_tests, [&](std::size_t test, const auto& named) {
                    const auto hit = TestOf<decltype(named)>::intersect(ray, triangle);
                    part.wrong[test].test = named.name;
                    ++part.wrong[test].decisions;
                    part.wrong[test].hits += hit && !hits;
                    part.wrong[test].misses += !hit && hits;
                    if (hit && hits) part.ulps[test].push_back(ulps(hit->t, t));
                });
            }
            return part;
        });
    TriangleAccuracy sum;
    sum.input = input.name;
    sum.pairs = pairs;
    for (const Part& part : parts) {
        sum.exact_hits += part.exact_hits;
        for (std::size_t i = 0; i < 3; ++i) sum.stages.count[i] += part.stages.count[i];
        for (std::size_t test = 0; test < triangle_test_count; ++test)
            sum.wrong[test].add(part.wrong[test]);
    }
    for (std::size_t test = 0; test < triangle_test_count; ++test) {
        std::vector<double> ulps;
        for (const Part& part : parts)
            ulps.insert(ulps.end(), part.ulps[test].begin(), part.ulps[test].end());
        sum.t[test] = summary(std::move(ulps));
    }
    return sum;
}

Leaks closed_mesh_leaks(int levels, int shift, std::uint64_t rays, std::uint64_t seed,
                        unsigned threads) {
    TriangleMesh mesh = bumpy_ball(levels);
    const Double3 centre =
        shift == 0 ? Double3(0.0) : std::pow(10.0, shift) * Double3(1.0, 0.5, -0.25);
    for (Point3& vertex : mesh.vertices) vertex = Point3(Double3(vertex) + centre);
    const std::vector<Triangle> triangles = mesh.triangles();

    // Nearly every ray hits a triangle that shares a vertex with the one it is aimed at: look there
    // first.
    std::vector<std::vector<std::uint32_t>> faces_at(mesh.vertices.size());
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face)
        for (const std::uint32_t vertex : mesh.faces[face]) faces_at[vertex].push_back(face);

    const auto parts =
        count_by_chunks<Leaks>(rays, seed, threads, [&](Pcg32& random, std::uint64_t count) {
            Leaks part;
            for (std::uint64_t i = 0; i < count; ++i) {
                const auto& face =
                    mesh.faces[random.below(static_cast<std::uint32_t>(mesh.faces.size()))];
                const Double3 from{mesh.vertices[face[0]]}, to{mesh.vertices[face[1]]};
                const double share = random.below(2) ? random.uniform_double()
                                                     : 0.0;  // a point of the edge, or the vertex
                const Point3 origin(centre + 0.2 * Double3(random_vector(random)));
                const Ray ray{.origin = origin,
                              .direction = Point3(from + share * (to - from)) - origin};
                const auto hits_mesh = [&]<class Test>(Test) {
                    for (const std::uint32_t vertex : face)
                        for (const std::uint32_t near : faces_at[vertex])
                            if (Test::intersect(ray, triangles[near])) return true;
                    for (const Triangle& triangle : triangles)
                        if (Test::intersect(ray, triangle)) return true;
                    return false;
                };
                if (!hits_mesh(FilteredExact{})) continue;
                ++part.rays;
                for_each_named(triangle_tests, [&](std::size_t test, const auto& named) {
                    part.leaks[test] += !hits_mesh(TestOf<decltype(named)>{});
                });
            }
            return part;
        });
    Leaks sum;
    sum.mesh = shift == 0 ? "at the origin" : "moved by 10^" + std::to_string(shift);
    for (const Leaks& part : parts) {
        sum.rays += part.rays;
        for (std::size_t test = 0; test < triangle_test_count; ++test)
            sum.leaks[test] += part.leaks[test];
    }
    return sum;
}

}  // namespace space::ch02
