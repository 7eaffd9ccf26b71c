#include "ex01_pareto_front.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace space;

namespace {

using Places = std::vector<std::size_t>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// As a reader would write them down.
std::string text_of(const std::vector<BuildAndTrace>& structures) {
    std::string text;
    for (const BuildAndTrace& s : structures)
        text += "(" + shortest(s.build_ms) + " ms, " + shortest(s.trace_ns) + " ns) ";
    return text;
}

/// The front by its definition, in the asked order.
Places front_of(const std::vector<BuildAndTrace>& all) {
    Places front;
    for (std::size_t i = 0; i < all.size(); ++i) {
        bool stays = !std::isnan(all[i].build_ms) && !std::isnan(all[i].trace_ns);
        for (const BuildAndTrace& other : all) {
            const bool no_worse =
                other.build_ms <= all[i].build_ms && other.trace_ns <= all[i].trace_ns;
            const bool better =
                other.build_ms < all[i].build_ms || other.trace_ns < all[i].trace_ns;
            stays = stays && !(no_worse && better);
        }
        if (stays) front.push_back(i);
    }
    std::ranges::stable_sort(front, {}, [&](std::size_t i) { return all[i].build_ms; });
    return front;
}

void check(const std::vector<BuildAndTrace>& structures, const Places& front) {
    CAPTURE(text_of(structures));
    REQUIRE(pareto_front(structures) == front);
}

/// Times of a few values, so that many are equal; one of `gave_up` is NaN.
std::vector<BuildAndTrace> random_structures(Pcg32& random, std::uint32_t values,
                                             std::uint32_t gave_up) {
    std::vector<BuildAndTrace> all(1 + random.below(12));
    for (BuildAndTrace& s : all) {
        s.build_ms = random.below(values);
        s.trace_ns = 1.0 + random.below(values);
        if (gave_up > 0 && random.below(gave_up) == 0) s.build_ms = none;
        if (gave_up > 0 && random.below(gave_up) == 0) s.trace_ns = none;
    }
    return all;
}

}  // namespace

TEST_CASE("one structure is the front, and of none there is none") {
    check({}, {});
    check({{5.0, 80.0}}, {0});
    check({{0.0, 1e6}}, {0});  // the naive loop builds nothing
}

TEST_CASE("worse in both times is beaten; better in one of them is not") {
    check({{1.0, 9.0}, {2.0, 10.0}}, {0});
    check({{2.0, 10.0}, {1.0, 9.0}}, {1});
    check({{1.0, 9.0}, {2.0, 8.0}}, {0, 1});
    check({{0.0, 9e5}, {30.0, 200.0}, {90.0, 150.0}, {95.0, 170.0}, {400.0, 140.0}}, {0, 1, 2, 4});
}

TEST_CASE("as good in one time and better in the other beats") {
    check({{1.0, 9.0}, {1.0, 8.0}}, {1});
    check({{1.0, 8.0}, {1.0, 9.0}}, {0});
    check({{1.0, 9.0}, {2.0, 9.0}}, {0});
    check({{2.0, 9.0}, {1.0, 9.0}}, {1});
    check({{1.0, 9.0}, {1.0, 8.0}, {2.0, 8.0}, {2.0, 7.0}}, {1, 3});
}

TEST_CASE("two with the same times do not beat each other, and stay as they stood") {
    check({{1.0, 9.0}, {1.0, 9.0}}, {0, 1});
    check({{2.0, 8.0}, {1.0, 9.0}, {2.0, 8.0}, {1.0, 9.0}, {2.0, 8.0}}, {1, 3, 0, 2, 4});
    check({{2.0, 8.0}, {2.0, 8.0}, {1.0, 7.0}}, {2});
}

TEST_CASE("a hundred, many with the same times, stay as they stood") {
    std::vector<BuildAndTrace> many;
    for (int i = 0; i < 100; ++i) many.push_back({double(i * 7 % 3), double(3 - i * 7 % 3)});
    check(many, front_of(many));
}

TEST_CASE("what gave up is not on the front and beats nobody, whichever time is missing") {
    check({{none, none}}, {});
    check({{none, 5.0}, {5.0, none}}, {});
    check({{none, 5.0}, {2.0, 8.0}}, {1});
    check({{1.0, none}, {2.0, 8.0}}, {1});
    check({{2.0, 8.0}, {none, 1.0}, {3.0, 7.0}, {0.0, none}, {4.0, 9.0}, {none, none}}, {0, 2});
}

TEST_CASE("the front runs from the shortest build to the longest, however the structures stand") {
    check({{400.0, 140.0}, {0.0, 9e5}, {90.0, 150.0}, {30.0, 200.0}}, {1, 3, 2, 0});
    std::vector<BuildAndTrace> many;
    for (int i = 0; i < 50; ++i) many.push_back({double(i * 37 % 50), double(50 - i * 37 % 50)});
    check(many, front_of(many));
}

TEST_CASE("1,000 charts, most with equal times and some with NaN: none too many, none missing") {
    Pcg32 random(121);
    for (int i = 0; i < 1'000; ++i) {
        const auto structures = random_structures(random, 2 + std::uint32_t(i % 7), i % 3 ? 9 : 0);
        check(structures, front_of(structures));
    }
}

TEST_CASE("times may be as small or as different as doubles are") {
    check({{1.0, 1.0}, {1.0 + 0x1p-52, 1.0}}, {0});
    check({{1.0 + 0x1p-52, 1.0}, {1.0, 1.0 + 0x1p-52}}, {1, 0});
    check({{1e-300, 1e300}, {1e300, 1e-300}, {1e300, 1e300}}, {0, 1});
}
