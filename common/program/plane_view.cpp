#include "common/program/plane_view.hpp"

namespace space {

std::vector<Point2> PlaneView::operator()(const ConvexCell& cell) const {
    std::vector<Point2> points;
    for (const Double2& p : cell) points.push_back((*this)(p));
    return points;
}

void draw_segment(Svg& svg, const PlaneView& view, const Double2& from, const Double2& to,
                  const Style& style) {
    const Point2 a = view(from), b = view(to);
    if (a == b) return svg.circle(a, 2.2, style);
    const Vector2 along = glm::normalize(b - a), across = 2.2f * Vector2(-along.y, along.x);
    svg.polygon({a + across, b + across, b - across, a - across}, style);
}

void draw_front_tick(Svg& svg, const PlaneView& view, const Double2& from, const Double2& to,
                     Ink ink) {
    svg.line(beside(view, from, to, 0.5, 0.0), beside(view, from, to, 0.5, 11.0), {.stroke = ink});
}

Point2 beside(const PlaneView& view, const Double2& from, const Double2& to, double along,
              double away) {
    const Double2 line = to - from;
    const bool is_point = glm::dot(line, line) == 0.0;  // also where the squares are too small
    const Double2 way = is_point ? Double2(1.0, 0.0) : glm::normalize(line), front(-way.y, way.x);
    return view(from + along * (to - from) + away / view.scale * front);
}

std::string drawn_name(std::string_view name) {
    std::string text = "*" + std::string(name.substr(0, 1)) + "*";
    if (name.size() > 1) text += "_{" + std::string(name.substr(1)) + "}";
    return text;
}

std::string plain_name(std::string_view name) {
    constexpr std::string_view digits[] = {"₀", "₁", "₂", "₃", "₄", "₅", "₆", "₇", "₈", "₉"};
    std::string text(name.substr(0, 1));
    for (const char c : name.substr(1)) text += digits[c - '0'];
    return text;
}

Point2 heinonen_name_place(const PlaneView& view, const NamedSegment& segment) {
    const char letter = segment.name.front();
    const double away = letter == 'B' || letter == 'G' ? -21.0 : letter == 'C' ? 27.0 : 21.0;
    return moved(beside(view, segment.from, segment.to, letter == 'G' ? 0.3 : 0.5, away), 0, 7);
}

}  // namespace space
