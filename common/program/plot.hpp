/// @file
/// Parts of measured charts that are drawings: panels with two axes, symbols, and names that keep
/// out of each other's way.
#pragma once

#include "common/geometry.hpp"
#include "common/program/axis.hpp"
#include "common/program/svg.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace space {

/// Mean width of a character beside its size, in the widest of the style block's fonts.
inline constexpr double character_share = 0.6;
inline double text_width(std::string_view text, double size) {
    return character_share * size * static_cast<double>(text.size());
}

/// A frame with an axis along its bottom and one along its left side, in drawing units.
struct Panel {
    double left, top, width, height;
    Axis x, y;

    double right() const { return left + width; }
    double bottom() const { return top + height; }
    Point2 place(double x_value, double y_value) const {
        return at(left + width * x.fraction(x_value), bottom() - height * y.fraction(y_value));
    }
};

/// What is written at a panel's sides.
struct PanelTexts {
    std::string_view title = "";
    bool x_ticks = true, y_ticks = true;
    double size = 16;
};

/// Lines at the ticks, their names below and to the left, the title above.
void draw_panel(Svg& svg, const Panel& panel, const PanelTexts& texts = {});

/// What stands for a value: shapes differ, not only colours.
enum class Shape { circle, square, triangle, diamond, pentagon, upside_down, star };

/// A shape in an ink, filled or as an outline.
struct Symbol {
    Shape shape = Shape::circle;
    Ink ink = Ink::blue;
    bool hollow = false;
    double radius = 6.0;
};
void draw_symbol(Svg& svg, Point2 centre, const Symbol& symbol);

/// Where a text's base line begins; a name farther off has a thin line from its point to `line`.
struct PlacedName {
    Point2 start;
    std::optional<Point2> line = {};
};

/// Finds places for names beside points, where least is in their way.
class Labels {
  public:
    /// Names stay within this part of the drawing where they can.
    explicit Labels(const Aabb2& inside) : inside_(inside) {}

    void keep_free(const Aabb2& box) { taken_.push_back(box); }
    void keep_free(Point2 centre, double radius);
    void keep_free_along(Point2 a, Point2 b);

    /// A place beside the point, or a little farther off. It is taken then.
    PlacedName place(Point2 point, std::string_view text, double size, double gap = 10.0);
    void draw(Svg& svg, Point2 point, std::string_view text, const TextStyle& style,
              double gap = 10.0);

  private:
    double in_the_way(const Aabb2& box) const;
    double in_the_way(Point2 from, Point2 to) const;

    Aabb2 inside_;
    std::vector<Aabb2> taken_;
};

}  // namespace space
