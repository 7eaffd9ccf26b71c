#include "ex02_missing_occlusion_test.hpp"

#include "tests/catch.hpp"

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
    CHECK_FALSE(light_reaches(floor_point, lamp, std::array{at_height(2)}));
    CHECK_FALSE(light_reaches(floor_point, lamp, std::array{at_height(0.001f)}));
    CHECK_FALSE(light_reaches(floor_point, lamp, std::array{at_height(3.999f)}));
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
    CHECK(light_reaches(floor_point, lamp, std::array{at_height(5)}));
    CHECK(light_reaches(floor_point, lamp, std::array{at_height(4.001f)}));
}

TEST_CASE("a triangle behind the point throws no shadow") {
    CHECK(light_reaches(floor_point, lamp, std::array{at_height(-1)}));
    CHECK(light_reaches(floor_point, lamp, std::array{at_height(-0.001f)}));
}

TEST_CASE("the light's distance does not matter") {
    for (const float height : {0.5f, 1.0f, 10.0f, 1000.0f}) {
        const PointLight light{.position = {0, 0, height}};
        CHECK_FALSE(light_reaches(floor_point, light, std::array{at_height(0.75f * height)}));
        CHECK(light_reaches(floor_point, light, std::array{at_height(1.25f * height)}));
    }
}
