// Affine maps and the boxes that they move: by hand, and by rational numbers.
#include "chapters/ch09_instancing_and_motion/affine.hpp"

#include "chapters/ch09_instancing_and_motion/transformed_box.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch09/graphs.hpp"
#include "tests/exact_vector.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

namespace space {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Entries of a like size or of very different ones, now and then 0.
Affine some_map(Pcg32& random) {
    Affine map;
    const bool wild = random.below(2) != 0;
    for (auto& row : map.rows)
        for (double& entry : row) {
            entry = double{random.uniform(-1.0f, 1.0f)};
            if (wild) entry = std::ldexp(entry, int(random.below(41)) - 20);
            if (random.below(8) == 0) entry = 0.0;
        }
    return map;
}

mpq_class exact_coordinate(const Affine& map, int axis, const ExactVector<3>& p) {
    mpq_class sum = map.at(axis, 3);
    for (int j = 0; j < 3; ++j) sum += mpq_class(map.at(axis, j)) * p[j];
    return sum;
}

bool is_in(const Aabb& box, const Affine& map, const Point3& p) {
    for (int axis = 0; axis < 3; ++axis) {
        const mpq_class at = exact_coordinate(map, axis, exact(p));
        if (at < double{box.min[axis]} || at > double{box.max[axis]}) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("points are turned, stretched and moved; differences are not moved") {
    const Affine map{{{{0, -2, 0, 10}, {3, 0, 0, 20}, {0, 0, 1, 30}}}};
    REQUIRE(map.point({1, 2, 3}) == Double3(6, 23, 33));
    REQUIRE(map.vector({1, 2, 3}) == Double3(-4, 3, 3));
    REQUIRE(map.size_of_vector({1, 2, 3}) == Double3(4, 3, 3));
    REQUIRE(map.size_of_point({1, 2, 3}) == Double3(14, 23, 33));
    REQUIRE(determinant(map) == 6.0);
    REQUIRE(determinant(scaled({-1, 1, 1})) == -1.0);
}

TEST_CASE("a product is its second factor first, then its first") {
    const Affine stretch = scaled({2, 3, 4}), move = moved({10, 20, 30});
    REQUIRE(composed(move, stretch).point(Double3(1)) == Double3(12, 23, 34));
    REQUIRE(composed(stretch, move).point(Double3(1)) == Double3(22, 63, 124));
    REQUIRE(composed(stretch, {}) == stretch);
    REQUIRE(composed({}, move) == move);
}

TEST_CASE(
    "a flattened corner is the double's nearest float, and every sum goes from left to right") {
    // 1e16 + 1 is 1e16: from left to right 1 is lost before 1e16 is taken away, and would not be
    // from right to left.
    Affine map;
    map.rows[0] = {1e16, 1, -1e16, 0};
    map.rows[1] = {1, 0x1p-24, 0x1p-50, 0};  // just above the middle of two floats, once rounded
    const Triangle triangle{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}};
    REQUIRE(flattened(map, triangle).a == Point3(0, std::nextafter(1.0f, 2.0f), 1));
    REQUIRE(flattened(map, triangle).b == Point3(1e16f, 1, 0));
}

TEST_CASE("an inverse brings points back, and its residual is above how far it does not") {
    Pcg32 random(3);
    int inverses = 0;
    for (int i = 0; i < sized(3000, 300); ++i) {
        const Affine map = some_map(random);
        const auto back = inverse(map);
        if (!back) continue;
        ++inverses;
        const Affine off = residual(*back, map);
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 4; ++column) {
                mpq_class sum = column == 3 ? back->at(row, 3) : row == column ? -1.0 : 0.0;
                for (int k = 0; k < 3; ++k)
                    sum += mpq_class(back->at(row, k)) * mpq_class(map.at(k, column));
                REQUIRE(abs(sum) <= mpq_class(off.at(row, column)));
            }
    }
    REQUIRE(inverses > sized(2000, 200));
}

TEST_CASE("the inverse of what is by powers of two is exact") {
    const Affine map = moved({4, 8, -16}, composed(scaled({2, -0.5, 8}), rotated({0, 0, 1}, 0)));
    REQUIRE(inverse(map) == Affine{{{{0.5, 0, 0, -2}, {0, -2, 0, 16}, {0, 0, 0.125, 2}}}});
}

TEST_CASE("I3: a singular matrix has no inverse, nor has one that doubles cannot tell from it") {
    REQUIRE_FALSE(inverse(scaled({1, 1, 0})));
    REQUIRE_FALSE(inverse(scaled({0, 0, 0})));
    REQUIRE_FALSE(inverse(Affine{{{{1, 2, 3, 0}, {2, 4, 6, 0}, {0, 0, 1, 0}}}}));
    REQUIRE_FALSE(inverse(scaled({1, not_a_number, 1})));
    REQUIRE_FALSE(inverse(scaled({1, infinity, 1})));
    Pcg32 random(8);
    for (int i = 0; i < 100; ++i) {  // the third row is a sum of the others, but for roundings
        const Affine turn = rotated(random);
        Affine map = composed(turn, some_map(random));
        for (std::size_t j = 0; j < 3; ++j)
            map.rows[2][j] = 0.3 * map.rows[0][j] + 0.7 * map.rows[1][j];
        REQUIRE_FALSE(inverse(map));
    }
}

TEST_CASE("scales that differ by 10^12 are no reason to refuse, however the object is turned") {
    Pcg32 random(6);
    for (int i = 0; i < 100; ++i) {
        const Affine stretch = scaled({1e-6, 1.0, 1e6}), turn = rotated(random);
        REQUIRE(inverse(composed(turn, stretch)));
        REQUIRE(inverse(composed(stretch, turn)));
    }
}

TEST_CASE("the box of a transformed box, by hand") {
    const Aabb box{{-1, -2, -3}, {1, 2, 3}};
    const Affine quarter{{{{0, -1, 0, 10}, {1, 0, 0, 0}, {0, 0, 2, 0}}}};
    const Aabb expected{{8, -1, -6}, {12, 1, 6}};
    REQUIRE(box_of_corners(quarter, box) == expected);
    REQUIRE(transformed_box(quarter, box).contains(expected));
    REQUIRE(transformed_box(quarter, {}).is_empty());
    REQUIRE(box_of_corners(quarter, {}).is_empty());
    REQUIRE(
        transformed_box(scaled(Double3(1e30)), {Point3(1e20f), Point3(2e20f)}) ==
        Aabb{Point3(std::numeric_limits<float>::max()), Point3(std::numeric_limits<float>::max())});
}

TEST_CASE("what doubles round away of a bound is still in the box") {
    Affine map;
    map.rows[0] = {1, 0x1p-60, 0, 0};  // 1 - 2^-60 and 2 + 2^-60 are no doubles
    const Aabb box{{1, -1, 0}, {2, 1, 1}};
    for (const Point3& corner : {box.min, box.max})
        REQUIRE(is_in(transformed_box(map, box), map, corner));
    REQUIRE_FALSE(is_in(box_of_corners(map, box), map, box.min));
}

TEST_CASE("I6: two corners make the box of a cube that is turned by 45 degrees a line") {
    const Affine turn = rotated({0, 0, 1}, std::numbers::pi / 4);
    const Aabb cube{Point3(-1.0f), Point3(1.0f)};
    const Aabb wrong = box_of_two_corners(turn, cube), right = transformed_box(turn, cube);
    REQUIRE(wrong.extent().x < 1e-6f);
    REQUIRE(right.extent().x == Approx(2.0 * std::numbers::sqrt2));
    REQUIRE_FALSE(wrong.contains(flattened(turn, {{1, -1, 0}, {}, {}}).a));
}

TEST_CASE("a transformed box holds all points of the box, exactly and as flattening rounds them") {
    Pcg32 random(5);
    int tight = 0;
    for (int i = 0; i < sized(3000, 300); ++i) {
        const Affine map = some_map(random);
        Aabb box;
        const Point3 low = random_point(random, -1.0f, 1.0f);
        const Point3 size = random_point(random, 0.0f, i % 2 ? 1.0f : 1e-3f);
        box.extend(low);
        box.extend(low + size);
        const Aabb moved_box = transformed_box(map, box), corners = box_of_corners(map, box);
        for (int corner = 0; corner < 9; ++corner) {
            Point3 p = random_point(random, box);
            for (int axis = 0; axis < 3 && corner < 8; ++axis)
                p[axis] = (corner >> axis & 1 ? box.max : box.min)[axis];
            REQUIRE(is_in(moved_box, map, p));
            REQUIRE(moved_box.contains(flattened(map, {p, p, p}).a));
        }
        // And no larger than it has to be: a float or two beyond the corners' box.
        for (int axis = 0; axis < 3; ++axis) {
            float low_end = corners.min[axis], high_end = corners.max[axis];
            for (int k = 0; k < 2; ++k) {
                low_end = std::nextafter(low_end, -infinity);
                high_end = std::nextafter(high_end, infinity);
            }
            tight += moved_box.min[axis] >= low_end && moved_box.max[axis] <= high_end;
        }
    }
    REQUIRE(tight > sized(3000, 300) * 3 * 99 / 100);
}

}  // namespace space
