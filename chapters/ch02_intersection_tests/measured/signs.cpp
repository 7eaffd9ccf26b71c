#include "chapters/ch02_intersection_tests/measured/signs.hpp"

#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace space::ch02 {
namespace {

using Whole3 = Exact3<Int128>;

Whole3 whole(const Vector3& v) {
    return {static_cast<Int128>(v.x), static_cast<Int128>(v.y), static_cast<Int128>(v.z)};
}
Double3 in_double(const Whole3& v) {
    return {to_double(v.x), to_double(v.y), to_double(v.z)};
}
double one_norm(const Double3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}
int sign_of(double x) {
    return (x > 0.0) - (x < 0.0);
}

Whole3 six_digits(Pcg32& random) {
    const auto digits = [&] { return static_cast<Int128>(100'000 + random.below(900'000)); };
    const Int128 x = digits(), y = digits(), z = digits();
    return {x, y, z};
}

/// x and y with a x + b y = gcd(a, b), by Euclid's algorithm.
struct Bezout {
    Int128 gcd, x, y;
};
Bezout bezout(Int128 a, Int128 b) {
    if (b == 0) return {a, 1, 0};
    const auto [gcd, x, y] = bezout(b, a % b);
    return {gcd, y, x - a / b * y};
}

/// Takes multiples of s and e, which leave d . (s x e) as it is, away from d until it is short.
void shorten(Whole3& d, const Whole3& s, const Whole3& e) {
    const Double3 ds = in_double(s), de = in_double(e);
    const double ss = glm::dot(ds, ds), ee = glm::dot(de, de), se = glm::dot(ds, de),
                 det = ss * ee - se * se;
    for (int i = 0; i < 3; ++i) {  // each round is as exact as doubles are
        const double along_s = glm::dot(in_double(d), ds), along_e = glm::dot(in_double(d), de);
        const auto m = static_cast<Int128>(std::round((along_s * ee - along_e * se) / det)),
                   n = static_cast<Int128>(std::round((along_e * ss - along_s * se) / det));
        d = {d.x - m * s.x - n * e.x, d.y - m * s.y - n * e.y, d.z - m * s.z - n * e.z};
    }
}

template <std::size_t N>
auto absolute(const Expansion<N>& x) {
    return x.sign() < 0 ? -x : x;
}
/// |x - end / 2| - |end / 2| - computed, exactly but for one rounding.
template <std::size_t N, std::size_t M>
double error_of_outside(double computed, const Expansion<N>& x, const Expansion<M>& end) {
    const auto half = end * 0.5;
    return (absolute(x - half) - absolute(half) + -computed).value();
}

}  // namespace

Volume volume_of(const WholeVectors& vectors) {
    const auto& [s, e, d] = vectors;
    const Double3 ds(s), de(e), dd(d);
    return {.in_float = double{glm::dot(glm::cross(s, e), d)},
            .in_double = glm::dot(glm::cross(ds, de), dd),
            .exact = to_double(space::dot(cross(whole(s), whole(e)), whole(d))),
            .bound = 7.0 * 0x1p-53 * one_norm(ds) * one_norm(de) * one_norm(dd)};
}

SignExample sign_example() {
    const auto hit = [&](auto test, const Triangle& triangle) {
        return decltype(test)::intersect(example_ray, triangle).has_value();
    };
    const auto row = [&](const char* arithmetic, double volume, auto test) {
        return SignRow{arithmetic, volume, hit(test, first_triangle), hit(test, second_triangle)};
    };
    const Volume volume = volume_of({example_ray.origin, example_b, example_ray.direction});
    return {.rows = {row("float", volume.in_float, MollerTrumboreFloat{}),
                     row("double", volume.in_double, MollerTrumbore{}),
                     row("exact", volume.exact, FilteredExact{})},
            .bound = volume.bound};
}

WholeVectors with_volume(std::int64_t volume, Pcg32& random) {
    for (;;) {
        const Whole3 s = six_digits(random), e = six_digits(random), n = cross(s, e);
        const auto [gcd, x, y] = bezout(n.x, n.y);
        if (gcd != 1 && gcd != -1) continue;
        Whole3 d{x * gcd * volume, y * gcd * volume, 0};
        shorten(d, s, e);
        return {Vector3(in_double(s)), Vector3(in_double(e)), Vector3(in_double(d))};
    }
}

LostSigns lost_signs(std::uint64_t volumes, std::uint64_t seed) {
    LostSigns lost{.volumes = volumes};
    Pcg32 random(seed);
    for (std::uint64_t i = 0; i < volumes; ++i) {
        const auto size = static_cast<std::int64_t>(1 + random.below(100));
        const Volume volume = volume_of(with_volume(random.below(2) ? size : -size, random));
        lost.in_float += sign_of(volume.in_float) != sign_of(volume.exact);
        lost.in_double += sign_of(volume.in_double) != sign_of(volume.exact);
        const bool certain = std::abs(volume.in_double) > volume.bound;
        lost.certain += certain;
        lost.certain_wrong += certain && sign_of(volume.in_double) != sign_of(volume.exact);
        lost.worst_error = std::max(lost.worst_error, std::abs(volume.in_double - volume.exact));
    }
    return lost;
}

double worst_known_share() {
    double worst = 0.0;
    for (const auto& [origin, direction, a, b, c] : bred_inputs) {
        const Double3 from(a), d(direction), e1 = Double3(b) - from, e2 = Double3(c) - from,
                                             s = Double3(origin) - from, p = glm::cross(d, e2),
                                             q = glm::cross(s, e1);
        const double det = glm::dot(p, e1), u = glm::dot(p, s), v = glm::dot(q, d);
        const double bound = FilteredExact::outside_bound(FilteredExact::sizes(d, e1, e2, s));
        const auto exact = expansion_volumes({origin, direction}, {a, b, c});
        const double of_u = error_of_outside(FilteredExact::outside(u, det), exact.u, exact.det),
                     of_v = error_of_outside(FilteredExact::outside(v, det - u), exact.v,
                                             exact.det - exact.u);
        worst = std::max({worst, std::abs(of_u) / bound, std::abs(of_v) / bound});
    }
    return worst;
}

const std::array<FilterInput, 10> bred_inputs{{
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
}};

}  // namespace space::ch02
