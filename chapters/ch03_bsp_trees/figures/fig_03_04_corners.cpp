// What a fragment's corner is, and what becomes of two neighbours' common edge.

#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"
#include "common/program/report.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace space::ch03 {
namespace {

/// The part of a polygon in front of a plane, by the chapter's cutter.
Fragment<3> front_of(const Cutter<3>& cutter, const Fragment<3>& fragment,
                     std::span<const SplitPlane<3>> planes, std::uint32_t plane) {
    std::vector<int> sides;
    cutter.corner_sides(fragment, planes[plane], sides);
    if (Cutter<3>::classify(sides) != PlaneSide::straddling) return fragment;
    return cutter.split(fragment, sides, plane).first;
}

/// Two triangles with a common edge from p to q, and a plane across it.
struct Neighbours {
    std::vector<Triangle> triangles;
    std::vector<SplitPlane<3>> planes;
    Point3 p, q;

    /// Where each of them says that the edge is cut. The edge is the first of the left one, and the
    /// first of the right one the other way round.
    std::array<Double3, 2> cuts(Grade grade) const {
        const Cutter<3> cutter(triangles, planes, grade, 0.0);
        std::array<Double3, 2> points;
        for (std::uint32_t i = 0; i < 2; ++i) {
            const Fragment<3> front =
                front_of(cutter, whole_polygon<3>(triangles[i], i), planes, 0);
            for (const auto& corner :
                 front.corners)  // the new corner on the common edge is near p - q
                if (on_edge(corner.at)) points[i] = corner.at;
        }
        return points;
    }
    bool on_edge(const Double3& point) const {
        const Double3 from(p), way = Double3(q) - from, to = point - from;
        const double along = glm::dot(to, way) / glm::dot(way, way);
        return along > 0x1p-20 && along < 1.0 - 0x1p-20 && glm::length(to - along * way) < 0x1p-20;
    }
};

/// All in the plane z = 0 where coordinates are neighbours of each other, 2^-24 apart; the plane is
/// at right angles to it.
Neighbours random_neighbours(Pcg32& random) {
    const auto point = [&](float low_x, float high_x, float low_y, float high_y) {
        return Point3(random_point(random, Aabb2{{low_x, low_y}, {high_x, high_y}}), 0.0f);
    };
    Neighbours n;
    n.p = point(0.72f, 0.78f, 0.51f, 0.58f);
    n.q = point(0.72f, 0.78f, 0.92f, 0.99f);
    const Point3 left = point(0.51f, 0.6f, 0.7f, 0.8f), right = point(0.9f, 0.99f, 0.7f, 0.8f);
    n.triangles = {{n.p, n.q, left}, {n.q, n.p, right}};
    const Point3 a = point(0.51f, 0.6f, 0.65f, 0.85f), b = point(0.9f, 0.99f, 0.65f, 0.85f);
    n.planes.push_back(SplitPlane<3>({a, b, {a.x, a.y, 1.0f}}));
    return n;
}

std::string name_of(Carrier carrier) {
    constexpr const char* edges[] = {"*ab*", "*bc*", "*ca*"};
    return carrier.is_original() ? std::string(edges[carrier.edge()])
                                 : fmt::format("*P*_{}", carrier.number() + 1);
}

/// The corners' numbers on the paper, and beside it what each of them is.
template <class Paper>
void draw_corners(Svg& svg, const Fragment<3>& fragment, const Paper& paper) {
    double y = 96;
    svg.text({404, y - 32}, "corner", {.anchor = Anchor::start, .size = 17, .bold = true});
    svg.text({476, y - 32}, "is where meet", {.anchor = Anchor::start, .size = 17, .bold = true});
    for (std::size_t i = 0; i < fragment.corners.size(); ++i) {
        const auto& corner = fragment.corners[i];
        const auto [before, after] = corner.carriers;
        svg.circle(paper(corner.at), 11, {.fill = Ink::paper});
        svg.text(moved(paper(corner.at), 0, 6), fmt::format("{}", i + 1),
                 {.size = 16, .bold = true});
        svg.text(at(424, y), fmt::format("{}", i + 1), {.size = 17, .bold = true});
        svg.text(at(476, y), name_of(before) + " and " + name_of(after),
                 {.anchor = Anchor::start, .size = 20});
        y += 32;
    }
}

/// A triangle that two planes have cut.
void draw_fragment(Svg& svg) {
    const std::vector<Triangle> triangle{{Point3(1, 1, 0), Point3(15, 2, 0), Point3(5, 10, 0)}};
    const std::vector<SplitPlane<3>> planes{
        SplitPlane<3>({Point3(4.5f, 11, 0), Point3(3, 0, 0), Point3(3, 0, -1)}),
        SplitPlane<3>({Point3(0, 4, 0), Point3(16, 7, 0), Point3(0, 4, 1)})};
    const Cutter<3> cutter(triangle, planes, Grade::exact, 0.0);
    const Fragment<3> half = front_of(cutter, whole_polygon<3>(triangle[0], 0), planes, 0),
                      fragment = front_of(cutter, half, planes, 1);
    const auto paper = [](const Double3& p) { return at(10 + 22 * p.x, 254 - 22 * p.y); };
    const auto outline = [&](const auto& corners) {
        std::vector<Point2> points;
        for (const auto& corner : corners) points.push_back(paper(corner));
        return points;
    };
    const std::vector<Double3> whole{triangle[0].a, triangle[0].b, triangle[0].c};
    std::vector<Double3> left;
    for (const auto& corner : fragment.corners) left.push_back(corner.at);
    svg.polygon(outline(whole), {.stroke = Ink::quiet, .dashed = true}, "triangle");
    svg.polygon(outline(left), {.stroke = {}, .fill = Ink::sky, .opacity = 0.45}, "fragment");
    for (const SplitPlane<3>& plane : planes)
        svg.line(paper(Double3(plane.through[0])), paper(Double3(plane.through[1])),
                 {.stroke = Ink::blue});
    svg.polygon(outline(left), {});
    svg.text({88, 24}, "*P*_1", {.ink = Ink::blue, .size = 20});
    svg.text({372, 90}, "*P*_2", {.ink = Ink::blue, .size = 20});
    constexpr std::array<std::pair<double, const char*>, 3> names{
        {{-14, "*a*"}, {22, "*b*"}, {14, "*c*"}}};
    for (std::size_t i = 0; i < 3; ++i)
        svg.text(moved(paper(whole[i]), names[i].first, i == 2 ? -4 : 12), names[i].second,
                 {.size = 20});
    draw_corners(svg, fragment, paper);
}

constexpr int tries = 10'000;

/// Of many random neighbours those whose cuts are farthest apart; how many differ.
Neighbours farthest_apart(Grade grade, int& differ) {
    Pcg32 random(3);
    Neighbours best;
    double most = -1.0;
    differ = 0;
    for (int i = 0; i < tries; ++i) {
        const Neighbours n = random_neighbours(random);
        const auto [one, other] = n.cuts(grade);
        differ += one != other;
        const double apart = glm::length(one - other);
        if (apart > most && other.x > one.x) most = apart, best = n;
    }
    return best;
}

/// A common edge under a magnifying glass: floats are seen as dots.
struct Glass {
    static constexpr double side = 200, cells = 6.0, unit = 0x1p-24, top = 300;
    const Neighbours& shown;
    Double3 middle;
    double left;

