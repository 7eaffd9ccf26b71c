// Naive tracing through the suite, and against the exact oracle: with the exact test, with which it
// is what every structure is measured by, and with chapter 1's.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"

#include "common/mesh.hpp"
#include "common/parallel.hpp"
#include "common/scene.hpp"
#include "tests/suite/accelerator_suite.hpp"
#include "tests/suite/test_rays.hpp"

#include <filesystem>
#include <functional>

namespace space {
namespace {

constexpr int random_rays = 20'000, aimed_rays = 2'500, mesh_rays = 600, exact_rays = 1'000;

/// As many as are worth starting for the oracle, which is slow.
const unsigned threads = std::max(1u, std::thread::hardware_concurrency());

Tally compared(std::span<const Triangle> triangles, const std::vector<Ray>& rays) {
    const Naive<> naive = Naive<>::build(triangles);
    const ExactOracle oracle = ExactOracle::build(triangles);
    std::vector<Comparison> comparisons(rays.size());
    parallel_for(rays.size(), threads, 16, [&](std::size_t i) {
        comparisons[i] = compare(oracle, rays[i], closest_hit(naive, rays[i]));
    });
    Tally tally;
    for (const Comparison& comparison : comparisons) tally.add(comparison);
    return tally;
}

std::vector<Ray> rays_of(int count, const std::function<TestRay()>& make) {
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) rays.push_back(make().ray);
    return rays;
}

SuiteReport check_against_oracle(int rays_per_scene) {
    SuiteOptions options;
    options.exact_rays = rays_per_scene;
    const SuiteReport report = check_accelerator<Naive<FilteredExact>>(
        "naive, filtered-exact",
        [](std::span<const Triangle> triangles) { return Naive<FilteredExact>::build(triangles); },
        options);
    CHECK(report.exact.wrong() == 0);
    CHECK(report.exact.rounded_t == 0);
    CHECK(report.exact[Agreement::interval_end] == 0);
    return report;
}

}  // namespace

TEST_CASE(
    "naive tracing with the exact test gives exact arithmetic's answers to the suite's rays") {
    CHECK(check_against_oracle(exact_rays).exact.examined() > std::size_t{25} * exact_rays);
}
// By hand, a minute of two cores: naive_tests "[.big]".
TEST_CASE("naive tracing with the exact test, every ray of the suite", "[.big]") {
    const SuiteReport report = check_against_oracle(1'000'000);
    CHECK(report.exact.examined() == report.rays);
}
TEST_CASE("the suite: naive tracing with chapter 1's test") {
    const SuiteReport report = check_accelerator<Naive<>, MollerTrumbore>(
        "naive", [](std::span<const Triangle> triangles) { return Naive<>::build(triangles); });
    CHECK(report.naive_wrong == 0);
}

TEST_CASE("naive tracing is exactly right on 10^5 random rays over five scenes") {
    Tally sum;
    for (const TestScene& scene :
         {TestScene{"soup", scenes::soup(300, 0.2f, 101)},
          TestScene{"uneven", adversarial_scenes()[5].triangles},
          TestScene{"ball", scenes::ball(3)}, TestScene{"dense", scenes::soup(150, 1.0f, 102)},
          TestScene{"far away", scenes::mapped(scenes::soup(300, 0.3f, 103), [](const Point3& p) {
                        return p + Point3(1e4f, -2e4f, 3e4f);
                    })}}) {
        RayMaker maker(scene.triangles, 104);
        const Tally tally =
            compared(scene.triangles, rays_of(random_rays, [&] { return maker.random(); }));
        fmt::print("{} ({} triangles), random rays: {}\n", scene.name, scene.triangles.size(),
                   tally.text());
        CHECK(tally.wrong() == 0);
        CHECK(tally.beyond_bound == 0);
        sum += tally;
    }
    CHECK(sum.examined() == 5 * random_rays);
    CHECK(sum[Agreement::interval_end] == 0);
}

TEST_CASE(
    "on rays at edges and vertices naive tracing errs only within its error bound, in every "
    "adversarial scene") {
    for (const TestScene& scene : adversarial_scenes()) {
        RayMaker maker(scene.triangles, 105);
        int i = 0;
        const Tally tally = compared(scene.triangles, rays_of(aimed_rays, [&] {
                                         return ++i % 2 ? maker.at_edge() : maker.at_vertex();
                                     }));
        fmt::print("{}, rays at edges and vertices: {}\n", scene.name, tally.text());
        INFO(scene.name << ": " << tally.text());
        CHECK(tally.beyond_bound == 0);
        CHECK(tally[Agreement::wrong_hit] == 0);
    }
}

TEST_CASE("naive tracing is exactly right on random rays in the book's scenes") {
    for (const char* name :
         {"soup", "soup_uneven", "slivers", "boxes", "stadium", "icosphere", "sphereflake"}) {
        const std::vector<Triangle> triangles = make_scene(name, 1, true).mesh.triangles();
        RayMaker maker(triangles, 106);
        const Tally tally = compared(triangles, rays_of(mesh_rays, [&] { return maker.random(); }));
        fmt::print("{} ({} triangles), random rays: {}\n", name, triangles.size(), tally.text());
        INFO(name);
        CHECK(tally.wrong() == 0);
        CHECK(tally.beyond_bound == 0);
    }
}

TEST_CASE("naive tracing is exactly right on the bunny") {
    const std::filesystem::path file = "/usr/share/glmark2/models/bunny.obj";
    if (!std::filesystem::exists(file)) {
        WARN("skipped: " << file.string() << " is not there (package glmark2-data)");
        return;
    }
    const std::vector<Triangle> triangles = load_mesh(file).triangles();
    RayMaker maker(triangles, 107);
    Tally tally = compared(triangles, rays_of(mesh_rays, [&] { return maker.random(); }));
    tally += compared(triangles, rays_of(mesh_rays / 10, [&] { return maker.from_face(); }));
    fmt::print("bunny ({} triangles), random rays: {}\n", triangles.size(), tally.text());
    CHECK(tally.wrong() == 0);
    CHECK(tally.beyond_bound == 0);
}

}  // namespace space
