#include "common/geometry.hpp"

#include "tests/catch.hpp"

namespace space {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST_CASE(
    "an empty box has no extent and no area, is in every box, and becomes any point that it is "
    "extended by") {
    Aabb box = Aabb::empty();
    CHECK(box.is_empty());
    CHECK(box.extent() == Vector3{0.0f});
    CHECK(box.half_area() == 0.0);
    CHECK(Aabb{{0, 0, 0}, {1, 1, 1}}.contains(box));
    CHECK_FALSE(box.contains(Point3{0.0f}));
    box.extend({1, 2, 3});
    CHECK(box == Aabb{{1, 2, 3}, {1, 2, 3}});
    CHECK_FALSE(box.is_empty());
    box.extend(Aabb::empty());
    CHECK(box == Aabb{{1, 2, 3}, {1, 2, 3}});
    CHECK(Aabb{{0, 0, 0}, {1, -1, 1}}.is_empty());
    CHECK(Aabb{{0, 0, 0}, {1, nan, 1}}.is_empty());
}

TEST_CASE("a box's extent, middle, half area and longest axis, by hand") {
    const Aabb box{{-1, 2, 0}, {1, 5, 4}};
    CHECK(box.extent() == Vector3{2, 3, 4});
    CHECK(box.centroid() == Point3{0, 3.5f, 2});
    CHECK(box.half_area() == 2 * 3 + 3 * 4 + 4 * 2);
    CHECK(box.longest_axis() == 2);
    CHECK(Aabb{{0, 0, 0}, {2, 2, 1}}.longest_axis() == 0);  // the first of equal ones
    const Aabb2 rectangle{{0, 0}, {3, 4}};
    CHECK(rectangle.half_area() == 7.0);
    CHECK(rectangle.longest_axis() == 1);
}

TEST_CASE("a box is closed") {
    const Aabb box{{0, 0, 0}, {1, 2, 0}};
    CHECK(box.contains(Point3{0, 2, 0}));
    CHECK(box.contains(Point3{1, 0, -0.0f}));
    CHECK_FALSE(box.contains(Point3{std::nextafter(1.0f, 2.0f), 0, 0}));
    CHECK_FALSE(box.contains(Point3{0, 0, 0x1p-149f}));
    CHECK(box.contains(box));
    CHECK_FALSE(box.contains(Aabb{{0, 0, 0}, {1, 2.5f, 0}}));
}

TEST_CASE("huge boxes have a finite middle and half area") {
    const Aabb box{{-3e38f, -3e38f, -3e38f}, {3e38f, 3e38f, 3e38f}};
    CHECK(box.centroid() == Point3{0.0f});
    CHECK(Aabb{{3e38f, 0, 0}, {3.2e38f, 1, 1}}.centroid().x == Approx(3.1e38f));
    CHECK(std::isfinite(Aabb{{0, 0, 0}, {3e38f, 3e38f, 3e38f}}.half_area()));
}

TEST_CASE("a ray is valid with finite origin and direction, a direction and an interval") {
    const Ray good{{0, 0, 0}, {0, 0, 1}};
    CHECK(is_valid(good));
    CHECK(is_valid(Ray{{0, 0, 0}, {0, -0.0f, 0x1p-149f}}));
    CHECK(is_valid(Ray{{0, 0, 0}, {0, 0, 1}, 2, 2}));
    CHECK(is_valid(Ray{{0, 0, 0}, {0, 0, 1}, -infinity, infinity}));
    CHECK_FALSE(is_valid(Ray{{0, 0, 0}, {0, -0.0f, 0}}));
    CHECK_FALSE(is_valid(Ray{{0, nan, 0}, {0, 0, 1}}));
    CHECK_FALSE(is_valid(Ray{{0, 0, infinity}, {0, 0, 1}}));
    CHECK_FALSE(is_valid(Ray{{0, 0, 0}, {nan, 0, 1}}));
    CHECK_FALSE(is_valid(Ray{{0, 0, 0}, {0, -infinity, 1}}));
    CHECK_FALSE(is_valid(Ray{{0, 0, 0}, {0, 0, 1}, 2, 1}));
    CHECK_FALSE(is_valid(Ray{{0, 0, 0}, {0, 0, 1}, nan, 1}));
    CHECK_FALSE(is_valid(Ray{{0, 0, 0}, {0, 0, 1}, 0, nan}));
    CHECK(is_valid(Ray2{{0, 0}, {1, 0}}));
    CHECK_FALSE(is_valid(Ray2{{0, 0}, {0, 0}}));
    CHECK(good.at(2.5f) == Point3{0, 0, 2.5f});
}

TEST_CASE(
    "a triangle's normal is twice its area long and points to where its vertices run "
    "counter-clockwise") {
    const Triangle triangle{{1, 1, 2}, {4, 1, 2}, {1, 3, 2}};
    CHECK(normal(triangle) == Double3(0, 0, 6));
    CHECK(normal({triangle.a, triangle.c, triangle.b}) == Double3(0, 0, -6));
    CHECK(normal({{0, 0, 0}, {1, 2, 3}, {2, 4, 6}}) == Double3(0.0));
    CHECK(bounds(triangle) == Aabb{{1, 1, 2}, {4, 3, 2}});
    // In float the difference of these products is lost.
    CHECK(normal({{0, 0, 0}, {0x1.000002p0f, 1, 0}, {0x1.000004p0f, 0x1.000002p0f, 0}}) ==
          Double3(0, 0, 0x1p-46));
}

}  // namespace space
