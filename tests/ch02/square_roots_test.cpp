#include "chapters/ch02_intersection_tests/square_roots.hpp"

#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <array>
#include <map>

namespace space::ch02 {
namespace {

constexpr std::uint32_t stride = 1;  // all 2^24 floats

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float smallest = std::numeric_limits<float>::denorm_min();

std::uint32_t bits(float x) {
    return std::bit_cast<std::uint32_t>(x);
}

/// Positive normal floats, all exponents alike.
float positive(Pcg32& random) {
    return std::bit_cast<float>((1u + random.below(254)) << 23 | random.next() >> 9);
}

template <int Rounds>
int differing(int fours) {
    Pcg32 random(501);
    int different = 0;
    for (int i = 0; i < fours; ++i) {
        std::array<float, 4> a{}, roots{};
        for (float& x : a) x = positive(random);
        newton_roots<Rounds>(a, roots);
        const Float4 vector = newton_root<Rounds>(Float4{a[0], a[1], a[2], a[3]});
        const Simd4 simd = newton_root<Rounds>(Simd4([&](auto j) { return a[j]; }));
        for (std::size_t j = 0; j < 4; ++j) {
            const std::uint32_t alone = bits(newton_root<Rounds>(a[j]));
            different += bits(roots[j]) != alone;
            different += bits(vector[static_cast<int>(j)]) != alone;
            different += bits(simd[j]) != alone;
        }
    }
    return different;
}

}  // namespace

TEST_CASE(
    "over all floats from 1 to 4 each round of Newton's method has its worst error, and by "
    "division the third is the "
    "last that helps") {
    // In units in the last place.
    const std::map<std::string, double> worst{
        {"Newton 0", 408'333},    {"Newton 1", 6'795},    {"Newton 2", 2.694},
        {"Newton 3", 0.75},       {"Newton 4", 0.75},     {"reciprocal 0", 566'817},
        {"reciprocal 1", 28'403}, {"reciprocal 2", 77.1}, {"reciprocal 3", 2.51},
        {"reciprocal 4", 1.74},   {"library", 0.5}};
    int looked_at = 0;
    for (const RootForm& form : root_forms()) {
        const RootAccuracy found = root_accuracy(form, stride, 100);
        INFO(form.name << ": " << found.worst_binades << " ulp in [1, 4), " << found.worst_normal
                       << " over the exponents");
        if (const auto expected = worst.find(form.name); expected != worst.end()) {
            ++looked_at;
            CHECK(found.worst_binades <= 1.005 * expected->second);
            if (stride == 1) CHECK(found.worst_binades >= 0.98 * expected->second);
            // From binade to binade errors repeat, so no sample exceeds them.
            CHECK(found.worst_normal <= 1.005 * expected->second);
        } else {  // the processor's: its maker promises 1.5 * 2^-12, of which a round makes 3.4 *
                  // 2^-24, and some roundings
            CHECK(found.worst_binades <= (form.rounds == 0 ? 0x1p24 * 1.5 * 0x1p-12 : 7.0));
        }
        if (form.name == "Newton 3" && stride == 1) CHECK(found.correctly_rounded > 0.74);
        if (form.name == "library") CHECK(found.correctly_rounded == 1.0);
    }
    CHECK(looked_at == 11);
}

TEST_CASE(
    "four roots at a time, by arrays, vector types or std::experimental::simd, are bit for bit the "
    "scalar ones") {
    constexpr int fours = 20'000;
    CHECK(differing<0>(fours) == 0);
    CHECK(differing<1>(fours) == 0);
    CHECK(differing<2>(fours) == 0);
    CHECK(differing<3>(fours) == 0);
    CHECK(differing<4>(fours) == 0);
}

TEST_CASE(
    "the careful root gives zeros, infinity, NaN and negative numbers the answers of IEEE 754") {
    CHECK(bits(careful_newton_root<3>(0.0f)) == bits(0.0f));
    CHECK(bits(careful_newton_root<3>(-0.0f)) == bits(-0.0f));
    CHECK(careful_newton_root<3>(infinity) == infinity);
    for (const float bad :
         {nan, -nan, -1.0f, -smallest, -infinity, std::numeric_limits<float>::lowest()})
        CHECK(std::isnan(careful_newton_root<3>(bad)));
}

TEST_CASE(
    "the careful root is within one unit in the last place for denormals too, where the plain one "
    "is not") {
    Pcg32 random(502);
    double careful = 0.0;
    int plain_wrong = 0, samples = 0;
    const auto look = [&](float a) {
        const double exact = std::sqrt(double{a});
        careful = std::max(careful, ulps(careful_newton_root<3>(a), exact));
        plain_wrong += std::abs(newton_root<3>(a) - exact) > 1e-4 * exact;
        ++samples;
    };
    for (std::uint32_t pattern = 1; pattern < 4096; ++pattern) look(std::bit_cast<float>(pattern));
    for (int i = 0; i < 20'000; ++i) look(std::bit_cast<float>(1u + random.below((1u << 23) - 1)));
    CHECK(careful <= 0.76);
    CHECK(plain_wrong > samples / 5);
    for (int i = 0; i < 20'000; ++i) {
        const float a = positive(random);
        REQUIRE(bits(careful_newton_root<3>(a)) == bits(newton_root<3>(a)));
    }
}

}  // namespace space::ch02
