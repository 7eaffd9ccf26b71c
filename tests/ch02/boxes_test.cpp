// Ray-box tests against rational numbers (GMP).
#include "chapters/ch02_intersection_tests/boxes.hpp"

#include "chapters/ch02_intersection_tests/measured/exact_deciders.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "chapters/ch02_intersection_tests/oriented_box.hpp"
#include "tests/catch.hpp"
#include "tests/exact_vector.hpp"

#include <glm/gtc/quaternion.hpp>

#include <bit>
#include <cstdio>
#include <functional>

namespace space::ch02 {
namespace {

constexpr int pairs_each = sized(20'000, 1'000);

/// The ray's part in the closed box: an end is absent where nothing bounds it.
struct RationalInterval {
    std::optional<mpq_class> enter, leave;
};
/// By definition: every axis bounds t on both sides, where low <= o + t d <= high.
std::optional<RationalInterval> rational_interval(const Ray& ray, const Aabb& box) {
    RationalInterval part;
    const auto at_least = [&](const mpq_class& t) {
        if (!part.enter || *part.enter < t) part.enter = t;
    };
    const auto at_most = [&](const mpq_class& t) {
        if (!part.leave || t < *part.leave) part.leave = t;
    };
    if (std::isfinite(ray.tmin)) at_least(mpq_class(ray.tmin));
    if (std::isfinite(ray.tmax)) at_most(mpq_class(ray.tmax));
    const ExactVector<3> o = exact(ray.origin), lows = exact(box.min) - o,
                         highs = exact(box.max) - o, direction = exact(ray.direction);
    for (int axis = 0; axis < 3; ++axis) {
        const mpq_class &low = lows[axis], &high = highs[axis], &d = direction[axis];
        if (low > high) return std::nullopt;
        if (d == 0) {
            if (low > 0 || high < 0) return std::nullopt;
        } else if (d > 0) {
            at_least(low / d);
            at_most(high / d);
        } else {
            at_least(high / d);
            at_most(low / d);
        }
    }
    if (part.enter && part.leave && *part.leave < *part.enter) return std::nullopt;
    return part;
}

/// Whole numbers, by 64-bit integers: o + t d within [0, 2] for some t >= 0, t = n / d for d in
/// {-1, 1}.
bool lattice_hit(const Ray& ray) {
    int enter = 0, leave = 1 << 20;
    for (int axis = 0; axis < 3; ++axis) {
        const int o = static_cast<int>(ray.origin[axis]), d = static_cast<int>(ray.direction[axis]);
        if (d == 0 && (o < 0 || o > 2)) return false;
        if (d != 0) {
            enter = std::max(enter, d > 0 ? -o : o - 2);
            leave = std::min(leave, d > 0 ? 2 - o : o);
        }
    }
    return enter <= leave;
}

float any_float(Pcg32& random, int lowest, int highest) {
    const int exponent =
        lowest + static_cast<int>(random.below(static_cast<std::uint32_t>(highest - lowest + 1)));
    const float size = std::ldexp(1.0f + random.uniform(), exponent);
    return random.below(2) ? size : -size;
}

/// Rays at a box's corner, edge, face or inside, with coordinates of size 2^lowest to 2^highest,
/// then made worse: flat and empty boxes, zeros of either sign, denormal or huge directions,
/// intervals that end at or beside the box.
RayAndBox hostile_pair(Pcg32& random, int lowest, int highest) {
    RayAndBox pair;
    Ray& ray = pair.ray;
    Aabb& box = pair.box;
    Point3 target;
    for (int axis = 0; axis < 3; ++axis) {
        const float p = any_float(random, lowest, highest), q = any_float(random, lowest, highest);
        box.min[axis] = std::min(p, q);
        box.max[axis] = std::max(p, q);
        if (random.below(6) == 0) box.max[axis] = box.min[axis];
        if (random.below(12) == 0) box.min[axis] = box.max[axis] = random.below(2) ? 0.0f : -0.0f;
        const std::uint32_t place = random.below(3);
        target[axis] = place == 0   ? box.min[axis]
                       : place == 1 ? box.max[axis]
                                    : std::clamp(0.5f * box.min[axis] + 0.5f * box.max[axis],
                                                 box.min[axis], box.max[axis]);
        ray.origin[axis] = random.below(4) ? any_float(random, lowest, highest) : target[axis];
    }
    // Of any length down to denormal and up to huge; the rounding of the components makes it miss
    // or hit.
    const double mantissa = 0.5 + random.uniform_double();
    const int exponent = static_cast<int>(random.below(3));
    const double length = std::ldexp(mantissa, random.below(2) ? exponent : -60 * exponent);
    for (int axis = 0; axis < 3; ++axis) {
        const double d = length * (double{target[axis]} - ray.origin[axis]);
        ray.direction[axis] = static_cast<float>(std::clamp(d, -0x1.fp127, 0x1.fp127));
        if (ray.direction[axis] == 0.0f || random.below(12) == 0)
            ray.direction[axis] = random.below(2) ? 0.0f : -0.0f;
        if (random.below(40) == 0)
            ray.direction[axis] = std::bit_cast<float>(random.below(1u << 23));  // denormal
    }
    if (random.below(3) == 0) {
        const float t = static_cast<float>(1.0 / length),
                    ends[] = {0.0f,
                              -0.0f,
                              t,
                              std::nextafter(t, 0.0f),
                              std::nextafter(t, infinity),
                              -t,
                              0.5f * t,
                              2.0f * t,
                              -infinity,
                              infinity,
                              std::numeric_limits<float>::max()};
        ray.tmin = ends[random.below(11)];
        ray.tmax = ends[random.below(11)];
        if (ray.tmin > ray.tmax) std::swap(ray.tmin, ray.tmax);
    }
    if (random.below(100) == 0) box = Aabb::empty();
    return pair;
}

struct Size {
    const char* name;
    int lowest, highest;
};
constexpr Size sizes[] = {{"about 1", -2, 0},      {"from 10^-6 to 10^6", -20, 20},
                          {"whatever", -126, 124}, {"tiny", -126, -100},
                          {"huge", 100, 124},      {"about 1, far away", 10, 12}};

/// Of all hostile pairs and the chapter's own.
void for_hostile_pairs(int each, const std::function<void(const RayAndBox&)>& look) {
    for (const Size& size : sizes) {
        Pcg32 random(301, static_cast<std::uint64_t>(size.lowest + 200));
        for (int i = 0; i < each; ++i) look(hostile_pair(random, size.lowest, size.highest));
    }
    Pcg32 random(302);
    for (int i = 0; i < each; ++i) look(make_box_pair(random));
}

bool valid(const Ray& ray) {
    return is_valid(ray) && ray.tmin != infinity && ray.tmax != -infinity;
}

struct Misses {
    int exact_hits = 0, false_misses = 0, false_hits = 0, too_late = 0, too_early = 0;
};
/// Counts what SlabConservative loses: boxes, and parts of the interval.
Misses conservative_misses(int each) {
    Misses count;
    for_hostile_pairs(each, [&](const RayAndBox& pair) {
        if (!valid(pair.ray)) return;
        const auto exact =
            pair.box.is_empty() ? std::nullopt : rational_interval(pair.ray, pair.box);
        const auto found = SlabConservative::intersect(pair.ray, pair.box);
        count.exact_hits += exact.has_value();
        count.false_misses += exact && !found;
        count.false_hits += !exact && found;
        if (!exact || !found) return;
        if (std::isnan(found->enter) || std::isnan(found->leave)) ++count.too_late;
        if (std::isfinite(found->enter))
            count.too_late += exact->enter && mpq_class(found->enter) > *exact->enter;
        if (std::isfinite(found->leave))
            count.too_early += !exact->leave || mpq_class(found->leave) < *exact->leave;
        if (found->enter == infinity)
            count.too_late += exact->enter && *exact->enter < mpq_class(0x1p127) * 2;
        if (found->leave == -infinity) ++count.too_early;
    });
    return count;
}

}  // namespace

TEST_CASE(
    "on the 7000 lattice rays the safe tests decide exactly, and the plain ones decide wrongly "
    "only in the plane of "
    "a face") {
    struct Count {
        int misses = 0, hits = 0, elsewhere = 0;
        void add(bool got, bool expected, bool in_face = false) {
            misses += expected && !got;
            hits += got && !expected;
            elsewhere += got != expected && !in_face;
        }
    };
    Count branching, min_max, reciprocal, safe, conservative, expansions, rationals;
    int rays = 0, hits = 0;
    // Eight directions have no length: 7500 and 500 of 8000 are left, as zeros have two signs.
    for (const auto& [ray, box] : lattice_boxes()) {
        const bool expected = lattice_hit(ray);
        ++rays;
        hits += expected;
        bool in_face = false;
        for (int axis = 0; axis < 3; ++axis)
            in_face = in_face || (ray.direction[axis] == 0.0f &&
                                  (ray.origin[axis] == 0.0f || ray.origin[axis] == 2.0f));
        branching.add(SlabBranching::intersect(ray, box).has_value(), expected);
        min_max.add(SlabMinMax::intersect(ray, box).has_value(), expected, in_face);
        reciprocal.add(SlabReciprocal::intersect(ray, box).has_value(), expected, in_face);
        safe.add(SlabSafe::intersect(ray, box).has_value(), expected);
        conservative.add(SlabConservative::intersect(ray, box).has_value(), expected);
        expansions.add(exactly_hits(ray, box), expected);
        rationals.add(rational_interval(ray, box).has_value(), expected);
    }
    CHECK(rays == 7000);
    CHECK(hits == 2240);
    for (const Count& right : {branching, safe, conservative, expansions, rationals}) {
        CHECK(right.misses == 0);
        CHECK(right.hits == 0);
    }
    for (const Count& wrong : {min_max, reciprocal}) {
        CHECK(wrong.misses == 992);
        CHECK(wrong.hits == 344);
        CHECK(wrong.elsewhere == 0);
    }
}

TEST_CASE("the exact decision by expansions is that by rational numbers") {
    int pairs = 0, hits = 0, different = 0;
    for_hostile_pairs(pairs_each, [&](const RayAndBox& pair) {
        const bool expected =
            valid(pair.ray) && !pair.box.is_empty() && rational_interval(pair.ray, pair.box);
        ++pairs;
        hits += expected;
        different += exactly_hits(pair.ray, pair.box) != expected;
    });
    CHECK(pairs == 7 * pairs_each);
    CHECK(hits > pairs / 10);
    CHECK(hits < pairs);
    CHECK(different == 0);
}

TEST_CASE(
    "the conservative test misses no box, and no part of the ray in it, over hostile rays and "
    "boxes") {
    const Misses count = conservative_misses(pairs_each);
    CHECK(count.exact_hits > pairs_each / 2);
    CHECK(count.false_misses == 0);
    CHECK(count.too_late == 0);
    CHECK(count.too_early == 0);
    // Its price: nearly all rays aim at a corner or an edge here, and half of them pass it.
    CHECK(count.false_hits > 0);
    CHECK(count.false_hits < count.exact_hits);
}

TEST_CASE("the conservative test misses no box: the full sizes", "[.big]") {
    const Misses count = conservative_misses(1'500'000);
    CHECK(count.false_misses == 0);
    CHECK(count.too_late == 0);
    CHECK(count.too_early == 0);
}

TEST_CASE("rounding makes the safe test miss a corner that the conservative one hits") {
    const Aabb box{{0.2f, 0.5f, 0.8f}, {0.7f, 0.8f, 1.0f}};
    const Ray ray{{-9, -3, 3}, {9.69999981f, 3.79999995f, -2}};
    REQUIRE(exactly_hits(ray, box));
    CHECK_FALSE(SlabReciprocal::intersect(ray, box));
    CHECK_FALSE(SlabSafe::intersect(ray, box));
    CHECK(SlabConservative::intersect(ray, box));
}

/// The ends of the slab from `low` to `high` across the x axis for the ray from x = o in the
/// direction d, by the conservative test.
Interval slab_ends(float o, float d, float low, float high) {
    const auto found =
        SlabConservative::intersect({{o, 0, 0}, {d, 0, 0}}, {{low, -1, -1}, {high, 1, 1}});
    REQUIRE(found);
    return *found;
}
/// (t - exact t) / exact t of a plane in units of 2^-24: exact but for a rounding of double.
double relative_error(float t, float o, float d, float plane) {
    const double way = double{plane} - o;
    return (double{t} * d - way) / way * 0x1p24;
}

TEST_CASE(
    "ends in float are never on the wrong side of the exact ones, and the worst are near to them") {
    // Hill climbing for the largest near end and the smallest far end.
    double near = -10.0, far = 10.0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Pcg32 random(307, seed);
        const auto number = [&] { return std::ldexp(1.0f + random.uniform(), -1); };
        for (const bool at_near : {true, false}) {
            float best[3] = {-number(), number(), number()};
            double most = at_near ? -10.0 : 10.0;
            for (int step = 0; step < 2'500; ++step) {
                float next[3] = {best[0], best[1], best[2]};
                float& x = next[random.below(3)];
                const float size = random.uniform(-1.0f, 1.0f);
                const int finer = static_cast<int>(random.below(24));
                const float nudged = x * (1.0f + std::ldexp(size, -finer));
                x = random.below(8) ? nudged : x < 0.0f ? -number() : number();
                const Interval ends = at_near ? slab_ends(next[0], next[1], next[2], infinity)
                                              : slab_ends(next[0], next[1], -infinity, next[2]);
                const double found =
                    relative_error(at_near ? ends.enter : ends.leave, next[0], next[1], next[2]);
                if (at_near ? found < most : found > most) continue;
                most = found;
                std::copy(next, next + 3, best);
            }
            near = at_near ? std::max(near, most) : near;
            far = at_near ? far : std::min(far, most);
        }
    }
    std::printf("near ends off by %.3f roundings at most, far ends by %.3f at least\n", near, far);
    CHECK(near <= 0.0);
    CHECK(near > -0.75);  // of four roundings
    CHECK(far >= 0.0);
    CHECK(far < 2.5);  // two more than the four
}

