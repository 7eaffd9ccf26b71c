// All volumes around the same part: some segments that a tree keeps together.

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bounding_sphere.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/tight_box.hpp"
#include "common/program/plane_view.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch07 {
namespace {

constexpr double side = 212;  ///< of a panel

/// The largest subtree of at most seven segments.
std::vector<Segment> part_of_scene() {
    const std::vector<Segment> segments = scattered_segments();
    const BvhNodes<2> tree = MedianBuilder::build<2>(segments, {.max_leaf_size = 7});
    std::vector<Segment> part;
    tree.for_each_node([&](std::uint32_t index, unsigned) {
        if (tree.own(index).size() <= part.size()) return;
        part.clear();
        for (const std::uint32_t i : tree.own(index)) part.push_back(segments[i]);
    });
    return part;
}

/// Where panels stand, and what of the plane they show.
struct Panels {
    std::vector<Segment> part = part_of_scene();
    std::vector<Point2> points = corners_of<2>(part);
    std::vector<Double2> hull = convex_hull({points.begin(), points.end()});
    BoundingSphere<2> frame = ritter_sphere<2>(points);

    PlaneView view(int column, int row) const {
        const double scale = 0.44 * side / frame.radius, size = side / scale;
        const Double2 corner(8 + (side + 4) * column, 30 + (side + 66) * row);
        const Double2 low = Double2(frame.centre) - 0.5 * size;
        return {.corner = corner + scale * Double2(-low.x, low.y), .scale = scale, .size = size};
    }
    double hull_length() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < hull.size(); ++i)
            sum += glm::distance(hull[i], hull[(i + 1) % hull.size()]);
        return sum;
    }
};

constexpr Style filled{.stroke = Ink::blue, .fill = Ink::sky, .opacity = 0.3};

void draw_outline(Svg& svg, const PlaneView& view, const BoundingSphere<2>& circle) {
    svg.circle(view(Double2(circle.centre)), view.scale * circle.radius, filled);
    svg.circle(view(Double2(circle.centre)), 3, {.stroke = {}, .fill = Ink::blue});
}
void draw_outline(Svg& svg, const PlaneView& view, const OrientedBounds<2>& box) {
    const auto c = corners(box);
    svg.polygon(view({c[0], c[1], c[3], c[2]}), filled);
}
void draw_outline(Svg& svg, const PlaneView& view, const KDop<8, 2>& octagon) {
    std::vector<Double2> corners = outline_of(octagon);
    for (Double2& p : corners) p += middle_and_size(octagon).first;
    svg.polygon(view(corners), filled);
}

template <class Volume>
void draw_panel(Svg& svg, const Panels& panels, int column, int row, const char* name,
                const Volume& volume) {
    const PlaneView view = panels.view(column, row);
    const double x = 8 + (side + 4) * column + 0.5 * side, y = 30 + (side + 66) * row;
    svg.text(at(x, y - 8), name, {.size = 17, .bold = true});
    draw_outline(svg, view, volume);
    svg.polygon(view(panels.hull), {.stroke = Ink::quiet, .dashed = true});
    for (const Segment& s : panels.part) svg.line(view(Double2(s.a)), view(Double2(s.b)));
    svg.text(at(x, y + side + 22),
             fmt::format("{:.2f} of the hull's", surface(volume) / panels.hull_length()),
             {.size = 17});
}

}  // namespace

Svg fig_07_12(const Options&) {
    const Panels panels;
    const std::span<const Point2> points(panels.points);
    Svg svg(
        "Six volumes around the same segments, each with the length of its boundary beside the "
        "convex hull's",
        8 + 3 * side + 8 + 8, 30 + 2 * side + 66 + 36);
    draw_panel(svg, panels, 0, 0, "axis-aligned box", bounds_along<2>(Frame<2>(1.0), points));
    draw_panel(svg, panels, 1, 0, "box, principal axes", principal_box<2>(points));
    draw_panel(svg, panels, 2, 0, "smallest box", tight_box<2>(points));
    draw_panel(svg, panels, 0, 1, "Ritter's circle", ritter_sphere<2>(points));
    draw_panel(svg, panels, 1, 1, "smallest circle", smallest_sphere<2>(points));
    draw_panel(svg, panels, 2, 1, "8-DOP", k_dop_around<8, 2>(points));
    return svg;
}

}  // namespace space::ch07
