#include "ex04_bounds_of_a_patch.hpp"

#include "common/random.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace space;

namespace {

/// The point with these weights, of whole sum, at this height; as a source computes it.
Point3 point_of(const CoarsePatch& patch, const std::array<int, 3>& weights, double height) {
    Double3 from(0.0), way(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        from += double(weights[i]) * Double3(patch.corners[i]);
        way += double(weights[i]) * Double3(patch.outwards[i]);
    }
    const double sum = weights[0] + weights[1] + weights[2];
    return Point3(from / sum + height * (way / sum));
}

/// In long double the box of the six ends, which no box may do without.
struct ExactBox {
    std::array<long double, 3> low, high;

    explicit ExactBox(const CoarsePatch& patch) {
        low.fill(HUGE_VALL);
        high.fill(-HUGE_VALL);
        for (std::size_t i = 0; i < 3; ++i)
            for (const float height : {patch.lowest, patch.highest})
                for (int axis = 0; axis < 3; ++axis) {
                    const long double corner = patch.corners[i][axis],
                                      way = patch.outwards[i][axis], end = corner + height * way;
                    const auto a = std::size_t(axis);
                    low[a] = std::min(low[a], end);
                    high[a] = std::max(high[a], end);
                }
    }
};

void require_holds(const CoarsePatch& patch, Pcg32& random) {
    const Aabb box = bounds_of(patch);
    CAPTURE(patch.corners[0], patch.corners[1], patch.corners[2], patch.outwards[0],
            patch.outwards[1], patch.outwards[2], patch.lowest, patch.highest, box);
    for (int i = 0; i < 40; ++i) {
        const int n = 1 << random.below(7);
        const int a = int(random.below(std::uint32_t(n) + 1)),
                  b = int(random.below(std::uint32_t(n - a) + 1));
        const double share = i % 4 == 0 ? 0.0 : i % 4 == 1 ? 1.0 : random.uniform_double();
        const double height =
            double{patch.lowest} + share * (double{patch.highest} - double{patch.lowest});
        const Point3 point = point_of(patch, {a, b, n - a - b}, height);
        if (box.contains(point)) continue;  // to make a report's texts takes longer than the rest
        CAPTURE(a, b, n - a - b, height, point);
        REQUIRE(box.contains(point));
    }
}

void require_tight(const CoarsePatch& patch) {
    const Aabb box = bounds_of(patch);
    const ExactBox exact(patch);
    CAPTURE(patch.corners[0], patch.corners[1], patch.corners[2], patch.outwards[0],
            patch.outwards[1], patch.outwards[2], patch.lowest, patch.highest, box);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = std::size_t(axis);
        float largest = 0.0f;
        for (std::size_t i = 0; i < 3; ++i)
            largest = std::max({largest, std::abs(patch.corners[i][axis]),
                                std::abs(patch.highest * patch.outwards[i][axis]),
                                std::abs(patch.lowest * patch.outwards[i][axis])});
        const double some_roundings = 4.0 * 0x1p-23 * double{largest};
        REQUIRE(Error{double(exact.low[a]) - double{box.min[axis]}, some_roundings});
        REQUIRE(Error{double{box.max[axis]} - double(exact.high[a]), some_roundings});
    }
}

CoarsePatch random_patch(Pcg32& random, float away, float lowest, float highest) {
    CoarsePatch patch{{}, {}, lowest, highest};
    const Vector3 offset = away * random_vector(random);
    for (std::size_t i = 0; i < 3; ++i) {
        patch.corners[i] = offset + random_vector(random);
        patch.outwards[i] = random_vector(random);
    }
    return patch;
}

/// The triangle (0, 0, 0), (4, 0, 0), (0, 4, 0) and ways along z.
CoarsePatch flat(float lowest, float highest) {
    return {{Point3{0, 0, 0}, Point3{4, 0, 0}, Point3{0, 4, 0}},
            {Vector3{0, 0, 1}, Vector3{0, 0, 1}, Vector3{0, 0, 1}},
            lowest,
            highest};
}

}  // namespace

TEST_CASE("a flat patch with bumps from 1 to 2 lies between these heights") {
    const Aabb box = bounds_of(flat(1, 2));
    CHECK(box.contains(Point3{0, 0, 1}));
    CHECK(box.contains(Point3{4, 0, 2}));
    CHECK(box.contains(Point3{0, 4, 2}));
    require_tight(flat(1, 2));
}

TEST_CASE("dents count as bumps do") {
    Pcg32 random(1);
    require_holds(flat(-3, -1), random);
    require_tight(flat(-3, -1));
    require_holds(flat(-1, 2), random);
    require_tight(flat(-1, 2));
}

TEST_CASE("each corner has its own way") {
    CoarsePatch patch = flat(0, 2);
    patch.outwards = {Vector3{-1, 0, 0}, Vector3{3, 0, 0}, Vector3{0, 0.5f, -1}};
    Pcg32 random(2);
    require_holds(patch, random);
    require_tight(patch);
}

TEST_CASE("ways need not have the length 1") {
    CoarsePatch patch = flat(0, 2);
    for (Vector3& way : patch.outwards) way *= 5.0f;
    Pcg32 random(3);
    require_holds(patch, random);
    require_tight(patch);
}

TEST_CASE("without bumps the box is the triangle's") {
    Pcg32 random(4);
    for (int i = 0; i < 100; ++i) {
        const CoarsePatch patch = random_patch(random, 0.0f, 0.0f, 0.0f);
        require_holds(patch, random);
        require_tight(patch);
    }
}

TEST_CASE("random patches: the box holds every point, near and far from the origin") {
    Pcg32 random(5);
    for (const float away : {0.0f, 1.0f, 1e3f, 1e6f})
        for (int i = 0; i < sized(5'000, 500); ++i) {
            const float a = random.uniform(-1.0f, 1.0f), b = random.uniform(-1.0f, 1.0f);
            require_holds(random_patch(random, away, std::min(a, b), std::max(a, b)), random);
        }
}

TEST_CASE("random patches: the box is as small as it may be") {
    Pcg32 random(6);
    for (const float away : {0.0f, 1.0f, 1e3f})
        for (int i = 0; i < 2'000; ++i) {
            const float a = random.uniform(-1.0f, 1.0f), b = random.uniform(-1.0f, 1.0f);
            require_tight(random_patch(random, away, std::min(a, b), std::max(a, b)));
        }
}
