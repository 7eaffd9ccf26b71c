#include "chapters/ch03_bsp_trees/bsp.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <algorithm>
#include <cmath>
#include <string>

using namespace space;

namespace {

/// The names of the segments A .. G in each splitter's sets.
struct Sets {
    std::string splitters, cuts;
    std::vector<std::string> front, back;  ///< of each splitter

    static char name(std::uint32_t polygon) {
        return static_cast<char>('A' + static_cast<int>(polygon));
    }
    void observe(const BspBuilder<2>::Chosen& event) {
        splitters += name(event.polygon.value());
        front.emplace_back();
        back.emplace_back();
    }
    void observe(const BspBuilder<2>::Placed& event) {
        const bool both = event.side == PlaneSide::straddling;
        if (both || event.side == PlaneSide::front) front.back() += name(event.fragment.polygon);
        if (both || event.side == PlaneSide::back) back.back() += name(event.fragment.polygon);
    }
    void observe(const BspBuilder<2>::Cut& event) { cuts += name(event.whole.polygon); }
};

std::vector<Triangle> soup(std::uint32_t count, float size, std::uint64_t seed) {
    Pcg32 random(seed);
    const auto point = [&](float s) { return random_point(random, -s, s); };
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point3 centre = point(1.0f);
        triangles.push_back({centre + point(size), centre + point(size), centre + point(size)});
    }
    return triangles;
}

}  // namespace

TEST_CASE("the splitters G, E, B, A give the sets and the tree that Heinonen16 prints") {
    const std::vector<Segment> segments = heinonen_segments();
    const std::uint32_t order[] = {6, 4, 1, 0};
    for (const Grade grade :
         {Grade::thick_float, Grade::ordered_float, Grade::ordered_double, Grade::exact}) {
        Sets sets;
        const BspTree<2> tree = BspBuilder<2>::build(
            segments,
            {.splitter = BspConfig::SplitterChoice::first, .grade = grade, .order = order}, sets);
        CHECK(sets.splitters.front() == 'G');
        CHECK(sets.front[0] == "ABC");
        CHECK(sets.back[0] == "DEF");
        CHECK(sets.cuts == "C");
        const auto of = [&](char name) {
            return static_cast<std::size_t>(sets.splitters.find(name));
        };
        CHECK(sets.front[of('E')] + sets.back[of('E')] == "DF");
        CHECK(sets.front[of('B')] == "AC");
        CHECK(sets.back[of('B')] == "C");
        CHECK(tree.fragments.size() == 8);
        CHECK(tree.nodes.size() == 8);
    }
}

TEST_CASE("the suite: BSP tree") {
    run_suite<Bsp>("bsp");
}

TEST_CASE("the suite: BSP tree with free planes") {
    check_accelerator<Bsp<>>("bsp, free planes", [](std::span<const Triangle> t) {
        return Bsp<>::build(t, {.splitter = BspConfig::SplitterChoice::free});
    });
}

