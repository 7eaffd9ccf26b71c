// When to build anew: costs by hand, and the best in hindsight against all that there are.
#include "chapters/ch09_instancing_and_motion/rebuild_policy.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace space {
namespace {

/// Frames whose rays cost what cost(built, frame) says, and are expected to.
template <class Cost>
MotionCosts costs_of(std::size_t frames, double build, double refit, const Cost& cost) {
    MotionCosts costs{.build = build, .refit = refit, .traced = {}, .expected = {}};
    for (std::size_t built = 0; built < frames; ++built) {
        std::vector<double> row;
        for (std::size_t frame = built; frame < frames; ++frame) row.push_back(cost(built, frame));
        costs.traced.push_back(row);
        costs.expected.push_back(row);
    }
    return costs;
}

/// Each frame since the build makes rays dearer by one.
MotionCosts steady(std::size_t frames, double build, double refit) {
    return costs_of(frames, build, refit, [](std::size_t built, std::size_t frame) {
        return 10.0 + double(frame - built);
    });
}

/// Random costs, which never grow when the tree is newer.
MotionCosts some_costs(std::size_t frames, Pcg32& random) {
    std::vector<std::vector<double>> growth(frames, std::vector<double>(frames));
    for (std::size_t frame = 0; frame < frames; ++frame) {
        double cost = random.uniform(1.0f, 5.0f);
        for (std::size_t built = frame + 1; built-- > 0;) {
            growth[built][frame] = cost;
            cost += random.below(3) ? random.uniform(0.0f, 2.0f) : 0.0f;
        }
    }
    const double build = random.uniform(1.0f, 12.0f), refit = random.uniform(0.0f, 1.0f);
    return costs_of(frames, build, refit,
                    [&](std::size_t built, std::size_t frame) { return growth[built][frame]; });
}

/// The least total, by trying all.
double least_of_all(const MotionCosts& costs) {
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t choice = 0; choice < 1u << (costs.frames() - 1); ++choice) {
        Rebuilds rebuilds(costs.frames());
        rebuilds[0] = true;
        for (std::size_t frame = 1; frame < costs.frames(); ++frame)
            rebuilds[frame] = (choice >> (frame - 1) & 1u) != 0;
        least = std::min(least, total_cost(costs, rebuilds));
    }
    return least;
}

}  // namespace

TEST_CASE("costs by hand: five frames, a build in the first and in the fourth") {
    const MotionCosts costs = steady(5, 7.0, 1.0);
    // 7 + 10, 1 + 11, 1 + 12, 7 + 10, 1 + 11
    CHECK(total_cost(costs, {true, false, false, true, false}) == 71.0);
    CHECK(total_cost(costs, {true, true, true, true, true}) == 85.0);
    CHECK(total_cost(costs, {true, false, false, false, false}) == 71.0);
}

TEST_CASE("policies by hand") {
    const MotionCosts costs = steady(8, 7.0, 1.0);
    CHECK(decided(RebuildEvery{3}, costs) == Rebuilds{1, 0, 0, 1, 0, 0, 1, 0});
    CHECK(decided(RebuildEvery{1}, costs) == Rebuilds(8, true));
    CHECK(decided(RebuildEvery{8}, costs) == Rebuilds{1, 0, 0, 0, 0, 0, 0, 0});
    // 12 is more than 1.15 times 10, and seen when the frame after it begins.
    CHECK(decided(RebuildByCost{1.15}, costs) == Rebuilds{1, 0, 0, 1, 0, 0, 1, 0});
    CHECK(decided(RebuildByCost{1.2}, costs) == Rebuilds{1, 0, 0, 0, 1, 0, 0, 0});
    // 0 + 1 + 2 + 3 are the 6 that a build costs more than a refit.
    CHECK(decided(RebuildByExcess{7.0, 1.0}, costs) == Rebuilds{1, 0, 0, 0, 1, 0, 0, 0});
    CHECK(decided(RebuildByExcess{7.5, 1.0}, costs) == Rebuilds{1, 0, 0, 0, 0, 1, 0, 0});
    CHECK(decided(RebuildEvery{1}, steady(0, 1.0, 0.0)).empty());
}

