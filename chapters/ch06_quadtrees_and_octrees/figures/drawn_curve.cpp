#include "chapters/ch06_quadtrees_and_octrees/figures/drawn_curve.hpp"

#include "chapters/ch06_quadtrees_and_octrees/figures/plane_cells.hpp"
#include "chapters/ch06_quadtrees_and_octrees/morton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace space::ch06 {
namespace {

constexpr double top = 40, curve_left = 348, curve_side = 320;

std::string bits_of(std::uint64_t number, int count) {
    return fmt::format("{:0{}b}", number, count);
}

/// Four bits in a cell: those of y in one colour, those of x in another.
void draw_codes(Svg& svg, double left, double side) {
    constexpr std::uint32_t depth = 2, cells = 1u << depth;
    const PlaneView view{.corner = {left, top}, .scale = side / cells, .size = cells};
    for (std::uint64_t code = 0; code < cells * cells; ++code) {
        const OrthtreeCell<2> cell = cell_of_code<2>(code, depth);
        const Double2 low(cell.place[0], cell.place[1]);
        svg.polygon(view(corners_of({low, low + 1.0})), {.stroke = Ink::faint});
        const Point2 middle = view(low + Double2(0.5, 0.5));
        svg.text(moved(middle, 0, -3), std::to_string(code), {.size = 20});
        const std::string bits = bits_of(code, 2 * depth);
        for (std::size_t i = 0; i < bits.size(); ++i)
            svg.text(moved(middle, 10.0 * double(i) - 15.0, 18), bits.substr(i, 1),
                     {.ink = i % 2 == 0 ? Ink::vermillion : Ink::blue, .size = 17, .bold = true});
    }
    for (std::uint32_t i = 0; i < cells; ++i) {
        svg.text(moved(view({i + 0.5, 0.0}), 0, 20), bits_of(i, depth),
                 {.ink = Ink::blue, .size = 17, .bold = true});
        svg.text(moved(view({0.0, i + 0.5}), -16, 6), bits_of(i, depth),
                 {.ink = Ink::vermillion, .size = 17, .bold = true});
    }
    svg.text(moved(view({0.5 * cells, 0.0}), 0, 42), "*x*", {.ink = Ink::blue});
    svg.text(moved(view({0.0, 0.5 * cells}), -40, 6), "*y*", {.ink = Ink::vermillion});
    svg.line(view({0.5 * cells, 0.0}), view({0.5 * cells, double(cells)}), {.stroke = Ink::quiet});
    svg.line(view({0.0, 0.5 * cells}), view({double(cells), 0.5 * cells}), {.stroke = Ink::quiet});
    svg.text(at(left + 0.5 * side, 24), "bits by turns", {.bold = true});
}

/// A step of the curve: from one code to the next.
struct Step {
    Double2 from, to;
    double length() const { return glm::length(to - from); }
};

/// To a neighbour over a side, over a corner, and farther: the longest of all stand out.
Ink ink_of(const Step& step, double longest) {
    if (step.length() == longest) return Ink::vermillion;
    return step.length() > 1.5 ? Ink::orange : Ink::blue;
}

/// All cells of one depth, in the order of their codes.
class Curve {
  public:
    explicit Curve(std::uint32_t depth)
        : depth_(depth),
          cells_(double(1u << depth)),
          count_(std::uint64_t{1} << (2 * depth)),
          view_{.corner = {curve_left, top}, .scale = curve_side / cells_, .size = cells_} {
        for (std::uint64_t code = 0; code + 1 < count_; ++code)
            steps_.push_back({middle(code), middle(code + 1)});
        for (const Step& step : steps_) {
            longest_ = std::max(longest_, step.length());
            jumps_ += step.length() > 1.5;
        }
    }

    void draw(Svg& svg, const std::optional<Point2>& asked) const {
        svg.rect(at(curve_left, top), at(curve_side, curve_side), {.stroke = Ink::faint});
        const double quarter = cells_ / 4;
        for (int i = 1; i < 4; ++i) {
            svg.line(view_({quarter * i, 0.0}), view_({quarter * i, cells_}),
                     {.stroke = Ink::faint});
            svg.line(view_({0.0, quarter * i}), view_({cells_, quarter * i}),
                     {.stroke = Ink::faint});
        }
        const double half = cells_ / 2;
        svg.line(view_({half, 0.0}), view_({half, cells_}), {.stroke = Ink::quiet});
        svg.line(view_({0.0, half}), view_({cells_, half}), {.stroke = Ink::quiet});
        if (asked) draw_asked(svg, cell_at(*asked));
        draw_steps(svg);
        svg.text(at(curve_left + 0.5 * curve_side, 24), "the curve", {.bold = true});
        if (asked)
            draw_code(svg, cell_at(*asked));
        else
            draw_jumps(svg);
    }
    std::string told_jumps() const {
        return fmt::format("{} of {} steps are jumps, the longest over {:.2f} cells.", jumps_,
                           steps_.size(), longest_);
    }
    std::string told_code(const Point2& asked) const {
        const OrthtreeCell<2> cell = cell_at(asked);
        return fmt::format("Cell ({}, {}), in bits {} and {}, has the code {}, in bits {}.",
                           cell.place[0], cell.place[1], bits_of(cell.place[0], int(depth_)),
                           bits_of(cell.place[1], int(depth_)), morton_code(cell),
                           bits_of(morton_code(cell), int(2 * depth_)));
    }

