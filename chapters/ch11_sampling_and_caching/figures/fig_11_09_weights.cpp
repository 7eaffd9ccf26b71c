// Two ways to choose a direction below a lamp: their densities, and how much a sample of each
// counts.

#include "chapters/ch11_sampling_and_caching/directions.hpp"
#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/multiple_importance.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace space::ch11 {
namespace {

/// A lamp of 2 x 2 at the height of a quarter, seen in the plane through its middle.
constexpr double weights_height = 0.25, weights_half = 1.0;

/// The densities of one direction, `degrees` from the normal.
struct TwoDensities {
    double cosine, area;

    explicit TwoDensities(double degrees) {
        const double angle = degrees * std::numbers::pi / 180.0;
        const Double3 direction{std::sin(angle), 0.0, std::cos(angle)};
        cosine = cosine_hemisphere_pdf({0.0, 0.0, 1.0}, direction);
        const double distance = weights_height / direction.z;
        const TriangleLight both_halves{.triangle = {},
                                        .index = 0,
                                        .normal = {0.0, 0.0, -1.0},
                                        .radiance = Double3(1.0),
                                        .area = 4.0 * weights_half * weights_half,
                                        .probability = 1.0,
                                        .before = 0.0};
        const bool meets = std::abs(distance * direction.x) <= weights_half;
        area = meets ? area_pdf(both_halves, direction.z, distance) : 0.0;
    }
};

/// A frame in which curves over -90 to 90 degrees are drawn.
struct AngleFrame {
    Point2 corner;
    double width, height, most;

    Point2 operator()(double degrees, double value) const {
        return moved(corner, width * (degrees + 90.0) / 180.0,
                     height * (1.0 - std::min(value / most, 1.0)));
    }
    template <class Curve>
    void draw(Svg& svg, const Curve& curve, const Style& style) const {
        std::vector<Point2> points;
        for (double degrees = -89.5; degrees < 90.0; degrees += 0.5)
            points.push_back((*this)(degrees, curve(TwoDensities(degrees))));
        svg.polyline(points, style);
    }
    void draw_axes(Svg& svg, const std::string& name) const {
        svg.line((*this)(-90, 0), (*this)(90, 0), {.stroke = Ink::quiet});
        for (int degrees = -90; degrees <= 90; degrees += 45) {
            svg.line((*this)(degrees, 0), moved((*this)(degrees, 0), 0, 6), {.stroke = Ink::quiet});
            svg.text(moved((*this)(degrees, 0), 0, 24), fmt::format("{}°", degrees),
                     {.ink = Ink::quiet, .size = 16});
        }
        svg.text(moved(corner, 0, -8), name, {.anchor = Anchor::start, .size = 18, .bold = true});
    }
};

}  // namespace

Svg fig_11_09(const Options&) {
    Svg svg("Densities of two ways to choose a direction, and the weights of their samples", 640,
            494);
    const AngleFrame densities{at(30, 36), 580, 160, 0.62}, weights{at(30, 262), 580, 160, 1.05};
    densities.draw_axes(svg, "densities");
    densities.draw(svg, [](const TwoDensities& p) { return p.cosine; }, {.stroke = Ink::blue});
    densities.draw(svg, [](const TwoDensities& p) { return p.area; }, {.stroke = Ink::vermillion});
    weights.draw_axes(svg, "weights");
    const auto draw_weights = [&](double (*heuristic)(double, double), bool dashed) {
        weights.draw(svg, [&](const TwoDensities& p) { return heuristic(p.cosine, p.area); },
                     {.stroke = Ink::blue, .dashed = dashed});
        weights.draw(
            svg,
            [&](const TwoDensities& p) { return p.area > 0.0 ? heuristic(p.area, p.cosine) : 0.0; },
            {.stroke = Ink::vermillion, .dashed = dashed});
    };
    draw_weights(&balance_heuristic, false);
    draw_weights(&power_heuristic, true);
    svg.text(densities(0, 0.34), "by the cosine", {.ink = Ink::blue, .size = 17, .halo = true});
    svg.text(densities(48, 0.5), "by area",
             {.anchor = Anchor::end, .ink = Ink::vermillion, .size = 17, .halo = true});
    svg.text(at(320, 484), "full: balance heuristic; dashed: power heuristic",
             {.ink = Ink::quiet, .size = 17});
    return svg;
}

}  // namespace space::ch11
