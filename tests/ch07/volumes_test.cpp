// Volumes around points: sizes known beforehand, and every point inside, by rational numbers.
#include "chapters/ch07_bounding_volume_hierarchies/tight_box.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/exact_volumes.hpp"
#include "tests/ch07/volume_points.hpp"

#include <numbers>

namespace space {

static_assert(BoundingVolume<Aabb>);
static_assert(BoundingVolume<BoundingSphere<3>>);
static_assert(BoundingVolume<OrientedBounds<3>>);
static_assert(BoundingVolume<KDop<6>> && BoundingVolume<KDop<26>>);

namespace {

/// Sums of a few doubles of about their size.
Approx close(double x) {
    return Approx(x).epsilon(1e-14).margin(1e-300);
}
/// Oriented boxes: their axes are floats (the header's bound), planes are rounded outwards, and
/// points of turned boxes are rounded, by up to 2^-24 of 14 each: with edges from 1 to 8 an axis is
/// off by 50 units of 2^-24, and a width by 1000.
Approx turned(double x) {
    return Approx(x).epsilon(3'000 * 0x1p-24);
}

/// Calls visit(volume) with each of the chapter's volumes around the points.
template <int D, class Visit>
void for_each_volume(std::span<const Point<D>> points, const Visit& visit) {
    visit(box_around<D>(points));
    visit(ritter_sphere<D>(points));
    visit(smallest_sphere<D>(points));
    visit(principal_box<D>(points));
    visit(tight_box<D>(points));
    if constexpr (D == 2) {
        visit(k_dop_around<4, 2>(points));
        visit(k_dop_around<8, 2>(points));
    } else {
        visit(k_dop_around<6, 3>(points));
        visit(k_dop_around<14, 3>(points));
        visit(k_dop_around<18, 3>(points));
        visit(k_dop_around<26, 3>(points));
    }
}

std::vector<Point3> octahedron() {
    return {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
}
std::vector<Point3> cube() {
    std::vector<Point3> corners;
    for (int k = 0; k < 8; ++k) corners.push_back({k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1});
    return corners;
}

}  // namespace

TEST_CASE("an octahedron: a 14-DOP is it, an 18-DOP a rhombic dodecahedron, a box a cube") {
    const std::vector<Point3> points = octahedron();
    const double root3 = std::sqrt(3.0), root2 = std::sqrt(2.0);
    CHECK(surface(box_around<3>(points)) == 24.0);
    CHECK(content(box_around<3>(points)) == 8.0);
    const auto six = k_dop_around<6, 3>(points);
    CHECK(surface(six) == close(24.0));
    CHECK(content(six) == close(8.0));
    const auto fourteen = k_dop_around<14, 3>(points);
    CHECK(surface(fourteen) == close(4.0 * root3));
    CHECK(content(fourteen) == close(4.0 / 3.0));
    const auto eighteen = k_dop_around<18, 3>(points);
    CHECK(surface(eighteen) == close(6.0 * root2));
    CHECK(content(eighteen) == close(2.0));
    CHECK(surface(k_dop_around<26, 3>(points)) == close(4.0 * root3));
    const BoundingSphere<3> sphere = smallest_sphere<3>(points);
    CHECK(sphere.centre == Point3(0.0f));
    CHECK(sphere.radius == std::nextafter(1.0f, 2.0f));  // rounded up
    CHECK(surface(sphere) == Approx(4.0 * std::numbers::pi));
    CHECK(content(sphere) == Approx(4.0 / 3.0 * std::numbers::pi));
}

TEST_CASE("a cube is its own k-DOP, for every k") {
    const std::vector<Point3> points = cube();
    CHECK(content(k_dop_around<14, 3>(points)) == close(8.0));
    CHECK(surface(k_dop_around<18, 3>(points)) == close(24.0));
    CHECK(surface(k_dop_around<26, 3>(points)) == close(24.0));
    CHECK(content(k_dop_around<26, 3>(points)) == close(8.0));
}

TEST_CASE("in the plane: an octagon around a diamond is the diamond, around a square the square") {
    const std::vector<Point2> diamond{{3, 0}, {0, 3}, {-3, 0}, {0, -3}};
    CHECK(surface(k_dop_around<4, 2>(std::span<const Point2>(diamond))) == close(24.0));
    CHECK(surface(k_dop_around<8, 2>(std::span<const Point2>(diamond))) ==
          close(12.0 * std::sqrt(2.0)));
    CHECK(content(k_dop_around<8, 2>(std::span<const Point2>(diamond))) == close(18.0));
    CHECK(content(box_around<2>(diamond)) == 36.0);
    CHECK(surface(smallest_sphere<2>(diamond)) == Approx(6.0 * std::numbers::pi));
    CHECK(content(smallest_sphere<2>(diamond)) == Approx(9.0 * std::numbers::pi));
}

TEST_CASE("a turned rectangle of 10 x 5 is found, where the axis-aligned box has 11 x 10") {
    const std::vector<Point2> points{{0, 0}, {8, 6}, {5, 10}, {-3, 4}, {2.5f, 5}};
    CHECK(content(box_around<2>(points)) == 110.0);
    for (const OrientedBounds<2>& box : {tight_box<2>(points), principal_box<2>(points)}) {
        CHECK(surface(box) == Approx(30.0).epsilon(16 * 0x1p-24));
        CHECK(content(box) == Approx(50.0).epsilon(16 * 0x1p-24));
    }
}

TEST_CASE("of rectangles at 3,600 angles none has a shorter boundary than the tight one") {
    for (const auto& [name, points] : point_sets<2>(sized(20u, 3u), 40)) {
        if (surface(box_around<2>(points)) > 1e30) continue;  // no sums of squares in float below
        const double tight = surface(tight_box<2>(points));
        for (int i = 0; i < 3'600; ++i) {
            const double angle = i * (0.5 * std::numbers::pi / 3'600);
            const Double2 u(std::cos(angle), std::sin(angle)), v(-u.y, u.x);
            Aabb2 box;
            double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300}, largest = 0.0;
            for (const Point2& p : points)
                for (int axis = 0; axis < 2; ++axis) {
                    const double along = glm::dot(axis ? v : u, Double2(p));
                    low[axis] = std::min(low[axis], along);
                    high[axis] = std::max(high[axis], along);
                    largest = std::max(largest, std::abs(along));
                }
            const double boundary = 2.0 * (high[0] - low[0] + high[1] - low[1]);
            CAPTURE(name, points.size(), i);
            // Axes are off by 2^-24, and each of four planes by as much.
            REQUIRE(tight <= boundary + 32 * 0x1p-24 * largest + 8 * 0x1p-149);
        }
    }
}

TEST_CASE("turned boxes in space are found, whatever points are in them") {
    Pcg32 random(71);
    for (int i = 0; i < sized(200, 20); ++i) {
        Double3 e;
        const auto points = points_of_turned_box<3>(random, random.below(100), e);
        const OrientedBounds<3> box = tight_box<3>(points);
        CAPTURE(i, e.x, e.y, e.z);
        REQUIRE(content(box) == turned(e.x * e.y * e.z));
        REQUIRE(surface(box) == turned(2.0 * (e.x * e.y + e.y * e.z + e.z * e.x)));
    }
}

TEST_CASE(
    "a tight box has no more surface than that of the principal axes, or an axis-aligned one") {
    for (const auto& [name, points] : point_sets<3>(sized(20u, 3u), 60)) {
        const double largest = std::sqrt(3.0) * largest_coordinate<3>(points);
        if (largest > largest_proved) continue;
        const Aabb box = box_around<3>(points);
        // With axes off by 2^-24 and planes by 2^-23 of what they are, a width is off by e; so a
        // surface 2 (a b + b c + c a) by 4 e (a + b + c) + 6 e^2, and there are two of them.
        const double e = 0x1p-21 * largest + 0x1p-147;
        const double off = 24.0 * e * glm::length(edges(box)) + 12.0 * e * e;
        const double tight = surface(tight_box<3>(points)) * (1.0 - 0x1p-22);
        CAPTURE(name, points.size());
        CHECK(tight <= surface(principal_box<3>(points)) + off);
        CHECK(tight <= surface(box) + off);
    }
}

namespace {

template <int D>
void check_containment(std::size_t each, std::uint32_t most) {
    for (const auto& [name, points] : point_sets<D>(each, most)) {
        const double largest = largest_coordinate<D>(points);
        for_each_volume<D>(points, [&](const auto& volume) {
            CAPTURE(D, name, points.size());
            for (const Point<D>& p : points) REQUIRE(exactly_contains(volume, p));
            REQUIRE_FALSE(volume.is_empty());
            if (largest > largest_proved) return;
            // Numbers even where the squares of coordinates overflow floats.
            REQUIRE(std::isfinite(surface(volume)));
            REQUIRE(surface(volume) >= 0.0);
            REQUIRE(content(volume) >= 0.0);
        });
    }
}

}  // namespace

TEST_CASE("every volume contains every point that it was made around, exactly") {
    check_containment<2>(sized(40u, 4u), 40);
    check_containment<3>(sized(40u, 4u), 40);
}

TEST_CASE("more slabs are never looser: 26 within 14 and 18, these within 6, which is the box") {
    for (const auto& [name, points] : point_sets<3>(sized(20u, 3u), 40)) {
        const auto six = k_dop_around<6, 3>(points);
        const auto fourteen = k_dop_around<14, 3>(points);
        const auto eighteen = k_dop_around<18, 3>(points);
        const auto all = k_dop_around<26, 3>(points);
        const Aabb box = box_around<3>(points);
        CAPTURE(name);
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK(six.slabs[i] == Slab{box.min[int(i)], box.max[int(i)]});
            CHECK((six.slabs[i] == fourteen.slabs[i] && six.slabs[i] == eighteen.slabs[i]));
        }
        for (std::size_t i = 0; i < 7; ++i) CHECK(fourteen.slabs[i] == all.slabs[i]);
        for (std::size_t i = 3; i < 9; ++i) CHECK(eighteen.slabs[i] == all.slabs[i + 4]);
        if (!(surface(box) < double{infinity})) continue;
        CHECK(surface(all) <= surface(fourteen) * (1 + 1e-12));
        CHECK(surface(all) <= surface(eighteen) * (1 + 1e-12));
        CHECK(surface(fourteen) <= surface(box) * (1 + 1e-12));
        CHECK(surface(eighteen) <= surface(box) * (1 + 1e-12));
    }
}

// ---- unions -----------------------------------------------------------------------------------

namespace {

template <int D>
bool exactly_contains(const BoundingSphere<D>& outer, const BoundingSphere<D>& inner) {
    if (outer.radius == infinity) return true;
    const ExactVector<D> way = exact(inner.centre) - exact(outer.centre);
    const mpq_class spare = mpq_class(outer.radius) - mpq_class(inner.radius);
    return spare >= 0 && dot(way, way) <= spare * spare;
}
bool exactly_contains(const Aabb& outer, const Aabb& inner) {
    return outer.contains(inner);
}
template <int K, int D>
bool exactly_contains(const KDop<K, D>& outer, const KDop<K, D>& inner) {
    for (std::size_t i = 0; i < outer.slabs.size(); ++i)
        if (outer.slabs[i].low > inner.slabs[i].low || outer.slabs[i].high < inner.slabs[i].high)
            return false;
    return true;
}
/// The corners by Cramer's rule.
bool exactly_contains(const OrientedBounds<3>& outer, const OrientedBounds<3>& inner) {
    const ExactVector<3> a = exact(inner.axes[0]), b = exact(inner.axes[1]),
                         c = exact(inner.axes[2]);
    const ExactVector<3> bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const mpq_class volume = dot(a, bc);
    for (unsigned k = 0; k < 8; ++k) {
        const auto along = [&](unsigned i) -> mpq_class {
            const Slab& slab = inner.slabs[i];
            return mpq_class(k >> i & 1 ? slab.high : slab.low) / volume;
        };
        ExactVector<3> corner;
        for (int axis = 0; axis < 3; ++axis)
            corner[axis] = along(0) * bc[axis] + along(1) * ca[axis] + along(2) * ab[axis];
        if (!exactly_contains<3>(exact_slabs(outer), corner)) return false;
    }
    return true;
}

/// Random pairs of sets, some of them inside the other.
template <class Make>
void check_unions(const char* kind, const Make& make) {
    const auto sets = point_sets<3>(sized(20u, 3u), 20);
    Pcg32 random(72);
    for (std::size_t i = 0; i + 1 < sets.size(); ++i) {
        std::vector<Point3> second = sets[i + 1].points;
        if (random.below(3) == 0) second = {sets[i].points.begin(), sets[i].points.begin() + 1};
        if (largest_coordinate<3>(sets[i].points) > largest_proved) continue;
        if (largest_coordinate<3>(second) > largest_proved) continue;
        const auto a = make(sets[i].points), b = make(second);
        const auto both = merged(a, b);
        CAPTURE(kind, sets[i].name, sets[i + 1].name, i);
        REQUIRE(exactly_contains(both, a));
        REQUIRE(exactly_contains(both, b));
        const decltype(a) none{};
        REQUIRE((merged(a, none) == a && merged(none, a) == a && merged(none, none) == none));
    }
}

}  // namespace

TEST_CASE("a union contains both, exactly, and with an empty one it is the other") {
    check_unions("box_around", [](std::span<const Point3> p) { return box_around<3>(p); });
    check_unions("ritter_sphere", [](std::span<const Point3> p) { return ritter_sphere<3>(p); });
    check_unions("smallest_sphere",
                 [](std::span<const Point3> p) { return smallest_sphere<3>(p); });
    check_unions("principal_box", [](std::span<const Point3> p) { return principal_box<3>(p); });
    check_unions("tight_box", [](std::span<const Point3> p) { return tight_box<3>(p); });
    check_unions("k_dop_around", [](std::span<const Point3> p) { return k_dop_around<14, 3>(p); });
    check_unions("k_dop_around", [](std::span<const Point3> p) { return k_dop_around<26, 3>(p); });
}

TEST_CASE("unions of spheres: of two apart by both far ends, of one in the other the larger") {
    const BoundingSphere<3> left{{-3, 0, 0}, 1}, right{{5, 0, 0}, 3}, inner{{5, 1, 0}, 1.5f};
    const BoundingSphere<3> both = merged(left, right);
    CHECK(both.centre == Point3(2, 0, 0));
    CHECK(both.radius == std::nextafter(6.0f, 7.0f));
    CHECK(merged(right, inner) == right);
    CHECK(merged(inner, right) == right);
    CHECK(merged(left, left) == left);
}

TEST_CASE("the union of two k-DOPs is the k-DOP of all points") {
    Pcg32 random(73);
    std::vector<Point3> all;
    for (int i = 0; i < 60; ++i) all.push_back(random_point(random, -1.0f, 1.0f));
    const std::span<const Point3> points(all);
    CHECK(merged(k_dop_around<26, 3>(points.first(20)), k_dop_around<26, 3>(points.subspan(20))) ==
          k_dop_around<26, 3>(points));
    CHECK(merged(box_around<3>(points.first(20)), box_around<3>(points.subspan(20))) ==
          box_around<3>(points));
}

// ---- degenerate input -------------------------------------------------------------------------

TEST_CASE("around nothing every volume is empty, has no size, and is met by no ray") {
    const std::vector<Point3> nothing;
    const Ray ray{{0, 0, 0}, {1, 0, 0}, -infinity, infinity};
    for_each_volume<3>(nothing, [&](const auto& volume) {
        CHECK(volume.is_empty());
        CHECK(surface(volume) == 0.0);
        CHECK(content(volume) == 0.0);
        CHECK_FALSE(meets(prepared_for(ray, volume), volume));
    });
}

TEST_CASE("around one point, once or many times, volumes are that point") {
    for (const std::size_t count : {1u, 2u, 1'000u}) {
        const std::vector<Point3> points(count, Point3(3, -4, 12));
        CHECK(smallest_sphere<3>(points) == BoundingSphere<3>{{3, -4, 12}, 0.0f});
        CHECK(ritter_sphere<3>(points) == BoundingSphere<3>{{3, -4, 12}, 0.0f});
        for_each_volume<3>(points, [&](const auto& volume) {
            CHECK(surface(volume) <= 1e-11);  // oriented boxes: planes a float apart
            CHECK(content(volume) <= 1e-17);
        });
    }
}

TEST_CASE("around a flat or long part no volume but the sphere has content, and all are finite") {
    std::vector<Point3> flat, line;
    for (int i = 0; i < 50; ++i) {
        flat.push_back({float(i % 7), float(i / 7), 2.0f});
        line.push_back({float(i), 2.0f * float(i), -float(i)});
    }
    for (const auto& points : {flat, line}) {
        for_each_volume<3>(points, [&](const auto& volume) {
            CHECK(std::isfinite(surface(volume)));
            CHECK(std::isfinite(content(volume)));
        });
        CHECK(content(tight_box<3>(points)) < 1e-3);
        CHECK(content(principal_box<3>(points)) < 1e-3);
    }
    CHECK(content(box_around<3>(flat)) == 0.0);
    CHECK(surface(box_around<3>(flat)) == 2.0 * 6.0 * 7.0);
    CHECK(surface(k_dop_around<26, 3>(flat)) <= 2.0 * 6.0 * 7.0);
    CHECK(content(k_dop_around<26, 3>(flat)) == 0.0);
    CHECK(surface(tight_box<3>(line)) < 1e-2);
    const Double3 half(0.5 * Double3(line.back()));
    CHECK(smallest_sphere<3>(line).radius == Approx(glm::length(half)).epsilon(0x1p-22));
}

TEST_CASE("with coordinates of 10^30 surfaces and contents are numbers, and right") {
    std::vector<Point3> points = cube();
    for (Point3& p : points) p *= 0x1p100f;
    const double scale = 0x1p200;
    CHECK(surface(box_around<3>(points)) == 24.0 * scale);
    CHECK(surface(k_dop_around<26, 3>(points)) == close(24.0 * scale));
    CHECK(content(k_dop_around<26, 3>(points)) == close(8.0 * scale * 0x1p100));
    CHECK(surface(tight_box<3>(points)) == turned(24.0 * scale));
    CHECK(surface(smallest_sphere<3>(points)) == Approx(12.0 * std::numbers::pi * scale));
}

TEST_CASE("polygons with a corner that is not finite are left out") {
    const std::vector<Triangle> triangles{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                          {{0, 0, 0}, {infinity, 0, 0}, {0, 1, 0}},
                                          {{0, 0, std::nanf("")}, {1, 0, 0}, {0, 1, 0}}};
    CHECK(corners_of<3>(triangles) == std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

}  // namespace space
