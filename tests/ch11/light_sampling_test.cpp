#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance.hpp"
#include "chapters/ch11_sampling_and_caching/surface_point.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch11/statistics.hpp"
#include "tests/ch11/up.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace space {
namespace {

using Exact = Naive<FilteredExact>;

struct EmittingTriangle {
    Triangle triangle;
    Color emission;
};

LitScene scene_of(const std::vector<EmittingTriangle>& triangles) {
    LitScene lit;
    for (const EmittingTriangle& t : triangles) {
        if (t.emission != Color(0.0f))
            lit.lights.push_back(static_cast<std::uint32_t>(lit.triangles.size()));
        lit.triangles.push_back(t.triangle);
        lit.emission.push_back(t.emission);
    }
    return lit;
}

/// Lights all around the origin, their fronts towards it but for one.
LitScene four_lights() {
    return scene_of({{{{-1, -1, -1}, {0, 1, -1}, {1, -1, -1}}, Color(0.0f)},
                     {{{-1, -1, 1}, {0, 1, 1}, {1, -1, 1}}, Color(1.0f, 2.0f, 3.0f)},
                     {{{2, -1, 0}, {2, 0, 1}, {2, 1, 0}}, Color(0.5f)},
                     {{{2, 2, 2}, {2, 2, 2}, {2, 2, 2}}, Color(9.0f)},
                     {{{3, 3, 0}, {3, 3, 3}, {3, 3, 1}}, Color(9.0f)},
                     {{{0, -3, 0}, {1, -3, 0}, {0, -3, 0.5f}}, Color(4.0f)},
                     {{{-2, -1, 0}, {-2, 0, 1}, {-2, 1, 0}}, Color(0.25f)}});
}

TEST_CASE("a light is chosen as often as its share of the power; what has no area, never") {
    const LightTable table(four_lights());
    REQUIRE(table.lights().size() == 4);
    double sum = 0.0, power = 0.0;
    for (const TriangleLight& light : table.lights()) {
        sum += light.probability;
        power += light.area * luminance(light.radiance);
        CHECK(table.find(light.index) == &light);
    }
    CHECK(sum == Approx(1.0).epsilon(1e-15));
    CHECK(luminance(table.flux()) == Approx(std::numbers::pi * power).epsilon(1e-14));
    for (const std::uint32_t none : {0u, 3u, 4u, 7u}) CHECK(table.find(none) == nullptr);

    const int count = sized(100'000, 10'000);
    std::vector<std::uint64_t> observed(4);
    std::vector<double> expected;
    Pcg32 random(2);
    for (int i = 0; i < count; ++i)
        ++observed[static_cast<std::size_t>(&table.choose(random.uniform_double()) -
                                            table.lights().data())];
    for (const TriangleLight& light : table.lights()) {
        CHECK(light.probability == Approx(light.area * luminance(light.radiance) / power));
        expected.push_back(count * light.probability);
    }
    CHECK(chi_square(observed, expected) < chi_square_limit(4));
    CHECK(&table.choose(0.0) == &table.lights().front());
    CHECK(&table.choose(1.0 - 0x1p-53) == &table.lights().back());
}

TEST_CASE("a scene without lights has an empty table") {
    CHECK(
        LightTable(scene_of({{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, Color(0.0f)}})).lights().empty());
    CHECK(LightTable(LitScene{}).flux() == Double3(0.0));
}

TEST_CASE("the mean of 1 / density is the solid angle of all lights whose front is seen") {
    const LightTable table(four_lights());
    const Double3 from{0.1, -0.2, 0.3};
    double solid_angle = 0.0;
    int fronts = 0;
    for (const TriangleLight& light : table.lights()) {
        const SphericalTriangle seen(light.triangle, from);
        if (seen.volume >= 0.0) continue;
        solid_angle += seen.solid_angle;
        ++fronts;
    }
    REQUIRE((fronts > 1 && fronts < 4));
    Mean area, by_solid_angle, wrong;
    Pcg32 random(3);
    for (int i = 0; i < sized(200'000, 20'000); ++i) {
        const double choice = random.uniform_double();
        const Double2 u = random_pair(random);
        const LightSample a = sample_light_area(table, from, choice, u),
                          s = sample_light_solid_angle(table, from, choice, u);
        area.add(a.is_lit ? 1.0 / a.pdf : 0.0);
        by_solid_angle.add(s.is_lit ? 1.0 / s.pdf : 0.0);
        wrong.add(a.is_lit ? 1.0 / solid_angle_pdf(*a.light, {a.light->triangle, from}) : 0.0);
    }
    CHECK(area.agrees_with(solid_angle));
    CHECK(by_solid_angle.agrees_with(solid_angle));
    CHECK(by_solid_angle.variance() < area.variance());
}

TEST_CASE("a light that is seen whole by its solid angle has always the same density") {
    const LightTable table(scene_of({{{{-1, -1, 1}, {0, 1, 1}, {1, -1, 1}}, Color(1.0f)}}));
    const double pdf =
        1.0 / SphericalTriangle(table.lights()[0].triangle, Double3(0.0)).solid_angle;
    Pcg32 random(4);
    for (int i = 0; i < 100; ++i) {
        const double choice = random.uniform_double();
        const Double2 u = random_pair(random);
        CHECK(sample_light_solid_angle(table, Double3(0.0), choice, u).pdf == pdf);
    }
}

TEST_CASE("a ray that meets a light has the density with which it would have been chosen") {
    const LitScene lit = four_lights();
    const LightTable table(lit);
    const Exact accelerator = Exact::build(lit.triangles);
    Pcg32 random(5);
    int met = 0;
    for (int i = 0; i < 10'000; ++i) {
        const Point3 from = random_point(random, -0.9f, 0.9f);
        for (const Lighting lighting : {Lighting::area, Lighting::solid_angle}) {
            const double choice = random.uniform_double();
            const LightSample sample =
                sample_light(lighting, table, Double3(from), choice, random_pair(random));
            if (!sample.is_lit) continue;
            const Ray ray{.origin = from, .direction = Vector3(sample.direction)};
            const std::optional<Hit> hit = closest_hit(accelerator, ray);
            if (!hit || hit->triangle != sample.light->index) continue;  // beside, by a rounding
            ++met;
            // The direction of a ray is rounded to float.
            REQUIRE(light_pdf(lighting, table, ray, *hit) == Approx(sample.pdf).epsilon(2e-5));
            REQUIRE(light_pdf(lighting, table, ray, *hit) > 0.0);
        }
    }
    CHECK(met > 9'000);
}

TEST_CASE("a light is not lit from behind, from its own plane, or where it is touched") {
    const Triangle t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};  // its front is up
    const LightTable table(scene_of({{t, Color(1.0f)}}));
    Pcg32 random(6);
    for (const Double3& from :
         {Double3(0.2, 0.2, -1.0), Double3(0.2, 0.2, -1e-9), Double3(0.2, 0.2, 0.0),
          Double3(2.0, 2.0, 0.0), Double3(0.0, 0.0, 0.0), Double3(0.5, 0.0, 0.0)})
        for (int i = 0; i < 100; ++i) {
            const Double2 u = random_pair(random);
            CHECK_FALSE(sample_light_area(table, from, 0.5, u).is_lit);
            CHECK_FALSE(sample_light_solid_angle(table, from, 0.5, u).is_lit);
        }
    for (const double height : {1.0, 1e-3, 1e-7, 1e-12})
        for (int i = 0; i < 100; ++i) {
            const Double2 u = random_pair(random);
            const LightSample a = sample_light_area(table, {0.2, 0.2, height}, 0.5, u),
                              s = sample_light_solid_angle(table, {0.2, 0.2, height}, 0.5, u);
            for (const LightSample& sample : {a, s}) {
                REQUIRE(sample.is_lit);
                REQUIRE((std::isfinite(sample.pdf) && sample.pdf > 0.0));
                REQUIRE(std::abs(glm::length(sample.direction) - 1.0) < 1e-12);
            }
        }
}

/// A surface and a light somewhere, and a ray from one to the other.
struct Meeting {
    std::vector<Triangle> triangles;  ///< surface, light
    Point3 origin;                    ///< above the surface, by shadow_origin
    Double3 surface_point, light_point;
};

/// Scales from 2^-7 to 2^7 each: surfaces far from the world's origin with small lights near it,
/// and the reverse.
std::optional<Meeting> random_meeting(Pcg32& random) {
    const auto random_scale = [&] {
        return std::ldexp(1.0f, static_cast<int>(random.below(15)) - 7);
    };
    const auto random_triangle = [&] {
        const float place = random_scale(), size = random_scale();
        const Point3 at = place * Point3(random_vector(random));
        Triangle t;
        t.a = at + size * random_vector(random);
        t.b = at + size * random_vector(random);
        t.c = at + size * random_vector(random);
        return t;
    };
    const auto point_of = [&](const Triangle& t) {
        const double u = random.uniform(), v = random.uniform() * (1.0 - u);
        const Double3 a{t.a};
        return a + u * (Double3(t.b) - a) + v * (Double3(t.c) - a);
    };
    Meeting m;
    m.triangles.push_back(random_triangle());
    m.triangles.push_back(random_triangle());
    m.surface_point = point_of(m.triangles[0]);
    m.light_point = point_of(m.triangles[1]);
    const Double3 to = m.light_point - m.surface_point;
    Double3 n = normal(m.triangles[0]);
    if (glm::dot(n, to) < 0.0) n = -n;
    m.origin = shadow_origin(m.triangles[0], m.surface_point, n);
    const SphericalTriangle seen(m.triangles[1], Double3(m.origin));
    if (seen.volume > 0.0) std::swap(m.triangles[1].b, m.triangles[1].c);  // front towards us
    // Neither cuts through the other, and no needles (see shadow_origin).
    for (const Triangle& t : m.triangles) {
        const Double3 e = Double3(t.b) - Double3(t.a), f = Double3(t.c) - Double3(t.a);
        if (glm::length(glm::cross(e, f)) < 1e-4 * std::max(glm::dot(e, e), glm::dot(f, f)))
            return {};
    }
    const auto sides = [](const Triangle& of, const Triangle& t, const Double3& up) {
        int above = 0;
        for (int i = 0; i < 3; ++i)
            above += glm::dot(Double3(t[i]) - Double3(of.a), up) > 0.0 ? 1 : 0;
        return above;
    };
    const bool apart = sides(m.triangles[0], m.triangles[1], n) == 3 &&
                       sides(m.triangles[1], m.triangles[0], normal(m.triangles[1])) == 3;
    return apart ? std::optional(m) : std::nullopt;
}

struct WrongShadows {
    int rays = 0, plain = 0, both_moved = 0, ours = 0;
};

WrongShadows wrong_shadows(int count) {
    WrongShadows wrong;
    Pcg32 random(7);
    while (wrong.rays < count) {
        const std::optional<Meeting> m = random_meeting(random);
        if (!m) continue;
        const Exact accelerator = Exact::build(m->triangles);
        const Triangle& light = m->triangles[1];
        const Double3 n = normal(light);
        const Ray ours = ray_to_light(m->origin, light, m->light_point, n);
        Double3 up = normal(m->triangles[0]);
        if (glm::dot(up, m->light_point - m->surface_point) < 0.0) up = -up;
        if (!(glm::dot(up, Double3(ours.direction)) > 0.0)) continue;
        ++wrong.rays;
        const Point3 from(m->surface_point), to(m->light_point);
        wrong.plain += any_hit(accelerator, {from, to - from, 0.0f, 1.0f});
        const Point3 moved = shadow_origin(light, m->light_point, n);
        wrong.both_moved += any_hit(accelerator, {m->origin, moved - m->origin, 0.0f, 1.0f});
        wrong.ours += any_hit(accelerator, ours);
    }
    return wrong;
}

TEST_CASE("no surface and no light stands in the way of the ray between them, in 10^6 rays") {
    const WrongShadows wrong = wrong_shadows(sized(1'000'000, 20'000));
    CAPTURE(wrong.plain, wrong.both_moved);
    CHECK(wrong.ours == 0);
    CHECK(wrong.plain > wrong.rays / 4);
    CHECK(wrong.both_moved > wrong.rays / 1'000);
}

TEST_CASE("what stands before the light still blocks it, and what stands behind does not") {
    const Triangle floor{{-9, 0, -9}, {0, 0, 9}, {9, 0, -9}},
        light{{-1, 4, -1}, {1, 4, -1}, {0, 4, 1}};
    const auto blocked_at = [&](float height) {
        const Triangle blocker{{-2, height, -2}, {2, height, -2}, {0, height, 2}};
        const Exact accelerator = Exact::build(std::vector{floor, light, blocker});
        const Point3 origin = shadow_origin(floor, Double3(0.0), {0, 1, 0});
        return any_hit(accelerator, ray_to_light(origin, light, {0, 4, 0}, {0, -1, 0}));
    };
    CHECK(blocked_at(2.0f));
    CHECK(blocked_at(4.0f - 0x1p-18f));
    CHECK_FALSE(blocked_at(4.0f));  // in the light's plane
    CHECK_FALSE(blocked_at(4.0f + 0x1p-18f));
}

}  // namespace
}  // namespace space
