#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/plane_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace space::ch03 {
namespace {

constexpr std::array colors{Ink::blue, Ink::orange, Ink::green, Ink::vermillion,
                            Ink::sky,  Ink::quiet,  Ink::purple};

const Point2 eye{3.25f, 0.75f};

/// Angles from the left: what a piece covers of the eye's half circle.
std::pair<double, double> angles(const Piece& piece) {
    const auto angle = [&](const Double2& p) {
        return std::numbers::pi - std::atan2(p.y - eye.y, p.x - eye.x);
    };
    return std::minmax({angle(piece.from), angle(piece.to)});
}

/// Around the eye: what each piece covers, the nearest last.
void draw_ring(Svg& svg, const Story& story, std::span<const std::size_t> order,
               const Point2& centre) {
    constexpr double inner = 22, outer = 38;
    const auto on_ring = [&](double angle, double radius) {
        return centre + at(-radius * std::cos(angle), -radius * std::sin(angle));
    };
    for (const std::size_t i : order) {
        const auto [from, to] = angles(story.pieces[i]);
        std::vector<Point2> sector;
        constexpr int steps = 24;
        for (int k = 0; k <= steps; ++k)
            sector.push_back(on_ring(from + (to - from) * k / steps, outer));
        for (int k = steps; k >= 0; --k)
            sector.push_back(on_ring(from + (to - from) * k / steps, inner));
        svg.polygon(sector, {.stroke = {}, .fill = colors[story.pieces[i].polygon]});
    }
    svg.circle(centre, 6, {.stroke = {}, .fill = Ink::ink}, "eye");
    svg.text(moved(centre, -12, 6), "eye", {.anchor = Anchor::end, .size = 18, .halo = true});
}

/// Beside the circle that has the piece's number.
Point2 name_place(const PlaneView& view, const Piece& piece, const Point2& circle) {
    const Point2 place = heinonen_name_place(view, piece), middle = moved(place, 0, -7);
    constexpr float apart = 31;
    const float distance = glm::distance(middle, circle);
    return distance < apart ? place + (apart / distance - 1.0f) * (middle - circle) : place;
}

constexpr double left = 470, bar_width = 160, bar_row = 44;

/// The eye's picture when these pieces have been painted.
void draw_picture(Svg& svg, double top, const Story& story, std::span<const std::size_t> painted) {
    svg.begin_group(fmt::format("picture-{}", painted.size()));
    svg.rect(at(left, top), at(bar_width, 22), {.stroke = Ink::quiet});
    for (const std::size_t i : painted) {
        const auto [from, to] = angles(story.pieces[i]);
        svg.rect(at(left + bar_width * from / std::numbers::pi, top),
                 at(bar_width * (to - from) / std::numbers::pi, 22),
                 {.stroke = {}, .fill = colors[story.pieces[i].polygon]});
    }
    svg.end_group();
}

}  // namespace

Svg fig_03_07(const Options&) {
    const Story story = heinonen_story();
    std::vector<std::size_t> order;  // pieces, the farthest first
    story.tree.back_to_front(eye, [&](const Fragment<2>& fragment) {
        order.push_back(story.fragment_pieces[static_cast<std::size_t>(
            &fragment - story.tree.fragments.data())]);
    });
    Svg svg(
        "Painter's order: pieces numbered from the farthest to the nearest as the tree gives "
        "them, and the eye's picture after each",
        640, 424);
    const PlaneView view{.corner = {8, 20}, .scale = 24, .size = heinonen_size};
    for (std::size_t i = 0; i < story.turns.size(); ++i) {
        const auto [from, to] = line_in_cell(story, i);
        svg.line(view(from), view(to), {.stroke = Ink::faint});
    }
    svg.rect(view({0, heinonen_size}), at(384, 384), {.stroke = Ink::quiet});
    draw_ring(svg, story, order, view(Double2(eye)));
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Piece& piece = story.pieces[order[k]];
        draw_segment(svg, view, piece.from, piece.to,
                     {.stroke = {}, .fill = colors[piece.polygon]});
        const Point2 where = view(0.5 * (piece.from + piece.to));
        svg.text(name_place(view, piece, where), written(piece), {.size = 20, .halo = true});
        svg.circle(where, 12, {.stroke = Ink::ink, .fill = Ink::paper}, "order-" + piece.name);
        svg.text(moved(where, 0, 6), fmt::format("{}", k + 1), {.size = 17, .bold = true});
        const double top = 22 + bar_row * static_cast<double>(k);
        svg.text(at(410, top + 18), fmt::format("{}", k + 1),
                 {.anchor = Anchor::start, .size = 17, .bold = true});
        svg.text(at(430, top + 18), written(piece), {.anchor = Anchor::start, .size = 20});
        draw_picture(svg, top, story, std::span(order).first(k + 1));
    }
    svg.text(at(left + bar_width / 2, 22 + bar_row * static_cast<double>(order.size()) + 16),
             "what the eye sees", {.ink = Ink::quiet, .size = 17});
    return svg;
}

}  // namespace space::ch03
