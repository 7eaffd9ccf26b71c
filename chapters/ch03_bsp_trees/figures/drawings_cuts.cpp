// What a fragment's corner is, and what becomes of two neighbours' common edge.

#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/sketch.hpp"
#include "common/program/report.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace space::ch03 {
namespace {

/// The part of a polygon in front of a plane, by the chapter's cutter.
Fragment<3> front_of(const Cutter<3>& cutter, const Fragment<3>& fragment, std::uint32_t plane) {
    std::vector<int> sides;
    cutter.corner_sides(fragment, plane, sides);
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
            const Fragment<3> front = front_of(cutter, whole_polygon<3>(triangles[i], i), 0);
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

}  // namespace

// -------------------------------------------------------------------------------------------------
// 3.3 Corners, and cracks

Svg fig_03_03(const Options&) {
    Svg svg(
        "A fragment's corners are meets of planes; below, where two neighbours cut their "
        "common edge, by three grades",
        640, 584);

    // A triangle that two planes have cut.
    const std::vector<Triangle> triangle{{Point3(1, 1, 0), Point3(15, 2, 0), Point3(5, 10, 0)}};
    const std::vector<SplitPlane<3>> planes{
        SplitPlane<3>({Point3(4.5f, 11, 0), Point3(3, 0, 0), Point3(3, 0, -1)}),
        SplitPlane<3>({Point3(0, 4, 0), Point3(16, 7, 0), Point3(0, 4, 1)})};
    const Cutter<3> cutter(triangle, planes, Grade::exact, 0.0);
    const Fragment<3> fragment =
        front_of(cutter, front_of(cutter, whole_polygon<3>(triangle[0], 0), 0), 1);
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
    const auto name_of = [](Carrier carrier) {
        constexpr const char* edges[] = {"*ab*", "*bc*", "*ca*"};
        return carrier.is_original() ? std::string(edges[carrier.edge()])
                                     : fmt::format("*P*_{}", carrier.number() + 1);
    };
    constexpr std::array<std::pair<double, const char*>, 3> names{
        {{-14, "*a*"}, {16, "*b*"}, {14, "*c*"}}};
    for (std::size_t i = 0; i < 3; ++i)
        svg.text(moved(paper(whole[i]), names[i].first, i == 2 ? -4 : 12), names[i].second,
                 {.size = 20});
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

    // The common edge of two neighbours under a magnifying glass.
    const auto farthest_apart = [](Grade grade, int tries, int& differ) {
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
    };
    constexpr int tries = 10'000;
    constexpr double side = 200, cells = 6.0, unit = 0x1p-24;
    int differ = 0;
    const Neighbours shown = farthest_apart(Grade::thick_float, tries, differ);
    const auto middle = shown.cuts(Grade::exact)[0];
    const auto panel = [&](double left_side, const char* name, Grade grade) {
        const double top = 300;
        const auto map = [&](const Double3& p) {
            return Double2(left_side + side / 2 + (p.x - middle.x) / unit * side / cells,
                           top + side / 2 - (p.y - middle.y) / unit * side / cells);
        };
        const auto [one, other] = shown.cuts(grade);
        const Double2 way =
            glm::normalize(Double2(shown.q.x - shown.p.x, -(double{shown.q.y} - shown.p.y)));
        const ConvexCell frame{{left_side, top},
                               {left_side + side, top},
                               {left_side + side, top + side},
                               {left_side, top + side}};
        /// The part of the glass on one side of the line through a point.
        const auto half = [&](const ConvexCell& cell, const Double2& through, const Double2& along,
                              bool left_part) {
            ConvexCell part;
            const auto beyond = [&](const Double2& p) {
                return (left_part ? 1.0 : -1.0) *
                       (along.x * (p.y - through.y) - along.y * (p.x - through.x));
            };
            for (std::size_t i = 0; i < cell.size(); ++i) {
                const Double2 &p = cell[i], &q = cell[(i + 1) % cell.size()];
                if (beyond(p) >= 0.0) part.push_back(p);
                if (beyond(p) * beyond(q) < 0.0)
                    part.push_back(p + beyond(p) / (beyond(p) - beyond(q)) * (q - p));
            }
            return part;
        };
        const auto points = [](const ConvexCell& cell) {
            std::vector<Point2> list;
            for (const Double2& p : cell) list.push_back(Point2(p));
            return list;
        };
        svg.begin_group(name);
        svg.polygon(points(frame), {.stroke = {}, .fill = Ink::vermillion, .opacity = 0.85});
        for (const bool is_left : {true, false}) {
            const ConvexCell mine = half(frame, map(is_left ? one : other), -way, is_left);
            svg.polygon(points(mine), {.stroke = {}, .fill = Ink::paper});
            svg.polygon(points(mine),
                        {.stroke = {}, .fill = is_left ? Ink::sky : Ink::yellow, .opacity = 0.6});
        }
        for (int row = -4; row <= 4; ++row)
            for (int column = -4; column <= 4; ++column) {
                const Double2 dot = map({(std::floor(middle.x / unit) + column) * unit,
                                         (std::floor(middle.y / unit) + row) * unit, 0.0});
                if (dot.x > left_side + 2 && dot.x < left_side + side - 2 && dot.y > top + 2 &&
                    dot.y < top + side - 2)
                    svg.circle(Point2(dot), 1.8, {.stroke = {}, .fill = Ink::quiet});
            }
        svg.rect(at(left_side, top), at(side, side), {.stroke = Ink::quiet});
        svg.circle(Point2(map(one)), 7, {.stroke = Ink::ink, .fill = Ink::sky});
        if (one != other)
            svg.circle(Point2(map(other)), 7, {.stroke = Ink::ink, .fill = Ink::yellow});
        svg.end_group();
        int count = 0;
        farthest_apart(grade, tries, count);
        svg.text(at(left_side + side / 2, top + side + 26), name, {.size = 17, .bold = true});
        svg.text(
            at(left_side + side / 2, top + side + 50),
            count ? fmt::format("{} of {} differ", with_commas(static_cast<std::uint64_t>(count)),
                                with_commas(tries))
                  : "none differs",
            {.ink = count ? Ink::vermillion : Ink::ink, .size = 17});
    };
    panel(4, "own order", Grade::thick_float);
    panel(220, "canonical order", Grade::ordered_float);
    panel(436, "exact", Grade::exact);
    return svg;
}

}  // namespace space::ch03
