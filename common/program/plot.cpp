#include "common/program/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace space {
namespace {

double area(const Aabb2& box) {
    const Double2 size = glm::max(Double2(box.max) - Double2(box.min), Double2(0.0));
    return size.x * size.y;
}

double overlap(const Aabb2& a, const Aabb2& b) {
    return area({glm::max(a.min, b.min), glm::min(a.max, b.max)});
}

Aabb2 square(Point2 centre, double radius) {
    return {moved(centre, -radius, -radius), moved(centre, radius, radius)};
}

bool is_in(const Aabb2& box, Point2 point) {
    return glm::clamp(point, box.min, box.max) == point;
}

/// Points so close together that squares about them cover a line.
std::vector<Point2> along(Point2 a, Point2 b) {
    const auto steps = static_cast<int>(std::ceil(glm::length(b - a) / 6.0f));
    std::vector<Point2> points;
    for (int i = 0; i <= steps; ++i)
        points.push_back(a + (static_cast<float>(i) / static_cast<float>(std::max(steps, 1))) *
                                 (b - a));
    return points;
}

/// The box of a text whose base line begins at (x, y).
Aabb2 text_box(double x, double y, double width, double size) {
    return {at(x, y - 0.8 * size), at(x + width, y + 0.2 * size)};
}

}  // namespace

void draw_panel(Svg& svg, const Panel& panel, const PanelTexts& texts) {
    const Style grid{.stroke = Ink::faint};
    for (const Tick& tick : panel.x.ticks) {
        const double x = panel.left + panel.width * panel.x.fraction(tick.value);
        svg.line(at(x, panel.top), at(x, panel.bottom()), grid);
        if (texts.x_ticks)
            svg.text(at(x, panel.bottom() + 1.15 * texts.size), tick.text, {.size = texts.size});
    }
    for (const Tick& tick : panel.y.ticks) {
        const double y = panel.bottom() - panel.height * panel.y.fraction(tick.value);
        svg.line(at(panel.left, y), at(panel.right(), y), grid);
        if (texts.y_ticks)
            svg.text(at(panel.left - 6, y + 0.35 * texts.size), tick.text,
                     {.anchor = Anchor::end, .size = texts.size});
    }
    svg.polyline({at(panel.left, panel.top), at(panel.left, panel.bottom()),
                  at(panel.right(), panel.bottom())},
                 {.stroke = Ink::quiet});
    if (!texts.title.empty())
        svg.text(at(panel.left + 2, panel.top - 7), texts.title,
                 {.anchor = Anchor::start, .size = texts.size + 1, .bold = true});
}

void draw_symbol(Svg& svg, Point2 centre, const Symbol& symbol) {
    const Style style{.stroke = symbol.hollow ? std::optional(symbol.ink) : std::nullopt,
                      .fill = symbol.hollow ? Ink::paper : symbol.ink};
    if (symbol.shape == Shape::circle) return svg.circle(centre, symbol.radius, style);
    // Corners, and the turn of the first one from straight up, in parts of a full turn.
    constexpr std::array<std::array<double, 2>, 7> corners{
        {{0, 0}, {4, 0.125}, {3, 0}, {4, 0}, {5, 0}, {3, 0.5}, {10, 0}}};
    const auto [count, first] = corners[static_cast<std::size_t>(symbol.shape)];
    std::vector<Point2> polygon;
    for (int i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * (first + i / count);
        const double inward = symbol.shape == Shape::star && i % 2 == 1 ? 0.45 : 1.0;
        const double radius = 1.15 * inward * symbol.radius;
        polygon.push_back(moved(centre, radius * std::sin(angle), -radius * std::cos(angle)));
    }
    svg.polygon(polygon, style);
}

void Labels::keep_free(Point2 centre, double radius) {
    taken_.push_back(square(centre, radius));
}

void Labels::keep_free_along(Point2 a, Point2 b) {
    for (const Point2& point : along(a, b)) keep_free(point, 2.0);
}

double Labels::in_the_way(const Aabb2& box) const {
    double sum = 4.0 * (area(box) - overlap(box, inside_));
    for (const Aabb2& other : taken_) sum += overlap(box, other);
    return sum;
}

/// Of a line from a symbol to its name; the symbol itself is not.
double Labels::in_the_way(Point2 from, Point2 to) const {
    double sum = 0.0;
    for (const Point2& point : along(from, to))
        for (const Aabb2& other : taken_)
            if (!is_in(other, from)) sum += overlap(square(point, 3.0), other);
    return sum;
}

PlacedName Labels::place(Point2 point, std::string_view text, double size, double gap) {
    const double width = text_width(text, size), middle = 0.3 * size;
    const Double2 p(point);
    Aabb2 best;
    std::optional<Point2> line;
    double least = std::numeric_limits<double>::infinity();
    for (const double far : {1.0, 2.2, 3.6, 5.0})
        for (const auto& [side, up] : std::array<std::array<double, 2>, 8>{
                 {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, 1}, {1, 1}, {-1, -1}}}) {
            const double away = far * gap;
            const double x = p.x + side * away - (side > 0 ? 0 : side < 0 ? width : width / 2);
            const double y =
                p.y + middle + up * (side == 0 ? away + 0.4 * size : 0.8 * away + middle);
            const Aabb2 box = text_box(x, y, width, size);
            const Point2 nearest = glm::clamp(point, box.min, box.max);
            const bool is_far = glm::length(nearest - point) > static_cast<float>(1.6 * gap);
            const double cost =
                in_the_way(box) + (is_far ? in_the_way(point, nearest) : 0.0) + 12.0 * (far - 1.0);
            if (cost >= least) continue;
            least = cost, best = box;
            line = is_far ? std::optional(nearest) : std::nullopt;
        }
    const double blank = 0.5 * character_share * size;  // "3" beside "4" is not 34
    taken_.push_back({moved(best.min, -blank, 0), moved(best.max, blank, 0)});
    if (line) keep_free_along(point, *line);
    return {.start = at(Double2(best.min).x, Double2(best.max).y - 0.2 * size), .line = line};
}

void Labels::draw(Svg& svg, Point2 point, std::string_view text, const TextStyle& style,
                  double gap) {
    const PlacedName placed = place(point, text, style.size, gap);
    if (placed.line) svg.line(point, *placed.line, {.stroke = Ink::quiet});
    TextStyle from_start = style;
    from_start.anchor = Anchor::start;
    svg.text(placed.start, text, from_start);
}

}  // namespace space
