/// @file
/// Error against time of pictures by paths, photons and cached irradiance, as plain values.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace space::ch11 {

/// A picture at one setting. Errors are relative: root mean squares over the pixels that are
/// judged, over the mean of these.
struct ErrorPoint {
    std::string method;      ///< what a line of the chart is
    std::string setting;     ///< what changes along it
    std::uint64_t work = 0;  ///< samples a pixel, photons, or records
    double seconds = 0.0;    ///< maps and caches included
    double error = 0.0;
    double bias = 0.0;  ///< the part of the error that the mean of many such pictures keeps
};

/// One scene's points, method after method, each from the fastest setting on.
struct Convergence {
    std::string scene;
    int width = 0, height = 0;
    std::uint64_t judged = 0;  ///< pixels
    double target = 0.0;       ///< an error that is good enough
    double resolution = 0.0;   ///< below this, an error is not told from none
    std::vector<ErrorPoint> points;

    std::vector<std::string> methods() const {
        std::vector<std::string> names;
        for (const ErrorPoint& p : points)
            if (std::ranges::find(names, p.method) == names.end()) names.push_back(p.method);
        return names;
    }
    std::vector<ErrorPoint> of(const std::string& method) const {
        std::vector<ErrorPoint> some;
        for (const ErrorPoint& p : points)
            if (p.method == method) some.push_back(p);
        return some;
    }
    /// Seconds until the error is `wanted`, along a method's line, straight between its points in
    /// both logarithms; of `paths`, which have no bias, also beyond the last, as one over the root
    /// of the time. None where a line does not come so far.
    std::optional<double> seconds_to(const std::string& method, double wanted) const {
        const std::vector<ErrorPoint> line = of(method);
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (line[i].error > wanted) continue;
            if (i == 0 || line[i - 1].error <= line[i].error) return line[i].seconds;
            const double part =
                std::log(line[i - 1].error / wanted) / std::log(line[i - 1].error / line[i].error);
            return line[i - 1].seconds * std::pow(line[i].seconds / line[i - 1].seconds, part);
        }
        if (!method.starts_with("paths") || line.empty()) return std::nullopt;
        const double ratio = line.back().error / wanted;
        return line.back().seconds * ratio * ratio;
    }
    /// The least of seconds_to over all methods whose names begin so.
    std::optional<double> least_seconds_to(const std::string& beginning, double wanted) const {
        std::optional<double> least;
        for (const std::string& method : methods()) {
            if (!method.starts_with(beginning)) continue;
            const std::optional<double> seconds = seconds_to(method, wanted);
            if (seconds && (!least || *seconds < *least)) least = seconds;
        }
        return least;
    }
    /// How many times as fast as paths the methods that begin so come to an error.
    std::optional<double> gain(const std::string& beginning, double wanted) const {
        const auto paths = least_seconds_to("paths", wanted),
                   other = least_seconds_to(beginning, wanted);
        return paths && other ? std::optional(*paths / *other) : std::nullopt;
    }
};

}  // namespace space::ch11
