#include "chapters/ch01_naive_ray_tracing/measured/measurements.hpp"

#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>

namespace space::ch01 {
namespace {

/// A scene with the sizes that give it about 1 K, 10 K, 100 K and 1 M triangles; fewer where it has
/// no such size.
struct Sizes {
    const char* name;
    std::vector<std::uint32_t> large;
    std::vector<std::uint32_t> small;  ///< about 10, 100 and 1,000 triangles
};
const std::array<Sizes, 5>& sized_scenes() {
    static const std::array<Sizes, 5> scenes{{
        {"soup", {1'000, 10'000, 100'000, 1'000'000}, {10, 100, 1'000}},
        {"icosphere", {7, 22, 71, 224}, {1, 2, 7}},
        {"tetra", {5, 7, 8, 10}, {2, 3, 5}},
        {"slivers", {1'000, 10'000, 100'000}, {10, 100, 1'000}},
        {"boxes", {80, 800, 8'000, 80'000}, {1, 8, 80}},
    }};
    return scenes;
}

struct Measured {
    std::string name, spec;
};
/// The scenes of a series of measurements, size after size: the first few small ones, the first few
/// large ones.
std::vector<Measured> series(std::size_t small_sizes, std::size_t large_sizes) {
    std::vector<Measured> measured;
    for (const Sizes& scene : sized_scenes()) {
        const auto add = [&](const std::vector<std::uint32_t>& sizes, std::size_t count) {
            for (std::size_t i = 0; i < std::min(count, sizes.size()); ++i)
                measured.push_back({scene.name, fmt::format("{}:{}", scene.name, sizes[i])});
        };
        add(scene.small, small_sizes);
        add(scene.large, large_sizes);
    }
    return measured;
}

constexpr int rounds = 3;

/// How often one run repeats its work, so that it takes some milliseconds with few triangles too.
int repeats_for(Amount amount, int work, double triangles) {
    return amount == Amount::small ? 1 : std::max(1, static_cast<int>(work / triangles));
}

Winding check_winding(std::span<const Triangle> triangles) {
    Winding winding;
    for (const Triangle& t : triangles) {
        const Double3 n = normal(t);
        if (n == Double3(0.0)) continue;
        ++winding.triangles;
        winding.flipped += normal({t.a, t.c, t.b}) == -n;
        winding.kept += glm::dot(normal({t.b, t.c, t.a}), n) > 0.0;
    }
    return winding;
}

/// The rays of a picture and their answers, in the order in which they are asked.
struct Record {
    std::vector<Ray> camera, shadow;
    std::vector<std::optional<Hit>> hits;
    std::vector<char> occluded;
};

/// Naive tracing that writes down what it is asked and what it answers.
struct Recorder {
    const Naive<>& naive;
    Record& record;

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray& ray, Counts& counts) const {
        record.camera.push_back(ray);
        return record.hits.emplace_back(naive.closest_hit(ray, counts));
    }
    template <class Counts>
    bool any_hit(const Ray& ray, Counts& counts) const {
        record.shadow.push_back(ray);
        return record.occluded.emplace_back(naive.any_hit(ray, counts));
    }
    TreeShape shape() const { return naive.shape(); }
};

/// Gives the recorded answers again, without a test.
struct Player {
    const Record& record;
    mutable std::size_t hit = 0, shadow = 0;

    template <class Counts>
    std::optional<Hit> closest_hit(const Ray&, Counts&) const {
        return record.hits[hit++];
    }
    template <class Counts>
    bool any_hit(const Ray&, Counts&) const {
        return record.occluded[shadow++];
    }
    TreeShape shape() const { return {}; }
};

/// A ray at a vertex of the sphere.
struct RayAtVertex {
    Ray ray;
    bool exact;  ///< it goes exactly through the vertex
};
/// Rays from outside at vertices of the unit icosphere, well inside its outline. They end before
/// its far side, so that each must hit the near side: one that hits nothing slipped through a
/// closed surface.
std::vector<RayAtVertex> rays_at_vertices(const TriangleMesh& sphere, std::size_t count,
                                          std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<RayAtVertex> rays;
    while (rays.size() < count) {
        const Point3 origin = random_point(random, -3.0f, 3.0f);
        const Point3& vertex =
            sphere.vertices[random.below(static_cast<std::uint32_t>(sphere.vertices.size()))];
        const Vector3 direction = vertex - origin;
        // Seen at less than 60 degrees from the normal: the way through the sphere is longer than
        // its radius.
        if (glm::dot(direction, vertex) < -0.5f * glm::length(direction))
            rays.push_back({{origin, direction, 0.0f, 1.1f},
                            Double3(direction) == Double3(vertex) - Double3(origin)});
    }
    return rays;
}

}  // namespace

