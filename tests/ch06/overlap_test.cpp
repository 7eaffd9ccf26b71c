// Overlap of a segment or triangle with a cell: exact arithmetic's answer on every pair.
#include "chapters/ch06_quadtrees_and_octrees/simplex_overlap.hpp"
#include "tests/catch.hpp"
#include "tests/ch04/exact_parts.hpp"
#include "tests/ch06/overlap_pairs.hpp"

#include <fmt/format.h>

namespace space {
namespace {

constexpr int pairs = sized(60'000, 5'000);

/// Whether the exact parts touch: something is left of the polygon in the closed box.
template <int D>
bool exactly_overlaps(const Simplex<D>& simplex, const OrthtreeBox<D>& cell, double shrunk = 0.0) {
    ExactPart<D> part = exact_part<D>(simplex);
    for (int axis = 0; axis < D; ++axis) {
        const mpq_class margin = shrunk * (mpq_class(cell.max[axis]) - cell.min[axis]);
        part = exactly_clipped<D>(part, std::size_t(axis), cell.min[axis] + margin, -1);
        part = exactly_clipped<D>(part, std::size_t(axis), cell.max[axis] - margin, 1);
    }
    return !part.empty();
}

template <int D>
void check_pairs() {
    PairMaker<D> maker(1);
    int overlapping = 0, grazing = 0;
    for (int i = 0; i < pairs; ++i) {
        const OverlapPair<D> pair = maker.next();
        const bool expected = exactly_overlaps<D>(pair.simplex, pair.cell);
        CAPTURE(i, D);
        REQUIRE(SimplexOverlap<D>(pair.simplex).overlaps(pair.cell) == expected);
        overlapping += expected;
        grazing += expected && !exactly_overlaps<D>(pair.simplex, pair.cell, 1e-9);
    }
    fmt::print("  D = {}: {} pairs, {} overlap, {} of them touch within 10^-9 of an edge\n", D,
               pairs, overlapping, grazing);
    CHECK(overlapping > pairs / 4);
    CHECK(overlapping < pairs - pairs / 8);
    CHECK(grazing > pairs / 20);
}

}  // namespace

TEST_CASE("overlap is that of rational numbers, for what only touches and what has no area, too") {
    check_pairs<2>();
    check_pairs<3>();
}

TEST_CASE("overlap is exact for the largest and the smallest floats") {
    for (const float scale : {0x1p126f, 0x1p-126f, 0x1p-146f}) {
        const OrthtreeBox<3> cell{Double3(0.0), Double3(double{scale})};
        const auto overlaps = [&](Triangle t) {
            for (Point3* p : {&t.a, &t.b, &t.c}) *p *= scale;
            CHECK(SimplexOverlap<3>(t).overlaps(cell) == exactly_overlaps<3>(t, cell));
            return SimplexOverlap<3>(t).overlaps(cell);
        };
        // The plane x + y + z = 3 touches a corner; beyond it nothing.
        CHECK(overlaps({{3, 0, 0}, {0, 3, 0}, {0, 0, 3}}));
        CHECK_FALSE(overlaps({{3.5f, 0, 0}, {0, 3, 0}, {0, 0, 3}}));
        CHECK(overlaps({{2, 0, 0}, {0, 2, 0}, {1, 1, 0}}));  // a segment in fact, at an edge
        CHECK_FALSE(overlaps({{2.5f, 0, 0}, {0, 2, 0}, {1, 1.5f, 0}}));
    }
}

}  // namespace space
