/// @file
/// What chapter 11 counts and times of ways to sample, as plain values.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch11 {

/// Mean and variance of numbers, one after the other (Welford 1962).
struct RunningMean {
    std::uint64_t count = 0;
    double mean = 0.0, squares = 0.0;

    void add(double x) {
        ++count;
        const double difference = x - mean;
        mean += difference / double(count);
        squares += difference * (x - mean);
    }
    double variance() const { return squares / double(count - 1); }
    double error() const { return std::sqrt(variance() / double(count)); }
};

/// An irradiance by so many samples of one pattern.
struct PatternPoint {
    std::string_view integrand, pattern;
    std::uint64_t samples = 0;
    double error = 0.0;  ///< relative, root mean square over seeds
};

/// Many triangles of one size at distance 1, seen from all sides.
struct SphericalTrianglePoint {
    double size = 0.0;
    // The largest relative errors of the solid angle:
    double by_angles = 0.0;  ///< as the sum of three angles minus pi
    double by_volume = 0.0;  ///< as the program has it
};

/// One way of lighting in one scene.
struct LightingPoint {
    std::string scene;
    std::string_view lighting;
    double mean = 0.0;        ///< over the pixels
    double mean_error = 0.0;  ///< its standard error
    double variance = 0.0;    ///< of one sample, the mean over the pixels, over the mean squared
    double ns = 0.0;          ///< of a sample

    /// How much variance falls in a nanosecond.
    double efficiency() const { return 1.0 / (variance * ns); }
};

/// Rays that paths trace.
struct PathWorkPoint {
    std::string scene;
    std::uint64_t samples = 0, path_rays = 0, shadow_rays = 0;
};

/// An estimator beside an exact value: the mean over many seeds.
struct ReferencePoint {
    std::string what, estimator;
    double exact = 0.0;
    double exact_error = 0.0;  ///< a bound, where the value is not in closed form
    double mean = 0.0, error = 0.0;
    std::uint64_t seeds = 0;

    /// How many standard errors the mean is off; what rounding may do is none.
    double deviation() const {
        const double off =
            std::max(std::abs(mean - exact) - exact_error - 1e-9 * std::abs(exact), 0.0);
        return off == 0.0    ? 0.0
               : error > 0.0 ? off / error
                             : std::numeric_limits<double>::infinity();
    }
    bool agrees() const { return deviation() <= 5.0; }
};

/// All of it.
struct SamplingMeasurements {
    std::vector<PatternPoint> patterns;
    std::vector<SphericalTrianglePoint> spherical_triangles;
    std::vector<LightingPoint> lightings;  ///< empty where nothing is timed
    std::vector<PathWorkPoint> path_work;
    std::vector<ReferencePoint> references;
};

}  // namespace space::ch11