    Double2 operator()(const Double3& p) const {
        return Double2(left + side / 2 + (p.x - middle.x) / unit * side / cells,
                       top + side / 2 - (p.y - middle.y) / unit * side / cells);
    }
    ConvexCell frame() const {
        return {{left, top}, {left + side, top}, {left + side, top + side}, {left, top + side}};
    }
    /// The part of the glass on the left or on the right of the edge through a point.
    ConvexCell half(const Double3& through, bool is_left) const {
        const Double2 way = glm::normalize(
                          Double2(double{shown.q.x - shown.p.x}, -(double{shown.q.y} - shown.p.y))),
                      at = (*this)(through);
        return part_above(frame(), [&](const Double2& p) {
            return (is_left ? 1.0 : -1.0) * (way.y * (p.x - at.x) - way.x * (p.y - at.y));
        });
    }
};

std::vector<Point2> on_paper(const ConvexCell& cell) {
    std::vector<Point2> list;
    for (const Double2& p : cell) list.push_back(Point2(p));
    return list;
}

void draw_floats(Svg& svg, const Glass& glass) {
    for (int row = -4; row <= 4; ++row)
        for (int column = -4; column <= 4; ++column) {
            const Double2 dot =
                glass({(std::floor(glass.middle.x / Glass::unit) + column) * Glass::unit,
                       (std::floor(glass.middle.y / Glass::unit) + row) * Glass::unit, 0.0});
            if (dot.x > glass.left + 2 && dot.x < glass.left + Glass::side - 2 &&
                dot.y > Glass::top + 2 && dot.y < Glass::top + Glass::side - 2)
                svg.circle(Point2(dot), 1.8, {.stroke = {}, .fill = Ink::ink});
        }
}

void draw_glass(Svg& svg, const Glass& glass, const char* name, Grade grade) {
    const auto [one, other] = glass.shown.cuts(grade);
    svg.begin_group(name);
    svg.polygon(on_paper(glass.frame()), {.stroke = {}, .fill = Ink::vermillion, .opacity = 0.85});
    for (const bool is_left : {true, false}) {
        const ConvexCell mine = glass.half(is_left ? one : other, is_left);
        svg.polygon(on_paper(mine), {.stroke = {}, .fill = Ink::paper});
        svg.polygon(on_paper(mine),
                    {.stroke = {}, .fill = is_left ? Ink::sky : Ink::yellow, .opacity = 0.6});
    }
    draw_floats(svg, glass);
    svg.rect(at(glass.left, Glass::top), at(Glass::side, Glass::side), {.stroke = Ink::quiet});
    svg.circle(Point2(glass(one)), 7, {.stroke = Ink::ink, .fill = Ink::sky});
    if (one != other)
        svg.circle(Point2(glass(other)), 7, {.stroke = Ink::ink, .fill = Ink::yellow});
    svg.end_group();
    int count = 0;
    farthest_apart(grade, count);
    svg.text(at(glass.left + Glass::side / 2, Glass::top + Glass::side + 26), name,
             {.size = 17, .bold = true});
    svg.text(at(glass.left + Glass::side / 2, Glass::top + Glass::side + 50),
             count ? fmt::format("{} of {} differ", with_commas(static_cast<std::uint64_t>(count)),
                                 with_commas(tries))
                   : "none differs",
             {.ink = count ? Ink::vermillion : Ink::ink, .size = 17});
}

}  // namespace

Svg fig_03_04(const Options&) {
    Svg svg(
        "A fragment's corners are meets of planes; below, where two neighbours cut their "
        "common edge, by three grades",
        640, 584);
    draw_fragment(svg);
    int differ = 0;
    const Neighbours shown = farthest_apart(Grade::thick_float, differ);
    const Double3 middle = shown.cuts(Grade::exact)[0];
    draw_glass(svg, {shown, middle, 4}, "own order", Grade::thick_float);
    draw_glass(svg, {shown, middle, 220}, "canonical order", Grade::ordered_float);
    draw_glass(svg, {shown, middle, 436}, "exact", Grade::exact);
    return svg;
}

}  // namespace space::ch03
