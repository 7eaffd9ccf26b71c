// Morton codes: bits by hand, and the order and the cells that they stand for. Catalogue O3 and O4.
#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"

#include "chapters/ch06_quadtrees_and_octrees/morton_order.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace space {
namespace {

// Bit by bit.
template <int D>
std::uint64_t slowly_interleaved(const std::array<std::uint32_t, D>& place) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < morton_bits<D>; ++bit)
        for (std::size_t axis = 0; axis < D; ++axis)
            code |= std::uint64_t{(place[axis] >> bit) & 1} << (std::size_t(bit) * D + axis);
    return code;
}

/// Cells of one depth in the order of a walk from the root.
template <int D>
void append_depth_first(const OrthtreeCell<D>& cell, std::uint32_t depth,
                        std::vector<OrthtreeCell<D>>& cells) {
    if (cell.depth == depth) {
        cells.push_back(cell);
        return;
    }
    for (std::uint32_t k = 0; k < orthants<D>; ++k) append_depth_first(cell.child(k), depth, cells);
}

template <int D>
void check_depth_first_order(std::uint32_t depth) {
    std::vector<OrthtreeCell<D>> cells;
    append_depth_first<D>({}, depth, cells);
    REQUIRE(cells.size() == std::size_t{1} << (D * depth));
    for (std::uint64_t code = 0; code < cells.size(); ++code) {
        REQUIRE(morton_code(cells[code]) == code);
        REQUIRE(cell_of_code<D>(code, depth) == cells[code]);
    }
}

template <int D>
void check_round_trips() {
    constexpr std::uint32_t all = std::uint32_t((std::uint64_t{1} << morton_bits<D>)-1);
    Pcg32 random(D);
    for (int i = 0; i < sized(100'000, 5'000); ++i) {
        std::array<std::uint32_t, D> place;
        for (std::uint32_t& along : place) along = random.next() & all;
        const std::uint64_t code = interleave<D>(place);
        REQUIRE(code == slowly_interleaved<D>(place));
        REQUIRE(deinterleave<D>(code) == place);
        REQUIRE(interleave<D>(deinterleave<D>(code)) == code);
    }
}

}  // namespace

