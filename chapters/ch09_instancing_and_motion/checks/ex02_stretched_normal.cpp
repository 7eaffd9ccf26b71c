#include "ex02_stretched_normal.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <glm/matrix.hpp>

#include <cmath>

using namespace space;

namespace {

/// Whole numbers from -9 to 9.
Double3 whole(Pcg32& random) {
    Double3 v;
    for (int i = 0; i < 3; ++i) v[i] = double(random.below(19)) - 9.0;
    return v;
}

bool is_normal(const Double3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && v != Double3(0.0);
}

/// The cosine of the angle between a normal and what should lie in the surface.
double cosine(const Double3& normal, const Double3& tangent) {
    return std::abs(glm::dot(glm::normalize(normal), glm::normalize(tangent)));
}

glm::dmat3 diagonal(double x, double y, double z) {
    return {Double3(x, 0, 0), Double3(0, y, 0), Double3(0, 0, z)};
}

}  // namespace

TEST_CASE("nothing done, nothing changed") {
    const Double3 n = normal_in_world(glm::dmat3(1.0), {1, 2, 3});
    REQUIRE(is_normal(n));
    REQUIRE(glm::cross(n, Double3(1, 2, 3)) == Double3(0.0));
    REQUIRE(glm::dot(n, Double3(1, 2, 3)) > 0.0);
}

TEST_CASE("a quarter turn turns the normal along") {
    const glm::dmat3 turn(Double3(0, 1, 0), Double3(-1, 0, 0), Double3(0, 0, 1));
    const Double3 n = normal_in_world(turn, {1, 2, 3});
    REQUIRE(is_normal(n));
    REQUIRE(glm::cross(n, Double3(-2, 1, 3)) == Double3(0.0));
    REQUIRE(glm::dot(n, Double3(-2, 1, 3)) > 0.0);
}

TEST_CASE("a slope of 45 degrees that is stretched twice along x is less steep") {
    const Double3 n = normal_in_world(diagonal(2, 1, 1), {1, 1, 0});
    REQUIRE(is_normal(n));
    REQUIRE(glm::cross(n, Double3(1, 2, 0)) == Double3(0.0));
    REQUIRE(glm::dot(n, Double3(1, 2, 0)) > 0.0);
}

TEST_CASE("a wall stays a wall when the room is sheared along it") {
    const glm::dmat3 shear(Double3(1, 0, 0), Double3(3, 1, 0), Double3(0, 0, 1));
    const Double3 floor = normal_in_world(shear, {0, 1, 0});  // y = 0: x alone is moved
    REQUIRE(is_normal(floor));
    REQUIRE(glm::cross(floor, Double3(0, 1, 0)) == Double3(0.0));
    const Double3 wall = normal_in_world(shear, {1, 0, 0});  // its edge goes up along (3, 1, 0)
    REQUIRE(is_normal(wall));
    REQUIRE(glm::dot(wall, Double3(3, 1, 0)) == 0.0);
    REQUIRE(wall.x > 0.0);
}

TEST_CASE("the outside of a mirrored object stays outside") {
    for (const glm::dmat3& mirror :
         {diagonal(-1, 1, 1), diagonal(1, -2, 1), diagonal(-1, -1, -1), diagonal(-1, -1, 1)})
        for (const Double3& n : {Double3(1, 0, 0), Double3(0, 1, 0), Double3(2, 3, -1)}) {
            CAPTURE(mirror[0], mirror[1], mirror[2], n);
            const Double3 world = normal_in_world(mirror, n);
            REQUIRE(is_normal(world));
            REQUIRE(glm::dot(world, mirror * n) > 0.0);
        }
}

TEST_CASE("at right angles to the surface and on its old side, for random matrices") {
    Pcg32 random(93);
    for (int i = 0; i < 2000; ++i) {
        const Double3 x = whole(random);
        const Double3 y = whole(random);
        const Double3 z = whole(random);
        const glm::dmat3 m(x, y, z);
        const Double3 a = whole(random);
        const Double3 b = whole(random);
        const Double3 normal = glm::cross(a, b);
        if (glm::determinant(m) == 0.0 || normal == Double3(0.0)) continue;
        CAPTURE(i, x, y, z, a, b, normal);
        const Double3 world = normal_in_world(m, normal);
        REQUIRE(is_normal(world));
        REQUIRE(cosine(world, m * a) < 1e-12);
        REQUIRE(cosine(world, m * b) < 1e-12);
        REQUIRE(glm::dot(world, m * normal) > 0.0);  // n . n > 0
    }
}

TEST_CASE("tiny and huge objects have normals, too") {
    for (const double size : {1e-60, 1e-20, 1e20, 1e60})
        for (const double mirror : {1.0, -1.0}) {
            const glm::dmat3 m(mirror * size * Double3(2, 1, 0), size * Double3(0, 1, 3),
                               size * Double3(1, 0, 1));
            const Double3 a(1, 2, 0), b(0, 1, 1), normal = glm::cross(a, b);
            CAPTURE(size, mirror);
            const Double3 world = normal_in_world(m, normal);
            REQUIRE(is_normal(world));
            REQUIRE(cosine(world, m * a / size) < 1e-12);
            REQUIRE(cosine(world, m * b / size) < 1e-12);
            REQUIRE(glm::dot(world, m * normal / size) > 0.0);
        }
}

TEST_CASE("all around a sphere that is stretched ten times") {
    Pcg32 random(94);
    const glm::dmat3 m = diagonal(10, 1, 1);
    for (int i = 0; i < 500; ++i) {
        const Double3 p = random_direction(random);
        const Double3 wanted(p.x / 100.0 * 10.0, p.y, p.z);  // the gradient at (10 x, y, z)
        CAPTURE(i, p);
        const Double3 world = normal_in_world(m, p);
        REQUIRE(is_normal(world));
        REQUIRE(glm::length(glm::cross(glm::normalize(world), glm::normalize(wanted))) < 1e-12);
        REQUIRE(glm::dot(world, wanted) > 0.0);
    }
}
