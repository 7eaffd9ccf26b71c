#include "chapters/ch09_instancing_and_motion/placement.hpp"

#include "chapters/ch09_instancing_and_motion/random_placement.hpp"
#include "tests/catch.hpp"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

using namespace space;

namespace {

/// x goes to y, y to -x.
const glm::dmat3 quarter(Double3(0, 1, 0), Double3(-1, 0, 0), Double3(0, 0, 1));

Double3 whole(Pcg32& random) {
    Double3 v;
    for (int i = 0; i < 3; ++i) v[i] = double(random.below(19)) - 9.0;
    return v;
}

/// Powers of two, some of them negative.
ObjectPlacement exact_placement(Pcg32& random) {
    ObjectPlacement placement{.translation = whole(random)};
    const std::uint32_t turns = random.below(4);
    for (std::uint32_t i = 0; i < turns; ++i) placement.rotation = quarter * placement.rotation;
    for (int i = 0; i < 3; ++i) {
        const double size = std::ldexp(1.0, int(random.below(9)) - 4);
        placement.scale[i] = random.below(4) ? size : -size;
    }
    return placement;
}

double largest(const Double3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace

TEST_CASE("a point is scaled, turned and moved, in this order") {
    const ObjectPlacement placement{
        .translation = {10, 20, 30}, .rotation = quarter, .scale = {2, 3, 4}};
    CHECK(placement.to_world({0, 0, 0}) == Double3(10, 20, 30));
    CHECK(placement.to_world({1, 1, 1}) == Double3(7, 22, 34));
    CHECK(placement.to_local({7, 22, 34}) == Double3(1, 1, 1));
    CHECK(placement.direction_to_local({-3, 2, 4}) == Double3(1, 1, 1));
}

TEST_CASE("the matrices say what the placement does, both ways, exactly where numbers are exact") {
    Pcg32 random(1);
    for (int i = 0; i < sized(2000, 200); ++i) {
        const ObjectPlacement placement = exact_placement(random);
        const Double3 p = whole(random), world = placement.to_world(p);
        CAPTURE(i);
        REQUIRE(placement.to_local(world) == p);
        REQUIRE(Double3(matrix(placement) * glm::dvec4(p, 1)) == world);
        REQUIRE(Double3(inverse_matrix(placement) * glm::dvec4(world, 1)) == p);
        REQUIRE(affine(placement).point(p) == world);
        REQUIRE(affine(placement).vector(p) == world - placement.translation);
        REQUIRE(inverse_matrix(placement) * matrix(placement) == glm::dmat4(1.0));
    }
}

TEST_CASE("an odd number of negative scales is a mirror: the sign of the determinant") {
    Pcg32 random(2);
    std::size_t mirrors = 0;
    for (int i = 0; i < sized(2000, 200); ++i) {
        ObjectPlacement placement = exact_placement(random);
        placement.rotation = random_rotation(random);
        CAPTURE(i);
        REQUIRE(placement.is_mirrored() == (determinant(affine(placement)) < 0.0));
        mirrors += placement.is_mirrored();
    }
    CHECK(mirrors > 0);
}

TEST_CASE("a rotation about an axis leaves the axis and turns counter-clockwise around it") {
    const double turn = std::acos(-1.0) / 2.0;
    const glm::dmat3 about_z = rotation_about(Double3(0, 0, 1), turn);
    CHECK(largest(about_z * Double3(1, 0, 0) - Double3(0, 1, 0)) < 1e-16);
    CHECK(largest(about_z * Double3(0, 1, 0) - Double3(-1, 0, 0)) < 1e-16);
    CHECK(about_z * Double3(0, 0, 1) == Double3(0, 0, 1));
    // A third of a turn about the diagonal takes x to y, y to z, z to x.
    const glm::dmat3 third = rotation_about(glm::normalize(Double3(1, 1, 1)), 4.0 / 3.0 * turn);
    CHECK(largest(third * Double3(1, 2, 3) - Double3(3, 1, 2)) < 1e-15);
}

TEST_CASE("random rotations are rotations, in all directions") {
    Pcg32 random(3);
    Double3 sum(0.0);
    constexpr int count = sized(4000, 400);
    for (int i = 0; i < count; ++i) {
        const glm::dmat3 r = random_rotation(random);
        const glm::dmat3 off = r * glm::transpose(r) - glm::dmat3(1.0);
        for (int column = 0; column < 3; ++column) REQUIRE(largest(off[column]) < 0x1p-50);
        REQUIRE(std::abs(glm::determinant(r) - 1.0) < 0x1p-50);
        sum += r[0];
    }
    // The mean of a coordinate has a standard deviation of 1 / sqrt(3 count).
    CHECK(largest(sum / double(count)) < 4.0 / std::sqrt(3.0 * count));
}

TEST_CASE("a drifted rotation is made orthonormal again, and stays where it was") {
    Pcg32 random(4);
    for (int i = 0; i < sized(1000, 100); ++i) {
        const glm::dmat3 r = random_rotation(random);
        glm::dmat3 drifted = r;
        for (int column = 0; column < 3; ++column)
            drifted[column] += 1e-6 * Double3(random_vector(random));
        const glm::dmat3 made = orthonormal(drifted);
        const glm::dmat3 off = made * glm::transpose(made) - glm::dmat3(1.0);
        for (int column = 0; column < 3; ++column) {
            REQUIRE(largest(off[column]) < 0x1p-50);
            REQUIRE(largest(made[column] - r[column]) < 1e-5);
        }
        REQUIRE(glm::determinant(made) > 0.0);
    }
}

TEST_CASE("cofactors take the cross product of edges to that of the placed edges") {
    Pcg32 random(5);
    for (int i = 0; i < sized(2000, 200); ++i) {
        const Double3 x = whole(random);
        const Double3 y = whole(random);
        const Double3 z = whole(random);
        const Double3 a = whole(random);
        const Double3 b = whole(random);
        const glm::dmat3 m(x, y, z);
        REQUIRE(cofactors(m) * glm::cross(a, b) == glm::cross(m * a, m * b));
    }
}

TEST_CASE("a normal stays at right angles to the surface and on its side, mirrored or not") {
    Pcg32 random(6);
    std::size_t mirrored = 0;
    for (int i = 0; i < sized(2000, 200); ++i) {
        const Double3 x = whole(random);
        const Double3 y = whole(random);
        const Double3 z = whole(random);
        const Double3 a = whole(random);
        const Double3 b = whole(random);
        const Double3 n = glm::cross(a, b);
        const glm::dmat3 m(x, y, z);
        const double det = glm::determinant(m);
        if (det == 0.0 || n == Double3(0.0)) continue;
        mirrored += det < 0.0;
        const Double3 world = world_normal(m, n);
        REQUIRE(glm::dot(world, m * a) == 0.0);
        REQUIRE(glm::dot(world, m * b) == 0.0);
        REQUIRE(glm::dot(world, m * n) > 0.0);
    }
    CHECK(mirrored > 0);
}

// The difference, three products, two sums and the quotient are rounded once each, each by u24 =
// 2^-24 of what they are, and an entry of the rotation by u24 of itself, which its transpose knows
// nothing of: with |d| the largest coordinate of q - t, 5 sqrt(3) and 4 sqrt(3) of u24 |d| / scale.
TEST_CASE(
    "a point comes back in float within 9 sqrt(3) units of the difference, however far away") {
    Pcg32 random(7);
    double most = 0.0;
    for (int i = 0; i < sized(100'000, 2000); ++i) {
        const BasicPlacement<float> placement =
            rounded(random_placement(random, i % 2 ? 1e6 : 1.0, i % 3 ? 1.0 : 100.0));
        const glm::vec3 q = placement.to_world(random_vector(random));
        const Double3 d = Double3(q) - Double3(placement.translation);
        const Double3 truth = glm::inverse(glm::dmat3(placement.rotation)) * d;
        const Double3 bound =
            9.0 * std::sqrt(3.0) * 0x1p-24 * largest(d) / Double3(placement.scale);
        const Double3 error = Double3(placement.to_local(q)) - truth / Double3(placement.scale);
        CAPTURE(i);
        REQUIRE(largest(error / bound) <= 1.0);
        most = std::max(most, largest(error / bound));
    }
    CHECK(most >= 0.2);
}
