// Cells and their frame: exact corners, and every point in exactly one cell of each depth.
#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <gmpxx.h>

#include <cmath>
#include <vector>

namespace space {
namespace {

constexpr int boxes = sized(3'000, 300);

/// Boxes near and far, tiny and huge, flat and as small as points.
template <int D>
BasicAabb<D> some_box(Pcg32& random) {
    const int exponent = static_cast<int>(random.below(240)) - 130;
    BasicAabb<D> box;
    const int points = 1 + static_cast<int>(random.below(4));
    const bool whole = random.below(3) == 0;
    const float away =
        random.below(2) ? std::ldexp(1.0f, static_cast<int>(random.below(30))) : 0.0f;
    for (int i = 0; i < points; ++i) {
        Point<D> p = random_point(random, BasicAabb<D>{Point<D>(-4.0f), Point<D>(4.0f)});
        if (whole) p = glm::round(p);
        p += away;
        for (int axis = 0; axis < D; ++axis) {
            if (random.below(8) == 0) p[axis] = 0.0f;
            p[axis] = std::ldexp(p[axis], std::min(exponent, 95));
        }
        box.extend(p);
    }
    return box;
}

template <int D>
OrthtreeCell<D> some_cell(Pcg32& random) {
    OrthtreeCell<D> cell{random.below(max_orthtree_depth<D> + 1), {}};
    for (std::uint32_t& place : cell.place) place = random.below(1u << cell.depth);
    return cell;
}

/// Points of a box, many of them on planes of the cells and one float beside.
template <int D>
Point<D> some_point(Pcg32& random, const BasicAabb<D>& box, const OrthtreeFrame<D>& frame) {
    Point<D> p = random_point(random, box);
    for (int axis = 0; axis < D; ++axis) {
        const std::uint32_t depth = random.below(max_orthtree_depth<D> + 1);
        const std::uint32_t place = random.below(1u << std::min(depth, 30u));
        if (random.below(2)) p[axis] = static_cast<float>(frame.plane(axis, depth, place));
        if (random.below(3) == 0)
            p[axis] = std::nextafter(p[axis], random.below(2) ? 1e38f : -1e38f);
        p[axis] = std::clamp(p[axis], box.min[axis], box.max[axis]);
    }
    return p;
}

template <int D>
void check_exact_corners() {
    Pcg32 random(1, D);
    for (int i = 0; i < boxes; ++i) {
        const BasicAabb<D> box = some_box<D>(random);
        const auto frame = OrthtreeFrame<D>::around(box);
        int exponent = 0;
        REQUIRE(std::frexp(frame.edge, &exponent) == 0.5);
        for (int axis = 0; axis < D; ++axis) {
            REQUIRE(frame.corner[axis] <= double{box.min[axis]});
            REQUIRE(frame.box().max[axis] >= double{box.max[axis]});
        }
        const OrthtreeCell<D> cell = some_cell<D>(random);
        const OrthtreeBox<D> got = frame.box(cell);
        const mpq_class edge =
            mpq_class(frame.edge) / mpq_class(std::ldexp(1.0, static_cast<int>(cell.depth)));
        REQUIRE(mpq_class(frame.cell_edge(cell.depth)) == edge);
        for (int axis = 0; axis < D; ++axis) {
            const mpq_class low =
                mpq_class(frame.corner[axis]) + cell.place[static_cast<std::size_t>(axis)] * edge;
            REQUIRE(mpq_class(got.min[axis]) == low);
            REQUIRE(mpq_class(got.max[axis]) == mpq_class(low + edge));
            REQUIRE(mpq_class(got.centre()[axis]) == mpq_class(low + edge / 2));
        }
    }
}

template <int D>
void check_half_open() {
    Pcg32 random(2, D);
    for (int i = 0; i < boxes; ++i) {
        const BasicAabb<D> box = some_box<D>(random);
        const auto frame = OrthtreeFrame<D>::around(box);
        const Point<D> p = some_point(random, box, frame);
        const OrthtreeCell<D> finest = frame.cell_of(p, max_orthtree_depth<D>);
        for (std::uint32_t depth = 0; depth <= max_orthtree_depth<D>; ++depth) {
            const OrthtreeCell<D> cell = frame.cell_of(p, depth);
            REQUIRE(cell == finest.ancestor(depth));
            const OrthtreeBox<D> its = frame.box(cell), root = frame.box();
            for (int axis = 0; axis < D; ++axis) {
                REQUIRE(its.min[axis] <= double{p[axis]});
                if (its.max[axis] < root.max[axis]) REQUIRE(double{p[axis]} < its.max[axis]);
                REQUIRE(double{p[axis]} <= its.max[axis]);
            }
        }
    }
}

}  // namespace

TEST_CASE("the frame holds its box, and corners, centres and edges s/2^i of all cells are exact") {
    check_exact_corners<2>();
    check_exact_corners<3>();
}

TEST_CASE("a point is in one half-open cell of each depth, and each of them in the one above") {
    check_half_open<2>();
    check_half_open<3>();
}

TEST_CASE("the frame is no larger than it must be") {
    const auto frame = OrthtreeFrame<3>::around({Point3(0.0f), Point3(1.0f, 0.5f, 0.0f)});
    CHECK(frame.edge == 1.0);
    CHECK(frame.corner == Double3(0.0));
    CHECK(OrthtreeFrame<2>::around({Point2(-3.0f), Point2(2.0f)}).edge == 8.0);
    CHECK(OrthtreeFrame<3>::around({Point3(1e6f, 0, 0), Point3(1e6f, 1e-10f, 0)}).edge == 0x1p-10);
    CHECK(OrthtreeFrame<3>::around({}).edge == 1.0);
    // It would fit into an edge of 1, but for where corners may be.
    const Aabb beside{Point3(-0x1p-30f), Point3(1.0f - 0x1p-24f)};
    CHECK(OrthtreeFrame<3>::around(beside).edge == 2.0);
}

TEST_CASE("a point outside of the root is in the cell next to it") {
    const OrthtreeFrame<2> unit;
    CHECK(unit.cell_of({-1.0f, 5.0f}, 3) == OrthtreeCell<2>{3, {0, 7}});
    CHECK(unit.cell_of({1.0f, 0.5f}, 3) == OrthtreeCell<2>{3, {7, 4}});
    CHECK(unit.cell_of({1.0f, 0.5f}, 0) == OrthtreeCell<2>{});
}

TEST_CASE("children, parents and orthants go together") {
    Pcg32 random(3);
    for (int i = 0; i < 100; ++i) {
        const OrthtreeCell<3> cell = some_cell<3>(random);
        for (std::uint32_t k = 0; k < orthants<3>; ++k) {
            REQUIRE(cell.child(k).parent() == cell);
            REQUIRE(cell.child(k).orthant() == k);
        }
    }
}

}  // namespace space
