// The staircase to rounding holds what a machine computes: every line of rounding.dox with numbers
// is computed here and looked for in the text.
#include "tests/ch02/toy.hpp"
#include "tests/text.hpp"

#include <cmath>
#include <limits>

namespace space::ch02 {
namespace {

const Text rounding_page("chapters/ch02_intersection_tests/rounding.dox");

double relative_error(double computed, double exact) {
    return (computed - exact) / exact;
}
double gamma(int k, double u) {
    return k * u / (1.0 - k * u);
}
constexpr double u24 = 0x1p-24, u53 = 0x1p-53;

}  // namespace

TEST_CASE("step 1 of the staircase: floats are as it says") {
    using F = std::numeric_limits<float>;
    using D = std::numeric_limits<double>;
    rounding_page.check_says(
        fmt::format("In a `float` \\f$m\\f$ has {} bits and {};", F::digits,
                    formula(fmt::format("{} \\le e \\le {}", F::min_exponent - F::digits,
                                        F::max_exponent - F::digits))));
    rounding_page.check_says(
        fmt::format("in a `double` {} bits and {}.", D::digits,
                    formula(fmt::format("{} \\le e \\le {}", D::min_exponent - D::digits,
                                        D::max_exponent - D::digits))));
    CHECK(std::ldexp(1.0, F::min_exponent - F::digits) == double{F::denorm_min()});

    const auto ulp = [](float x) { return std::nextafter(x, F::infinity()) - x; };
    CHECK(ulp(1.0f) == 0x1p-23f);
    CHECK(ulp(2.0f) == 2 * ulp(1.5f));
    rounding_page.check_says(
        fmt::format("near 100,000 it is {}",
                    formula(fmt::format("2^{{{}}} = {}", std::ilogb(ulp(1e5f)), ulp(1e5f)))));
    CHECK(static_cast<float>((1 << 24) + 1) == static_cast<float>(1 << 24));
    CHECK(static_cast<float>((1 << 24) - 1) == static_cast<double>((1 << 24) - 1));
    rounding_page.check_says("from \\f$2^{24} = 16{,}777{,}216\\f$ on odd numbers");
    CHECK(1 << 24 == 16'777'216);
    rounding_page.check_says(fmt::format("the float next to it, {:.27f}. *That*", double{0.1f}));
}

TEST_CASE("step 2 of the staircase: one rounding") {
    rounding_page.check_says("u_{24} = 2^{-24} \\approx " + power(u24));
    rounding_page.check_says("u_{53} = 2^{-53} \\approx " + power(u53));
    CHECK(std::numeric_limits<float>::epsilon() == 0x1p-23f);
    const double exact = double{0.1f} + double{0.2f};  // 25 bits: no rounding
    const float rounded = 0.1f + 0.2f;
    // Digits that are cut off, and not rounded.
    const auto digits = [](double x) { return fmt::format("{:.20f}", x).substr(0, 18); };
    rounding_page.check_says(
        fmt::format("have the exact sum {}…; the nearest float is {}…, so here {}.", digits(exact),
                    digits(double{rounded}),
                    formula("\\delta = " + power(relative_error(double{rounded}, exact)))));
}

TEST_CASE("step 3 of the staircase: one line of a program") {
    // The toy: 1.23 * 4.56 + 7.89, in ten-thousandths.
    const std::int64_t product = 123 * 456, sum = toy(product) + 78'900, exact = product + 78'900;
    rounding_page.check_says(fmt::format(
        "it rounds {} to {} and {} to {}. The exact result is {}; the toy is off by {}, a relative "
        "error of {:.5f}.",
        decimal(product, 4), decimal(toy(product), 2), decimal(sum, 2), decimal(toy(sum), 1),
        decimal(exact, 4), decimal(toy(sum) - exact, 4),
        static_cast<double>(toy(sum) - exact) / static_cast<double>(exact)));

    const float a = 1.1f, b = 3.3f, c = -3.6f;
    rounding_page.check_says("\\f$a = 1.1\\f$, \\f$b = 3.3\\f$, \\f$c = -3.6\\f$");
    const double ab = double{a} * double{b};  // 48 bits
    const float rounded = a * b, result = rounded + c;
    const double delta = relative_error(double{rounded}, ab);
    CHECK(double{result} == double{rounded} + double{c});
    rounding_page.check_says(formula("\\delta_1 = " + power(delta)) + "; the sum is exact");
    const double error = relative_error(double{result}, ab + double{c});
    rounding_page.check_says(
        fmt::format("the result {:.10f} has a relative error of {}, {:.0f} times", result,
                    formula(power(error)), error / delta));
    rounding_page.check_says(
        fmt::format("{} was off by {} and the difference was {:.2f}: {:.2f} / {:.2f} = {:.0f}.",
                    formula(fmt::format("|x| = {:.2f}", ab)), formula(power(delta)), result, ab,
                    double{result}, ab / double{result}));
}

TEST_CASE("step 4 of the staircase: many roundings") {
    rounding_page.check_says(formula("\\gamma_7 = " + power(gamma(7, u53), 3)) + " in double");
    rounding_page.check_says(formula("\\gamma_8 = " + power(gamma(8, u24), 3)) + " in float");
    // The toy: 8.01 + 7.94 - 8.00 - 7.94.
    const std::int64_t first = 80'100 + 79'400, second = toy(first) - 80'000,
                       third = second - 79'400;
    CHECK(toy(second) == second);
    CHECK(toy(third) == third);
    const std::int64_t exact = first - 80'000 - 79'400, sizes = 80'100 + 79'400 + 80'000 + 79'400;
    CHECK(first % 1'000 == 500);  // a tie
    rounding_page.check_says(
        fmt::format("It gets {}, which is a tie and goes to {}; then {}; then {}. The exact sum is "
                    "{}, the error {}.",
                    decimal(first, 2), decimal(toy(first), 1), decimal(second, 2),
                    decimal(third, 2), decimal(exact, 2), decimal(third - exact, 2)));
    const double g = gamma(3, 0.005);
    rounding_page.check_says(fmt::format("\\gamma_3 \\cdot {0} = {1:.4f} \\cdot {0} = {2:.2f}",
                                         decimal(sizes, 2), g,
                                         g * static_cast<double>(sizes) / 1e4));
    CHECK((third - exact) / exact == 5);
    rounding_page.check_says("and still five times the result");
}

TEST_CASE("step 5 of the staircase: a sign that float loses and double keeps") {
    rounding_page.check_says("for \\f$a = 1 + 2^{-12}\\f$ and \\f$c = 1 + 2^{-11}\\f$");
    const float a = 1.0f + 0x1p-12f, c = 1.0f + 0x1p-11f;
    CHECK(a * a == c);
    CHECK(a * a - c == 0.0f);
    CHECK(double{a} * double{a} - double{c} == 0x1p-24);
    CHECK(double{a} * double{a} == 1.0 + 0x1p-11 + 0x1p-24);
}

TEST_CASE("step 6 of the staircase: where the rule ends") {
    rounding_page.check_says("(about " + formula(power(0x1p128)) + ")");
    rounding_page.check_says("2^{-126} \\approx " + power(0x1p-126));
    CHECK(std::numeric_limits<float>::min() == 0x1p-126f);
    CHECK(std::isinf(1e30f * 1e30f));
    const float tiny = 1e-25f * 1e-20f;
    rounding_page.check_says(
        fmt::format("gives {}, {:.0f} % too much", formula(power(double{tiny})),
                    100.0 * relative_error(double{tiny}, double{1e-25f} * double{1e-20f})));
    CHECK(1e-30f * 1e-30f == 0.0f);
    CHECK(1e-20f * 1e-20f * 1e-20f == 0.0f);
    const float nan = std::nanf("");
    CHECK_FALSE(nan == nan);
    CHECK(!(nan >= 0.0f));
    CHECK_FALSE(nan < 0.0f);
    const float zero = 0.0f, infinite = std::numeric_limits<float>::infinity();
    for (const float x : {zero / zero, zero * infinite, infinite - infinite, std::sqrt(-1.0f)})
        CHECK(std::isnan(x));
    CHECK(-zero == zero);
    CHECK(1.0f / -zero == -infinite);
    const double smallest = double{std::numeric_limits<float>::denorm_min()},
                 largest = double{std::numeric_limits<float>::max()};
    CHECK(smallest * smallest * smallest == 0x1p-447);
    CHECK(largest * largest * largest < 0x1p384);
    CHECK(largest * largest * largest > 0x1p383);
    rounding_page.check_says("at least \\f$2^{-447}\\f$, at most \\f$2^{384}\\f$");
}

TEST_CASE("step 7 of the staircase: what rounding does not keep") {
    const float a = 1e8f, b = -1e8f, c = 1.0f;
    CHECK((a + b) + c != a + (b + c));
    int differ = 0;
    for (float x = 1; x < 50; ++x)
        for (float y = 1; y < 50; ++y) differ += x / y != x * (1.0f / y);
    CHECK(differ > 0);
}

}  // namespace space::ch02