namespace {

/// Counts the pixels that lose to what is behind the eye where t has no lower bound.
void count_behind(const Scene& scene, const Naive<>& naive, SceneCounts& counts, int width,
                  int height) {
    const PixelGrid grid(scene.camera, width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Ray ray = grid.ray(x, y);
            const bool in_front = any_hit(naive, ray);
            ray.tmin = -infinity;
            const std::optional<Hit> first = closest_hit(naive, ray);
            if (!first || first->t >= 0.0f) continue;
            ++counts.behind;
            counts.behind_wins += in_front;
        }
}

}  // namespace

Scene in_reverse(Scene scene) {
    std::reverse(scene.mesh.faces.begin(), scene.mesh.faces.end());
    std::reverse(scene.colors.begin(), scene.colors.end());
    return scene;
}

std::vector<SceneCounts> count_scenes(const Options& options) {
    constexpr std::array names{"room", "sphereflake", "soup", "icosphere", "lattice"};
    const int width = options.small ? 24 : 40, height = options.small ? 18 : 30;
    std::vector<SceneCounts> all;
    Progress progress("counting", names.size());
    for (const char* name : names) {
        const Scene scene = make_scene(name, options.seed, options.small);
        const std::vector<Triangle> triangles = scene.mesh.triangles();
        const Naive<> naive = Naive<>::build(triangles);
        const RenderSettings settings{.width = width, .height = height, .threads = options.threads};

        const Scene reversed = in_reverse(scene);
        const RenderCounts counts = render(scene, naive, settings).counts;
        const Coverage coverage = compare_coverage(
            scene, trace_depth({scene.camera, width, height}, naive, options.threads),
            rasterise(scene, width, height));
        all.push_back(
            {.scene = name,
             .triangles = triangles.size(),
             .lights = scene.lights.size(),
             .pixels = static_cast<std::uint64_t>(width * height),
             .hits = counts.hits,
             .shadow_rays = counts.shadow_rays,
             .occluded = counts.occluded,
             .tests = counts.traversal.triangles_tested,
             .hits_as_printed = algorithm1_as_printed(scene, triangles, settings).counts.hits,
             .hits_in_reverse =
                 algorithm1_as_printed(reversed, reversed.mesh.triangles(), settings).counts.hits,
             .covered = coverage.covered,
             .disagree = coverage.disagree,
             .near_edge = coverage.near_edge,
             .same_depth = coverage.same_depth,
             .unexplained = coverage.unexplained,
             .winding = check_winding(triangles)});
        count_behind(scene, naive, all.back(), width, height);
        progress.step();
    }
    return all;
}

namespace {

template <class Real>
std::vector<char> leaks(std::span<const Triangle> triangles, std::span<const RayAtVertex> rays) {
    const auto naive = Naive<BasicMollerTrumbore<Real>>::build(triangles);
    std::vector<char> leaked;
    for (const RayAtVertex& at : rays) leaked.push_back(!closest_hit(naive, at.ray));
    return leaked;
}

}  // namespace

VertexLeaks measure_leaks(const Options& options) {
    const bool full = options.amount() == Amount::full;
    const Scene scene = make_scene("icosphere:12");
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const std::vector<RayAtVertex> rays =
        rays_at_vertices(scene.mesh, full ? 20'000 : 2'000, options.seed);
    std::vector<char> in_float, in_double;
    const std::array<std::function<void()>, 2> candidates{
        [&] { in_float = leaks<float>(triangles, rays); },
        [&] { in_double = leaks<double>(triangles, rays); }};
    std::vector<double> ms{0.0, 0.0};
    if (options.counts || options.small)
        for (const auto& run : candidates) run();
    else
        ms = interleaved_medians(candidates, rounds);
    VertexLeaks counted{.rays = rays.size(), .float_ms = ms[0], .double_ms = ms[1]};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        counted.exact += rays[i].exact;
        counted.leaks_float += in_float[i];
        counted.leaks_double += in_double[i];
        counted.exact_leaks_double += rays[i].exact && in_double[i];
    }
    return counted;
}

