// The strata of the square on a lamp's triangle, by area and by solid angle: on the lamp, and as
// the point below it sees them.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/spherical_triangle.hpp"
#include "common/pcg32.hpp"
#include "common/program/svg.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace space::ch11 {
namespace {

/// A lamp parallel to the floor, at the height 0.5 over the point that sees it.
constexpr Triangle lamp{{-0.35f, -0.3f, 0.5f}, {0.1f, 1.7f, 0.5f}, {1.65f, -0.35f, 0.5f}};
constexpr int lamp_strata = 8;  ///< on each side of the square

/// The point of the lamp for a point of the square, as a vector from the origin.
Double3 lamp_point(bool by_solid_angle, const Double2& u) {
    return by_solid_angle ? sample_solid_angle(SphericalTriangle(lamp, Double3(0.0)), u)
                          : uniform_point(lamp, u);
}

/// Equal solid angles have equal areas on this paper (Lambert 1772): the direction at the angle t
/// to the pole lies 2 sin(t / 2) from the middle.
Double2 on_equal_area_map(const Double3& p) {
    const Double3 d = glm::normalize(p);
    return Double2(d.x, d.y) * std::sqrt(2.0 / (1.0 + d.z));
}

/// One of the four drawings: a way of sampling, and whether the point's view is drawn.
struct LampDrawing {
    bool by_solid_angle, as_seen;
    Point2 corner;

    Point2 operator()(const Double2& u) const {
        const Double3 p = lamp_point(by_solid_angle, u);
        const Double2 q = as_seen ? on_equal_area_map(p) : Double2(p.x, p.y);
        return as_seen ? moved(corner, 146 + 122 * q.x, 172 - 122 * q.y)
                       : moved(corner, 66 + 122 * q.x, 222 - 122 * q.y);
    }
    /// The image of a line of the square, of those with u.x or with u.y fixed.
    std::vector<Point2> line(int fixed, double at_u) const {
        std::vector<Point2> points;
        for (int i = 0; i <= 32; ++i) {
            Double2 u(at_u);
            u[1 - fixed] = i / 32.0;
            points.push_back((*this)(u));
        }
        return points;
    }
};

}  // namespace

Svg fig_11_08(const Options&) {
    Svg svg(
        "A lamp's triangle with strata and samples, uniform in its area and in the solid angle, "
        "from below and as the point sees it",
        660, 586);
    const std::array<std::string, 2> names{"by area", "by solid angle"};
    for (std::size_t way = 0; way < 2; ++way)
        for (std::size_t view = 0; view < 2; ++view) {
            const LampDrawing drawing{
                way == 1, view == 1,
                at(20 + 320 * static_cast<double>(way), 40 + 280 * static_cast<double>(view))};
            if (view == 0)
                svg.text(moved(drawing.corner, 150, -12), names[way], {.size = 19, .bold = true});
            for (int i = 0; i <= lamp_strata; ++i) {
                const double u = double(i) / lamp_strata;
                const bool is_side = i == 0 || i == lamp_strata;
                const Style style{.stroke = is_side ? Ink::ink : Ink::faint};
                if (!is_side) svg.polyline(drawing.line(0, u), style);
                if (!is_side) svg.polyline(drawing.line(1, u), style);
            }
            std::vector<Point2> outline = drawing.line(0, 0.0);
            for (const Point2& p : drawing.line(1, 1.0)) outline.push_back(p);
            std::vector<Point2> back = drawing.line(0, 1.0);
            outline.insert(outline.end(), back.rbegin(), back.rend());
            svg.polygon(outline);
            Pcg32 random(5);
            for (int y = 0; y < lamp_strata; ++y)
                for (int x = 0; x < lamp_strata; ++x) {
                    Double2 u(x, y);
                    u.x += random.uniform_double();
                    u.y += random.uniform_double();
                    svg.circle(drawing(u / double(lamp_strata)), 3,
                               {.stroke = {}, .fill = Ink::blue});
                }
            if (view == 0)
                svg.circle(moved(drawing.corner, 66, 222), 6,
                           {.stroke = Ink::vermillion, .fill = Ink::vermillion});
        }
    return svg;
}

}  // namespace space::ch11
