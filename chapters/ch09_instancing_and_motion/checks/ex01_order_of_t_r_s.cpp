#include "common/random.hpp"
#include "tests/check.hpp"

#include <glm/matrix.hpp>

#include <array>
#include <cmath>
#include <utility>

#pragma GCC poison inverse  // the way back is to be found, not called
#include "ex01_order_of_t_r_s.hpp"

using namespace space;

namespace {

/// A quarter turn about z: x goes to y, y to -x.
const glm::dmat3 quarter(Double3(0, 1, 0), Double3(-1, 0, 0), Double3(0, 0, 1));

/// Axes that change places and signs, with determinant 1.
glm::dmat3 random_turn(Pcg32& random) {
    std::array<int, 3> to{0, 1, 2};
    const std::uint32_t a = random.below(3);
    const std::uint32_t b = random.below(3);
    std::swap(to[a], to[b]);
    glm::dmat3 turn(0.0);
    for (int i = 0; i < 3; ++i) turn[i][to[std::size_t(i)]] = random.below(2) ? 1.0 : -1.0;
    if (glm::determinant(turn) < 0.0) turn[2] = -turn[2];
    return turn;
}

/// Powers of two: products and quotients are exact.
Double3 random_scale(Pcg32& random) {
    Double3 scale;
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t power = random.below(9);
        const double size = std::ldexp(1.0, int(power) - 4);
        scale[i] = random.below(4) ? size : -size;
    }
    return scale;
}

Double3 random_whole(Pcg32& random) {
    Double3 p;
    for (int i = 0; i < 3; ++i) p[i] = double(random.below(2001)) - 1000.0;
    return p;
}

}  // namespace

TEST_CASE("a point is scaled, then turned, then moved") {
    const Placed placed{.translation = {10, 20, 30}, .rotation = quarter, .scale = {2, 3, 4}};
    REQUIRE(point_to_world(placed, {0, 0, 0}) == Double3(10, 20, 30));
    REQUIRE(point_to_world(placed, {1, 0, 0}) == Double3(10, 22, 30));
    REQUIRE(point_to_world(placed, {0, 1, 0}) == Double3(7, 20, 30));
    REQUIRE(point_to_world(placed, {0, 0, 1}) == Double3(10, 20, 34));
}

TEST_CASE("the way back is moved back, then turned back, then scaled back") {
    const Placed placed{.translation = {10, 20, 30}, .rotation = quarter, .scale = {2, 4, 8}};
    REQUIRE(point_to_local(placed, {10, 20, 30}) == Double3(0, 0, 0));
    REQUIRE(point_to_local(placed, {10, 22, 30}) == Double3(1, 0, 0));
    REQUIRE(point_to_local(placed, {6, 20, 30}) == Double3(0, 1, 0));
    REQUIRE(point_to_local(placed, {10, 20, 38}) == Double3(0, 0, 1));
}

TEST_CASE("a direction is not moved, and keeps the length that it has") {
    const Placed placed{.translation = {10, 20, 30}, .rotation = quarter, .scale = {2, 4, 8}};
    REQUIRE(direction_to_local(placed, {0, 1, 0}) == Double3(0.5, 0, 0));
    REQUIRE(direction_to_local(placed, {-4, 0, 0}) == Double3(0, 1, 0));
    REQUIRE(direction_to_local(placed, {0, 0, 2}) == Double3(0, 0, 0.25));
}

TEST_CASE("a turn that is no quarter: the transpose turns back") {
    const glm::dmat3 turn(Double3(0.6, 0.8, 0), Double3(-0.8, 0.6, 0), Double3(0, 0, 1));
    const Placed placed{.translation = {1, 0, 0}, .rotation = turn, .scale = {1, 1, 1}};
    const Double3 there = point_to_world(placed, {5, 0, 0.1});  // 0.1 is no float
    REQUIRE(glm::length(there - Double3(4, 4, 0.1)) < 1e-14);
    REQUIRE(glm::length(point_to_local(placed, there) - Double3(5, 0, 0.1)) < 1e-14);
}

TEST_CASE("a mirror is a scale like any other") {
    const Placed placed{.translation = {8, 0, 0}, .rotation = quarter, .scale = {-2, 1, 1}};
    REQUIRE(point_to_world(placed, {3, 1, 0}) == Double3(7, -6, 0));
    REQUIRE(point_to_local(placed, {7, -6, 0}) == Double3(3, 1, 0));
    REQUIRE(direction_to_local(placed, {0, 2, 0}) == Double3(-1, 0, 0));
}

TEST_CASE("there and back again is where it was, for random placements") {
    Pcg32 random(91);
    for (int i = 0; i < 1000; ++i) {
        Placed placed;
        placed.translation = random_whole(random);
        placed.rotation = random_turn(random);
        placed.scale = random_scale(random);
        const Double3 p = random_whole(random);
        CAPTURE(i, placed.translation, placed.rotation[0], placed.rotation[1], placed.rotation[2],
                placed.scale, p);
        Double3 wanted(placed.translation);
        for (int axis = 0; axis < 3; ++axis)
            wanted += placed.scale[axis] * p[axis] * placed.rotation[axis];
        REQUIRE(point_to_world(placed, p) == wanted);
        REQUIRE(point_to_local(placed, wanted) == p);
    }
}

TEST_CASE("a ray is at the same point at the same t in both spaces") {
    Pcg32 random(92);
    for (int i = 0; i < 1000; ++i) {
        Placed placed;
        placed.translation = random_whole(random);
        placed.rotation = random_turn(random);
        placed.scale = random_scale(random);
        const Double3 origin = random_whole(random);
        const Double3 direction = random_whole(random);
        CAPTURE(i, placed.translation, placed.rotation[0], placed.rotation[1], placed.rotation[2],
                placed.scale, origin, direction);
        const Double3 local_origin = point_to_local(placed, origin),
                      local_direction = direction_to_local(placed, direction);
        for (const double t : {0.0, 0.5, 1.0, 7.0})
            REQUIRE(point_to_local(placed, origin + t * direction) ==
                    local_origin + t * local_direction);
    }
}
