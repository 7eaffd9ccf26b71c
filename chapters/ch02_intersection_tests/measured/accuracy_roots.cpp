#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/square_roots.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace space::ch02 {
namespace {

template <int Rounds>
float by_reciprocal(float a) {
    return a * reciprocal_newton_root<Rounds>(a);
}
#if defined(__SSE__)
template <int Rounds>
float by_estimate(float a) {
    return a * hardware_reciprocal_root<Rounds>(a);
}
#endif
float library_root(float a) {
    return std::sqrt(a);
}

/// The error of the root of a in units in the last place, by the root in double, which is off by
/// 2^-29 of them.
double root_ulps(const RootForm& form, float a) {
    return ulps(form.root(a), std::sqrt(double{a}));
}

float float_of(std::uint32_t bits) {
    return std::bit_cast<float>(bits);
}

}  // namespace

const std::vector<RootForm>& root_forms() {
    static const std::vector<RootForm> all = [] {
        std::vector<RootForm> forms;
        const auto add = [&](const char* name, int rounds, float (*root)(float)) {
            forms.push_back({fmt::format(fmt::runtime(name), rounds), rounds, root});
        };
        const auto rounds = [&]<int... R>(std::integer_sequence<int, R...>) {
            (add("Newton {}", R, newton_root<R>), ...);
            (add("reciprocal {}", R, by_reciprocal<R>), ...);
        };
        rounds(std::make_integer_sequence<int, 5>{});
#if defined(__SSE__)
        add("estimate {}", 0, by_estimate<0>);
        add("estimate {}", 1, by_estimate<1>);
        add("estimate {}", 2, by_estimate<2>);
#endif
        add("library", 0, library_root);
        return forms;
    }();
    return all;
}

RootAccuracy root_accuracy(const RootForm& form, std::uint32_t stride, std::uint32_t samples) {
    RootAccuracy accuracy{form.name};
    constexpr std::uint32_t one = 127u << 23, four = 129u << 23;
    std::uint64_t count = 0, correct = 0;
    for (std::uint32_t bits = one; bits < four; bits += stride) {
        const double error = root_ulps(form, float_of(bits));
        accuracy.worst_binades = std::max(accuracy.worst_binades, error);
        correct += error <= 0.5;
        ++count;
    }
    accuracy.correctly_rounded = static_cast<double>(correct) / static_cast<double>(count);

    Pcg32 random(1);
    for (std::uint32_t exponent = 0; exponent < 255; ++exponent) {  // 0: the denormals
        double& worst = exponent == 0 ? accuracy.worst_denormal : accuracy.worst_normal;
        for (std::uint32_t i = 0; i < samples; ++i) {
            const std::uint32_t mantissa = random.next() >> 9;
            if (exponent != 0 || mantissa != 0)
                worst = std::max(worst, root_ulps(form, float_of(exponent << 23 | mantissa)));
        }
    }
    return accuracy;
}

}  // namespace space::ch02