TEST_CASE("near planes shortened by three roundings would be met too late, by this ray") {
    // The difference is just above half-way between two floats, the product just above 2, and all
    // four roundings go up; found among all 2^23 mantissas of d.
    constexpr float o = 0x1p-24f, d = 0x1.33558ep-1f, plane = 0x1.3357bp+0f;
    CHECK(relative_error((plane - o) * ((1.0f / d) * (1.0f - 3.0f * 0x1p-24f)), o, d, plane) > 0.0);
    CHECK(relative_error(slab_ends(o, d, plane, infinity).enter, o, d, plane) <= 0.0);
}

TEST_CASE("ends of t among the denormal floats are within two of the exact ones, outside") {
    Pcg32 random(308);
    for (int i = 0; i < pairs_each; ++i) {
        const float mantissa = 1.0f + random.uniform();
        const float d = std::ldexp(mantissa, 100 + static_cast<int>(random.below(25))),
                    plane = std::ldexp(1.0f + random.uniform(), -40);
        // Where the product is denormal t d is a double, exactly.
        const double way = plane;
        const Interval near = slab_ends(0.0f, d, plane, infinity),
                       far = slab_ends(0.0f, d, -infinity, plane),
                       flat = slab_ends(0.0f, d, plane, plane);
        REQUIRE(double{near.enter} * d <= way);
        REQUIRE(double{far.leave} * d >= way);
        REQUIRE(flat.enter == near.enter);
        REQUIRE(flat.leave == far.leave);
        if (far.leave > 0x1p-130f) continue;  // where its relative error counts
        REQUIRE((double{near.enter} + 2 * 0x1p-149) * d >= way);
        REQUIRE((double{far.leave} - 2 * 0x1p-149) * d <= way);
    }
}

