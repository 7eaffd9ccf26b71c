#include "ex02_nan_slab.hpp"

#include "tests/catch.hpp"

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
        for (const float z : {0.0f, 2.0f}) CHECK(hits_box({{-1, -1, z}, {1, 1, zero}}, box));
}

TEST_CASE("a ray along an edge hits the closed box") {
    const Aabb box{{0, 0, 0}, {2, 2, 2}};
    for (const float zero : {0.0f, -0.0f})
        for (const float y : {0.0f, 2.0f})
            for (const float z : {0.0f, 2.0f}) CHECK(hits_box({{-1, y, z}, {1, zero, zero}}, box));
}

TEST_CASE("all rays from whole points in whole directions are decided as in exact arithmetic") {
    const Aabb box{{0, 0, 0}, {2, 2, 2}};
    const float places[] = {-1, 0, 1, 2, 3}, steps[] = {-1, -0.0f, 0, 1};
    int wrong = 0;
    for (const float x : places)
        for (const float y : places)
            for (const float z : places)
                for (const float dx : steps)
                    for (const float dy : steps)
                        for (const float dz : steps) {
                            const Ray ray{{x, y, z}, {dx, dy, dz}};
                            if (is_valid(ray))
                                wrong += hits_box(ray, box) != exactly_hits(ray, box);
                        }
    CHECK(wrong == 0);
}
