// Where secondary rays start: the distances that offset_origin proves, on inputs bred to come near
// to them, and a crease where chapter 1's rule starts a ray behind a neighbour.
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/offset_origin.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <bit>
#include <cstdio>

namespace space::ch02 {
namespace {

constexpr int climbs = 12, steps = 20'000;

struct Input {
    Triangle triangle{};
    Hit hit{};
};

/// How far the new origin lies before the triangle's own plane, and before the worst plane through
/// the hit point that is turned by 60 degrees; in roundings of the largest coordinate. By double,
/// which tells a millionth of that.
struct Distances {
    double own, neighbour;
};
Distances distances(const Input& input) {
    const Double3 n = normal(input.triangle);
    const double length = glm::length(n);
    if (!(length > 1e-3)) return {100.0, 100.0};  // not a needle, so that n is precise
    const Aabb box = bounds(input.triangle);
    const Point3 largest = glm::max(glm::abs(box.min), glm::abs(box.max));
    const double rounding = 0x1p-24 * std::max({largest.x, largest.y, largest.z});
    const Double3 moved =
        Double3(offset_origin(input.triangle, input.hit, n)) - hit_point(input.triangle, input.hit);
    const double along = glm::dot(moved, n) / length,
                 across = glm::length(moved - along * (n / length));
    return {along / rounding, (0.5 * along - std::sqrt(0.75) * across) / rounding};
}

/// Hill climbing for the smallest distance.
double climb(double Distances::*distance, std::uint64_t seed) {
    Pcg32 random(902, seed);
    Input best;
    const auto number = [&] { return random.uniform(-1.0f, 1.0f); };
    for (Point3* corner : {&best.triangle.a, &best.triangle.b, &best.triangle.c})
        for (int axis = 0; axis < 3; ++axis) (*corner)[axis] = number();
    double least = 100.0;
    for (int step = 0; step < steps; ++step) {
        Input next = best;
        Point3* corners[] = {&next.triangle.a, &next.triangle.b, &next.triangle.c};
        float& x = (*corners[random.below(3)])[static_cast<int>(random.below(3))];
        if (random.below(4) == 0) {
            x = number();
        } else {
            const std::uint32_t mask = (1u << (1 + random.below(23))) - 1u;
            x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) ^ (random.next() & mask));
        }
        if (random.below(4) == 0) {
            next.hit.u = random.uniform();
            next.hit.v = (1.0f - next.hit.u) * random.uniform();
        }
        if (!(std::abs(x) <= 4.0f)) continue;
        if (const double found = distances(next).*distance; found <= least) {
            least = found;
            best = next;
        }
    }
    return least;
}

}  // namespace

TEST_CASE(
    "an offset origin lies before its own plane by two roundings, and before a neighbour's turned "
    "by 60 degrees by a quarter of one, and hardly more") {
    double own = 100.0, neighbour = 100.0;
    for (std::uint64_t seed = 0; seed < climbs; ++seed) {
        own = std::min(own, climb(&Distances::own, seed));
        neighbour = std::min(neighbour, climb(&Distances::neighbour, seed));
    }
    std::printf("least distance before the own plane %.3f, before a neighbour %.3f\n", own,
                neighbour);
    CHECK(own > 2.26);
    CHECK(own < 3.1);
    CHECK(neighbour > 0.26);
    CHECK(neighbour < 1.0);
}

TEST_CASE(
    "in a crease chapter 1's rule starts a ray behind the neighbour and meets it again; an offset "
    "origin does not") {
    // The normal is nearly the x axis, but its signs lead along (1, 1, 1).
    const Triangle triangle{{1, 1, 1}, {1 - 0x1p-12f, 1.25f, 1}, {1 - 0x1p-12f, 1, 1.25f}};
    const Double3 n = normal(triangle);
    const Triangle neighbour{{1, 1, 1}, {1, 1.25f, 0.75f}, {1.302f, 1.13f, 1.13f}};
    const Double3 k = normal(neighbour);
    REQUIRE(glm::dot(n, k) > 0.5 * glm::length(n) * glm::length(k));
    const Hit at_corner{.t = 1, .triangle = 0, .u = 0, .v = 0};
    const Double3 corner = hit_point(triangle, at_corner);
    const Point3 by_signs = shadow_origin(triangle, corner, n),
                 by_normal = offset_origin(triangle, at_corner, n);
    CHECK(glm::dot(Double3(by_signs) - corner, n) > 0.0);
    CHECK(glm::dot(Double3(by_signs) - corner, k) < 0.0);
    CHECK(glm::dot(Double3(by_normal) - corner, n) > 0.0);
    CHECK(glm::dot(Double3(by_normal) - corner, k) > 0.0);
    // Out of the crease, over the inside of the neighbour.
    const Double3 inwards = 0.5 * (Double3(neighbour.b) + Double3(neighbour.c)) - corner;
    const Vector3 way(glm::normalize(k) + 5.0 * glm::normalize(inwards));
    REQUIRE(glm::dot(Double3(way), n) > 0.0);
    REQUIRE(glm::dot(Double3(way), k) > 0.0);
    CHECK(FilteredExact::intersect({by_signs, way}, neighbour));
    CHECK_FALSE(FilteredExact::intersect({by_normal, way}, neighbour));
}

}  // namespace space::ch02
