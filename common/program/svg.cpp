#include "common/program/svg.hpp"

#include "common/program/svg_colors.hpp"
#include "common/program/xml.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace space {
namespace {

/// Stands in a drawing for the id that the figure will get. No text holds it: XML forbids it.
constexpr char figure_id_mark = '\x01';

struct PaletteEntry {
    std::string_view name, light, dark;
};

// In the order of Ink, then the colours of text. The light values of the colours are those of Okabe
// & Ito; the dark ones are as far apart, and light enough to be read on a dark page. Three of the
// light ones are too pale to be read on white: as text they are darker. All text stands at
// least 4.5 : 1 against its paper (WCAG 2.1, level AA).
constexpr std::array<PaletteEntry, 14> palette{{
    {"ink", "#1a1a1a", "#ececec"},
    {"paper", "#ffffff", "#1c1d1f"},
    {"quiet", "#666666", "#a6a9ae"},
    {"faint", "#d5d5d5", "#44474c"},
    {"blue", "#0072b2", "#3f9fe8"},
    {"orange", "#e69f00", "#f0b23c"},
    {"green", "#009e73", "#2bc298"},
    {"vermillion", "#d55e00", "#f5803e"},
    {"sky", "#56b4e9", "#9ad8f8"},
    {"yellow", "#f0e442", "#f5ec7a"},
    {"purple", "#cc79a7", "#e3a2c7"},
    {"green-text", "#00775a", "#2bc298"},
    {"vermillion-text", "#b84a00", "#f5803e"},
    {"purple-text", "#a04a7d", "#e3a2c7"},
}};
constexpr std::size_t green_text = 11, vermillion_text = 12, purple_text = 13;

const PaletteEntry& text_entry(Ink ink) {
    switch (ink) {
        case Ink::green:
            return palette[green_text];
        case Ink::vermillion:
            return palette[vermillion_text];
        case Ink::purple:
            return palette[purple_text];
        case Ink::faint:
        case Ink::orange:
        case Ink::sky:
        case Ink::yellow:
            return palette[static_cast<std::size_t>(Ink::ink)];
        default:
            return palette[static_cast<std::size_t>(ink)];
    }
}

constexpr double arrow_length = 12.0, arrow_half_width = 4.5;

constexpr std::string_view font_rules =
    ".book-figure text{font-family:system-ui,\"Segoe UI\",Roboto,Helvetica,Arial,\"DejaVu "
    "Sans\",sans-serif}\n"
    ".book-figure .italic{font-family:\"Latin Modern Roman\",\"STIX Two Text\",\"Times New "
    "Roman\",Times,"
    "\"DejaVu Serif\",serif;font-style:italic}\n"
    ".book-figure .halo{paint-order:stroke;stroke-width:5;stroke-linejoin:round}\n"
    ".book-figure .pixels{image-rendering:pixelated}\n";

std::string style_block() {
    std::string light, dark, rules;
    for (const PaletteEntry& color : palette) {
        light += fmt::format("--{}:{};", color.name, color.light);
        dark += fmt::format("--{}:{};", color.name, color.dark);
        for (const std::string_view property : {"fill", "stroke", "color"})
            rules += fmt::format(".book-figure [{0}=\"{1}\"]{{{0}:var(--{2})}}\n", property,
                                 color.light, color.name);
    }
    // In a page the paper is the page's own (a variable of the theme's).
    constexpr std::string_view page = "--paper:var(--page-background-color,{});";
    return fmt::format(
        "<style>\n"
        "svg.book-figure{{{0}max-width:100%;height:auto}}\n"
        "@media (prefers-color-scheme:dark){{svg.book-figure{{{1}}}}}\n"
        "html.light-mode svg.book-figure{{{0}{2}}}\n"
        "html.dark-mode svg.book-figure{{{1}{3}}}\n"
        "{4}{5}</style>\n",
        light, dark, fmt::format(fmt::runtime(page), palette[1].light),
        fmt::format(fmt::runtime(page), palette[1].dark), font_rules, rules);
}

std::string paint(const Style& style) {
    std::string attributes =
        fmt::format(" fill=\"{}\"", style.fill ? svg_color(*style.fill) : "none");
    if (style.fill && style.opacity != 1.0)
        attributes += fmt::format(" fill-opacity=\"{}\"", svg_number(style.opacity));
    if (style.stroke)
        attributes += fmt::format(
            " stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"",
            svg_color(*style.stroke), svg_number(line_weight));
    if (style.stroke && style.dashed) attributes += " stroke-dasharray=\"6 6\"";
    return attributes;
}

std::string coordinates(const std::vector<Point2>& points) {
    std::vector<std::string> pairs;
    for (const Point2& p : points) pairs.push_back(svg_number(p.x) + ',' + svg_number(p.y));
    return fmt::format("{}", fmt::join(pairs, " "));
}

/// "*t*_{min}" as tspan elements.
std::string marked_up(std::string_view text, double size) {
    const double drop = 0.25 * size;
    std::string result;
    bool italic = false, dropped = false;
    // One run of characters with the same look.
    const auto run = [&](std::string_view characters, bool subscript) {
        if (characters.empty()) return;
        std::string attributes;
        if (italic) attributes += " class=\"italic\"";
        if (subscript) attributes += fmt::format(" font-size=\"{}\"", svg_number(0.75 * size));
        if (subscript != dropped)
            attributes += fmt::format(" dy=\"{}\"", svg_number(subscript ? drop : -drop));
        dropped = subscript;
        result += attributes.empty()
                      ? xml_escaped(characters)
                      : fmt::format("<tspan{}>{}</tspan>", attributes, xml_escaped(characters));
    };
    while (!text.empty()) {
        if (text.front() == '*') {
            italic = !italic;
            text.remove_prefix(1);
        } else if (text.front() == '_' && text.size() > 1) {
            const bool braced = text[1] == '{' && text.find('}') != text.npos;
            const std::string_view sub =
                braced ? text.substr(2, text.find('}') - 2) : text.substr(1, 1);
            run(sub, true);
            text.remove_prefix(braced ? sub.size() + 3 : 2);
        } else {
            const std::size_t end = std::min(text.find_first_of("*_", 1), text.size());
            run(text.substr(0, end), false);
            text.remove_prefix(end);
        }
    }
    return result;
}

}  // namespace

