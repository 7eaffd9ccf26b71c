// Directions over a surface, all alike and by the cosine, seen from the side and from above.

#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/program/svg.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch11 {
namespace {

constexpr std::uint32_t hemisphere_samples = 300;
constexpr double hemisphere_radius = 140;

std::vector<Double3> directions_by(DirectionSample (*choose)(const Double3&, const Double2&)) {
    Sampler sampler(SamplePattern::sobol, hemisphere_samples, 3);
    std::vector<Double3> directions;
    for (std::uint32_t i = 0; i < hemisphere_samples; ++i) {
        sampler.start(0, i);
        directions.push_back(choose({0.0, 0.0, 1.0}, sampler.next_pair()).direction);
    }
    return directions;
}

/// A half circle over `foot`, from its right end to its left one.
std::vector<Point2> dome_over(Point2 foot) {
    std::vector<Point2> dome;
    for (int i = 0; i <= 64; ++i) {
        const Double2 p = circle_point(i / 128.0);
        dome.push_back(moved(foot, hemisphere_radius * p.x, -hemisphere_radius * p.y));
    }
    return dome;
}

}  // namespace

Svg fig_11_07(const Options&) {
    Svg svg(
        "Directions over a surface, all alike and in proportion to the cosine, from the side and "
        "from above",
        640, 500);
    const std::array choose{&uniform_hemisphere, &cosine_hemisphere};
    const std::array<std::string, 2> names{"uniform", "by the cosine"};
    for (std::size_t i = 0; i < choose.size(); ++i) {
        const double x = 160 + 320 * static_cast<double>(i);
        const Point2 foot = at(x, 190), centre = at(x, 352);
        svg.text(at(x, 26), names[i], {.size = 19, .bold = true});
        svg.polyline(dome_over(foot), {.stroke = Ink::quiet});
        svg.line(moved(foot, -150, 0), moved(foot, 150, 0));
        svg.circle(centre, hemisphere_radius, {.stroke = Ink::quiet});
        for (const Double3& d : directions_by(choose[i])) {
            svg.circle(moved(foot, hemisphere_radius * d.x, -hemisphere_radius * d.z), 2.5,
                       {.stroke = {}, .fill = Ink::blue});
            svg.circle(moved(centre, hemisphere_radius * d.x, -hemisphere_radius * d.y), 2.5,
                       {.stroke = {}, .fill = Ink::blue});
        }
    }
    return svg;
}

}  // namespace space::ch11