TEST_CASE("directions whose reciprocal is denormal lose no part of the ray in the box") {
    Pcg32 random(309);
    for (int i = 0; i < pairs_each; ++i) {
        const float mantissa = 1.0f + random.uniform();
        const float d = std::ldexp(mantissa, 126 + static_cast<int>(random.below(2))),
                    plane = std::ldexp(1.0f + random.uniform(), 124);
        const Interval near = slab_ends(0.0f, d, plane, infinity),
                       far = slab_ends(0.0f, d, -infinity, plane);
        REQUIRE(double{near.enter} * d <= double{plane});
        REQUIRE(double{far.leave} * d >= double{plane});
        REQUIRE(relative_error(near.enter, 0.0f, d, plane) > -10.0);
        REQUIRE(relative_error(far.leave, 0.0f, d, plane) < 10.0);
    }
}

TEST_CASE("in double, four roundings between near and far lose no corner, before or behind") {
    // Exactly, the ray is at x = 17 and at y = 1 at once, at t = (1 + 2^-53 - ...) / c. The
    // difference of x is rounded up, that of y down; c's division does the rest.
    constexpr float small = 0x1p-53f * (1.0f - 0x1p-18f);
    const Aabb box{{17, -9, -1}, {99, 1, 1}};
    Pcg32 random(310);
    double worst = 0.0;
    for (int i = 0; i < 2'000; ++i) {
        const auto c = static_cast<float>((1u << 18) + random.below(1u << 18));
        for (const float way : {1.0f, -1.0f}) {
            const Ray ray{{-17.0f * small, -small, 0}, {way * 17.0f * c, way * c, 0}, -infinity};
            REQUIRE(exactly_hits(ray, box));
            REQUIRE(SlabConservative::intersect(ray, box));
            const double x = (17.0 + 17.0 * small) / (17.0 * c), y = (1.0 + double{small}) / c;
            worst = std::max(worst, (x - y) / y * 0x1p53);
        }
    }
    std::printf("near beyond far by up to %.3f roundings of double\n", worst);
    CHECK(worst > 3.0);
    CHECK(worst < 5.0);
}

