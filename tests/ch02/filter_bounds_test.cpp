// The bounds of the filtered exact test's filter against the errors that they bound, in exact
// arithmetic: on inputs that are bred for large errors. A bound that is too small fails here, and
// so does one that is much wider than it must be.
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>

namespace space::ch02 {
namespace {

constexpr int climbs = 10, steps = 20'000;

/// Long enough for sums of products of three differences of floats from 2^-60 to 2^60.
using Exact = mpf_class;
constexpr int exact_bits = 1024;
using ExactVector = std::array<Exact, 3>;

ExactVector exact(const Vector3& v) {
    return {Exact(double{v.x}, exact_bits), Exact(double{v.y}, exact_bits),
            Exact(double{v.z}, exact_bits)};
}
ExactVector operator-(const ExactVector& a, const ExactVector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
ExactVector cross(const ExactVector& a, const ExactVector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact dot(const ExactVector& a, const ExactVector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Exact outside(const Exact& x, const Exact& end) {
    return abs(x - end / 2) - abs(end) / 2;
}

/// Origin, direction and corners.
using Input = std::array<Vector3, 5>;

/// Errors as shares of their bounds. t's is 0 where the filter leaves t alone.
struct Shares {
    double u = 0.0, v = 0.0, t = 0.0;
};
constexpr double Shares::*shares[] = {&Shares::u, &Shares::v, &Shares::t};

/// The filter's numbers, computed as there, beside the exact ones.
Shares shares_of(const Input& input) {
    const auto& [origin, direction, corner_a, corner_b, corner_c] = input;
    const Double3 a{corner_a}, d{direction};
    const Double3 e1 = Double3(corner_b) - a, e2 = Double3(corner_c) - a, s = Double3(origin) - a;
    const Double3 p = glm::cross(d, e2), q = glm::cross(s, e1);
    const double det = glm::dot(p, e1), u = glm::dot(p, s), v = glm::dot(q, d);
    const double u_outside = FilteredExact::outside(u, det),
                 v_outside = FilteredExact::outside(v, det - u);
    const FilteredExact::Sizes sizes = FilteredExact::sizes(d, e1, e2, s);
    const double bound = FilteredExact::outside_bound(sizes);
    if (!(bound > 0.0)) return {};

    const ExactVector ea = exact(corner_a), ed = exact(direction), ee1 = exact(corner_b) - ea,
                      ee2 = exact(corner_c) - ea, es = exact(origin) - ea;
    const ExactVector ep = cross(ed, ee2), eq = cross(es, ee1);
    const Exact exact_det = dot(ep, ee1), exact_u = dot(ep, es), exact_v = dot(eq, ed);
    const auto share = [](const Exact& error, double of) { return Exact(abs(error) / of).get_d(); };
    Shares result;
    result.u = share(u_outside - outside(exact_u, exact_det), bound);
    result.v = share(v_outside - outside(exact_v, exact_det - exact_u), bound);
    if (u_outside < -bound && v_outside < -bound) {
        const double inverse = 1.0 / det, t = glm::dot(q, e2) * inverse,
                     slack = FilteredExact::t_bound(sizes, t, inverse);
        const Exact exact_t = dot(eq, ee2) / exact_det;
        const double low = t - slack, high = t + slack;
        result.t = exact_t < t ? share(t - exact_t, t - low) : share(exact_t - t, high - t);
    }
    return result;
}

float some_float(Pcg32& random) {
    const float mantissa = 1.0f + random.uniform();
    const float size = std::ldexp(mantissa, static_cast<int>(random.below(16)) - 8);
    return random.below(2) ? size : -size;
}

/// One component becomes another number, a neighbour, or that of another point.
void change(Input& input, Pcg32& random) {
    const int axis = static_cast<int>(random.below(3));
    float& x = input[random.below(5)][axis];
    switch (random.below(6)) {
        case 0:
            x = some_float(random);
            break;
        case 1:
            x = random.below(4) ? 0.5f * x : 0.0f;
            break;
        case 2:
            x = input[random.below(5)][axis];
            break;
        default: {  // some of its last bits
            const std::uint32_t mask = (1u << (1 + random.below(23))) - 1u;
            x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) ^ (random.next() & mask));
            if (!(std::abs(x) > 0x1p-30f && std::abs(x) < 0x1p30f)) x = some_float(random);
        }
    }
}

/// Hill climbing: a changed input takes the place of the best one if its share is no smaller.
double climb(double Shares::*share, std::uint64_t seed) {
    Pcg32 random(901, seed);
    Input best;
    for (Vector3& point : best)
        for (int axis = 0; axis < 3; ++axis) point[axis] = some_float(random);
    double most = shares_of(best).*share;
    for (int step = 0; step < steps; ++step) {
        Input next = best;
        const std::uint32_t changes = 1 + random.below(3);
        for (std::uint32_t i = 0; i < changes; ++i) change(next, random);
        if (const double found = shares_of(next).*share; found >= most) {
            most = found;
            best = next;
        }
    }
    return most;
}

/// The worst of some ten million inputs for u, for v and for t; then seven that were bred for other
/// bounds by other hands.
const Input bred[] = {
    {{{0x1.001b6cp+7f, 0x1.8b746ap-4f, 0x1.62aa4ap-3f},
      {0x1.8bb234p-7f, 0x1.86bf44p+5f, 0x1.8aa1acp-8f},
      {-0x1.dc1a1cp-5f, 0x1.5b56ecp-3f, -0x1.003f78p-2f},
      {0x0p+0f, 0x0p+0f, 0x1.9636b8p-8f},
      {0x1.4e8254p+0f, 0x1.ffb238p-8f, 0x1.509956p+7f}}},
    {{{-0x1.f2bc9ep-6f, -0x1.337366p-2f, 0x1.d05cb8p+7f},
      {0x1.e74d36p+2f, 0x1.4b3fb4p-8f, 0x1.dd0772p-7f},
      {-0x1.cf4f36p-6f, -0x1.e51a06p-1f, 0x1.b4edcap-2f},
      {0x1.314b14p-5f, 0x1.23bdd4p+5f, 0x1.bd9bc4p-2f},
      {-0x1.f72692p-6f, -0x1.9c8b86p-1f, 0x1.bd9f06p-2f}}},
    {{{0x1.f099f4p-5f, -0x1.b4cac4p+3f, -0x1.321902p+7f},
      {-0x1.a99274p-2f, -0x1.19ee2p-2f, -0x1.32192p+7f},
      {-0x1.a19fe4p-2f, -0x1.b10978p+3f, 0x1.177f9cp-2f},
      {0x1.d176b8p+1f, -0x1.b468c8p+3f, 0x1.b9e092p-2f},
      {-0x1.2df14ap-2f, 0x1.6220c4p-8f, 0x1.42c7dep-2f}}},
    {{{-0x1.20916ep-3f, -0x1.f41c1p+3f, -0x1.2508a4p-2f},
      {0x1.4571a6p+5f, 0x1.c239ep-4f, -0x1.a947f6p-4f},
      {-0x1.20916ep-3f, -0x1.f41c1p+3f, -0x1.2508a4p-2f},
      {-0x1.1bdadp-5f, 0x1.7597eep+5f, -0x1.a17986p-2f},
      {-0x1.f732fp-5f, -0x1.db486p+3f, 0x1.9fcdb2p+5f}}},
    {{{0x1.57564p+3f, -0x1.04349ep+8f, -0x1.701d5cp-4f},
      {0x1.4a314p+0f, 0x0p+0f, 0x1.9e1488p+9f},
      {0x1.43c8b2p+3f, 0x1.ca2aep+0f, 0x1.888edp-5f},
      {0x1.43c8b2p+3f, 0x1.ca2aep+0f, 0x1.888a7cp-5f},
      {0x1.4587bap-5f, 0x1.d677c4p+0f, 0x1.472f28p-4f}}},
    {{{-0x0p+0f, -0x1.da6e6p+10f, 0x1.14dd6cp-4f},
      {-0x1.0ce5b8p+4f, -0x1.a2ca32p-5f, 0x1.2edfcep-5f},
      {0x0p+0f, -0x1.25599ep-6f, -0x1.e79ab4p-1f},
      {0x1.ef3ea4p-6f, -0x1.e3898p-3f, -0x1.2418e4p+4f},
      {0x0p+0f, -0x1.255bep-6f, -0x1.e79ab4p-1f}}},
    {{{0x1.dd5f3cp+5f, 0x1.27eac8p-5f, -0x1.411a62p+9f},
      {-0x1.9c43c8p+1f, 0x1.3fa77p-1f, 0x1.b4239p+5f},
      {0x1.b89bf4p+5f, -0x0p+0f, -0x1.02c11p-6f},
      {0x1.715a08p+1f, -0x1.00048cp-3f, 0x1.dfb522p-3f},
      {0x1.b84d94p+5f, -0x1.00651p+6f, -0x1.f4fa18p-6f}}},
    {{{0x1.cc33a8p+6f, 0x0p+0f, -0x1.da2fcp-2f},
      {0x1.7833ap-4f, 0x1.f31582p+5f, 0x1.ea9238p-2f},
      {0x1.4de474p-4f, -0x1.29f2b8p-6f, 0x0p+0f},
      {0x1.5f3744p-5f, -0x1.4e1d5cp-6f, -0x1.29c67p+2f},
      {0x1.4748f8p-4f, -0x0p+0f, -0x0p+0f}}},
    {{{0x1.eb744p+11f, -0x1.300112p-1f, 0x1.07a55ap+0f},
      {-0x1.1f3888p-3f, -0x1.cf025cp-2f, 0x1.8671bep+5f},
      {-0x1.8cce28p+0f, 0x1.5fe464p+3f, 0x1.598664p-5f},
      {-0x1.8cce28p+0f, 0x1.5fe464p+3f, 0x1.598664p-5f},
      {-0x1.77ac02p+0f, -0x1.160d6ep-3f, 0x1.aa348p-4f}}},
    {{{0x1.e28fa4p+9f, 0x0p+0f, -0x1.c43e36p+1f},
      {0x1.4be384p-5f, 0x1.fa27c6p+1f, -0x1.984d3p-6f},
      {0x1.7184c8p+1f, -0x1.1f787cp-3f, -0x1.90e46p+0f},
      {0x1.29cb5ap+1f, -0x1.f3c72cp-6f, -0x1.311a58p+4f},
      {0x1.563054p+1f, -0x1.d56c74p-4f, -0x1.a88d0ep+0f}}},
};

}  // namespace

TEST_CASE(
    "no error in the filter exceeds its bound, and inputs bred for large errors come near to it") {
    const char* names[] = {"u", "v", "t"};
    const double floors[] = {0.67, 0.64, 0.30};
    for (int i = 0; i < 3; ++i) {
        double most = 0.0, climbed = 0.0;
        for (const Input& input : bred) most = std::max(most, shares_of(input).*shares[i]);
        for (std::uint64_t seed = 0; seed < climbs; ++seed)
            climbed = std::max(climbed, climb(shares[i], seed));
        std::printf("%s: largest error / bound %.3f, climbed %.3f\n", names[i], most, climbed);
        INFO(names[i] << ": largest error / bound " << most << ", climbed " << climbed);
        CHECK(std::max(most, climbed) <= 1.0);
        CHECK(most >= floors[i]);
        CHECK(climbed >= 0.1);
    }
}

}  // namespace space::ch02
