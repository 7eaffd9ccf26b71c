// Expansions against rational numbers (GMP), and the exact decision about spheres that is made of
// them.
#include "chapters/ch02_intersection_tests/expansion.hpp"

#include "chapters/ch02_intersection_tests/measured/exact_deciders.hpp"
#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "tests/catch.hpp"
#include "tests/exact_vector.hpp"

namespace space::ch02 {
namespace {

constexpr int rounds = sized(20'000, 1'000);

template <std::size_t N>
mpq_class exact_value(const Expansion<N>& e) {
    mpq_class sum = 0;
    for (std::size_t i = 0; i < e.size; ++i) sum += mpq_class(e.part[i]);
    return sum;
}

/// No zeros, growing, and nonadjacent: |part| is below half of the lowest set bit of its successor,
/// so a zero bit lies between them.
template <std::size_t N>
bool well_formed(const Expansion<N>& e) {
    if (e.size > N) return false;
    for (std::size_t i = 0; i < e.size; ++i) {
        if (e.part[i] == 0.0 || !std::isfinite(e.part[i])) return false;
        if (i == 0) continue;
        int exponent = 0;
        const double mantissa = std::frexp(e.part[i], &exponent);
        const auto bits = static_cast<std::uint64_t>(std::abs(mantissa) * 0x1p53);
        if (std::abs(e.part[i - 1]) >= std::ldexp(0.5, exponent - 53 + std::countr_zero(bits)))
            return false;
    }
    return true;
}

template <std::size_t N>
bool is(const Expansion<N>& e, const mpq_class& expected) {
    if (exact_value(e) != expected || !well_formed(e) || e.sign() != sgn(expected)) return false;
    return abs(mpq_class(e.value()) - expected) <= abs(expected) * mpq_class(0x1p-52);
}

/// Mantissas of any number of bits, exponents of a float's range or close together.
float some_float(Pcg32& random, int spread) {
    const std::uint32_t bits = 1u + random.below(1u << 24);
    const std::uint32_t mantissa = bits >> random.below(24);
    const int exponent =
        static_cast<int>(random.below(static_cast<std::uint32_t>(spread))) - spread / 2;
    const float size = std::ldexp(static_cast<float>(mantissa), exponent - 24);
    return random.below(2) ? size : -size;
}

}  // namespace

TEST_CASE("two_sum and two_product lose nothing") {
    Pcg32 random(401);
    for (int i = 0; i < rounds; ++i) {
        const double a_factor = some_float(random, 60), b_term = some_float(random, 200);
        const double a = a_factor * some_float(random, 60), b = b_term + some_float(random, 60);
        const auto [sum, sum_low] = two_sum(a, b);
        REQUIRE(sum == a + b);
        REQUIRE(mpq_class(sum) + mpq_class(sum_low) == mpq_class(a) + mpq_class(b));
        const auto [product, product_low] = two_product(a, b);
        REQUIRE(product == a * b);
        REQUIRE(mpq_class(product) + mpq_class(product_low) == mpq_class(a) * mpq_class(b));
    }
}

TEST_CASE(
    "differences, sums and products of expansions are exact, well formed, and have the right sign "
    "and value") {
    Pcg32 random(402);
    for (const int spread : {2, 30, 120, 246})
        for (int i = 0; i < rounds / 4; ++i) {
            const float a = some_float(random, spread), b = some_float(random, spread),
                        c = some_float(random, spread), d = some_float(random, spread);
            const mpq_class ra(a), rb(b), rc(c), rd(d);
            const auto ab = difference(a, b), cd = difference(c, d);
            REQUIRE(is(ab, ra - rb));
            REQUIRE(is(cd, rc - rd));
            REQUIRE(is(-ab, rb - ra));
            REQUIRE(is(ab + double{c}, ra - rb + rc));
            REQUIRE(is(ab + cd, ra - rb + rc - rd));
            REQUIRE(is(ab * double{c}, (ra - rb) * rc));
            const auto product = ab * cd;
            REQUIRE(is(product, (ra - rb) * (rc - rd)));
            REQUIRE(is(product * ab, (ra - rb) * (rc - rd) * (ra - rb)));
            REQUIRE(is(product * ab - ab * product, 0));
            REQUIRE(is(product + -product + double{d}, rd));
            // A determinant: its value cancels where the rows are close.
            REQUIRE(is(ab * double{d} - cd * double{b}, (ra - rb) * rd - (rc - rd) * rb));
        }
}

TEST_CASE("parts without common bits are not enough for the value, nonadjacent parts are") {
    Expansion<3> loose;
    for (const double part : {-(0x1p7 - 0x1p-46), -(0x1p60 - 0x1p7), 0x1p60}) loose.push(part);
    REQUIRE(exact_value(loose) == mpq_class(0x1p-46));
    CHECK_FALSE(well_formed(loose));
    CHECK(loose.value() == 0.0);
    // The same numbers added up: one part is left.
    Expansion<1> first;
    first.push(0x1p60);
    const auto sum = first + -(0x1p60 - 0x1p7) + -(0x1p7 - 0x1p-46);
    CHECK(is(sum, mpq_class(0x1p-46)));
    CHECK(sum.value() == 0x1p-46);
}

TEST_CASE("seven factors at the ends of a float's range neither over- nor underflow") {
    for (const float x : {0x1p-149f, std::numeric_limits<float>::min() * 1.9999999f,
                          std::numeric_limits<float>::max()}) {
        const auto e = difference(x, -x);  // 2 x
        const auto third = e * e * e;
        const mpq_class r = 2 * mpq_class(x);
        REQUIRE(is(third * double{x}, r * r * r * r / 2));
        REQUIRE(is(third * e * double{x} * double{x} * double{x}, r * r * r * r * r * r * r / 8));
    }
}

TEST_CASE("the exact sphere's quadratic is that of rational numbers, and so is its decision") {
    Pcg32 random(403);
    int hits = 0;
    for (int i = 0; i < rounds / 10; ++i) {
        Sphere sphere{random_vector(random), 1.0f};
        Ray ray{.origin = 4.0f * random_vector(random), .direction = random_vector(random)};
        if (i % 4 == 0)
            ray = {.origin = {1.0f, 0.0f, 5.0f},
                   .direction = {0.0f, random.uniform() < 0.5f ? 0.0f : 0x1p-60f, -3.0f}},
            sphere.centre = Point3(0.0f);
        const ExactQuadratic q(ray, sphere);
        const ExactVector<3> d = exact(ray.direction), f = exact(ray.origin) - exact(sphere.centre);
        const mpq_class a = dot(d, d), b = dot(f, d), radius(sphere.radius),
                        c = dot(f, f) - radius * radius;
        REQUIRE(exact_value(q.a) == a);
        REQUIRE(exact_value(q.b) == b);
        REQUIRE(exact_value(q.c) == c);
        REQUIRE(exact_value(q.discriminant) == b * b - a * c);
        REQUIRE(q.discriminant.sign() == sgn(mpq_class(b * b - a * c)));
        // Some root is >= 0: the sum of the roots is -2 b / a, their product c / a.
        const bool expected = b * b >= a * c && (c <= 0 || b <= 0);
        REQUIRE(exactly_hits_ahead(q) == expected);
        hits += expected;
    }
    CHECK(hits > rounds / 100);
    CHECK(rounds / 10 - hits > rounds / 100);
}

}  // namespace space::ch02