/// The safe test with its far ends times a factor, as Ize 2013 has it.
bool hits_with_factor(const Ray& ray, const Aabb& box, float factor) {
    const PreparedBoxRay prepared(ray);
    float enter = ray.tmin, leave = ray.tmax;
    for (int axis = 0; axis < 3; ++axis) {
        const bool backwards = std::signbit(prepared.inverse[axis]);
        const float near =
            ((backwards ? box.max : box.min)[axis] - ray.origin[axis]) * prepared.inverse[axis];
        const float far = ((backwards ? box.min : box.max)[axis] - ray.origin[axis]) *
                          prepared.inverse[axis] * factor;
        enter = near > enter ? near : enter;
        leave = far < leave ? far : leave;
    }
    return enter <= leave;
}

TEST_CASE(
    "1.00000024 on far ends alone is too little, by this ray; the next float but one is enough") {
    static_assert(1.00000024f == 1.0f + 4.0f * 0x1p-24f);
    const Ray ray{{-0x1.028f5cp-24f, -0x1.fae148p-25f, 0}, {0x1.aa9708p-1f, 0x1.aaa26cp-1f, 0}};
    const Aabb box{{0x1.0000c2p+0f, -9, -1}, {9, 0x1.000798p+0f, 1}};
    REQUIRE(exactly_hits(ray, box));
    CHECK_FALSE(hits_with_factor(ray, box, 1.0f + 4.0f * 0x1p-24f));
    CHECK(hits_with_factor(ray, box, 1.0f + 6.0f * 0x1p-24f));
    CHECK(SlabConservative::intersect(ray, box));
    // Corners like that one: y = 1 with x = 1 or a little before it.
    Pcg32 random(311);
    int hits = 0, missed = 0;
    for (int i = 0; i < 10 * pairs_each; ++i) {
        const auto near_one = [&] {
            return 1.0f + 0x1p-23f * static_cast<float>(random.below(1u << 12));
        };
        const float x = near_one(), y = near_one(), o = -0x1p-24f * random.uniform(0.9f, 1.1f),
                    dx = 1.0f - 0x1p-24f * static_cast<float>(random.below(1u << 13));
        const double t = (double{x} - o) / dx;
        const float p = -0x1p-24f * random.uniform(0.9f, 1.1f),
                    dy = static_cast<float>((double{y} - p) / t);
        const Ray aimed{{o, p, 0}, {dx, dy, 0}};
        const Aabb corner{{x, -9, -1}, {9, y, 1}};
        if (!exactly_hits(aimed, corner)) continue;
        ++hits;
        missed += !hits_with_factor(aimed, corner, 1.0f + 6.0f * 0x1p-24f);
    }
    CHECK(hits > pairs_each);
    CHECK(missed == 0);
}

