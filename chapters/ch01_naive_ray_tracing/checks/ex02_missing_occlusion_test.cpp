#include "ex02_missing_occlusion_test.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <array>

using namespace space;

namespace {

Triangle at_height(float z, float x = 0.0f) {
    return {{x - 1, -1, z}, {x + 1, -1, z}, {x, 1, z}};
}
const PointLight lamp{.position = {0, 0, 4}};
const Point3 floor_point{0, 0, 0};

}  // namespace

TEST_CASE("a triangle between the point and the light keeps the light away") {
    for (const float height : {2.0f, 0.001f, 3.999f}) {
        CAPTURE(Number{height});
        REQUIRE_FALSE(light_reaches(floor_point, lamp, std::array{at_height(height)}));
    }
}

TEST_CASE("a triangle keeps the light away however near it is to the point or to the light") {
    for (const float height : {4e-6f, 1e-20f, 4 - 4e-6f, std::nextafter(4.0f, 0.0f)}) {
        CAPTURE(Number{height});
        REQUIRE_FALSE(light_reaches(floor_point, lamp, std::array{at_height(height)}));
    }
}

TEST_CASE("either side of a triangle keeps the light away") {
    const Triangle up = at_height(2), down{up.a, up.c, up.b};
    CHECK_FALSE(light_reaches(floor_point, lamp, std::array{up}));
    CHECK_FALSE(light_reaches(floor_point, lamp, std::array{down}));
}

TEST_CASE("any one triangle is enough, wherever it stands in the list") {
    CHECK_FALSE(light_reaches(floor_point, lamp,
                              std::array{at_height(2), at_height(1, 10), at_height(3, -10)}));
    CHECK_FALSE(light_reaches(floor_point, lamp,
                              std::array{at_height(1, 10), at_height(3, -10), at_height(2)}));
}

TEST_CASE("triangles beside the way throw no shadow on the point") {
    CHECK(light_reaches(floor_point, lamp, {}));
    CHECK(light_reaches(floor_point, lamp, std::array{at_height(2, 10), at_height(3, -10)}));
}

TEST_CASE("a triangle beyond the light throws no shadow") {
    for (const float height : {5.0f, 4.001f, 4 + 4e-6f}) {
        CAPTURE(Number{height});
        REQUIRE(light_reaches(floor_point, lamp, std::array{at_height(height)}));
    }
}

TEST_CASE("a triangle behind the point throws no shadow") {
    for (const float height : {-1.0f, -0.001f, -4e-6f}) {
        CAPTURE(Number{height});
        REQUIRE(light_reaches(floor_point, lamp, std::array{at_height(height)}));
    }
}

TEST_CASE("the light's distance does not matter") {
    for (const float height : {0.5f, 1.0f, 10.0f, 1000.0f}) {
        const PointLight light{.position = {0, 0, height}};
        CAPTURE(Number{height});
        REQUIRE_FALSE(light_reaches(floor_point, light, std::array{at_height(0.75f * height)}));
        REQUIRE(light_reaches(floor_point, light, std::array{at_height(1.25f * height)}));
    }
}

TEST_CASE("wherever point and light are, a triangle shades if it stands between them") {
    Pcg32 random(12);
    for (int i = 0; i < 1000; ++i) {
        const Point3 point = random_point(random, -9, 9), light = random_point(random, -9, 9);
        for (const float t : {-0.5f, 0.25f, 0.75f, 1.5f}) {
            // Across the way, at the point's t.
            const Vector3 way = light - point;
            const Vector3 side = glm::cross(way, Vector3(way.y, way.z, -way.x) + Vector3(1));
            const Vector3 other = glm::cross(way, side) / glm::length(way);
            const Point3 there = point + t * way;
            const Triangle triangle{there - side - other, there + side - other, there + other};
            CAPTURE(point, light, triangle, t);
            REQUIRE(light_reaches(point, {.position = light}, std::array{triangle}) ==
                    (t < 0 || t > 1));
        }
    }
}
