// The page on square roots holds what a machine computes.
#include "chapters/ch02_intersection_tests/square_roots.hpp"
#include "tests/text.hpp"

#include <algorithm>
#include <limits>

namespace space::ch02 {
namespace {

const Text roots_page("chapters/ch02_intersection_tests/roots.dox");

double relative(double computed, double exact) {
    return (computed - exact) / exact;
}
/// One digit, with or without its 1: "10^{-19}", "3 \cdot 10^{18}".
std::string size_of(double x) {
    const std::string text = power(x, 0);
    return text.starts_with("1 \\cdot ") ? text.substr(8) : text;
}

}  // namespace

TEST_CASE("the guess is off by as much as the page says, before and after the correction") {
    double uncorrected_most = 0.0, uncorrected_least = 1.0, most = 0.0, least = 0.0;
    for (float a = 1.0f; a < 4.0f; a += 0x1p-20f) {
        const double root = std::sqrt(double{a});
        const auto bits = std::bit_cast<std::uint32_t>(a) >> 1;
        const auto plain = std::bit_cast<float>((1u << 29) - (1u << 22) + bits);
        uncorrected_most = std::max(uncorrected_most, relative(double{plain}, root));
        uncorrected_least = std::min(uncorrected_least, relative(double{plain}, root));
        most = std::max(most, relative(double{root_guess(a)}, root));
        least = std::min(least, relative(double{root_guess(a)}, root));
    }
    CHECK(uncorrected_least >= 0.0);
    roots_page.check_says(fmt::format(
        "never too small, and {:.1f} % too large at \\f$a = 2\\f$ (it says {})",
        100.0 * uncorrected_most,
        std::bit_cast<float>((1u << 29) - (1u << 22) + (std::bit_cast<std::uint32_t>(2.0f) >> 1))));
    roots_page.check_says(fmt::format(
        "`0x4C000`, {:.3f} in units of \\f$m\\f$, which leaves at most {:.1f} % on both sides",
        0x4C000 * 0x1p-23, 100.0 * std::max(most, -least)));
}

TEST_CASE("the rounds for 2 are those of the page") {
    const double root = std::sqrt(2.0);
    const double guess{root_guess(2.0f)}, first{newton_root<1>(2.0f)}, second{newton_root<2>(2.0f)},
        third{newton_root<3>(2.0f)};
    roots_page.check_says(fmt::format(
        "the guess {:.4f} is {:.1f} % too large; then {:.5f} ({} too large), {:.8f} ({}), {:.8f}:",
        guess, 100.0 * relative(guess, root), first, formula(power(relative(first, root), 0)),
        second, formula(power(relative(second, root), 1)), third));
    CHECK(third == double{static_cast<float>(root)});
}

TEST_CASE("what the trick does not know comes out as the page says") {
    roots_page.check_says(fmt::format(
        "The guess for 0 is about {}, and three rounds make it {}; the root of \\f$-0\\f$ comes "
        "out "
        "as {}, of \\f$-1\\f$ as {}, of infinity as NaN.",
        formula(size_of(double{root_guess(0.0f)})), formula(size_of(double{newton_root<3>(0.0f)})),
        formula(size_of(double{newton_root<3>(-0.0f)})),
        formula(size_of(double{newton_root<3>(-1.0f)}))));
    CHECK(std::isnan(newton_root<3>(std::numeric_limits<float>::infinity())));
}

}  // namespace space::ch02