TEST_CASE(
    "the suite: BSP tree whose subtrees share what straddles, where it doesn't double with every "
    "plane") {
    // Where every polygon crosses every plane there are 2^n references: no scene for sharing.
    const auto build = [](std::span<const Triangle> t) {
        return Bsp<>::build(t,
                            {.straddlers = BspConfig::Straddlers::share, .max_fragments = 30'000});
    };
    SuiteOptions options;
    std::vector<std::string> refused;
    std::erase_if(options.scenes, [&](const TestScene& scene) {
        try {
            build(scene.triangles);
            return false;
        } catch (const LimitError&) {
            refused.push_back(scene.name);
            return true;
        }
    });
    check_accelerator<Bsp<>>("bsp, shared", build, options);
    CHECK(options.scenes.size() > 18);
    CHECK(std::find(refused.begin(), refused.end(), "equal centroids") != refused.end());
    CHECK(std::find(refused.begin(), refused.end(), "whole numbers") != refused.end());
}

TEST_CASE("every grade and choice of splitters gives the naive loop's hits on random triangles") {
    const std::vector<Triangle> triangles = soup(60, 0.6f, 5);
    const auto naive = Naive<FilteredExact>::build(triangles);
    for (const Grade grade :
         {Grade::thick_float, Grade::ordered_float, Grade::ordered_double, Grade::exact})
        for (const BspConfig::SplitterChoice splitter :
             {BspConfig::SplitterChoice::first, BspConfig::SplitterChoice::random,
              BspConfig::SplitterChoice::balanced, BspConfig::SplitterChoice::fewest_splits,
              BspConfig::SplitterChoice::weighted, BspConfig::SplitterChoice::free})
            for (const BspConfig::Straddlers straddlers :
                 {BspConfig::Straddlers::split, BspConfig::Straddlers::share}) {
                const auto bsp = Bsp<FilteredExact>::build(triangles, {.splitter = splitter,
                                                                       .straddlers = straddlers,
                                                                       .grade = grade,
                                                                       .max_fragments = 200'000});
                Pcg32 random(9);
                int wrong = 0;
                for (int i = 0; i < sized(200, 20); ++i) {
                    const Point3 origin = 3.0f * random_vector(random);
                    const Triangle& aim = triangles[random.below(60)];
                    const Ray ray{origin,
                                  (i % 2 ? aim.a : (aim.a + aim.b + aim.c) / 3.0f) - origin};
                    wrong += closest_hit(bsp, ray) != closest_hit(naive, ray);
                }
                CHECK(wrong == 0);
            }
}

TEST_CASE("thick planes lose hits as they grow thicker, exact ones none") {
    const Scene mount = make_scene("mount:4");
    const std::vector<Triangle> triangles = mount.mesh.triangles();
    const auto naive = Naive<FilteredExact>::build(triangles);
    const auto wrong_rays = [&](Grade grade) {
        const auto bsp =
            Bsp<FilteredExact>::build(triangles, {.splitter = BspConfig::SplitterChoice::random,
                                                  .grade = grade,
                                                  .thickness_in_roundings = 1000.0});
        Pcg32 random(3);
        int wrong = 0;
        for (int i = 0; i < sized(10'000, 1'000); ++i) {  // at points of cuts and edges
            const auto& fragments = bsp.tree().fragments;
            const Fragment<3>& fragment =
                fragments[random.below(static_cast<std::uint32_t>(fragments.size()))];
            const auto corner = random.below(static_cast<std::uint32_t>(fragment.corners.size()));
            const Double3 p = fragment.corners[corner].at,
                          q = fragment.corners[(corner + 1) % fragment.corners.size()].at;
            const Point3 aim(p + random.uniform_double() * (q - p));
            const Vector3 back = 2.0f * random_vector(random);
            const Ray ray{aim + back, -back};
            wrong += closest_hit(bsp, ray) != closest_hit(naive, ray);
        }
        return wrong;
    };
    CHECK(wrong_rays(Grade::thick_float) > 0);
    CHECK(wrong_rays(Grade::exact) == 0);
}

TEST_CASE("polygons with a coordinate that is infinite or no number are left out") {
    for (const float bad : {infinity, -infinity, std::nanf("")})
        for (const Grade grade : {Grade::ordered_double, Grade::exact}) {
            std::vector<Triangle> triangles = soup(20, 0.5f, 3);
            const std::size_t fragments =
                Bsp<>::build(triangles, {.grade = grade}).shape().references;
            triangles.push_back({{bad, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}});
            CHECK(Bsp<>::build(triangles, {.grade = grade}).shape().references == fragments);
        }
}

TEST_CASE("a tree that would have more fragments than allowed is refused with one line") {
    CHECK_THROWS_AS(Bsp<>::build(soup(100, 1.0f, 6), {.max_fragments = 200}), LimitError);
}

TEST_CASE(
    "a build that would take more placements than allowed is refused with one line, and free "
    "planes need fewer") {
    const std::vector<Triangle> sphere =
        make_scene("icosphere:6").mesh.triangles();  // 720 of them: a chain
    CHECK_NOTHROW(Bsp<>::build(sphere, {.max_placed = 720 * 721 / 2}));
    CHECK_THROWS_AS(Bsp<>::build(sphere, {.max_placed = 720 * 721 / 2 - 1}), LimitError);
    CHECK_NOTHROW(Bsp<>::build(
        sphere, {.splitter = BspConfig::SplitterChoice::free, .max_placed = 720 * 721 / 10}));
}