std::string_view svg_color(Ink ink) {
    return palette[static_cast<std::size_t>(ink)].light;
}

std::string_view svg_text_color(Ink ink, bool dark) {
    return dark ? text_entry(ink).dark : text_entry(ink).light;
}

std::string_view svg_paper(bool dark) {
    const PaletteEntry& paper = palette[static_cast<std::size_t>(Ink::paper)];
    return dark ? paper.dark : paper.light;
}

std::string svg_fixed(std::string document, bool dark) {
    const std::string style = style_block();
    if (const std::size_t at = document.find(style); at != document.npos)
        document.replace(at, style.size(), fmt::format("<style>\n{}</style>\n", font_rules));
    // No dark colour is a light one of another, so one after the other is right.
    for (const PaletteEntry& color : palette)
        for (const char quote : {'"', '\''}) {
            const std::string from = quote + std::string(color.light) + quote,
                              to = quote + std::string(color.dark) + quote;
            for (std::size_t at = 0; dark && (at = document.find(from, at)) != document.npos;)
                document.replace(at, from.size(), to);
        }
    return document;
}

std::string svg_number(double value) {
    if (!std::isfinite(value)) throw std::invalid_argument("svg: a coordinate is not finite");
    std::string text = fmt::format("{:.2f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string svg_opening(std::string_view figure_id, std::string_view title, double width,
                        double height) {
    const std::string w = svg_number(width), h = svg_number(height);
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" id=\"{0}\" class=\"book-figure\" role=\"img\" "
        "aria-labelledby=\"{0}-title\" width=\"{1}\" height=\"{2}\" viewBox=\"0 0 {1} {2}\">\n"
        "<title id=\"{0}-title\">{3}</title>\n{4}"
        "<rect width=\"{1}\" height=\"{2}\" fill=\"{5}\"/>\n",
        xml_escaped(figure_id), w, h, xml_escaped(title), style_block(), svg_color(Ink::paper));
}

Svg::Svg(std::string title, double width, double height)
    : title_(std::move(title)), width_(width), height_(height) {}

void Svg::element(std::string_view tag, const std::string& attributes, std::string_view id) {
    body_ += fmt::format("<{}", tag);
    if (!id.empty()) body_ += fmt::format(" id=\"{}-{}\"", figure_id_mark, xml_escaped(id));
    body_ += attributes + "/>\n";
}

void Svg::line(Point2 a, Point2 b, const Style& style, std::string_view id) {
    polyline({a, b}, style, id);
}

