#include "ex04_eight_bits_a_plane.hpp"

#include "common/geometry.hpp"
#include "common/random.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

using namespace space;

namespace {

constexpr float largest = std::numeric_limits<float>::max();

/// As a ray is to see a plane, whatever became of the function in the exercise.
float seen(const Grid& grid, int axis, unsigned steps) {
    return grid.origin[axis] + std::ldexp(float(steps), grid.exponent[std::size_t(axis)]);
}
Grid right_grid(const Aabb& node) {
    Grid grid{node.min, {}};
    for (int axis = 0; axis < 3; ++axis) {
        int& exponent = grid.exponent[std::size_t(axis)] = -149;
        while (seen(grid, axis, 255) < node.max[axis]) ++exponent;
    }
    return grid;
}
/// The box that rays see, and the best of those.
Aabb unpacked(const Grid& grid, const PackedBox& box) {
    Aabb result;
    for (int axis = 0; axis < 3; ++axis) {
        result.min[axis] = seen(grid, axis, box.lower[std::size_t(axis)]);
        result.max[axis] = seen(grid, axis, box.upper[std::size_t(axis)]);
    }
    return result;
}
Aabb best(const Grid& grid, const Aabb& child) {
    Aabb result{Point3(-infinity), Point3(infinity)};
    for (int axis = 0; axis < 3; ++axis)
        for (unsigned steps = 0; steps < 256; ++steps) {
            const float position = seen(grid, axis, steps);
            if (position <= child.min[axis])
                result.min[axis] = std::max(result.min[axis], position);
            if (position >= child.max[axis])
                result.max[axis] = std::min(result.max[axis], position);
        }
    return result;
}

void check_grid(const Aabb& node) {
    const Grid grid = grid_of(node), right = right_grid(node);
    CAPTURE(node);
    REQUIRE(grid.origin == node.min);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        CAPTURE(axis);
        REQUIRE(grid.exponent[axis] == right.exponent[axis]);
    }
}
/// The child's box is packed in the right grid, whatever the answer's own is.
void check_pack(const Aabb& node, const Aabb& child) {
    const Grid grid = right_grid(node);
    const Aabb packed = unpacked(grid, pack(grid, child)), wanted = best(grid, child);
    CAPTURE(node, child);
    for (int axis = 0; axis < 3; ++axis) {
        CAPTURE(axis);
        const bool loses_no_ray =
            packed.min[axis] <= child.min[axis] && packed.max[axis] >= child.max[axis];
        CAPTURE(packed);
        REQUIRE(loses_no_ray);
        REQUIRE(Number{packed.min[axis]} == Number{wanted.min[axis]});
        REQUIRE(Number{packed.max[axis]} == Number{wanted.max[axis]});
    }
}

/// Two corners in order.
Aabb box_of(const Point3& p, const Point3& q) {
    return {glm::min(p, q), glm::max(p, q)};
}
/// In the box, on its corners at times.
Point3 point_in(Pcg32& random, const Aabb& box) {
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const double share = random.uniform_double();
        const std::uint32_t kind = random.below(8);
        const double low = box.min[axis], high = box.max[axis];
        p[axis] = kind == 0 ? box.min[axis]
                  : kind == 1
                      ? box.max[axis]
                      : std::clamp(float(low + share * (high - low)), box.min[axis], box.max[axis]);
    }
    return p;
}
void check_children(Pcg32& random, const Aabb& node, int count) {
    check_grid(node);
    for (int i = 0; i < count; ++i) {
        const Point3 p = point_in(random, node);
        const Point3 q = point_in(random, node);
        check_pack(node, box_of(p, q));
    }
}

}  // namespace

TEST_CASE("a node of 255 steps: each child between whole steps is packed as it is") {
    const Aabb node{Point3(0), Point3(255)};
    check_grid(node);
    check_pack(node, {{0, 1, 2}, {255, 254, 3}});
    check_pack(node, {{7, 7, 7}, {7, 7, 7}});
    check_pack(node, node);
}

TEST_CASE("between steps the lower plane goes down and the upper one up") {
    const Aabb node{Point3(0), Point3(255)};
    check_pack(node, {{0.5f, 1.25f, 2.75f}, {3.5f, 4.25f, 5.75f}});
    check_pack(node, {{1.999f, 1.001f, 254.5f}, {2.001f, 2.999f, 254.5f}});
}