TEST_CASE("the printed test rejects every ray from inside the box, the others none") {
    Pcg32 random(303);
    for (int i = 0; i < 1'000; ++i) {
        const Aabb box{Point3(-1.0f) + 0.5f * random_vector(random),
                       Point3(1.0f) + 0.5f * random_vector(random)};
        const Ray ray{.origin = 0.49f * random_vector(random),
                      .direction = Vector3(random_direction(random))};
        REQUIRE(box.contains(ray.origin));
        REQUIRE_FALSE(SlabAsPrinted::intersect(ray, box));
        REQUIRE(SlabBranching::intersect(ray, box));
        REQUIRE(SlabMinMax::intersect(ray, box));
        REQUIRE(SlabReciprocal::intersect(ray, box));
        REQUIRE(SlabSafe::intersect(ray, box));
        REQUIRE(SlabConservative::intersect(ray, box));
    }
    // From outside it decides as the others do.
    const Aabb box{Point3(0.0f), Point3(2.0f)};
    CHECK(SlabAsPrinted::intersect({{-1, 1, 1}, {1, 0.1f, 0.1f}}, box));
    CHECK_FALSE(SlabAsPrinted::intersect({{3, 1, 1}, {1, 0.1f, 0.1f}}, box));
}

TEST_CASE(
    "intervals are closed: a box that begins at tmax or ends at tmin is hit, one beyond is not") {
    const Aabb box{{2, -1, -1}, {4, 1, 1}};
    const auto with = [](float tmin, float tmax) { return Ray{{0, 0, 0}, {1, 0, 0}, tmin, tmax}; };
    const auto check = [&](auto test) {
        using Test = decltype(test);
        CHECK(Test::intersect(with(0, 2), box));
        CHECK(Test::intersect(with(4, 9), box));
        CHECK(Test::intersect(with(3, 3), box));
        CHECK_FALSE(Test::intersect(with(0, 1.99f), box));
        CHECK_FALSE(Test::intersect(with(4.01f, 9), box));
    };
    check(SlabBranching{});
    check(SlabMinMax{});
    check(SlabReciprocal{});
    check(SlabSafe{});
    check(SlabConservative{});
}