TEST_CASE("the best in hindsight by hand") {
    // Eight frames in two parts cost 2 (7 + 3) + 2 (10 + 11 + 12 + 13) = 112.
    const MotionCosts costs = steady(8, 7.0, 1.0);
    CHECK(best_in_hindsight(costs) == Rebuilds{1, 0, 0, 0, 1, 0, 0, 0});
    CHECK(total_cost(costs, best_in_hindsight(costs)) == 112.0);
    // Dear builds: never again. Cheap ones: always.
    CHECK(best_in_hindsight(steady(8, 1000.0, 1.0)) == Rebuilds{1, 0, 0, 0, 0, 0, 0, 0});
    CHECK(best_in_hindsight(steady(8, 1.5, 1.0)) == Rebuilds(8, true));
    CHECK(best_in_hindsight(steady(1, 5.0, 1.0)) == Rebuilds{1});
    CHECK(best_in_hindsight(steady(0, 5.0, 1.0)).empty());
    // All moves once, in frame 5.
    const auto once = costs_of(9, 20.0, 1.0, [](std::size_t built, std::size_t frame) {
        return built < 5 && frame >= 5 ? 50.0 : 10.0;
    });
    CHECK(best_in_hindsight(once) == Rebuilds{1, 0, 0, 0, 0, 1, 0, 0, 0});
}

TEST_CASE("the best in hindsight is the best of all, and no policy beats it") {
    Pcg32 random(5);
    for (int i = 0; i < sized(300, 60); ++i) {
        const std::size_t frames = 1 + random.below(9);
        const MotionCosts costs = some_costs(frames, random);
        const double best = total_cost(costs, best_in_hindsight(costs));
        CHECK(best == Approx(least_of_all(costs)).epsilon(1e-12));
        for (const std::size_t every : {1u, 2u, 5u})
            CHECK(total_cost(costs, decided(RebuildEvery{every}, costs)) >= best * (1 - 1e-12));
        for (const double factor : {1.0, 1.3, 2.0})
            CHECK(total_cost(costs, decided(RebuildByCost{factor}, costs)) >= best * (1 - 1e-12));
        CHECK(total_cost(costs, decided(RebuildByExcess{costs.build, costs.refit}, costs)) >=
              best * (1 - 1e-12));
    }
}

TEST_CASE("what is paid by the rule of the rent is bounded by what the best pays") {
    // With new trees that cost the same in each frame, what is paid beyond new trees' rays and
    // refits is at most twice what the best pays, and a frame's loss for each build.
    Pcg32 random(6);
    double largest = 0.0;
    for (int i = 0; i < sized(400, 80); ++i) {
        const std::size_t frames = 2 + random.below(60);
        std::vector<double> growth(frames + 1);
        double most = 0.0;
        for (std::size_t age = 1; age <= frames; ++age) {
            const double step = random.uniform(0.0f, 0.5f);
            growth[age] = growth[age - 1] + step;
        }
        const double build = random.uniform(5.0f, 40.0f), refit = random.uniform(0.0f, 1.0f);
        const MotionCosts costs = costs_of(
            frames, build, refit,
            [&](std::size_t built, std::size_t frame) { return 10.0 + growth[frame - built]; });
        const Rebuilds ours = decided(RebuildByExcess{build, refit}, costs);
        const double always_paid = double(frames) * (10.0 + refit) + build - refit;
        std::size_t built = 0, again = 0;
        for (std::size_t frame = 1; frame < frames; ++frame) {
            if (ours[frame]) built = frame, ++again;
            most = std::max(most, growth[frame - built]);
        }
        const double paid = total_cost(costs, ours) - always_paid,
                     best = total_cost(costs, best_in_hindsight(costs)) - always_paid;
        CHECK(paid <= 2.0 * best + double(again + 1) * most + 1e-9);
        if (best > 0.0) largest = std::max(largest, paid / best);
    }
    CHECK(largest > 1.2);
    CHECK(largest < 2.5);
}

}  // namespace space
