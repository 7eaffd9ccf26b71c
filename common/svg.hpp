/// @file
/// A small SVG writer for the book's drawings: the same bytes for the same calls, ids on the elements, colours as
/// CSS variables that follow light and dark pages, one palette and one line weight.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/geometry.hpp"

namespace space {

/// Names of the shared colour-blind-safe palette (Okabe & Ito 2008), and of ink, paper and quiet greys.
enum class Ink { ink, paper, quiet, faint, blue, orange, green, vermillion, sky, yellow, purple };

struct Style {
    Ink stroke = Ink::ink;
    double width = 1.5;            ///< in drawing units; 0 draws no line
    bool dashed = false;
    std::optional<Ink> fill = {};  ///< empty: not filled
    double fill_opacity = 1.0;
    bool arrow = false;            ///< an arrow head at the end of a line
};

enum class Anchor { start, middle, end };

/// Drawing units with y *downwards*, as in SVG; a page is about 640 units wide. `id` may be empty.
class Svg {
  public:
    Svg(std::string figure_id, std::string title, double width, double height);

    void line(Point2 a, Point2 b, const Style& style = {}, std::string_view id = {});
    void polyline(const std::vector<Point2>& points, const Style& style = {}, std::string_view id = {});
    void polygon(const std::vector<Point2>& points, const Style& style = {}, std::string_view id = {});
    void rect(Point2 corner, Vector2 size, const Style& style = {}, std::string_view id = {});
    void circle(Point2 centre, double radius, const Style& style = {}, std::string_view id = {});
    /// Text may hold "_" for a subscript of one character and "*word*" for italics: "t_1", "*n*".
    void text(Point2 at, std::string_view text, Anchor anchor = Anchor::middle, Ink ink = Ink::ink, double size = 16,
              std::string_view id = {});
    /// Groups what follows up to end_group under an id of its own, for scripts that show and hide it.
    void begin_group(std::string_view id);
    void end_group();
    /// Pixels as an embedded picture (base64 PNG), scaled without smoothing.
    void picture(Point2 corner, Vector2 size, const class Image& image, std::string_view id = {});

    std::string document() const;

  private:
    std::string figure_id_, title_, body_;
    double width_, height_;
};

}  // namespace space
