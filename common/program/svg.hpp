/// @file
/// A small SVG writer for the book's drawings: the same bytes for the same calls, ids on the
/// elements, one palette, one line weight.
///
/// Colours follow light and dark pages. Every element carries its light colour as a plain
/// attribute, so that any program can show the file; the style block maps each of them to a CSS
/// variable (`[stroke="#0072b2"]` to `var(--blue)`), which the figure sets itself: to its light
/// values, to its dark ones where the reader's system is dark, and, inlined into a page, to those
/// of the class `light-mode` or `dark-mode` on the page's `<html>`, which win. The styles hold
/// within `svg.book-figure` only, so many figures can stand in one page.
#pragma once

#include "common/geometry.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space {

class Image;

/// Names of the shared colour-blind-safe palette (Okabe & Ito 2008), and of ink, paper and quiet
/// greys. Yellow, sky and orange are for areas and lines: as text they are too pale.
enum class Ink { ink, paper, quiet, faint, blue, orange, green, vermillion, sky, yellow, purple };

inline Point2 at(double x, double y) {
    return Point2(glm::dvec2(x, y));
}
inline Point2 moved(const Point2& p, double x, double y) {
    return p + at(x, y);
}

/// Lines of every drawing and chart, in drawing units.
inline constexpr double line_weight = 2.0;

/// Line and filling of a shape.
struct Style {
    std::optional<Ink> stroke = Ink::ink;  ///< empty: no line
    std::optional<Ink> fill = {};          ///< empty: not filled
    double opacity = 1.0;                  ///< of the filling
    bool dashed = false;
    bool arrow = false;  ///< a head at the end of a line or polyline
};

/// Which end of a text stands at its point.
enum class Anchor { start, middle, end };

/// Size, colour and place of a text.
struct TextStyle {
    Anchor anchor = Anchor::middle;
    Ink ink = Ink::ink;
    double size = 18;  ///< in drawing units; below 16 nobody can read it on a phone
    bool bold = false;
    bool halo = false;  ///< a rim in the colour of the paper, for text over lines
    double turn = 0.0;  ///< degrees about its point, clockwise
};

/// Drawing units with y *downwards*, as in SVG; a drawing is about 640 units wide. An element's id
/// may be empty; others are written as FIGURE-id, unique in a page of many figures.
class Svg {
  public:
    /// The title is read aloud in place of the drawing: one sentence that says what it shows.
    Svg(std::string title, double width, double height);

    void line(Point2 a, Point2 b, const Style& style = {}, std::string_view id = {});
    void polyline(const std::vector<Point2>& points, const Style& style = {},
                  std::string_view id = {});
    void polygon(const std::vector<Point2>& points, const Style& style = {},
                 std::string_view id = {});
    void rect(Point2 corner, Vector2 size, const Style& style = {}, std::string_view id = {});
    void circle(Point2 centre, double radius, const Style& style = {}, std::string_view id = {});
    /// `at` is on the base line. The text may hold "*word*" for italics and "_" for a subscript of
    /// one character or of "{several}": "*t*_{min}".
    void text(Point2 at, std::string_view text, const TextStyle& style = {},
              std::string_view id = {});
    /// Groups what follows up to end_group under an id of its own, for scripts that show and hide
    /// it.
    void begin_group(std::string_view id);
    /// Groups what follows up to end_group as a part of a step-through: a page leads its reader
    /// through the steps, from 0 on, and shows the group from step `first` to step `last` (nothing:
    /// to the end) and `tells`, if not empty, at step `first`. Where no script runs, what is there
    /// at the end shows. Steps may not stand in steps.
    void begin_step(int first, std::optional<int> last = {}, std::string_view tells = {});
    /// What shows in this one of `steps` steps alone; where no script runs, the last one's.
    void begin_step_alone(std::size_t step, std::size_t steps, std::string_view tells = {});
    void end_group();
    /// Pixels as an embedded PNG; drawn twice as large or larger, as squares with sharp sides.
    void picture(Point2 corner, Vector2 size, const Image& image, std::string_view id = {});

    std::string document(std::string_view figure_id) const;

  private:
    void element(std::string_view tag, const std::string& attributes, std::string_view id);
    void arrow_head(Point2 from, Point2 tip, const Style& style);

    std::string title_, body_;
    double width_, height_;
    int open_groups_ = 0;
};

/// What every figure begins with: the svg tag, the title, the style block and the paper. Ends
/// before "</svg>".
std::string svg_opening(std::string_view figure_id, std::string_view title, double width,
                        double height);
/// The light value of a colour, "#0072b2": what stands in the elements' attributes.
std::string_view svg_color(Ink ink);
/// At most two decimals, never "-0". @throws std::invalid_argument where the number is not finite
std::string svg_number(double value);

}  // namespace space