TEST_CASE("a ray within a flat box hits it by the safe tests") {
    const Aabb flat{{2, -1, -1}, {2, 1, 1}};
    const Ray within{{2, 0, 0}, {0, 1, 0}};
    CHECK(SlabBranching::intersect(within, flat));
    CHECK(SlabSafe::intersect(within, flat));
    CHECK(SlabConservative::intersect(within, flat));
}

TEST_CASE(
    "a turned box that is not turned, or by right angles, is the axis-aligned box, interval by "
    "interval") {
    Pcg32 random(304);
    int hits = 0;
    for (int i = 0; i < 2'000; ++i) {
        const RayAndBox pair = make_box_pair(random);
        // Whole numbers: centre and half size are exact.
        const Vector3 half(1.0f + static_cast<float>(random.below(4)), 2.0f, 3.0f);
        const Point3 centre(static_cast<float>(random.below(9)), -4.0f, 1.0f);
        const Ray ray{.origin = Point3(glm::ivec3(8.0f * pair.ray.origin)),
                      .direction = Vector3(glm::ivec3(8.0f * pair.ray.direction))};
        if (!is_valid(ray)) continue;
        // Columns: x -> y -> -z -> x.
        const glm::mat3 turn(Vector3(0, 1, 0), Vector3(0, 0, -1), Vector3(-1, 0, 0));
        const Vector3 turned(half.z, half.x, half.y);
        const auto same = [&](const OrientedBox& box, const Aabb& aligned) {
            const auto one = intersect(ray, box), other = SlabSafe::intersect(ray, aligned);
            hits += one.has_value();
            return one.has_value() == other.has_value() &&
                   (!one || (one->enter == other->enter && one->leave == other->leave));
        };
        REQUIRE(same({centre, glm::mat3(1.0f), half}, {centre - half, centre + half}));
        REQUIRE(same({centre, turn, half}, {centre - turned, centre + turned}));
        REQUIRE(bounds(OrientedBox{centre, turn, half}) == Aabb{centre - turned, centre + turned});
    }
    CHECK(hits > 100);
}

