// Rays against volumes: none is missed that meets one in rational numbers.
#include "chapters/ch07_bounding_volume_hierarchies/tight_box.hpp"
#include "tests/catch.hpp"
#include "tests/ch07/exact_volumes.hpp"
#include "tests/ch07/volume_points.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace space {
namespace {

/// From anywhere to a point of the set, most often one at its boundary; of any length, with zeros
/// of either sign, and intervals that end at the point or beside it.
template <int D>
BasicRay<D> hostile_ray(Pcg32& random, const PointSet<D>& set, const NumberKind& kind) {
    const std::span<const Point<D>> points(set.points);
    const Vector<D> outwards = random_point<D>(random, {Point<D>(-1), Point<D>(1)});
    Point<D> aim = points[0];
    for (const Point<D>& p : points)
        if (glm::dot(Double<D>(outwards), Double<D>(p) - Double<D>(aim)) > 0.0) aim = p;
    BasicRay<D> ray{.origin = drawn_point<D>(random, kind), .direction = Vector<D>(0.0f)};
    if (random.below(8) == 0) ray.origin = points[random.below(std::uint32_t(points.size()))];
    const int exponent = random.below(3) ? 0 : -40;
    const double length = std::ldexp(0.5 + random.uniform_double(), exponent);
    for (int axis = 0; axis < D; ++axis) {
        const double way = length * (double{aim[axis]} - ray.origin[axis]);
        ray.direction[axis] = float(std::clamp(way, -3e38, 3e38));
        if (random.below(10) == 0) ray.direction[axis] = random.below(2) ? 0.0f : -0.0f;
        if (random.below(10) == 0) ray.origin[axis] = aim[axis];
    }
    if (random.below(3) == 0) {
        const auto t = float(1.0 / length);
        const float ends[] = {0.0f,     -0.0f,     t,       std::nextafter(t, 0.0f), -t, 2.0f,
                              0.5f * t, -infinity, infinity};
        ray.tmin = ends[random.below(9)];
        ray.tmax = ends[random.below(9)];
        if (ray.tmin > ray.tmax) std::swap(ray.tmin, ray.tmax);
    }
    return ray;
}

template <int D>
bool can_hit(const BasicRay<D>& ray) {
    return is_valid(ray) && ray.tmin != infinity && ray.tmax != -infinity;
}

struct Decisions {
    std::size_t hits = 0, missed = 0, falsely = 0;
    template <class Volume, int D>
    void decide(const BasicRay<D>& ray, const Volume& volume) {
        const bool expected = exactly_meets(ray, volume);
        const bool got = meets(prepared_for(ray, volume), volume);
        hits += expected;
        missed += expected && !got;
        falsely += got && !expected;
    }
};

/// Over all sets, rays with numbers of the set's kind and ordinary ones. Coordinates go up to
/// `largest`.
template <int D, class Make>
Decisions decisions(const Make& make, double largest) {
    Decisions result;
    Pcg32 random(75);
    for (const PointSet<D>& set : point_sets<D>(sized(12u, 2u), 30)) {
        if (largest_coordinate<D>(set.points) > largest) continue;
        const auto volume = make(std::span<const Point<D>>(set.points));
        const auto same = std::ranges::find(number_kinds, set.name, &NumberKind::name);
        for (int i = 0; i < 100; ++i) {
            const bool ordinary = same == number_kinds.end() || i % 4 == 0;
            const BasicRay<D> ray = hostile_ray(random, set, ordinary ? number_kinds[0] : *same);
            const std::vector<Point<D>> origin{ray.origin};
            if (!can_hit(ray) || largest_coordinate<D>(origin) > largest) continue;
            result.decide(ray, volume);
        }
    }
    return result;
}

template <int D, class Make>
void check_decisions(const char* name, const Make& make, double largest = double{infinity}) {
    const Decisions found = decisions<D>(make, largest);
    std::printf("%s in %d dimensions: %zu hits, %zu false ones\n", name, D, found.hits,
                found.falsely);
    CAPTURE(name, D);
    CHECK(found.hits > sized(2'000u, 400u));
    CHECK(found.missed == 0);
    // Rays that pass by within a few roundings: of those aimed at corners, less than half.
    CHECK(found.falsely < found.hits);
}

}  // namespace

TEST_CASE("no volume misses a ray that meets it, over hostile points and rays") {
    check_decisions<3>(
        "box", [](std::span<const Point3> p) { return box_around<3>(p); }, largest_proved);
    check_decisions<3>("sphere", [](std::span<const Point3> p) { return smallest_sphere<3>(p); });
    check_decisions<3>("oriented box", [](std::span<const Point3> p) { return tight_box<3>(p); });
    check_decisions<3>("14-DOP", [](std::span<const Point3> p) { return k_dop_around<14, 3>(p); });
    check_decisions<3>("26-DOP", [](std::span<const Point3> p) { return k_dop_around<26, 3>(p); });
    check_decisions<2>("circle", [](std::span<const Point2> p) { return smallest_sphere<2>(p); });
    check_decisions<2>("rectangle", [](std::span<const Point2> p) { return tight_box<2>(p); });
    check_decisions<2>("octagon", [](std::span<const Point2> p) { return k_dop_around<8, 2>(p); });
}

TEST_CASE("exact tangents of spheres are hits, and those a float farther out are none") {
    // At p on a sphere about the origin the tangents are the rays along its products with others.
    const std::vector<Point3> points = points_on_sphere<3>();
    Pcg32 random(76);
    int tangents = 0, beside = 0;
    for (int i = 0; i < sized(20'000, 2'000); ++i) {
        const Double3 p(points[random.below(std::uint32_t(points.size()))]);
        const Double3 along =
            glm::cross(p, Double3(points[random.below(std::uint32_t(points.size()))]));
        if (along == Double3(0.0)) continue;
        const double back = random.below(4'000), scale = std::ldexp(1.0, int(random.below(9)));
        const Double3 shift{random.below(1'000), random.below(1'000), random.below(1'000)};
        const Ray ray{.origin = Point3(p - back * along + shift),
                      .direction = Vector3(scale * along)};
        const BoundingSphere<3> sphere{Point3(shift), 9.0f};
        REQUIRE(square_of_distance(ray, sphere.centre) == 81);
        REQUIRE(meets(prepared_for(ray, sphere), sphere));
        ++tangents;
        const BoundingSphere<3> smaller{Point3(shift), std::nextafter(9.0f, 0.0f)};
        beside += meets(prepared_for(ray, smaller), smaller);
    }
    CHECK(tangents > sized(10'000, 1'000));
    CHECK(beside == 0);
}

TEST_CASE("how far the computed nearest point of a ray is off: within the bound") {
    // The test's own formula, with the square of the distance in rational numbers beside it.
    Pcg32 random(77);
    double largest = 0.0;
    for (int i = 0; i < sized(100'000, 3'000); ++i) {
        const Point3 centre = random_point(random, -1.0f, 1.0f);
        const Vector3 away = 100.0f * random_vector(random);
        const Ray ray{.origin = centre + away, .direction = random_vector(random) - away};
        if (!can_hit(ray)) continue;
        const SphereRay<3> way(ray);
        const Double3 f = way.origin - Double3(centre);
        const double t =
            std::clamp(-glm::dot(f, way.direction) * way.inverse_square, way.tmin, way.tmax);
        const Double3 nearest = f + t * way.direction;
        const double square = glm::dot(nearest, nearest);
        const mpq_class off = mpq_class(square) - square_of_distance(ray, centre);
        const double error = off.get_d() / (2.0 * std::sqrt(square));
        const double size = std::abs(f.x) + std::abs(f.y) + std::abs(f.z) + std::sqrt(square);
        largest = std::max(largest, error / (16.0 * 0x1p-53 * size));
    }
    std::printf("largest error / bound: %.3f\n", largest);
    CHECK(largest > 0.01);  // the bound is not for nothing
    CHECK(largest < 1.0);
}

namespace {

/// Whole numbers: rays through corners, along edges and in planes of sides, exactly. Axes of the
/// oriented boxes are 3-4-5 triangles', not of length 1: slabs all the same.
struct WholeVolumes {
    Aabb box;
    OrientedBounds<3> oriented;
    KDop<26> dop;
    std::vector<Point3> points;
};
WholeVolumes whole_volumes(Pcg32& random) {
    WholeVolumes volumes;
    const auto whole = [&] { return float(random.below(4'001)) - 2'000.0f; };
    for (int i = 0; i < 4; ++i) {
        Point3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = whole();
        volumes.points.push_back(p);
        volumes.box.extend(p);
        volumes.dop.extend(p);
    }
    volumes.oriented.axes = {{{3, 4, 0}, {-4, 3, 0}, {0, 0, 5}}};
    for (std::size_t i = 0; i < 3; ++i)
        for (const Point3& p : volumes.points)
            volumes.oriented.slabs[i].extend(dot_range<3>(volumes.oriented.axes[i], p));
    return volumes;
}

}  // namespace

TEST_CASE("rays of whole numbers through corners, along edges and in sides are all hits") {
    Pcg32 random(78);
    Decisions box, oriented, dop;
    for (int i = 0; i < sized(30'000, 2'000); ++i) {
        const WholeVolumes volumes = whole_volumes(random);
        const Point3 aim = volumes.points[random.below(4)];
        Ray ray{.origin = Point3(0.0f), .direction = Vector3(0.0f)};
        const float at_aim = float(1 + random.below(8));
        for (int axis = 0; axis < 3; ++axis) {
            ray.direction[axis] = float(random.below(2'001)) - 1'000.0f;
            ray.origin[axis] = aim[axis] - at_aim * ray.direction[axis];
        }
        const std::uint32_t ends = random.below(4);
        if (ends == 0) ray.tmin = -1.0f;
        if (ends == 1) ray.tmax = at_aim;
        if (ends == 2) ray.tmin = at_aim;
        if (!can_hit(ray)) continue;
        box.decide(ray, volumes.box);
        oriented.decide(ray, volumes.oriented);
        dop.decide(ray, volumes.dop);
    }
    for (const Decisions& found : {box, oriented, dop}) {
        CHECK(found.hits > sized(20'000u, 1'000u));
        CHECK(found.missed == 0);
    }
}

TEST_CASE("a dot product's range holds the exact one, is tight, and a point where nothing rounds") {
    Pcg32 random(79);
    const auto number = [&] {
        const int exponent = int(random.below(60)) - 30;
        return std::ldexp(random.uniform(-1.0f, 1.0f), exponent);
    };
    int points = 0;
    for (int i = 0; i < sized(100'000, 5'000); ++i) {
        Vector3 n, p;
        for (int axis = 0; axis < 3; ++axis) n[axis] = number();
        for (int axis = 0; axis < 3; ++axis) p[axis] = number();
        if (random.below(4) == 0) n = {1, -1, 0};
        if (random.below(8) == 0) n.y = -n.x * p.x / p.y;  // cancels
        if (!is_finite<3>(n)) continue;
        const DotRange range = dot_range<3>(n, p);
        const mpq_class product = dot(exact(n), exact(p));
        REQUIRE(mpq_class(range.low) <= product);
        REQUIRE(mpq_class(range.high) >= product);
        const double size = glm::dot(glm::abs(Double3(n)), glm::abs(Double3(p)));
        REQUIRE(range.high - range.low <= 10 * 0x1p-53 * size);
        points += range.low == range.high;
    }
    CHECK(points > 0);
    const DotRange plain = dot_range<3>({1, 0, 0}, {0.1f, 1e30f, 1e-30f});
    CHECK((plain.low == double{0.1f} && plain.high == double{0.1f}));
}

TEST_CASE("random lines meet volumes in proportion to their surfaces") {
    const std::vector<Point3> points{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0},         {0, -1, 0},
                                     {0, 0, 1}, {0, 0, -1}, {0.5f, 0.5f, 0.5f}};
    Pcg32 random(80);
    constexpr double radius = 2.0;  // of a ball that holds them all
    constexpr int lines = sized(40'000, 4'000);
    const auto box = box_around<3>(points);
    const auto sphere = smallest_sphere<3>(points);
    const auto dop = k_dop_around<18, 3>(points);
    const auto oriented = tight_box<3>(points);
    std::array<int, 4> met{};
    for (int i = 0; i < lines;) {
        const Frame<3> frame = frame_about(random_direction(random));
        const Double2 at(random_point<2>(random, {Point2(-1.0f), Point2(1.0f)}));
        if (glm::dot(at, at) > 1.0) continue;
        const Ray ray{.origin = Point3(radius * (at.x * frame[0] + at.y * frame[1])),
                      .direction = Vector3(frame[2]),
                      .tmin = -infinity};
        ++i;
        met[0] += meets(prepared_for(ray, box), box);
        met[1] += meets(prepared_for(ray, sphere), sphere);
        met[2] += meets(prepared_for(ray, dop), dop);
        met[3] += meets(prepared_for(ray, oriented), oriented);
    }
    const double all = surface(BoundingSphere<3>{.radius = float(radius)});
    const double wanted[] = {surface(box), surface(sphere), surface(dop), surface(oriented)};
    for (std::size_t i = 0; i < 4; ++i) {
        const double p = wanted[i] / all;
        CAPTURE(i, p, met[i]);
        CHECK(std::abs(met[i] - lines * p) < 4.0 * std::sqrt(lines * p * (1.0 - p)));  // 4 sigma
    }
}

TEST_CASE("a slab whose planes may be met anywhere, as far as doubles tell, clips nothing") {
    // n . d = 1, of which rounded sums keep nothing: 2^60 + 1 - 2^60. At t = 10 alone the ray is in
    // this slab, at its upper plane, and in that along x, at its lower one.
    for (const float sign : {1.0f, -1.0f}) {
        const OrientedBounds<3> box{.axes = {{{1, 1, 1}, {1, 0, 0}, {0, 1, 0}}},
                                    .slabs = {{{sign > 0 ? 0.0f : -10.0f, sign > 0 ? 10.0f : 0.0f},
                                               {10 * 0x1p60f, 0x1p70f},
                                               {-100, 100}}}};
        const Ray ray{.origin = Point3(0.0f), .direction = {0x1p60f, sign, -0x1p60f}};
        const DotRange speed = dot_range<3>(box.axes[0], ray.direction);
        CHECK((speed.low < 0.0 && speed.high > 0.0));
        CHECK(exactly_meets(ray, box));
        CHECK(meets(prepared_for(ray, box), box));
    }
}

TEST_CASE("a slab that the ray is parallel to is missed from outside and met from its plane") {
    const OrientedBounds<3> box{.axes = OrientedBounds<3>::axes_of(Frame<3>(1.0)),
                                .slabs = {{{0, 2}, {0, 2}, {0, 2}}}};
    for (const float zero : {0.0f, -0.0f})
        for (const float y : {-0.5f, 0.0f, 1.0f, 2.0f, 2.5f}) {
            const Ray ray{{-1, y, 2}, {1, zero, zero}};
            CHECK(meets(prepared_for(ray, box), box) == (y >= 0.0f && y <= 2.0f));
            const Ray away{{-1, y, 2}, {-1, zero, zero}};
            CHECK_FALSE(meets(prepared_for(away, box), box));
            const Ray line{{-1, y, 2}, {-1, zero, zero}, -infinity, infinity};
            CHECK(meets(prepared_for(line, box), box) == (y >= 0.0f && y <= 2.0f));
        }
}

}  // namespace space
