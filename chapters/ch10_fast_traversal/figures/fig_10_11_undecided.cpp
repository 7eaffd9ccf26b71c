// What the float filter of leaves decides near a corner of a triangle: the kernels' own text, asked
// by a ray for each square.

#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/triangle_block.hpp"
#include "common/program/svg.hpp"

#define SPACE_ISA drawn
#include "chapters/ch10_fast_traversal/kernels/leaf_filter.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace space::ch10 {
namespace {

/// How the filter answers about one triangle.
enum class Answer : std::size_t { missed, undecided, hit };
constexpr std::array<Ink, 3> answer_inks{Ink::sky, Ink::orange, Ink::green};

/// Parallel rays near a corner, a square of the paper for each.
class FilterMap {
  public:
    FilterMap(const Triangle& triangle, Point2 corner) : triangle_(triangle), corner_(corner) {}

    void draw(Svg& svg) const {
        svg.begin_group("map");
        for (int y = 0; y < rays; ++y)
            for (int x = 0, next = 0; x < rays; x = next) {  // a run of equal answers
                const Answer here = answer(x, y);
                while (next < rays && answer(next, y) == here) ++next;
                svg.rect(moved(corner_, square * x, square * y), at(square * (next - x), square),
                         {.stroke = {},
                          .fill = answer_inks[static_cast<std::size_t>(here)],
                          .opacity = 0.75});
            }
        svg.end_group();
        svg.rect(corner_, at(square * rays, square * rays), {.stroke = Ink::quiet});
        draw_side(svg, triangle_.b);
        draw_side(svg, triangle_.c);
    }
    static constexpr int rays = 96, before = 36;  ///< of them to the left of the corner, and below
    static constexpr double square = 4.0, spacing = 0x1p-22;

  private:
    /// The side from the corner up to the frame.
    void draw_side(Svg& svg, const Point3& end) const {
        const Double2 way(double{end.x} - double{triangle_.a.x},
                          double{end.y} - double{triangle_.a.y});
        const double length = square * (rays - before) / std::max(way.x, way.y);
        const Point2 from = moved(corner_, square * before, square * (rays - before));
        svg.line(from, moved(from, length * way.x, -length * way.y));
    }
    Ray ray(int x, int y) const {
        const Double2 place = Double2(triangle_.a.x, triangle_.a.y) +
                              spacing * Double2(x - before + 0.5, rays - before - y - 0.5);
        return {{static_cast<float>(place.x), static_cast<float>(place.y), 1.0f},
                {0.0f, 0.0f, -1.0f},
                0.0f,
                2.0f};
    }
    Answer answer(int x, int y) const {
        TriangleBlock block;
        block.put(0, triangle_, 0);
        for (std::size_t lane = 1; lane < TriangleBlock::size; ++lane) block.clear(lane);
        KernelRay prepared;
        if (!prepare_kernel_ray(ray(x, y), 1.0f, prepared)) return Answer::undecided;
        const drawn::LeafLanes lanes = drawn::filter_leaf<true>(
            reinterpret_cast<const char*>(&block), prepared, prepared.limit);
        return lanes.must_hit != 0  ? Answer::hit
               : lanes.may_hit != 0 ? Answer::undecided
                                    : Answer::missed;
    }

    Triangle triangle_;
    Point2 corner_;
};

}  // namespace

Svg fig_10_11(const Options&) {
    const Triangle triangle{{0.5f, 0.5f, 0.0f}, {0.9f, 0.6f, 0.0f}, {0.7f, 0.95f, 0.0f}};
    Svg svg(
        "A triangle, and a corner of it tens of thousands of times as large: which rays the float "
        "filter decides",
        660, 400);
    const auto on_paper = [](const Point3& p) {
        return at(20 + 420 * (double{p.x} - 0.5), 300 - 420 * (double{p.y} - 0.5));
    };
    svg.polygon({on_paper(triangle.a), on_paper(triangle.b), on_paper(triangle.c)},
                {.fill = Ink::green, .opacity = 0.3});
    const Point2 corner = on_paper(triangle.a), map = at(268, 8);
    constexpr double side = FilterMap::square * FilterMap::rays;
    svg.circle(corner, 6, {.stroke = Ink::quiet});
    svg.line(moved(corner, 0, -6), map, {.stroke = Ink::quiet, .dashed = true});
    svg.line(moved(corner, 0, 6), moved(map, 0, side), {.stroke = Ink::quiet, .dashed = true});
    FilterMap(triangle, map).draw(svg);
    const std::array<std::string, 3> names{"missed", "for the exact test", "hit"};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const double y = 24 + 28 * static_cast<double>(i);
        svg.rect(at(12, y - 14), at(16, 16),
                 {.stroke = {}, .fill = answer_inks[i], .opacity = 0.75});
        svg.text(at(36, y), names[i], {.anchor = Anchor::start, .size = 18});
    }
    return svg;
}

}  // namespace space::ch10
