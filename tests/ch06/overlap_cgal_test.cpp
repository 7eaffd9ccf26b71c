// Overlap of a segment or triangle with a cell against CGAL's exact predicate.
#include "chapters/ch06_quadtrees_and_octrees/simplex_overlap.hpp"
#include "tests/catch.hpp"
#include "tests/ch06/overlap_pairs.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <CGAL/Iso_cuboid_3.h>
#include <CGAL/Iso_rectangle_2.h>

#include <optional>

namespace space {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;

Kernel::Point_2 exact(const Double2& p) {
    return {p.x, p.y};
}
Kernel::Point_3 exact(const Double3& p) {
    return {p.x, p.y, p.z};
}

/// None where CGAL does not say: of what has no area.
std::optional<bool> cgal_overlaps(const OverlapPair<2>& pair) {
    const Kernel::Segment_2 segment(exact(Double2(pair.simplex.a)), exact(Double2(pair.simplex.b)));
    if (segment.is_degenerate()) return std::nullopt;
    return CGAL::do_intersect(segment,
                              Kernel::Iso_rectangle_2(exact(pair.cell.min), exact(pair.cell.max)));
}
std::optional<bool> cgal_overlaps(const OverlapPair<3>& pair) {
    const Kernel::Triangle_3 triangle(exact(Double3(pair.simplex.a)),
                                      exact(Double3(pair.simplex.b)),
                                      exact(Double3(pair.simplex.c)));
    if (triangle.is_degenerate()) return std::nullopt;
    return CGAL::do_intersect(triangle,
                              Kernel::Iso_cuboid_3(exact(pair.cell.min), exact(pair.cell.max)));
}

/// Misses and false overlaps.
template <int D>
void check_pairs(int pairs) {
    PairMaker<D> maker(2);
    int missed = 0, falsely = 0, answered = 0;
    for (int i = 0; i < pairs; ++i) {
        const OverlapPair<D> pair = maker.next();
        const std::optional<bool> expected = cgal_overlaps(pair);
        if (!expected) continue;
        ++answered;
        const bool got = SimplexOverlap<D>(pair.simplex).overlaps(pair.cell);
        missed += *expected && !got;
        falsely += got && !*expected;
    }
    CAPTURE(D);
    CHECK(answered > pairs / 2);
    CHECK(missed == 0);
    CHECK(falsely == 0);
}

}  // namespace

TEST_CASE("overlap against CGAL: none missed, none false") {
    check_pairs<2>(20'000);
    check_pairs<3>(20'000);
}

TEST_CASE("the same with a million pairs", "[.big]") {
    check_pairs<2>(1'000'000);
    check_pairs<3>(1'000'000);
}

}  // namespace space
