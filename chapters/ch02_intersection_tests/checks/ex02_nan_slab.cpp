#include "ex02_nan_slab.hpp"

#include "tests/check.hpp"

#include <algorithm>

using namespace space;

namespace {

/// In whole numbers: origin and direction components are at most 3, so that doubles compare the
/// slabs' ends exactly as products.
bool exactly_hits(const Ray& ray, const Aabb& box) {
    double enter = 0.0, leave = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        const double o = ray.origin[axis], d = ray.direction[axis];
        if (d == 0.0) {
            if (o < box.min[axis] || o > box.max[axis]) return false;
            continue;
        }
        enter = std::max(enter, std::min((box.min[axis] - o) / d, (box.max[axis] - o) / d));
        leave = std::min(leave, std::max((box.min[axis] - o) / d, (box.max[axis] - o) / d));
    }
    return enter <= leave;
}

}  // namespace

TEST_CASE("a ray in the plane of a face hits the closed box, whatever the sign of its zero") {
    const Aabb box{{0, 0, 0}, {2, 2, 2}};
    for (const float zero : {0.0f, -0.0f})
        for (const float z : {0.0f, 2.0f}) {
            const Ray ray{{-1, -1, z}, {1, 1, zero}};
            CAPTURE(box, ray);
            REQUIRE(hits_box(ray, box));
        }
}

TEST_CASE("a ray along an edge hits the closed box") {
    const Aabb box{{0, 0, 0}, {2, 2, 2}};
    for (const float zero : {0.0f, -0.0f})
        for (const float y : {0.0f, 2.0f})
            for (const float z : {0.0f, 2.0f}) {
                const Ray ray{{-1, y, z}, {1, zero, zero}};
                CAPTURE(box, ray);
                REQUIRE(hits_box(ray, box));
            }
}

TEST_CASE("a ray along a face hits from within and misses from without, by the last bit") {
    const Aabb box{{1, 1, 1}, {2, 2, 2}};
    for (int axis = 0; axis < 3; ++axis)
        for (const float zero : {0.0f, -0.0f})
            for (const float face : {1.0f, 2.0f})
                for (const float towards : {0.0f, 3.0f}) {
                    Ray ray{{1.5f, 1.5f, 1.5f}, {1, 1, 1}};
                    ray.origin[axis] = std::nextafter(face, towards);
                    ray.direction[axis] = zero;
                    CAPTURE(box, ray);
                    REQUIRE(hits_box(ray, box) == exactly_hits(ray, box));
                }
}

TEST_CASE("all rays from whole points in whole directions are decided as in exact arithmetic") {
    const Aabb box{{0, 0, 0}, {2, 2, 2}};
    const float places[] = {-1, 0, 1, 2, 3}, steps[] = {-1, -0.0f, 0, 1};
    for (int i = 0; i < 125; ++i)
        for (int k = 0; k < 64; ++k) {
            const Ray ray{{places[i / 25], places[i / 5 % 5], places[i % 5]},
                          {steps[k / 16], steps[k / 4 % 4], steps[k % 4]}};
            if (!is_valid(ray) || hits_box(ray, box) == exactly_hits(ray, box)) continue;
            CAPTURE(box, ray);
            REQUIRE(hits_box(ray, box) == exactly_hits(ray, box));
        }
}

TEST_CASE("the ray's interval counts: a box behind the ray or beyond its end is missed") {
    const Aabb box{{0, 0, 0}, {2, 2, 2}};
    for (const float zero : {0.0f, -0.0f}) {
        CHECK_FALSE(hits_box({{5, 1, 1}, {1, zero, zero}}, box));
        CHECK_FALSE(hits_box({{-5, 1, 1}, {1, zero, zero}, 0, 4}, box));
        CHECK_FALSE(hits_box({{-5, 1, 1}, {1, zero, zero}, 8, 9}, box));
        CHECK(hits_box({{-5, 1, 1}, {1, zero, zero}, 0, 5}, box));
    }
}