TEST_CASE(
    "a turned box is hit by rays at points clearly inside, missed by rays in a plane clearly "
    "beside a face, and the "
    "box around it holds it but for roundings") {
    Pcg32 random(305);
    constexpr float clear = 1e-4f;  // hundreds of roundings of numbers up to 10
    for (int i = 0; i < 10'000; ++i) {
        const Double3 first = random_direction(random), second = random_direction(random);
        const OrientedBox box{
            random_vector(random),
            glm::mat3(glm::mat3_cast(glm::dquat(0.0, first) * glm::dquat(0.0, second))),
            0.5f + 0.25f * random_vector(random)};
        const auto world = [&](const Vector3& local) { return box.centre + box.axes * local; };
        const Point3 inside = world((1.0f - clear) * box.half * random_vector(random));
        const Point3 origin = box.centre + 5.0f * Vector3(random_direction(random));
        const auto hit = intersect(Ray{origin, inside - origin}, box);
        REQUIRE(hit);
        REQUIRE(hit->enter < 1.0f);  // t is that of the world: the inside point is at t = 1
        REQUIRE(hit->leave > 1.0f);
        // In a plane beside a face.
        const int axis = static_cast<int>(random.below(3));
        Vector3 from = 3.0f * random_vector(random), to = 3.0f * random_vector(random);
        from[axis] = to[axis] = (1.0f + clear) * box.half[axis] + clear;
        REQUIRE_FALSE(intersect(Ray{world(from), world(to) - world(from)}, box));
        // Corners reach the box around it, to within a few roundings.
        const Aabb around = bounds(box);
        for (int corner = 0; corner < 8; ++corner) {
            const Point3 p = world(
                box.half * Vector3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
            REQUIRE(Aabb{around.min - 1e-6f, around.max + 1e-6f}.contains(p));
        }
    }
}

}  // namespace space::ch02
