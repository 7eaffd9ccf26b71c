#include "ex05_conservative_box.hpp"

#include "chapters/ch02_intersection_tests/measured/exact_deciders.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

using namespace space;

TEST_CASE("a ray through a corner of a box hits it") {
    const Ray ray{{-9, -3, 3}, {9.69999981f, 3.79999995f, -2}};
    CAPTURE(ray);
    CHECK(may_hit_box(ray, {{0.2f, 0.5f, 0.8f}, {0.7f, 0.8f, 1.0f}}));
}

TEST_CASE("the ray for which 1.00000024 is too little hits its box, at any scale") {
    for (const float scale : {1.0f, 0x1p-40f, 0x1p40f}) {
        const Ray ray{scale * Point3(-0x1.028f5cp-24f, -0x1.fae148p-25f, 0),
                      {0x1.aa9708p-1f, 0x1.aaa26cp-1f, 0}};
        const Aabb box{scale * Point3(0x1.0000c2p+0f, -9, -1),
                       scale * Point3(9, 0x1.000798p+0f, 1)};
        CAPTURE(ray, box);
        REQUIRE(may_hit_box(ray, box));
    }
}

TEST_CASE("no ray towards a corner that hits the box in exact arithmetic is missed") {
    Pcg32 random(5);
    int hits = 0;
    for (int i = 0; i < 200'000; ++i) {
        Aabb box;
        box.extend(random_vector(random));
        box.extend(random_vector(random));
        const Point3 corner{(random.below(2) ? box.min : box.max).x,
                            (random.below(2) ? box.min : box.max).y,
                            (random.below(2) ? box.min : box.max).z};
        const Point3 origin = random_point(random, -9, 9);
        // Of any length: where the corner is at t = 1 the roundings nearly cancel.
        const float stretch = random.below(2) ? 1.0f : random.uniform(0.5f, 1.5f);
        const Ray ray{origin, stretch * (corner - origin)};
        if (!space::ch02::exactly_hits(ray, box)) continue;
        ++hits;
        if (may_hit_box(ray, box)) continue;
        CAPTURE(ray, box);
        FAIL("the ray hits the box in exact arithmetic, and the answer says that it does not");
    }
    CHECK(hits > 50'000);
}

TEST_CASE("a ray that passes at a thousandth of the box's size is missed") {
    Pcg32 random(6);
    for (int i = 0; i < 10'000; ++i) {
        const Point3 origin = random_point(random, Aabb{{-9, -1, -1}, {-2, 1, 1}});
        // The box ends at y = 1; below, the ray goes upwards.
        const Point3 beside(0.0f, 1.001f, random.uniform(-1, 1));
        const Ray ray{origin, beside - origin};
        const Aabb box{{0, -1, -1}, {1, 1, 1}};
        if (!may_hit_box(ray, box)) continue;
        CAPTURE(ray, box);
        FAIL("the ray passes a thousandth above the box, and the answer says that it hits");
    }
    CHECK_FALSE(may_hit_box({{5, 0, 0}, {1, 0.1f, 0.1f}}, {{0, -1, -1}, {1, 1, 1}}));
}

TEST_CASE("a ray that passes at forty roundings is missed, at any scale") {
    // It leaves the slab of y at t = start and enters that of x forty roundings later.
    for (const float scale : {1.0f, 0x1p-40f, 0x1p40f})
        for (const float start : {2.0f, 3.0f, 5.0f}) {
            const Ray ray{scale * Point3(-start, 1.0f - start, 0), {scale, scale, 0}};
            const float edge = 40.0f * start * 0x1p-24f;
            const Aabb box{scale * Point3(edge, -9, -1), scale * Point3(9, 1, 1)};
            CAPTURE(ray, box);
            REQUIRE_FALSE(may_hit_box(ray, box));
        }
}
