#include "ex03_choose_a_splitter.hpp"

#include "common/pcg32.hpp"
#include "common/scene.hpp"
#include "tests/check.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

using namespace space;

namespace {

using Set = std::vector<Segment>;
using Candidates = std::vector<std::size_t>;

/// On which side of a -> b a point lies, in whole numbers.
int side(const Segment& line, const Point2& p) {
    const auto whole = [](float x) { return static_cast<std::int64_t>(x); };
    const std::int64_t area = (whole(line.b.x) - whole(line.a.x)) * (whole(p.y) - whole(line.a.y)) -
                              (whole(line.b.y) - whole(line.a.y)) * (whole(p.x) - whole(line.a.x));
    return area > 0 ? 1 : area < 0 ? -1 : 0;
}

double cost(const Set& set, std::size_t candidate, double split_weight) {
    int balance = 0, cuts = 0;
    for (const Segment& segment : set) {
        const int a = side(set[candidate], segment.a), b = side(set[candidate], segment.b);
        if (a * b < 0)
            ++cuts;
        else
            balance += a != 0 ? a : b;
    }
    return std::abs(balance) + split_weight * cuts;
}

Candidates all(const Set& set) {
    Candidates candidates(set.size());
    std::iota(candidates.begin(), candidates.end(), std::size_t{0});
    return candidates;
}

}  // namespace

TEST_CASE("G parts Heinonen's A to G three to three and cuts none: it is the best at any weight") {
    const Set set = heinonen_segments();
    for (const double weight : {0.0, 1.0, 8.0}) CHECK(choose_splitter(set, all(set), weight) == 6);
}

TEST_CASE("without G the weight of a cut decides between D and E") {
    // In front, behind, cut: A 1, 5, 0; D 2, 4, 0; E 3, 2, 1; F 1, 2, 3.
    const Set set = heinonen_segments();
    CHECK(choose_splitter(set, Candidates{0, 3, 4, 5}, 0.5) == 4);
    CHECK(choose_splitter(set, Candidates{0, 3, 4, 5}, 8.0) == 3);
    CHECK(choose_splitter(set, Candidates{0, 5}, 1.0) == 0);
}

TEST_CASE("of equal costs the earlier candidate counts") {
    const Set set = heinonen_segments();
    CHECK(choose_splitter(set, Candidates{3, 4}, 1.0) == 3);
    CHECK(choose_splitter(set, Candidates{4, 3}, 1.0) == 4);
    CHECK(choose_splitter(set, Candidates{5, 4}, 0.0) == 5);
}

TEST_CASE("only candidates are chosen") {
    const Set set = heinonen_segments();
    for (std::size_t i = 0; i < set.size(); ++i)
        CHECK(choose_splitter(set, Candidates{i}, 8.0) == i);
}

TEST_CASE("what only touches the line is not cut, and what lies on it counts on no side") {
    const Set set{{{0, 0}, {4, 0}},  // 0: 3 in front, 3 on it, 0 behind
                  {{0, 4}, {0, 8}},  // 1: 0 in front, 4 behind, 1 touching from behind
                  {{6, 0}, {8, 0}}, {{9, 0}, {8, 0}}, {{2, 0}, {2, 3}}, {{4, 1}, {3, 2}}};
    CHECK(cost(set, 0, 100.0) == 3.0);
    CHECK(choose_splitter(set, Candidates{1, 0}, 100.0) == 0);
}

TEST_CASE("of random sets with small whole coordinates the cheapest is chosen") {
    Pcg32 random(33);
    for (int round = 0; round < 2000; ++round) {
        const auto place = [&] { return static_cast<float>(random.below(7)); };
        Set set;
        while (set.size() < 12) {
            const float ax = place(), ay = place(), bx = place(), by = place();
            if (ax != bx || ay != by) set.push_back({{ax, ay}, {bx, by}});
        }
        Candidates candidates;
        for (int i = 0; i < 5; ++i) candidates.push_back(random.below(12));
        const double weight = std::array{0.0, 1.0, 3.5, 8.0}[random.below(4)];

        std::size_t best = candidates[0];
        for (const std::size_t candidate : candidates)
            if (cost(set, candidate, weight) < cost(set, best, weight)) best = candidate;
        const std::size_t chosen = choose_splitter(set, candidates, weight);
        CAPTURE(set, candidates, weight, cost(set, chosen, weight), cost(set, best, weight));
        REQUIRE(chosen == best);
    }
}
