#include "ex04_amdahl.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

using namespace space;

namespace {

/// "none", or both parts.
std::string model_of(const TimedRun& a, const TimedRun& b) {
    const std::optional<AmdahlModel> model = fitted_model(a, b);
    if (!model) return "none";
    return std::to_string(model->serial + 0.0) + " s + " + std::to_string(model->divided + 0.0) +
           " s / n";
}
std::string needed(const AmdahlModel& model, double speedup) {
    const std::optional<std::uint64_t> threads = threads_for(model, speedup);
    return threads ? std::to_string(*threads) : "none";
}

}  // namespace

TEST_CASE("one and two threads: 12 s and 7 s are 2 s serial and 10 s divided") {
    CHECK(model_of({1, 12.0}, {2, 7.0}) == "2.000000 s + 10.000000 s / n");
    CHECK(model_of({2, 7.0}, {1, 12.0}) == "2.000000 s + 10.000000 s / n");
}

TEST_CASE("neither run needs to be that of one thread") {
    CHECK(model_of({2, 10.0}, {4, 7.0}) == "4.000000 s + 12.000000 s / n");
    CHECK(model_of({8, 5.5}, {4, 7.0}) == "4.000000 s + 12.000000 s / n");
    CHECK(model_of({3, 8.0}, {12, 5.0}) == "4.000000 s + 12.000000 s / n");
}

TEST_CASE("all may be serial, or nothing") {
    CHECK(model_of({1, 8.0}, {4, 8.0}) == "8.000000 s + 0.000000 s / n");
    CHECK(model_of({1, 8.0}, {4, 2.0}) == "0.000000 s + 8.000000 s / n");
    CHECK(model_of({2, 4.0}, {8, 1.0}) == "0.000000 s + 8.000000 s / n");
}

TEST_CASE("no model fits where more threads took longer, or gained more than their number") {
    CHECK(model_of({1, 8.0}, {2, 9.0}) == "none");
    CHECK(model_of({2, 9.0}, {1, 8.0}) == "none");
    CHECK(model_of({1, 8.0}, {4, 1.0}) == "none");
    CHECK(model_of({4, 1.0}, {2, 4.0}) == "none");
}

TEST_CASE("the speed-up is held against one thread") {
    const AmdahlModel model{1.0, 7.0};
    CHECK(modelled_speedup(model, 1) == 1.0);
    CHECK(modelled_speedup(model, 7) == 4.0);        // 8 s against 1 s + 1 s
    CHECK(modelled_speedup({2.0, 14.0}, 7) == 4.0);  // whatever the unit
    CHECK(modelled_speedup({0.0, 8.0}, 16) == 16.0);
    CHECK(modelled_speedup({8.0, 0.0}, 16) == 1.0);
}

TEST_CASE("the bound: what is serial remains") {
    CHECK(largest_speedup({1.0, 7.0}) == 8.0);
    CHECK(largest_speedup({2.0, 6.0}) == 4.0);
    CHECK(largest_speedup({3.0, 0.0}) == 1.0);
    CHECK(largest_speedup({0.0, 8.0}) == std::numeric_limits<double>::infinity());
    // 15 % serial: "at most 6.6 times", as the thesis has it, and a little more.
    CHECK(largest_speedup({15.0, 85.0}) == 100.0 / 15.0);
}

TEST_CASE("the least number of threads for a speed-up: just enough is enough") {
    const AmdahlModel model{1.0, 7.0};
    CHECK(needed(model, 4.0) == "7");
    CHECK(needed(model, std::nextafter(4.0, 5.0)) == "8");
    CHECK(needed(model, 2.0) == "3");  // 8 / (1 + 7/2) < 2 < 8 / (1 + 7/3)
    CHECK(needed({0.0, 8.0}, 16.0) == "16");
    CHECK(needed({0.0, 8.0}, 15.5) == "16");
}

TEST_CASE("one thread is enough for what asks for no gain") {
    CHECK(needed({1.0, 7.0}, 1.0) == "1");
    CHECK(needed({1.0, 7.0}, 0.25) == "1");
    CHECK(needed({8.0, 0.0}, 1.0) == "1");
}

TEST_CASE("the bound is never reached, and nothing beyond it") {
    CHECK(needed({1.0, 7.0}, 8.0) == "none");
    CHECK(needed({1.0, 7.0}, 100.0) == "none");
    CHECK(needed({8.0, 0.0}, 1.5) == "none");
    CHECK(needed({1.0, 7.0}, 7.9375) == "889");                     // 8 / (1 + 7/n): 7/n <= 1/127
    CHECK(needed({1.0, 7.0}, 8.0 / (1.0 + 0x1p-20)) == "7340032");  // 7 * 2^20
}

TEST_CASE("many models: the number of threads does it, and one less does not") {
    Pcg32 random(84);
    for (int i = 0; i < 5'000; ++i) {
        const double serial = 1.0 + random.below(1'000), divided = double(random.below(100'000));
        const double speedup = 1.0 + double(random.below(64)) / 8;
        const AmdahlModel model{serial, divided};
        const auto exact = [&](double n) { return (serial + divided) / (serial + divided / n); };
        CAPTURE(i, serial, divided, speedup);
        const std::optional<std::uint64_t> threads = threads_for(model, speedup);
        REQUIRE(threads.has_value() == ((serial + divided) / serial > speedup || speedup == 1.0));
        if (!threads) continue;
        REQUIRE(exact(double(*threads)) >= speedup * (1.0 - 1e-12));
        if (*threads > 1) REQUIRE(exact(double(*threads - 1)) < speedup);
    }
}

TEST_CASE("many models: two of their times give them back") {
    Pcg32 random(48);
    for (int i = 0; i < 5'000; ++i) {
        const double serial = random.below(1'000), divided = 1.0 + random.below(1'000);
        const unsigned p = 1 + random.below(64), q = p + 1 + random.below(64);
        const auto fit = fitted_model({p, serial + divided / p}, {q, serial + divided / q});
        CAPTURE(i, serial, divided, p, q);
        // Without a serial part rounding may make it a little less than none.
        if (serial == 0.0) continue;
        REQUIRE(fit);
        REQUIRE(std::abs(fit->serial - serial) < 1e-9 * (serial + divided) * q);
        REQUIRE(std::abs(fit->divided - divided) < 1e-9 * (serial + divided) * q);
    }
}
