/// @file
/// Figures that answer when they are touched: the book's own algorithms, compiled to WebAssembly,
/// draw a figure again for each new state. A figure is a function from its state to a drawing, a
/// sentence, and what may be moved. Errors come back as values: a page has no exceptions.
#pragma once

#include "common/program/svg.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::live {

/// What a reader has changed, as it stands in the page's address: "ray=1.5,2;rule=sah". What is
/// missing or makes no sense is as the figure has it at first.
class State {
  public:
    explicit State(std::string_view text);

    double number(std::string_view name, double first, double least, double most) const;
    /// The nearest whole number.
    std::size_t whole(std::string_view name, std::size_t first, std::size_t least,
                      std::size_t most) const;
    /// Both coordinates between least and most.
    Double2 point(std::string_view name, const Double2& first, double least, double most) const;
    /// One of the names, by its place among them.
    std::size_t choice(std::string_view name, std::size_t first,
                       std::span<const std::string_view> names) const;
    /// "x,y x,y ..", as many as `limit`, each coordinate between least and most. An empty text
    /// means no points.
    std::vector<Double2> points(std::string_view name, std::span<const Double2> first, double least,
                                double most, std::size_t limit) const;

  private:
    std::optional<std::string_view> value(std::string_view name) const;
    std::vector<std::pair<std::string, std::string>> values_;
};

/// A point that may be dragged. It is drawn at `zero` + `unit` * `value`, each axis for itself.
struct Handle {
    std::string name, label;
    Double2 value;
    Double2 zero, unit;  ///< drawing units
};
/// One of several names.
struct Choice {
    std::string name, label;
    std::span<const std::string_view> names;
    std::size_t chosen;
};
/// A number.
struct Slider {
    std::string name, label;
    double value, least, most, step;
};

/// Points drawn by hand: a press where none is adds one. They stand as handles do.
struct Points {
    std::string name, label;
    std::vector<Double2> values;
    Double2 zero, unit;
    double least, most;
    std::size_t limit;
};
/// Pixels over a part of the drawing. Who drags them moves the first slider and the second.
struct Picture {
    Point2 corner;
    Vector2 size;  ///< drawing units
    int width, height;
    std::vector<std::uint8_t> rgba;  ///< sRGB, row by row; those of `first_row` and below
    int first_row = 0;
    double rays = 0;  ///< as many were traced; the page tells how many a second
};

/// The figure in a state. Of one with a picture the page says detail=low while it is moved: it may
/// be coarser then. When it rests the page says detail=more again and again, until all rows of a
/// picture have come. If answers take long it says effort=0.5 or less.
struct Answer {
    Svg drawing;
    std::string summary;  ///< a sentence for those who do not see the drawing, and for those who do
    std::vector<Handle> handles = {};
    std::vector<Choice> choices = {};
    std::vector<Slider> sliders = {};
    std::optional<Points> points = {};
    std::optional<Picture> picture = {};
};

/// A live figure, beside the drawing of the same id.
struct LiveFigure {
    std::string_view id;  ///< "fig_07_17"
    Answer (*answer)(const State&);
};

/// All there are.
std::span<const LiveFigure> live_figures();

/// What the page gets: JSON (svg, summary, handles, choices, sliders, points, picture; or error),
/// and the picture's pixels.
struct Reply {
    std::string text;
    std::vector<std::uint8_t> pixels = {};
};

/// The reply to "ID;NAME=VALUE;...".
Reply reply_to(std::string_view request);

}  // namespace space::live