TEST_CASE("the step is as small as 255 of them allow, for each axis by itself") {
    check_grid({{0, 0, 0}, {255, 256, 1}});
    check_grid({{0, 0, 0}, {127.5f, 127.75f, 510}});
    check_grid({{-3, 5, 100}, {3, 5.5f, 101}});
}

TEST_CASE("a lower corner that is not at 0") {
    const Aabb node{{-7, 3, 0.1f}, {9, 4, 0.7f}};
    check_grid(node);
    check_pack(node, {{-6.9f, 3.1f, 0.2f}, {0.3f, 3.3f, 0.3f}});
    check_pack(node, {{8.9f, 3.99f, 0.69f}, {9, 4, 0.7f}});
}

TEST_CASE("flat boxes, and nodes that are points") {
    for (const float at : {0.0f, 1.0f, -0.3f, 1e30f, 1e-42f}) {
        const Aabb wall{{at, 0, 0}, {at, 1, 2}}, point{Point3(at), Point3(at)};
        check_grid(wall);
        check_pack(wall, {{at, 0.25f, 0.3f}, {at, 0.25f, 0.9f}});
        check_grid(point);
        check_pack(point, point);
    }
}

TEST_CASE(
    "from far away to the origin no box gets smaller: differences are rounded, in double, too") {
    for (const float small : {0x1p-80f, 0x1p-30f, 0x1p-10f, 1e-45f}) {
        const Aabb node{Point3(-0x1p60f), Point3(0x1p60f)};
        check_pack(node, {Point3(-small), Point3(-small)});
        check_pack(node, {Point3(small), Point3(small)});
        const Aabb lower{Point3(-0x1p60f), Point3(-small)};
        check_pack(lower, {Point3(-small), Point3(-small)});
        check_grid(lower);
    }
}

TEST_CASE("random boxes near the origin") {
    Pcg32 random(4);
    for (int i = 0; i < sized(2'000, 200); ++i) {
        const Point3 p = random_point(random, -1.0f, 1.0f);
        const Point3 q = random_point(random, -1.0f, 1.0f);
        CAPTURE(i);
        check_children(random, box_of(p, q), 4);
    }
}

TEST_CASE("far from the origin sums are rounded, and steps are less than a float can tell") {
    Pcg32 random(5);
    for (int i = 0; i < sized(2'000, 200); ++i) {
        const float far = std::ldexp(1.0f, int(random.below(28)));
        const Point3 p = far + random_point(random, -1.0f, 1.0f);
        const Point3 q = far + random_point(random, -1.0f, 1.0f);
        CAPTURE(i);
        check_children(random, box_of(p, q), 4);
        check_children(random, box_of(-p, -q), 4);
    }
}

TEST_CASE("corners one float apart from a plane, on both sides") {
    Pcg32 random(6);
    for (int i = 0; i < sized(1'000, 100); ++i) {
        const Point3 p = random_point(random, -4.0f, 4.0f);
        const Point3 q = random_point(random, -4.0f, 4.0f);
        const Aabb node = box_of(p, q);
        const Grid grid = right_grid(node);
        Aabb child;
        for (int axis = 0; axis < 3; ++axis) {
            const auto near = [&] {
                const float at = seen(grid, axis, random.below(256));
                const float to = random.below(2) == 0 ? -infinity : infinity;
                return std::clamp(std::nextafter(at, to), node.min[axis], node.max[axis]);
            };
            const float a = near();
            const float b = near();
            child.min[axis] = std::min(a, b);
            child.max[axis] = std::max(a, b);
        }
        CAPTURE(i);
        check_pack(node, child);
    }
}

TEST_CASE("tiny and huge boxes") {
    Pcg32 random(7);
    for (const float size : {1e-45f, 1e-42f, 1e-38f, 1e-20f, 1e20f, 1e38f, largest}) {
        const Aabb cube{Point3(-size), Point3(size)};
        CAPTURE(size);
        check_children(random, cube, 50);
        for (int i = 0; i < 50; ++i) {
            const Point3 p = point_in(random, cube);
            const Point3 q = point_in(random, cube);
            check_children(random, box_of(p, q), 4);
        }
    }
}
