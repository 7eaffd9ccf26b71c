// What is true of all codes, sorts and trees: properties, on random examples that shrink.
#include "chapters/ch06_quadtrees_and_octrees/cell_neighbours.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_search.hpp"
#include "chapters/ch06_quadtrees_and_octrees/radix_sort.hpp"
#include "tests/catch.hpp"

#include <rapidcheck.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace space {
namespace {

/// The same examples on every run; RC_PARAMS in the environment asks for others.
const int seeded = ::setenv("RC_PARAMS", "seed=1 max_success=300", 0);

/// Coordinates that often tie, on planes of the unit cube's cells and off them.
Point3 some_point() {
    Point3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = float(*rc::gen::inRange(0, 25)) / 24.0f;
    return p;
}
std::vector<Point3> some_points() {
    std::vector<Point3> points(*rc::gen::inRange<std::size_t>(1, 60));
    for (Point3& p : points) p = some_point();
    return points;
}
LinearOrthtreeConfig some_config() {
    return {.leaf_size = *rc::gen::inRange<std::size_t>(0, 5),
            .max_depth = *rc::gen::inRange(0u, 25u),
            .skip_chains = *rc::gen::arbitrary<bool>()};
}

}  // namespace

TEST_CASE("property: interleaving keeps the order on each axis while the others stand still") {
    CHECK(rc::check([] {
        std::array<std::uint32_t, 3> a{};
        for (std::uint32_t& along : a) along = *rc::gen::inRange(0u, 1u << 21);
        auto b = a;
        const auto axis = *rc::gen::inRange<std::size_t>(0, 3);
        b[axis] = *rc::gen::inRange(0u, 1u << 21);
        RC_ASSERT((a[axis] < b[axis]) == (interleave<3>(a) < interleave<3>(b)));
    }));
}

TEST_CASE("property: the sort is the library's stable one") {
    CHECK(rc::check([](const std::vector<std::uint64_t>& codes) {
        std::vector<CodedIndex> items, scratch;
        for (const std::uint64_t code : codes)
            items.push_back({code % 1000 == 0 ? code : code % 300, std::uint32_t(items.size())});
        auto wanted = items;
        std::ranges::stable_sort(wanted, {}, &CodedIndex::code);
        radix_sort(items, scratch);
        RC_ASSERT(items == wanted);
    }));
}

TEST_CASE("property: steps over opposite faces undo each other, and steps over others commute") {
    CHECK(rc::check([] {
        const std::uint32_t depth = *rc::gen::inRange(1u, 22u);
        OrthtreeCell<3> cell{depth, {}};
        for (std::uint32_t& along : cell.place) along = *rc::gen::inRange(0u, 1u << depth);
        const CellFace one{*rc::gen::inRange(0, 3), *rc::gen::arbitrary<bool>()};
        const CellFace other{(one.axis + 1) % 3, *rc::gen::arbitrary<bool>()};
        const auto a = face_neighbour<3>(cell, one), b = face_neighbour<3>(cell, other);
        if (a) RC_ASSERT(face_neighbour<3>(*a, one.opposite()) == cell);
        if (a && b) RC_ASSERT(face_neighbour<3>(*a, other) == face_neighbour<3>(*b, one));
    }));
}

TEST_CASE("property: a tree without chains has no more than 2 n nodes, and the same answers") {
    CHECK(rc::check([] {
        const auto points = some_points();
        auto config = some_config();
        const Point3 query = some_point();
        const auto k = *rc::gen::inRange<std::size_t>(0, 70);
        const auto a = OrthtreePoints<3>::build(points, config);
        config.skip_chains = !config.skip_chains;
        const auto b = OrthtreePoints<3>::build(points, config);
        RC_ASSERT((config.skip_chains ? b : a).cells.nodes.size() <= 2 * points.size());
        RC_ASSERT((k_nearest<3, OrthtreeSearch<3>>(a, query, k)) ==
                  (k_nearest<3, OrthtreeSearch<3>>(b, query, k)));
    }));
}

TEST_CASE("property: a closed box finds what a loop finds") {
    CHECK(rc::check([] {
        const auto points = some_points();
        Aabb box;
        box.extend(some_point());
        box.extend(some_point());
        std::vector<std::uint32_t> found, wanted;
        points_in_box<3>(OrthtreePoints<3>::build(points, some_config()), box, found);
        for (std::uint32_t i = 0; i < points.size(); ++i)
            if (box.contains(points[i])) wanted.push_back(i);
        RC_ASSERT(found == wanted);
    }));
}

}  // namespace space