static_assert(interleave<2>({0b101, 0b011}) == 0b01'10'11);
static_assert(interleave<3>({0b01, 0b10, 0b11}) == 0b110'101);
static_assert(interleave<2>({~0u, ~0u}) == ~std::uint64_t{0});
static_assert(interleave<3>({(1u << 21) - 1, (1u << 21) - 1, (1u << 21) - 1}) ==
              (std::uint64_t{1} << 63) - 1);
static_assert(deinterleave<3>(0b110'101) == std::array<std::uint32_t, 3>{0b01, 0b10, 0b11});

TEST_CASE("codes are as reckoned by hand") {
    CHECK(interleave<2>({5, 9}) == 0b10'01'00'11);
    CHECK(interleave<3>({1, 0, 0}) == 1);
    CHECK(interleave<3>({0, 1, 0}) == 2);
    CHECK(interleave<3>({0, 0, 1}) == 4);
    CHECK(interleave<3>({1u << 20, 0, 0}) == std::uint64_t{1} << 60);
    CHECK(interleave<3>({0, 0, 1u << 20}) == std::uint64_t{1} << 62);
    CHECK(interleave<2>({0, 1u << 30}) == std::uint64_t{1} << 61);
}

TEST_CASE("interleaving is what it is bit by bit, and is undone") {
    check_round_trips<2>();
    check_round_trips<3>();
}

TEST_CASE("a bit too many changes no other axis") {
    CHECK(interleave<3>({1u << 21, 0, 0}) == 0);
    CHECK(interleave<3>({~0u, 0, 0}) == interleave<3>({(1u << 21) - 1, 0, 0}));
}

TEST_CASE("the order of codes is the order of a walk from the root, depth first") {
    check_depth_first_order<2>(5);
    check_depth_first_order<3>(3);
}

TEST_CASE("a code begins with the code of every cell that its cell lies in") {
    Pcg32 random(5);
    for (int i = 0; i < 1'000; ++i) {
        OrthtreeCell<3> cell{21, {}};
        for (std::uint32_t& along : cell.place) along = random.next() >> 11;
        for (std::uint32_t depth = 0; depth <= 21; ++depth)
            REQUIRE(morton_code(cell.ancestor(depth)) == morton_code(cell) >> (3 * (21 - depth)));
    }
}

// ---- points -----------------------------------------------------------------------------------

TEST_CASE("a point on a plane is in the upper cell, one float below it in the lower") {
    const OrthtreeFrame<2> unit;
    for (const float plane : {0.5f, 0.25f, 0.75f, 0x1p-31f, 1.0f - 0x1p-24f}) {
        const auto place = std::uint32_t(double{plane} * 0x1p31);
        CHECK(morton_code(unit, {plane, 0.0f}) == interleave<2>({place, 0}));
        CHECK(morton_code(unit, {std::nextafter(plane, 0.0f), 0.0f}) < interleave<2>({place, 0}));
    }
}

TEST_CASE("a difference that is rounded up to a plane does not lift the point over it") {
    // -1e-30 - (-1) is 1 in double, which is where the upper half of this root begins.
    const OrthtreeFrame<3> frame{.corner = Double3(-1.0), .edge = 2.0};
    CHECK(frame.cell_of({-1e-30f, 0.0f, 0.0f}, 1).place == std::array<std::uint32_t, 3>{0, 1, 1});
    CHECK(morton_code(frame, {-1e-30f, 0.0f, 0.0f}) ==
          interleave<3>({(1u << 20) - 1, 1u << 20, 1u << 20}));
}

TEST_CASE("points are ordered by code, equal codes by index") {
    const OrthtreeFrame<2> unit;
    const std::vector<Point2> points{{0.9f, 0.9f}, {0.1f, 0.1f}, {0.9f, 0.1f},
                                     {0.1f, 0.9f}, {0.1f, 0.1f}, {0.9f, 0.9f}};
    const MortonOrder order = morton_order<2>(unit, points);
    CHECK(order.indices == std::vector<std::uint32_t>{1, 4, 2, 3, 0, 5});
    CHECK(std::ranges::is_sorted(order.codes));
}

// ---- catalogue --------------------------------------------------------------------------------

namespace {

/// As it is found in many programs: 10 bits an axis, by a product and a conversion.
std::uint32_t careless_place(float x) {
    return static_cast<std::uint32_t>(x * 1024.0f);
}
std::uint64_t careless_code(const Point3& p) {
    return interleave<3>({careless_place(p.x), careless_place(p.y), careless_place(p.z)});
}

std::size_t distinct(std::vector<std::uint64_t> codes) {
    std::ranges::sort(codes);
    return std::size_t(std::ranges::unique(codes).begin() - codes.begin());
}

}  // namespace

TEST_CASE("O4: a product puts x = 1 into cell 1024 of 1024, whose code belongs to nobody") {
    const OrthtreeFrame<3> unit;
    CHECK(careless_place(1.0f) == 1024);
    CHECK(careless_code({1, 0, 0}) == std::uint64_t{1}
                                          << 30);  // a 31st bit: not among 30-bit codes
    CHECK(unit.cell_of({1, 0, 0}, 10).place == std::array<std::uint32_t, 3>{1023, 0, 0});
    CHECK(morton_code(unit.cell_of({1, 1, 1}, 10)) == (1u << 30) - 1);
    CHECK(morton_code(unit, {1, 1, 1}) == (std::uint64_t{1} << 63) - 1);
}

TEST_CASE(
    "O4: below the root, above it, and no number: each has a cell, the nearest or the first") {
    const OrthtreeFrame<3> unit;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(unit.cell_of({-1.0f, 2.0f, nan}, 10).place == std::array<std::uint32_t, 3>{0, 1023, 0});
    CHECK(unit.cell_of({-infinity, infinity, 0.5f}, 10).place ==
          std::array<std::uint32_t, 3>{0, 1023, 512});
}

namespace {

struct Distinct {
    std::size_t codes30, codes63, points;
};
/// Of 100,000 points in a cube of edge c within the unit cube, from 0.3 on.
Distinct distinct_in_corner(float c) {
    const OrthtreeFrame<3> unit;
    Pcg32 random(6);
    std::vector<std::uint64_t> short_codes, codes;
    std::vector<std::array<float, 3>> points;
    for (int i = 0; i < 100'000; ++i) {
        const Point3 p = random_point(random, 0.3f, 0.3f + c);
        short_codes.push_back(morton_code(unit.cell_of(p, 10)));
        codes.push_back(morton_code(unit, p));
        points.push_back({p.x, p.y, p.z});
    }
    std::ranges::sort(points);
    const auto repeated = std::ranges::unique(points);
    return {distinct(std::move(short_codes)), distinct(std::move(codes)),
            std::size_t(repeated.begin() - points.begin())};
}

}  // namespace

TEST_CASE("O3: in a corner of the scene 30 bits tell few points apart, 63 nearly all") {
    // From 0.3 to 0.31 there are 11 cells of 1/1024, to 0.301 two, to 0.3001 one.
    const Distinct large = distinct_in_corner(1e-2f), medium = distinct_in_corner(1e-3f),
                   small = distinct_in_corner(1e-4f), tiny = distinct_in_corner(1e-6f);
    CHECK(large.codes30 <= 11 * 11 * 11);
    CHECK(large.codes30 >= 11 * 11 * 11 - 2);
    CHECK(medium.codes30 == 8);
    CHECK(small.codes30 == 1);
    CHECK(large.codes63 > 99'990);
    CHECK(medium.codes63 > 99'980);
    CHECK(small.codes63 > 99'300);
    CHECK(small.codes63 < 99'600);
    // Cells of 2^-21 are coarser than floats near 0.3, 2^-25 apart.
    CHECK(tiny.codes63 == 27);
    CHECK(tiny.points > 36'000);
}

}  // namespace space
