// The page on filtered predicates holds what a machine computes.
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/measured/signs.hpp"
#include "tests/ch02/toy.hpp"
#include "tests/text.hpp"

#include <array>

namespace space::ch02 {
namespace {

const Text exact_page("chapters/ch02_intersection_tests/exact.dox");

/// Which stage decided last.
struct LastStage {
    std::optional<Stage> stage = {};
    void decided(Stage by) { stage = by; }
};

}  // namespace

TEST_CASE("the ray of the first example hits the first triangle, and double says the second") {
    const auto tuple = [](const Vector3& v) {
        return fmt::format("({:.0f}, {:.0f}, {:.0f})", v.x, v.y, v.z);
    };
    exact_page.check_says("origin = " + tuple(example_ray.origin));
    exact_page.check_says("direction = " + tuple(example_ray.direction));
    exact_page.check_says(" b = " + tuple(example_b));
    const SignExample example = sign_example();
    const auto& [in_float, in_double, exact] = example.rows;
    CHECK(exact.volume == 1.0);
    CHECK(exact.first);
    CHECK_FALSE(exact.second);
    CHECK(in_double.volume < 0.0);
    CHECK_FALSE(in_double.first);
    CHECK(in_double.second);
    CHECK(std::abs(in_double.volume) < example.bound);
}

TEST_CASE("whole vectors have the volume that they are made for") {
    Pcg32 random(3);
    for (int i = 0; i < 1'000; ++i) {
        const std::int64_t wanted = static_cast<std::int64_t>(random.below(2'001)) - 1'000;
        const WholeVectors made = with_volume(wanted, random);
        const Volume volume = volume_of(made);
        REQUIRE(volume.exact == static_cast<double>(wanted));
        REQUIRE(std::abs(volume.in_double - volume.exact) <= volume.bound);
        for (const Vector3& v : {made.s, made.e, made.d})
            for (int axis = 0; axis < 3; ++axis) {
                REQUIRE(std::abs(v[axis]) < 1e6f);
                REQUIRE(v[axis] == std::round(v[axis]));
            }
    }
}

TEST_CASE("the filter's example: a ray through an edge is passed on, and one beside it is not") {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    Ray ray{.origin = {2, -1, 3}, .direction = {-1, 1, -3}};
    const Double3 a(triangle.a), d(ray.direction), e = Double3(triangle.b) - a,
                                                   f = Double3(triangle.c) - a;
    const auto s = [&] { return Double3(ray.origin) - a; };
    const auto v = [&] { return glm::dot(glm::cross(s(), e), d); };
    const FilteredExact::Sizes size = FilteredExact::sizes(d, e, f, s());
    exact_page.check_says(formula(fmt::format("|D|_1 = {}", size.d)) + ", " +
                          formula(fmt::format("|e|_1 = |f|_1 = {}", size.e1)));
    exact_page.check_says(formula(fmt::format("|s|_1 = {}", size.s)));
    const double bound = FilteredExact::outside_bound(size);
    exact_page.check_says(
        fmt::format("5\\,(16 + 48) = {:.0f}\\,u_{{53}} = {}", bound * 0x1p53, power(bound)));
    const double det = glm::dot(glm::cross(d, f), e), u = glm::dot(glm::cross(d, f), s());
    exact_page.check_says(
        fmt::format("\\f$\\mathit{{det}} = {}\\f$, \\f$u = {}\\f$, \\f$v = {}\\f$", det, u, v()));
    CHECK(FilteredExact::outside(u, det) == -12.0);
    exact_page.check_says("\\mathrm{outside}(12, 48) = 12 - 24 = -12");
    CHECK(FilteredExact::outside(v(), det - u) == 0.0);
    exact_page.check_says("\\mathrm{outside}(0, 36) = 18 - 18 = 0");
    LastStage last;
    CHECK(FilteredExact::intersect(ray, triangle, last));
    CHECK(last.stage == Stage::integers);

    ray.origin.y = std::nextafter(-1.0f, 0.0f);
    CHECK(ray.origin.y == -1.0f + 0x1p-24f);
    CHECK(v() == 12 * 0x1p-24);
    exact_page.check_says("v = 12 \\cdot 2^{-24} = " + power(v()));
    exact_page.check_says("two million times");
    CHECK(v() / bound > 1.95e6);
    CHECK(v() / bound < 2.05e6);
    CHECK(FilteredExact::intersect(ray, triangle, last));
    CHECK(last.stage == Stage::filter);
}

TEST_CASE("the toy's error of a sum and of a product is found, and nothing is lost") {
    const std::int64_t a = 56'100, b = 789, h = toy(a + b), b_part = toy(h - a),
                       a_part = toy(h - b_part), l = toy(toy(a - a_part) + toy(b - b_part));
    CHECK(h + l == a + b);
    exact_page.check_says(fmt::format(
        "{} is {}. {}; then {} and {};", formula(decimal(a, 2) + " + " + decimal(b, 4)),
        decimal(a + b, 4), formula("h = " + decimal(h, 2)),
        formula(fmt::format("b' = {} - {} = {}", decimal(h, 2), decimal(a, 2), decimal(b_part, 2))),
        formula(fmt::format("a' = {} - {} = {}", decimal(h, 2), decimal(b_part, 2),
                            decimal(a_part, 2)))));
    exact_page.check_says(formula(fmt::format("l = {} + ({} - {}) = {}", decimal(a - a_part, 0),
                                              decimal(b, 4), decimal(b_part, 2), decimal(l, 4))));
    const std::int64_t product = 123 * 456;
    exact_page.check_says(fmt::format("{} becomes {}",
                                      formula("1.23 \\cdot 4.56 = " + decimal(product, 4)),
                                      formula(fmt::format("{} - {}", decimal(toy(product), 2),
                                                          decimal(toy(product) - product, 4)))));
}

}  // namespace space::ch02