std::vector<GrowthPoint> measure_growth(const Options& options) {
    const Amount amount = options.amount();
    constexpr int naive_width = 6, naive_height = 4, width = 160, height = 120;
    const std::vector<Measured> scenes = amount == Amount::small   ? series(2, 0)
                                         : amount == Amount::quick ? series(0, 3)
                                                                   : series(0, 4);
    std::vector<GrowthPoint> growth;
    Progress progress("time against triangles", scenes.size());
    for (const Measured& measured : scenes) {
        const Scene scene = make_scene(measured.spec, options.seed);
        const Naive<> naive = Naive<>::build(scene.mesh.triangles());
        const auto triangles = static_cast<double>(scene.mesh.faces.size());
        const int repeats = repeats_for(amount, 20'000, triangles);
        const std::array<std::function<void()>, 2> candidates{
            [&] {
                for (int i = 0; i < repeats; ++i)
                    do_not_optimize(render<NoCounts>(scene, naive,
                                                     {.width = naive_width, .height = naive_height})
                                        .image);
            },
            [&] {
                for (int i = 0; i < repeats; ++i)
                    do_not_optimize(rasterise(scene, width, height).pixels);
            }};
        const std::vector<double> ms = interleaved_medians(candidates, rounds);
        growth.push_back({.scene = measured.name,
                          .triangles = triangles,
                          .naive_us = 1000.0 * ms[0] / (repeats * naive_width * naive_height),
                          .rasteriser_us = 1000.0 * ms[1] / (repeats * width * height)});
        progress.step();
    }
    return growth;
}

std::vector<SharePoint> measure_shares(const Options& options) {
    const Amount amount = options.amount();
    constexpr int width = 20, height = 15;
    const std::vector<Measured> scenes = amount == Amount::small   ? series(2, 0)
                                         : amount == Amount::quick ? series(3, 0)
                                                                   : series(2, 2);
    const int rest_repeats = amount == Amount::small ? 1 : 100;  // some microseconds each
    std::vector<SharePoint> shares;
    Progress progress("share of time in intersection tests", scenes.size());
    for (const Measured& measured : scenes) {
        const Scene scene = make_scene(measured.spec, options.seed);
        const Naive<> naive = Naive<>::build(scene.mesh.triangles());
        const RenderSettings settings{.width = width, .height = height};
        Record record;
        render<NoCounts>(scene, Recorder{naive, record}, settings);
        const auto triangles = static_cast<double>(scene.mesh.faces.size());
        const int repeats = repeats_for(amount, 1'000, triangles);
        const std::array<std::function<void()>, 2> candidates{
            [&] {
                for (int i = 0; i < repeats; ++i) {
                    for (const Ray& ray : record.camera) do_not_optimize(closest_hit(naive, ray));
                    for (const Ray& ray : record.shadow) do_not_optimize(any_hit(naive, ray));
                }
            },
            [&] {
                for (int i = 0; i < rest_repeats; ++i)
                    do_not_optimize(render<NoCounts>(scene, Player{record}, settings).image);
            }};
        const std::vector<double> ms = interleaved_medians(candidates, 2 * rounds + 1);
        shares.push_back({measured.name, triangles, ms[0] / repeats, ms[1] / rest_repeats});
        progress.step();
    }
    return shares;
}

Measurements measure(const Options& options) {
    Measurements measured{.counts = count_scenes(options),
                          .leaks = measured_once<measure_leaks>(options)};
    if (options.counts) return measured;
    measured.growth = measured_once<measure_growth>(options);
    measured.shares = measured_once<measure_shares>(options);
    return measured;
}

}  // namespace space::ch01
