#include "ex05_roulette_without_bias.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace space;

namespace {

const Double3 black{0.0};

double largest(const Double3& throughput) {
    return std::max({throughput.x, throughput.y, throughput.z});
}

/// How many of `n` paths go on, and what they carry on average, for n values of u in the middles of
/// n parts of [0, 1). If q is a multiple of 1 / n no value lies on it.
struct Survivors {
    int count = 0;
    Double3 mean{0.0};
};
Survivors survivors(const Double3& throughput, int bounce, int n) {
    Survivors all;
    for (int i = 0; i < n; ++i) {
        const Double3 after = after_roulette(throughput, bounce, (i + 0.5) / n);
        if (after != black) ++all.count;
        all.mean += after / double(n);
    }
    return all;
}

const std::vector<Double3> throughputs{{0.5, 0.5, 0.5},      {0.25, 0.5, 0.125}, {0.01, 0.02, 0.8},
                                       {0.001, 0.0005, 0.0}, {0.0, 0.003, 0.0},  {0.9, 0.2, 0.3},
                                       {0.95, 0.95, 0.95},   {0.96, 0.1, 0.5},   {0.99, 0.99, 0.99},
                                       {1.0, 1.0, 1.0},      {1.5, 0.3, 0.6},    {7.0, 8.0, 9.0}};

/// In a white furnace, where each surface sends out 1 - r and reflects r.
double furnace_path(const Double3& reflectance, Pcg32& random, int channel, int& bounces) {
    Double3 throughput{1.0};
    double radiance = 0.0;
    for (int bounce = 0; throughput != black && bounce < 5'000; ++bounce, ++bounces) {
        radiance += throughput[channel] * (1.0 - reflectance[channel]);
        throughput = after_roulette(throughput * reflectance, bounce, random.uniform_double());
    }
    return radiance;
}

}  // namespace

TEST_CASE("after the first three bounces every path goes on as it is") {
    for (const Double3& t : throughputs)
        for (int bounce = 0; bounce < 3; ++bounce)
            for (const double u : {0.0, 0.3, 0.9999}) {
                CAPTURE(t, bounce, u);
                REQUIRE(after_roulette(t, bounce, u) == t);
            }
}

TEST_CASE("a path that carries nothing carries nothing afterwards, for u = 0, too") {
    for (const double u : {0.0, 0x1p-53, 0.5, 0.9999})
        for (const int bounce : {0, 3, 100}) {
            CAPTURE(u, bounce);
            REQUIRE(after_roulette(black, bounce, u) == black);
        }
}

TEST_CASE("from bounce 3 on as many go on as the largest share says, but 95 of 100 at most") {
    for (const Double3& t : throughputs)
        for (const int bounce : {3, 4, 17, 1'000}) {
            CAPTURE(t, bounce);
            REQUIRE(survivors(t, bounce, 2'000).count ==
                    static_cast<int>(std::lround(2'000 * std::min(0.95, largest(t)))));
        }
}

TEST_CASE("on average a path carries as much as before, in each colour") {
    for (const Double3& t : throughputs) {
        const Double3 mean = survivors(t, 3, 2'000).mean;
        CAPTURE(t, mean);
        for (int channel = 0; channel < 3; ++channel)
            REQUIRE(mean[channel] == Approx(t[channel]).epsilon(1e-12));
    }
}

TEST_CASE("all that go on carry the same") {
    for (const Double3& t : throughputs) {
        Double3 first = black;
        for (int i = 0; i < 100; ++i) {
            const Double3 after = after_roulette(t, 5, i / 100.0);
            CAPTURE(t, i, after, first);
            if (after == black) continue;
            if (first == black) first = after;
            REQUIRE(after == first);
        }
    }
}

TEST_CASE("hardly any light: few go on, but some, and none carries too much or infinity") {
    for (const double share : {1e-9, 1e-100, 1e-300, 5e-324}) {
        const Double3 t{share, share, 0.0};
        CAPTURE(share);
        REQUIRE(after_roulette(t, 3, 0.5) == black);
        REQUIRE(after_roulette(t, 3, share) == black);  // u < q, not u <= q
        const Double3 after = after_roulette(t, 3, 0.0);
        REQUIRE((after == black || after == Double3(1.0, 1.0, 0.0)));
        // Someone must: for the lowest u, or for the highest.
        if (share > 1e-10) {
            REQUIRE((after != black || after_roulette(t, 3, 1.0 - 0x1p-53) != black));
        }
    }
}

TEST_CASE("between two perfect mirrors a path ends: after some 20 bounces on average") {
    Pcg32 random(117);
    int bounces = 0;
    for (int i = 0; i < 2'000; ++i) {
        int before = bounces;
        furnace_path(Double3(1.0), random, 0, bounces);
        CAPTURE(i);
        REQUIRE(bounces - before < 2'000);  // 0.95^2000 is 10^-44
    }
    // 3 and 1 / 0.05 more, with a standard deviation of 19.5 / sqrt(2000): five of them.
    CHECK(bounces / 2'000.0 == Approx(23.0).margin(5 * 19.5 / std::sqrt(2'000.0)));
}

TEST_CASE("a furnace is white in all colours, for bright walls and dark ones") {
    for (const Double3& reflectance :
         {Double3(0.5, 0.5, 0.5), Double3(0.9, 0.3, 0.1), Double3(0.97, 0.97, 0.97)})
        for (int channel = 0; channel < 3; ++channel) {
            Pcg32 random(118);
            const int n = sized(20'000, 4'000);
            double sum = 0.0, squares = 0.0;
            int bounces = 0;
            for (int i = 0; i < n; ++i) {
                const double radiance = furnace_path(reflectance, random, channel, bounces);
                sum += radiance;
                squares += radiance * radiance;
            }
            const double mean = sum / n, error = std::sqrt((squares / n - mean * mean) / n);
            CAPTURE(reflectance, channel, mean, error);
            REQUIRE(Error{std::abs(mean - 1.0), 5.0 * error + 1e-12});
        }
}
