// One test in three orders: the answers are the same, and those of Möller & Trumbore in float.
#include "chapters/ch02_intersection_tests/branches.hpp"

#include "chapters/ch02_intersection_tests/measured/inputs.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "tests/catch.hpp"

#include <utility>

namespace space::ch02 {
namespace {

constexpr int rays_each = 10'000;

}  // namespace

TEST_CASE("the three orders give the same answer, bit for bit, on every class of input") {
    int hits = 0, different = 0, interval_ends = 0;
    for (const TriangleInput& input : triangle_inputs()) {
        Pcg32 random(903);
        for (int i = 0; i < rays_each; ++i) {
            auto [ray, triangle] = make_pair(input, random);
            const auto first = CheapFirst::intersect(ray, triangle);
            const auto compare = [&] {
                const auto cheap = CheapFirst::intersect(ray, triangle);
                different += DecideLast::intersect(ray, triangle) != cheap;
                different += ExpensiveFirst::intersect(ray, triangle) != cheap;
                return cheap.has_value();
            };
            hits += compare();
            if (!first) continue;
            // At the interval's ends, which are closed.
            ray.tmin = ray.tmax = first->t;
            interval_ends += !compare();
            ray.tmin = std::nextafter(first->t, infinity);
            ray.tmax = infinity;
            interval_ends += compare();
            ray.tmin = -infinity;
            ray.tmax = std::nextafter(first->t, -infinity);
            interval_ends += compare();
        }
    }
    CHECK(hits > rays_each);
    CHECK(different == 0);
    CHECK(interval_ends == 0);
}

TEST_CASE("the three orders hit corners and edges, and nothing beside them, behind or parallel") {
    const Triangle triangle{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const auto check = [&](auto test) {
        using Test = decltype(test);
        const auto from = [&](float x, float y, float tmax) {
            return Test::intersect({{x, y, 2}, {0, 0, -1}, 0.0f, tmax}, triangle);
        };
        CHECK(from(1, 2, infinity) == Hit{.t = 2, .triangle = 0, .u = 0.25f, .v = 0.5f});
        for (const auto& [x, y] : {std::pair{0.0f, 0.0f}, {4, 0}, {0, 4}, {2, 0}, {0, 2}, {2, 2}})
            CHECK(from(x, y, 2.0f));
        for (const auto& [x, y] :
             {std::pair{-0x1p-20f, 1.0f}, {1, -0x1p-20f}, {2, 2 + 0x1p-20f}, {5, 0}, {0, 5}})
            CHECK_FALSE(from(x, y, infinity));
        CHECK_FALSE(from(1, 1, 1.5f));
        CHECK_FALSE(Test::intersect({{1, 1, -2}, {0, 0, -1}}, triangle));
        CHECK_FALSE(Test::intersect({{-1, 1, 0}, {1, 0, 0}}, triangle));
        CHECK_FALSE(Test::intersect({{1, 1, 2}, {0, 0, -1}}, {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}}));
    };
    check(CheapFirst{});
    check(DecideLast{});
    check(ExpensiveFirst{});
}

TEST_CASE("the orders decide as the chapter's test in float does where nothing is near a border") {
    Pcg32 random(904);
    int hits = 0, different = 0;
    for (int i = 0; i < rays_each; ++i) {
        const auto [ray, triangle] = make_pair(triangle_inputs()[0], random);
        const auto ours = CheapFirst::intersect(ray, triangle),
                   theirs = MollerTrumboreFloat::intersect(ray, triangle);
        hits += theirs.has_value();
        different += ours.has_value() != theirs.has_value();
        if (ours && theirs) different += std::abs(ours->t - theirs->t) > 1e-5f * theirs->t;
    }
    CHECK(hits > rays_each / 20);
    CHECK(different == 0);
}

}  // namespace space::ch02