  private:
    Double2 middle(std::uint64_t code) const {
        const auto place = cell_of_code<2>(code, depth_).place;
        return Double2(place[0], place[1]) + 0.5;
    }
    OrthtreeCell<2> cell_at(const Point2& asked) const {
        return OrthtreeFrame<2>{.edge = square_of_curve}.cell_of(asked, depth_);
    }

    void draw_steps(Svg& svg) const {
        for (const Ink ink : {Ink::orange, Ink::blue, Ink::vermillion})
            for (const Step& step : steps_)
                if (ink_of(step, longest_) == ink)
                    svg.line(view_(step.from), view_(step.to), {.stroke = ink});
        for (std::uint64_t code = 0; code < count_; ++code)
            svg.circle(view_(middle(code)), std::min(3.0, 0.2 * view_.scale),
                       {.stroke = {}, .fill = Ink::ink});
        const auto label = [&](std::uint64_t code, double x, double y) {
            const std::string text = std::to_string(code);
            const Point2 place = view_(middle(code));
            const double room = 672 - 5.0 * double(text.size()) - double{place.x};  // to the rim
            svg.text(moved(place, std::min(x, room), y), text, {.size = 17, .halo = true});
        };
        label(0, -4, 22);
        if (depth_ > 1) label(count_ / 4 - 1, -2, -8);
        label(count_ / 4, 4, 22);
        if (depth_ > 1) label(count_ / 2 - 1, 2, -8);
        label(count_ / 2, -6, -8);
        label(count_ - 1, 2, -8);
    }
    /// The cells in which the asked one lies, from the root down: its code's digits.
    void draw_asked(Svg& svg, const OrthtreeCell<2>& cell) const {
        for (std::uint32_t depth = 1; depth <= depth_; ++depth) {
            const auto place = cell.ancestor(depth).place;
            const double edge = double(1u << (depth_ - depth));
            const Double2 low = edge * Double2(place[0], place[1]);
            svg.polygon(view_(corners_of({low, low + edge})),
                        {.stroke = Ink::green, .fill = Ink::green, .opacity = 0.15});
        }
    }
    void draw_code(Svg& svg, const OrthtreeCell<2>& cell) const {
        const std::uint64_t code = morton_code(cell);
        svg.circle(view_(middle(code)), 9, {.stroke = Ink::green});
        const std::string bits = bits_of(code, int(2 * depth_));
        const double y = top + curve_side + 24;
        svg.text(at(curve_left, y), fmt::format("*x* = {}", bits_of(cell.place[0], int(depth_))),
                 {.anchor = Anchor::start, .ink = Ink::blue, .size = 17, .bold = true});
        svg.text(at(curve_left, y + 24),
                 fmt::format("*y* = {}", bits_of(cell.place[1], int(depth_))),
                 {.anchor = Anchor::start, .ink = Ink::vermillion, .size = 17, .bold = true});
        const double right = curve_left + curve_side;
        for (std::size_t i = 0; i < bits.size(); ++i)
            svg.text(at(right - 11.0 * double(bits.size() - i), y), bits.substr(i, 1),
                     {.ink = i % 2 == 0 ? Ink::vermillion : Ink::blue, .size = 17, .bold = true});
        svg.text(at(right, y + 24), fmt::format("code {}", code),
                 {.anchor = Anchor::end, .ink = Ink::green, .size = 17, .bold = true});
    }
    void draw_jumps(Svg& svg) const {
        const double x = curve_left + 0.5 * curve_side, y = top + curve_side;
        svg.text(at(x, y + 24), fmt::format("{} of {} steps are jumps,", jumps_, steps_.size()),
                 {.size = 17});
        svg.text(at(x, y + 48), fmt::format("the longest over {:.2f} cells", longest_),
                 {.size = 17});
    }

    std::uint32_t depth_;
    double cells_;  ///< along a side
    std::uint64_t count_;
    PlaneView view_;
    std::vector<Step> steps_ = {};
    double longest_ = 0;
    std::size_t jumps_ = 0;
};

}  // namespace

PlaneView curve_view() {
    return {.corner = {curve_left, top},
            .scale = curve_side / square_of_curve,
            .size = square_of_curve};
}

DrawnCurve drawn_curve(const CurveScene& scene) {
    const Curve curve(scene.depth);
    const std::uint64_t cells = std::uint64_t{1} << (2 * scene.depth);
    Svg svg(fmt::format("Morton codes of 16 cells, and the curve through {} cells in their order "
                        "with its jumps",
                        cells),
            676, 420);
    draw_codes(svg, 56, 264);
    curve.draw(svg, scene.asked);
    return {.drawing = std::move(svg),
            .tells = (scene.asked ? curve.told_code(*scene.asked) + " " : "") + curve.told_jumps()};
}

}  // namespace space::ch06
