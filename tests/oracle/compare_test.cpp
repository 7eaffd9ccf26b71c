#include "tests/oracle/compare.hpp"

#include "tests/catch.hpp"

#include <cmath>

namespace space {
namespace {

Triangle layer(float z) {
    return {{-4, -4, z}, {8, -4, z}, {-4, 8, z}};
}
/// Far in front; two at the same t; one a float behind them, which a distant origin cannot tell
/// apart; one far behind.
const std::vector<Triangle> layers{layer(2), layer(1), layer(1), layer(std::nextafter(1.0f, 0.0f)),
                                   layer(-2)};
const ExactOracle oracle = ExactOracle::build(layers);

Ray down(float z) {
    return {.origin = {0, 0, z}, .direction = {0, 0, -1}};
}
Agreement judged(const Ray& ray, std::optional<Hit> answer) {
    return compare(oracle, ray, answer).agreement;
}

}  // namespace

TEST_CASE("right answers agree, ties are told") {
    CHECK(judged(down(4), Hit{.t = 2, .triangle = 0}) == Agreement::agree);
    CHECK(judged(down(1.5f), Hit{.t = 0.5f, .triangle = 1}) == Agreement::tie);
    CHECK(judged(down(1.5f), Hit{.t = 0.5f, .triangle = 2}) == Agreement::tie);
    CHECK(judged({.origin = {0, 0, 4}, .direction = {0, 0, 1}}, std::nullopt) == Agreement::agree);
}

TEST_CASE("an order that t cannot tell is an inversion, any other order is wrong") {
    const Ray far = {.origin = {0, 0, 0x1p20f}, .direction = {0, 0, -1}, .tmin = 0x1p20f - 1.5f};
    const float t = 0x1p20f - 1;
    CHECK(judged(far, Hit{.t = t, .triangle = 3}) == Agreement::inversion);
    CHECK(judged(down(1.5f), Hit{.t = 0.5f, .triangle = 3}) == Agreement::inversion);
    CHECK(judged(down(1.5f), Hit{.t = 3.5f, .triangle = 4}) == Agreement::wrong_triangle);
    CHECK(judged(down(4), Hit{.t = 3, .triangle = 1}) == Agreement::wrong_triangle);
    CHECK(judged(down(4), Hit{.t = 2, .triangle = 99}) == Agreement::wrong_triangle);
}

TEST_CASE(
    "hits and misses that are none are wrong, and beyond the bound unless they are near an edge") {
    const Comparison miss = compare(oracle, down(4), std::nullopt);
    CHECK(miss.agreement == Agreement::wrong_miss);
    CHECK(miss.wrongly_decided == 0u);
    CHECK(miss.beyond_bound);

    const Ray beside{.origin = {100, 0, 4}, .direction = {0, 0, -1}};
    const Comparison hit = compare(oracle, beside, Hit{.t = 2, .triangle = 0});
    CHECK(hit.agreement == Agreement::wrong_hit);
    CHECK(hit.beyond_bound);

    const Ray behind{.origin = {0, 0, 0}, .direction = {0, 0, -1}, .tmin = 0, .tmax = 1};
    CHECK(judged(behind, Hit{.t = 2, .triangle = 4}) == Agreement::wrong_hit);

    const Ray at_edge{.origin = {2, 2, 4}, .direction = {0, 0, -1}};
    const Comparison leak = compare(oracle, at_edge, std::nullopt);
    CHECK(leak.agreement == Agreement::wrong_miss);
    CHECK_FALSE(leak.beyond_bound);
}

TEST_CASE("a hit at the very end of the interval may be taken for outside") {
    Ray ray = down(4);
    ray.tmax = 2;
    CHECK(judged(ray, std::nullopt) == Agreement::interval_end);
    CHECK(judged(ray, Hit{.t = 2, .triangle = 0}) == Agreement::agree);
    ray.tmax = std::nextafter(2.0f, 0.0f);
    CHECK(judged(ray, Hit{.t = 2, .triangle = 0}) == Agreement::interval_end);
    ray.tmax = 1.9f;
    CHECK(judged(ray, Hit{.t = 2, .triangle = 0}) == Agreement::wrong_hit);
}

TEST_CASE(
    "t that is not the nearest float is counted, and told when rounding does not explain it") {
    const float t = 2, next = std::nextafter(t, 3.0f);
    CHECK_FALSE(compare(oracle, down(4), Hit{.t = t, .triangle = 0}).rounded);
    const Comparison off = compare(oracle, down(4), Hit{.t = next, .triangle = 0});
    CHECK(off.agreement == Agreement::agree);
    CHECK(off.rounded);
    CHECK(off.beyond_bound);  // t is exactly 2: half a float is explained, a whole one is not
}

TEST_CASE("a tally counts every ray, and says what was skipped") {
    Tally tally;
    tally.add(compare(oracle, down(4), Hit{.t = 2, .triangle = 0}));
    tally.add(compare(oracle, down(1.5f), Hit{.t = 0.5f, .triangle = 2}));
    tally.add(compare(oracle, down(4), std::nullopt));
    tally.skipped = 7;
    Tally sum = tally;
    sum += tally;
    CHECK(sum.examined() == 6);
    CHECK(sum.wrong() == 2);
    CHECK(sum[Agreement::tie] == 2);
    CHECK(sum.text() ==
          "agree 2, tie 2, wrong miss 2; t not the nearest float 0; beyond the error bound 2; "
          "skipped 14");
}

}  // namespace space
