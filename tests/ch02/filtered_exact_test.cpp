// The filtered exact test against the exact oracle: hit and miss, t to the last bit, and the ends
// of the interval.
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "tests/oracle/moller_trumbore_bound.hpp"
#include "tests/suite/accelerator_suite.hpp"

#include <array>
#include <bit>
#include <cstdio>
#include <functional>

namespace space::ch02 {
namespace {

constexpr int pairs_each = sized(3'000, 300);

struct Stages {
    std::array<std::uint64_t, 3> count{};
    void decided(Stage stage) { ++count[static_cast<std::size_t>(stage)]; }
    std::uint64_t operator[](Stage stage) const { return count[static_cast<std::size_t>(stage)]; }
};

struct Outcome {
    std::uint64_t decisions = 0, hits = 0, boundary = 0, disagreements = 0, wrong_t = 0,
                  wrong_uv = 0;
    Stages stages;
    std::string first;  ///< of the disagreements

    std::string text() const {
        return fmt::format(
            "{} decisions, {} hits, {} at edges or vertices; filter {}, integers {}, expansions "
            "{}{}",
            decisions, hits, boundary, stages.count[0], stages.count[1], stages.count[2], first);
    }
    bool right() const { return disagreements == 0 && wrong_t == 0 && wrong_uv == 0; }
    void operator+=(const Outcome& other) {
        decisions += other.decisions;
        hits += other.hits;
        boundary += other.boundary;
        disagreements += other.disagreements;
        wrong_t += other.wrong_t;
        wrong_uv += other.wrong_uv;
        for (std::size_t i = 0; i < 3; ++i) stages.count[i] += other.stages.count[i];
        if (first.empty()) first = other.first;
    }
};

std::string words(const RayAndTriangle& pair) {
    std::string text;
    for (const Vector3& v :
         {pair.ray.origin, pair.ray.direction, pair.triangle.a, pair.triangle.b, pair.triangle.c})
        text += fmt::format(" ({:a}, {:a}, {:a})", v.x, v.y, v.z);
    return text + fmt::format(" in [{:a}, {:a}]", pair.ray.tmin, pair.ray.tmax);
}

/// Returns the exact t.
std::optional<float> compare_one(const RayAndTriangle& pair, Outcome& outcome) {
    const std::vector<ExactHit> exact = ExactOracle::build({&pair.triangle, 1}).hits(pair.ray);
    const std::optional<Hit> hit =
        FilteredExact::intersect(pair.ray, pair.triangle, outcome.stages);
    ++outcome.decisions;
    outcome.hits += !exact.empty();
    outcome.boundary += !exact.empty() && exact[0].place != Place::interior;
    const auto wrong = [&](std::uint64_t& counter, const char* what) {
        if (++counter == 1 && outcome.first.empty())
            outcome.first = fmt::format("\n  {}:{}", what, words(pair));
    };
    if (hit.has_value() != !exact.empty())
        wrong(outcome.disagreements, exact.empty() ? "wrong hit" : "wrong miss");
    if (hit && !exact.empty()) {
        if (hit->t != exact[0].t) wrong(outcome.wrong_t, "wrong t");
        const Crossing weights = crossing(pair.ray, pair.triangle).value();
        const double error =
            moller_trumbore_bound(pair.ray, pair.triangle, weights).weight + 0x1p-24;
        if (!(hit->u >= 0.0f && hit->v >= 0.0f && double{hit->u} + hit->v <= 1.0 + 0x1p-23 &&
              std::abs(hit->u - weights.u) <= error && std::abs(hit->v - weights.v) <= error))
            wrong(outcome.wrong_uv, "wrong u, v");
    }
    return exact.empty() ? std::nullopt : std::optional(exact[0].t);
}

/// Every pair, and where it hits the same with the interval's ends at t and its neighbours.
Outcome compare_all(int pairs, const std::function<RayAndTriangle()>& make) {
    Outcome outcome;
    for (int i = 0; i < pairs; ++i) {
        RayAndTriangle pair = make();
        const std::optional<float> t = compare_one(pair, outcome);
        if (!t || i % 4 != 0) continue;
        const float before = std::nextafter(*t, -infinity), after = std::nextafter(*t, infinity);
        for (const auto& [tmin, tmax] : {std::pair{*t, *t},
                                         {after, infinity},
                                         {-infinity, before},
                                         {before, after},
                                         {*t, infinity},
                                         {-infinity, *t}}) {
            pair.ray.tmin = tmin;
            pair.ray.tmax = tmax;
            compare_one(pair, outcome);
        }
    }
    return outcome;
}

/// Any finite float: the bits are drawn.
float wild(Pcg32& random) {
    for (;;)
        if (const auto x = std::bit_cast<float>(random.next()); std::isfinite(x)) return x;
}
float small_whole(Pcg32& random) {
    return static_cast<float>(random.below(9)) - 4.0f;
}
Vector3 vector_of(Pcg32& random, float (*component)(Pcg32&)) {
    const float x = component(random), y = component(random), z = component(random);
    return {x, y, z};
}
/// Exponents from `low` to `low + 15`.
template <int Low>
float near_power(Pcg32& random) {
    const float mantissa = random.uniform(-1.0f, 1.0f);
    return std::ldexp(mantissa, Low + static_cast<int>(random.below(16)));
}

RayAndTriangle all_of(Pcg32& random, float (*component)(Pcg32&)) {
    const Vector3 o = vector_of(random, component), d = vector_of(random, component),
                  a = vector_of(random, component), b = vector_of(random, component);
    return {{.origin = o, .direction = d, .tmin = -infinity, .tmax = infinity},
            {a, b, vector_of(random, component)}};
}
/// The origin lies on the line from a point of the triangle's border backwards by a whole number of
/// directions, all in numbers of `component`: exactly, as long as nothing is rounded.
RayAndTriangle at_border(Pcg32& random, float (*component)(Pcg32&)) {
    RayAndTriangle pair = all_of(random, component);
    const Triangle& t = pair.triangle;
    const Vector3 target = random.below(2) ? t.a : 0.5f * t.a + 0.5f * t.b;
    pair.ray.origin = target - static_cast<float>(random.below(4)) * pair.ray.direction;
    return pair;
}
/// Whole numbers of 20 bits.
float long_whole(Pcg32& random) {
    return static_cast<float>(random.below(1u << 20)) - 0x1p19f;
}
/// At the border, but for an origin that is moved along x by less than the filter can tell.
RayAndTriangle beside_border(Pcg32& random) {
    RayAndTriangle pair = at_border(random, long_whole);
    const float x = pair.ray.origin.x;
    for (Point3* corner : {&pair.triangle.a, &pair.triangle.b, &pair.triangle.c}) corner->x -= x;
    const float hair = std::ldexp(1.0f, -36 - static_cast<int>(random.below(16)));
    pair.ray.origin.x = random.below(2) ? hair : -hair;
    return pair;
}
/// In one plane, or nearly.
RayAndTriangle edge_on(Pcg32& random) {
    RayAndTriangle pair = make_pair({"", Aim::edge}, random);
    const Triangle& t = pair.triangle;
    const Double3 ab = Double3(t.b) - Double3(t.a), ac = Double3(t.c) - Double3(t.a);
    const auto in_plane = [&](double u_scale, double v_scale) {
        const double u = u_scale * random.uniform_double(), v = v_scale * random.uniform_double();
        return Point3(Double3(t.a) + u * ab + v * ac);
    };
    pair.ray.origin = in_plane(-1.0, 2.0);
    pair.ray.direction = in_plane(1.0, 1.0) - pair.ray.origin;
    return pair;
}

struct Kind {
    const char* name;
    std::function<RayAndTriangle(Pcg32&)> make;
};
const std::vector<Kind>& hostile_kinds() {
    static const std::vector<Kind> all{
        {"small whole numbers", [](Pcg32& random) { return all_of(random, small_whole); }},
        {"small whole numbers, at the border",
         [](Pcg32& random) { return at_border(random, small_whole); }},
        {"any bits", [](Pcg32& random) { return all_of(random, wild); }},
        {"any bits, at the border",
         [](Pcg32& random) { return at_border(random, near_power<-8>); }},
        {"denormal", [](Pcg32& random) { return at_border(random, near_power<-140>); }},
        {"huge", [](Pcg32& random) { return at_border(random, near_power<108>); }},
        {"a hair beside the border", beside_border},
        {"within the plane, or nearly", edge_on},
        {"no area",
         [](Pcg32& random) {
             RayAndTriangle pair = make_pair({"", Aim::edge}, random);
             Triangle& t = pair.triangle;
             t.c = random.below(2) ? t.a : 0.5f * t.a + 0.5f * t.b;
             return pair;
         }},
    };
    return all;
}

/// `first` pairs of each of the first three classes, random and aimed at edges and vertices.
Outcome all_inputs(int pairs, int first) {
    Outcome sum;
    int first_left = 3;
    const auto add = [&](std::string_view name, const auto& make) {
        const Outcome outcome = compare_all(first_left-- > 0 ? first : pairs, make);
        fmt::print("{}: {}\n", name, outcome.text());
        std::fflush(stdout);
        INFO(name << ": " << outcome.text());
        CHECK(outcome.right());
        sum += outcome;
    };
    for (const TriangleInput& input : triangle_inputs()) {
        Pcg32 random(201);
        add(input.name, [&] { return make_pair(input, random); });
    }
    for (const Aim aim : {Aim::edge, Aim::vertex, Aim::grazing})
        for (const auto& [scale, shift] : {std::pair{-20, 0}, {20, 0}, {0, 7}}) {
            Pcg32 random(202);
            const TriangleInput input{"", aim, scale, shift};
            add(fmt::format("aim {}, scaled by 10^{}, shifted by 10^{}", static_cast<int>(aim),
                            scale, shift),
                [&] { return make_pair(input, random); });
        }
    for (const Kind& kind : hostile_kinds()) {
        Pcg32 random(203);
        add(kind.name, [&] { return kind.make(random); });
    }
    fmt::print("all: {}\n", sum.text());
    return sum;
}

}  // namespace

TEST_CASE(
    "filtered exact decides as exact arithmetic does, with the nearest float t, on every class of "
    "input and at every "
    "end of the interval") {
    const Outcome sum = all_inputs(pairs_each, pairs_each);
    CHECK(sum.hits > sum.decisions / 10);
    CHECK(sum.boundary > 0);
    // All three stages are tried.
    CHECK(sum.stages[Stage::filter] > 0);
    CHECK(sum.stages[Stage::integers] > 0);
    CHECK(sum.stages[Stage::expansions] > 0);
    CHECK(sum.stages[Stage::filter] + sum.stages[Stage::integers] + sum.stages[Stage::expansions] ==
          sum.decisions);
}

TEST_CASE("filtered exact decides as exact arithmetic does: the full sizes", "[.big]") {
    CHECK(all_inputs(100'000, 1'000'000).right());
}

TEST_CASE(
    "each stage decides alone where the one before cannot tell, and finds the point that the ray "
    "is aimed at") {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    for (const auto& [target, stage] : {std::pair{Point3(1, 1, 0), Stage::filter},
                                        {Point3(2, 0, 0), Stage::integers},
                                        {Point3(0, 0, 0), Stage::integers}}) {
        Stages stages;
        const auto hit =
            FilteredExact::intersect({target + Vector3(1, 2, 3), {-1, -2, -3}}, triangle, stages);
        REQUIRE(hit);
        CHECK(hit->t == 1.0f);
        CHECK(hit->u == target.x / 4.0f);
        CHECK(hit->v == target.y / 4.0f);
        CHECK(stages[stage] == 1);
        CHECK(stages[Stage::filter] + stages[Stage::integers] + stages[Stage::expansions] == 1);
    }
    Stages stages;  // 0x1p-100 beside 4: no integer holds both
    const auto hit =
        FilteredExact::intersect({{2, 0x1p-100f, 3}, {0, -0x1p-100f, -3}}, triangle, stages);
    REQUIRE(hit);
    CHECK(hit->t == 1.0f);
    CHECK(hit->u == 0.5f);
    CHECK(hit->v == 0.0f);
    CHECK(stages[Stage::expansions] == 1);
    CHECK(stages[Stage::filter] + stages[Stage::integers] == 0);
    CHECK_FALSE(FilteredExact::intersect({{2, -0x1p-149f, 3}, {0, 0, -3}}, triangle));
    CHECK(FilteredExact::intersect({{2, 0x1p-149f, 3}, {0, 0, -3}}, triangle));
}

TEST_CASE(
    "t is the nearest float up to the largest one, and infinity from half a unit in the last place "
    "beyond it") {
    // From z = 2^24 down to about z = 1/2, 2^-104 per unit of t: t is about 2^128 - 2^103, the
    // middle between the largest float and what would follow it; the plane's tilt makes it differ
    // by 2^-84 of itself.
    bool from_behind = false;
    float way = 1.0f;  // or backwards: t and the interval change their signs
    const auto with_tilt = [&](float tilt, float end) {
        const Ray ray{{0x1p-36f, 0x1p-36f, 0x1p24f},
                      {0, 0, -way * 0x1p-104f},
                      std::min(0.0f, way * end),
                      std::max(0.0f, way * end)};
        const Point3 a(0, 0, 0.5f), b(1, 0, 0.5f + tilt), c(0, 1, 0.5f);
        return RayAndTriangle{ray, from_behind ? Triangle{a, c, b} : Triangle{a, b, c}};
    };
    Outcome outcome;
    constexpr float largest = std::numeric_limits<float>::max();
    for (const bool behind : {false, true})
        for (const float sign : {1.0f, -1.0f}) {
            from_behind = behind;
            way = sign;
            CHECK(compare_one(with_tilt(0x1p-23f, infinity), outcome) == way * largest);
            CHECK(compare_one(with_tilt(0x1p-23f, largest), outcome) == way * largest);
            CHECK(compare_one(with_tilt(0.0f, infinity), outcome) == way * infinity);
            CHECK(compare_one(with_tilt(-0x1p-23f, infinity), outcome) == way * infinity);
            CHECK(compare_one(with_tilt(-0x1p-23f, largest), outcome) == std::nullopt);
        }
    INFO(outcome.text());
    CHECK(outcome.right());
    CHECK(outcome.stages[Stage::expansions] == 20);
}

/// A ray straight down at a plane that is tilted so little that t differs from a number half-way
/// between two floats by 2^-58 and less of itself. The edges' last bits make the volumes long, and
/// so t is computed with three roundings to either side. Where the ray's y is small enough, no
/// integer holds the volumes.
RayAndTriangle nearly_half_way(Pcg32& random, float tilt, float y) {
    const auto edge = [&](float size) { return size * (1.0f + random.uniform()); };
    const float half_way = 2.0f - 0x1p-23f * static_cast<float>(1 + random.below(1u << 10)),
                below = -0x1p-24f;  // half a unit in half_way's last place
    const float e1x = edge(0x1p10f), e1y = -edge(0x1p-1f), e2x = edge(0x1p-1f), e2y = edge(0x1p10f);
    // t = half_way - below - tilt (e2y x - e2x y) / (e1x e2y - e1y e2x)
    return {{{0x1p-24f, y, half_way}, {0, 0, -1}},
            {{0, 0, below}, {e1x, e1y, below + tilt}, {e2x, e2y, below}}};
}

TEST_CASE(
    "t is the nearest float where three roundings hide on which side of the middle it is, by "
    "integers and by expansions") {
    for (const float y : {0x1p-24f, 0x1p-60f}) {
        Pcg32 random(205);
        Outcome outcome;
        for (int i = 0; i < pairs_each; ++i)
            compare_one(nearly_half_way(random, i % 2 ? 0x1p-24f : -0x1p-24f, y), outcome);
        INFO(outcome.text());
        CHECK(outcome.right());
        CHECK(outcome.hits == outcome.decisions);
        CHECK(outcome.stages[Stage::filter] == 0);
    }
}

TEST_CASE("t half-way between two floats is the even one of them, whether the lower or the upper") {
    Pcg32 random(208);
    Outcome outcome;
    int lower = 0;
    for (int i = 0; i < pairs_each; ++i) {
        const RayAndTriangle pair = nearly_half_way(random, 0.0f, 0x1p-24f);
        const double t = double{pair.ray.origin.z} - pair.triangle.a.z;
        lower += compare_one(pair, outcome) < t;
    }
    INFO(outcome.text());
    CHECK(outcome.right());
    CHECK(outcome.stages[Stage::expansions] == outcome.decisions);
    CHECK(lower > pairs_each / 4);
    CHECK(lower < pairs_each * 3 / 4);
}

TEST_CASE("the sign of a side that roundings turn round is left to exact numbers") {
    // Straight down beside the middle of the edge from a to b or c. The first corner's last bits
    // are lost in the differences, and the products round: the computed side is inside, the exact
    // one is not, or the other way round.
    Pcg32 random(207);
    std::array<Outcome, 2> outcomes;
    std::array<int, 2> turned{};
    for (int i = 0; i < 10 * pairs_each; ++i) {
        const auto number = [&] { return random.uniform(0.5f, 1.0f); };
        const auto tiny = [&] { return 0x1p-52f * random.uniform(-1.0f, 1.0f); };
        const float ax = tiny(), ay = tiny(), x = number(), y = number();
        const Point3 a(ax, ay, 0), far(x, y, 0), left(-y, x, 0);
        const bool at_u = i % 2;  // u is 0 on the edge from a to c
        const Triangle triangle = at_u ? Triangle{a, -left, far} : Triangle{a, far, left};
        const Ray ray{{0.5f * x, 0.5f * y, 1}, {0, 0, -1}, -infinity, infinity};
        // Twice the area of a, the ray's point and the edge's end: in double, and (twice) exactly.
        const double computed =
            (double{x} - ax) * (0.5 * y - ay) - (double{y} - ay) * (0.5 * x - ax);
        const double exact = double{y} * ax - double{x} * ay;
        const double side = at_u ? -1.0 : 1.0;
        turned[at_u] += side * computed > 0.0 && side * exact < 0.0;
        compare_one({ray, triangle}, outcomes[at_u]);
    }
    for (int i = 0; i < 2; ++i) {
        INFO(outcomes[i].text());
        CHECK(outcomes[i].right());
        CHECK(turned[i] > pairs_each / 100);
    }
}

TEST_CASE("integers decide up to the last of their 127 bits, and no ray that needs more") {
    // Corners of a cube of side 2^p, each moved inwards by less than 2 so that all bits are used,
    // and directions of up to 24 bits: the volumes are as large as they can be.
    Pcg32 random(206);
    std::array<Outcome, 2> outcomes;  // by whether a direction's bits fit
    for (int i = 0; i < 4 * pairs_each; ++i) {
        const int p = 37 + static_cast<int>(random.below(5));
        const auto corner = [&](std::uint32_t at) {
            Point3 point;
            for (int axis = 0; axis < 3; ++axis)
                point[axis] = at >> axis & 1u ? std::ldexp(1.0f, p) - std::ldexp(1.0f, p - 24)
                                              : -std::ldexp(1.0f, p);
            return point;
        };
        RayAndTriangle pair;
        pair.triangle = {corner(random.below(8)), corner(random.below(8)), corner(random.below(8))};
        pair.ray = {.origin = corner(random.below(8)), .tmin = -infinity, .tmax = infinity};
        for (int axis = 0; axis < 3; ++axis) {
            const float size = 1.0f - std::ldexp(1.0f, -1 - static_cast<int>(random.below(24)));
            pair.ray.direction[axis] = random.below(3) ? (random.below(2) ? size : -size) : 0.0f;
        }
        if (i % 2) {  // two large components, and one whose last bit lies far below theirs
            const int low = static_cast<int>(random.below(3));
            for (int axis = 0; axis < 3; ++axis) {
                float& d = pair.ray.direction[axis];
                d = random.below(2) ? 1.0f - 0x1p-24f : -(1.0f - 0x1p-24f);
                if (axis == low) d = std::ldexp(d, -12 - static_cast<int>(random.below(12)));
            }
        }
        // One last bit somewhere.
        (random.below(2) ? pair.ray.origin : pair.triangle.b)[static_cast<int>(random.below(3))] =
            random.below(2) ? 1.0f : -1.0f;
        compare_one(pair, outcomes[p > 39]);
    }
    for (const Outcome& outcome : outcomes) {
        INFO(outcome.text());
        CHECK(outcome.right());
        CHECK(outcome.stages[Stage::integers] > 0);
    }
    CHECK(outcomes[1].stages[Stage::expansions] > 0);
}

TEST_CASE("the largest volumes that integers hold, and the smallest that they don't") {
    // Three corners of a cube, all of whose bits count because of a single 1 in the origin.
    const auto triangle_of = [](int bits) {
        const float m = std::ldexp(1.0f, bits) - std::ldexp(1.0f, bits - 24);
        return Triangle{{m, -m, -m}, {-m, m, -m}, {-m, -m, m}};
    };
    const auto stages_of = [](const Ray& ray, const Triangle& triangle) {
        Outcome outcome;
        const std::optional<float> t = compare_one({ray, triangle}, outcome);
        INFO(outcome.text());
        CHECK(t);
        CHECK(outcome.right());
        return outcome.stages;
    };
    // A direction with two components near 2^w and one just below 2^24 makes det a hair more than
    // twice the product of the factors: above 2^126, and above 2^127. t is so near to half-way
    // between two floats that the filter cannot tell which it is.
    const auto ray_of = [](const Point3& origin, int w) {
        const float d = std::ldexp(1.0f, w) - std::ldexp(1.0f, w - 24);
        return Ray{origin, {d, d, 0x1p24f - 1.0f}, -infinity, infinity};
    };
    for (const Point3& o : {Point3(0x1.fd5276p+23f, -0x1.56df2p+37f, -0x1.7c47c6p+39f),
                            Point3(0x1.de1366p+23f, 0x1.266b28p+39f, -0x1.d8e888p+39f)})
        CHECK(stages_of(ray_of(o, 41), triangle_of(41))[Stage::integers] == 1);
    for (const Point3& o : {Point3(0x1.8a4f8cp+22f, 0x1.1a142p+37f, -0x1.874d82p+39f),
                            Point3(0x1.c16b62p+23f, -0x1.6f44p+32f, -0x1.5feeeap+40f)})
        CHECK(stages_of(ray_of(o, 42), triangle_of(41))[Stage::expansions] == 1);
    // Of t, the origin at the fourth corner but for one coordinate makes one and a half of the
    // product: 2^126 and 2^129 times 1.5.
    const auto stages_beside = [&](float z, const Vector3& d, int bits) {
        const float m = triangle_of(bits).a.x;
        return stages_of({{m, m, z}, d}, triangle_of(bits));
    };
    CHECK(stages_beside(0x1.2f6cdp+20f, {-0x1.d3244cp-1f, -0x1.fc3f74p-1f, -0x1.2dbf9p-1f},
                        41)[Stage::integers] == 1);
    CHECK(stages_beside(0x1.59a81p+20f, {-0x1.efa9a2p-1f, -0x1.eee826p-1f, -0x1.288048p-1f},
                        41)[Stage::integers] == 1);
    CHECK(stages_beside(0x1.ab2a54p+22f, {-0x1.e4d764p-1f, -0x1.ece0acp-1f, -0x1.2ff12p-1f},
                        42)[Stage::expansions] == 1);
    CHECK(stages_beside(0x1.56eaa4p+22f, {-0x1.d49f62p-1f, -0x1.d1d5aep-1f, -0x1.2da304p-1f},
                        42)[Stage::expansions] == 1);
}

TEST_CASE("a line in the triangle's plane, or beside it, does not hit it") {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    CHECK(expansion_volumes({{1, 1, 1}, {0, 0, -1}}, triangle).line_hits());
    CHECK_FALSE(expansion_volumes({{1, 1, 0}, {1, 0, 0}}, triangle).line_hits());
    CHECK_FALSE(expansion_volumes({{1, 1, 1}, {1, 0, 0}}, triangle).line_hits());
}

TEST_CASE("a ray that is not valid and a triangle that is not finite are never hit") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const Ray good{{1, 1, 3}, {0, 0, -3}};
    CHECK(FilteredExact::intersect(good, triangle));
    for (const float bad : {nan, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            Ray ray = good;
            ray.origin[axis] = bad;
            CHECK_FALSE(FilteredExact::intersect(ray, triangle));
            ray = good;
            ray.direction[axis] = bad;
            CHECK_FALSE(FilteredExact::intersect(ray, triangle));
            for (Point3 Triangle::*corner : {&Triangle::a, &Triangle::b, &Triangle::c}) {
                Triangle broken = triangle;
                (broken.*corner)[axis] = bad;
                CHECK_FALSE(FilteredExact::intersect(good, broken));
            }
        }
    // Infinities that meet nothing but zeros: the volumes are finite, and those of a hit.
    CHECK_FALSE(FilteredExact::intersect({{1, 0, 0}, {-1, 0, 0.5f}},
                                         {{0, 0, 0}, {infinity, 1, 0}, {0, 0, 1}}));
    CHECK_FALSE(FilteredExact::intersect({{1, 0, 0.5f}, {-1, 0, 0}},
                                         {{0, 0, 0}, {0, 0, 1}, {infinity, 1, 0}}));
    CHECK_FALSE(FilteredExact::intersect({{1, 1, 0}, {0, 0, 0}}, triangle));
    CHECK_FALSE(FilteredExact::intersect({{1, 1, 3}, {0, 0, -3}, nan, infinity}, triangle));
    CHECK_FALSE(FilteredExact::intersect({{1, 1, 3}, {0, 0, -3}, 0.0f, nan}, triangle));
    CHECK_FALSE(FilteredExact::intersect({{1, 1, 3}, {0, 0, -3}, 2.0f, 0.0f}, triangle));
}

TEST_CASE("a ray parallel to a triangle and nearly in its plane does not hit it at infinity") {
    const Triangle triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const float height : {0x1p-60f, -0x1p-60f, 0x1p-100f})
        for (const float way : {1.0f, -1.0f}) {
            Stages stages;
            CHECK_FALSE(FilteredExact::intersect(
                {{-1, 0.25f, height}, {way, 0, 0}, -infinity, infinity}, triangle, stages));
            CHECK(stages[Stage::filter] == 0);
        }
}

TEST_CASE("powers of two apart by 2^38 are integers of few bits") {
    // The trailing zeros of the mantissas do not count.
    Stages stages;
    CHECK(FilteredExact::intersect({{0x1p19f, 0, 1}, {0, 0, -0x1p30f}},
                                   {{0, 0, 0}, {0x1p20f, 0, 0}, {0, 0x1p-18f, 0}}, stages));
    CHECK(stages[Stage::integers] == 1);
}

TEST_CASE(
    "the suite: naive tracing with the filtered exact test, never wrong, with t to the last bit") {
    SuiteOptions options;
    options.aimed_rays = 300;  // naive tracing with chapter 1's test has its full share
    options.other_rays = 60;
    const SuiteReport report = check_accelerator<Naive<FilteredExact>, FilteredExact>(
        "naive, filtered exact",
        [](std::span<const Triangle> triangles) { return Naive<FilteredExact>::build(triangles); },
        options);
    CHECK(report.exact.examined() > sized(1'000, 200));
    CHECK(report.exact.wrong() == 0);
    CHECK(report.exact.rounded_t == 0);
    CHECK(report.exact[Agreement::interval_end] == 0);
}

}  // namespace space::ch02