void Svg::polyline(const std::vector<Point2>& points, const Style& style, std::string_view id) {
    std::vector<Point2> shown = points;
    const bool headed =
        style.arrow && points.size() > 1 && points.back() != points[points.size() - 2];
    if (headed) {  // the line ends inside the head, or its blunt end would stick out of the tip
        const Vector2 along = glm::normalize(points.back() - points[points.size() - 2]);
        shown.back() -= along * static_cast<float>(0.8 * arrow_length);
    }
    element("polyline", fmt::format(" points=\"{}\"", coordinates(shown)) + paint(style), id);
    if (headed) arrow_head(points[points.size() - 2], points.back(), style);
}

void Svg::arrow_head(Point2 from, Point2 tip, const Style& style) {
    const Vector2 along = glm::normalize(tip - from), across{-along.y, along.x};
    const Point2 base = tip - along * static_cast<float>(arrow_length);
    const Vector2 half = across * static_cast<float>(arrow_half_width);
    element("polygon",
            fmt::format(" points=\"{}\"", coordinates({tip, base + half, base - half})) +
                paint({.stroke = {}, .fill = style.stroke}),
            {});
}

void Svg::polygon(const std::vector<Point2>& points, const Style& style, std::string_view id) {
    element("polygon", fmt::format(" points=\"{}\"", coordinates(points)) + paint(style), id);
}

void Svg::rect(Point2 corner, Vector2 size, const Style& style, std::string_view id) {
    element("rect",
            fmt::format(" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", svg_number(corner.x),
                        svg_number(corner.y), svg_number(size.x), svg_number(size.y)) +
                paint(style),
            id);
}

void Svg::circle(Point2 centre, double radius, const Style& style, std::string_view id) {
    element("circle",
            fmt::format(" cx=\"{}\" cy=\"{}\" r=\"{}\"", svg_number(centre.x), svg_number(centre.y),
                        svg_number(radius)) +
                paint(style),
            id);
}

void Svg::text(Point2 at, std::string_view text, const TextStyle& style, std::string_view id) {
    constexpr std::array<std::string_view, 3> anchors{"start", "middle", "end"};
    body_ += "<text";
    if (!id.empty()) body_ += fmt::format(" id=\"{}-{}\"", figure_id_mark, xml_escaped(id));
    body_ += fmt::format(
        " x=\"{}\" y=\"{}\" font-family=\"sans-serif\" font-size=\"{}\" text-anchor=\"{}\" "
        "fill=\"{}\"",
        svg_number(at.x), svg_number(at.y), svg_number(style.size),
        anchors[static_cast<std::size_t>(style.anchor)], svg_text_color(style.ink));
    if (style.bold) body_ += " font-weight=\"bold\"";
    if (style.halo) body_ += fmt::format(" class=\"halo\" stroke=\"{}\"", svg_color(Ink::paper));
    if (style.turn != 0.0)
        body_ += fmt::format(" transform=\"rotate({} {} {})\"", svg_number(style.turn),
                             svg_number(at.x), svg_number(at.y));
    body_ += ">" + marked_up(text, style.size) + "</text>\n";
}

void Svg::begin_group(std::string_view id) {
    body_ += fmt::format("<g id=\"{}-{}\">\n", figure_id_mark, xml_escaped(id));
    ++open_groups_;
}

void Svg::begin_step(int first, std::optional<int> last, std::string_view tells) {
    body_ += fmt::format("<g data-first=\"{}\"", first);
    if (last) body_ += fmt::format(" data-last=\"{}\" display=\"none\"", *last);
    body_ += ">\n";
    if (!tells.empty()) body_ += fmt::format("<desc>{}</desc>\n", xml_escaped(tells));
    ++open_groups_;
}

void Svg::begin_step_alone(std::size_t step, std::size_t steps, std::string_view tells) {
    const int only = static_cast<int>(step);
    begin_step(only, step + 1 == steps ? std::optional<int>() : only, tells);
}

void Svg::end_group() {
    if (open_groups_-- == 0) throw std::logic_error("svg: end_group without begin_group");
    body_ += "</g>\n";
}

std::string Svg::document(std::string_view figure_id) const {
    if (open_groups_ != 0) throw std::logic_error("svg: begin_group without end_group");
    std::string result = svg_opening(figure_id, title_, width_, height_);
    const std::string id = xml_escaped(figure_id);
    for (const char c : body_)
        if (c == figure_id_mark)
            result += id;
        else
            result += c;
    return result + "</svg>\n";
}

}  // namespace space
