// What a BSP tree is used for: the painter's order and rays; and a body on which it fails.

#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/figures/sketch.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace space::ch03 {
namespace {

constexpr std::array colors{Ink::blue, Ink::orange, Ink::green, Ink::vermillion,
                            Ink::sky,  Ink::quiet,  Ink::purple};

}  // namespace

// -------------------------------------------------------------------------------------------------
// 3.4 Painter's order

Svg fig_03_04(const Options&) {
    const Story story = heinonen_story();
    const Point2 eye{3.25f, 0.75f};
    std::vector<std::size_t> order;  // pieces, the farthest first
    story.tree.back_to_front(eye, [&](const Fragment<2>& fragment) {
        order.push_back(story.fragment_pieces[static_cast<std::size_t>(
            &fragment - story.tree.fragments.data())]);
    });
    /// Angles from the left: what a piece covers of the eye's half circle.
    const auto angles = [&](const Piece& piece) {
        const auto angle = [&](const Double2& p) {
            return std::numbers::pi - std::atan2(p.y - eye.y, p.x - eye.x);
        };
        return std::minmax({angle(piece.from), angle(piece.to)});
    };

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
    const Point2 centre = view(Double2(eye));
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

    constexpr double left = 470, width = 160, row = 44;
    const auto strip = [&](double top, std::size_t painted, std::string_view id) {
        svg.begin_group(id);
        svg.rect(at(left, top), at(width, 22), {.stroke = Ink::quiet});
        for (std::size_t k = 0; k < painted; ++k) {
            const auto [from, to] = angles(story.pieces[order[k]]);
            svg.rect(at(left + width * from / std::numbers::pi, top),
                     at(width * (to - from) / std::numbers::pi, 22),
                     {.stroke = {}, .fill = colors[story.pieces[order[k]].polygon]});
        }
        svg.end_group();
    };
    for (std::size_t k = 0; k < order.size(); ++k) {
        const Piece& piece = story.pieces[order[k]];
        draw_segment(svg, view, piece.from, piece.to,
                     {.stroke = {}, .fill = colors[piece.polygon]});
        svg.text(heinonen_name_place(view, piece), written(piece), {.size = 20, .halo = true});
        const Point2 where = view(0.5 * (piece.from + piece.to));
        svg.circle(where, 12, {.stroke = Ink::ink, .fill = Ink::paper}, "order-" + piece.name);
        svg.text(moved(where, 0, 6), fmt::format("{}", k + 1), {.size = 17, .bold = true});
        const double top = 22 + row * static_cast<double>(k);
        svg.text(at(410, top + 18), fmt::format("{}", k + 1),
                 {.anchor = Anchor::start, .size = 17, .bold = true});
        svg.text(at(430, top + 18), written(piece), {.anchor = Anchor::start, .size = 20});
        strip(top, k + 1, "picture-" + fmt::format("{}", k + 1));
    }
    svg.text(at(left + width / 2, 22 + row * static_cast<double>(order.size()) + 16),
             "what the eye sees", {.ink = Ink::quiet, .size = 17});
    return svg;
}

// -------------------------------------------------------------------------------------------------
// 3.6 A convex body

Svg fig_03_06(const Options&) {
    constexpr int sides = 24;
    std::vector<Segment> body;  // clockwise, so that fronts look outwards
    const auto corner = [](int i) {
        const double angle = -2.0 * std::numbers::pi * (i + 0.35) / sides;
        return Point2(at(7.0 + 4.6 * std::cos(angle), 7.0 + 4.6 * std::sin(angle)));
    };
    for (int i = 0; i < sides; ++i) body.push_back({corner(i), corner(i + 1)});
    constexpr double size = 14.0, slot = 12.0;
    const ConvexCell frame{{0, 0}, {size, 0}, {size, size}, {0, size}};

    Svg svg("A convex polygon's own lines make a chain; with free lines the tree is shallow", 640,
            604);
    const auto panel = [&](double left, const BspConfig& config, const char* name,
                           std::string_view id) {
        const Story story = watched_build(body, config, frame);
        const PlaneView view{.corner = {left, 34}, .scale = 304 / size, .size = size};
        svg.text(at(left + 152, 22), name, {.bold = true});
        svg.begin_group(id);
        std::size_t free = 0;
        for (std::size_t i = 0; i < story.turns.size(); ++i) {
            const bool is_free = !story.turns[i].splitter;
            free += is_free;
            const auto [from, to] = line_in_cell(story, i);
            svg.line(view(from), view(to), {.stroke = is_free ? Ink::vermillion : Ink::blue});
        }
        for (const std::size_t i : story.fragment_pieces)
            draw_segment(svg, view, story.pieces[i].from, story.pieces[i].to,
                         {.stroke = {}, .fill = Ink::ink});
        svg.rect(view({0, size}), at(304, 304), {.stroke = Ink::quiet});

        const TreeLayout layout = layout_of(story);
        const double width = static_cast<double>(story.cells.size()),
                     step = std::min(slot, 300.0 / width);
        const auto place = [&](const Double2& p) {
            return at(left + 152 + step * (p.x - width / 2.0), 366 + 8.0 * p.y);
        };
        for (std::size_t i = 0; i < story.turns.size(); ++i)
            if (story.turns[i].parent != BspTree<2>::none)
                svg.line(place(layout.nodes[story.turns[i].parent]), place(layout.nodes[i]),
                         {.stroke = Ink::quiet});
        for (std::size_t i = 0; i < story.turns.size(); ++i)
            svg.circle(
                place(layout.nodes[i]), 3.6,
                {.stroke = {}, .fill = story.turns[i].splitter ? Ink::blue : Ink::vermillion});
        svg.end_group();
        svg.text(at(left + 152, 590),
                 fmt::format("{} nodes, depth {}", story.turns.size(), story.tree.depth()), {});
    };
    panel(8, {.splitter = BspConfig::SplitterChoice::first}, "only the sides' own lines", "chain");
    panel(328, {.splitter = BspConfig::SplitterChoice::free, .candidates = 2, .lopsided = 0.2},
          "with free lines", "free");
    return svg;
}

// -------------------------------------------------------------------------------------------------
// 3.7 A ray, front to back

namespace {

/// Where the ray meets a segment, in double; infinity where it does not.
double distance_along(const BasicRay<2>& ray, const Segment& segment) {
    const Double2 o(ray.origin), d(ray.direction), a(segment[0]), way = Double2(segment[1]) - a;
    const double turn = d.x * way.y - d.y * way.x;
    if (turn == 0.0) return infinity;
    const Double2 from = a - o;
    const double t = (from.x * way.y - from.y * way.x) / turn,
                 s = (from.x * d.y - from.y * d.x) / turn;
    return t >= 0.0 && s >= 0.0 && s <= 1.0 ? t : double{infinity};
}

/// Whether the way from `from` to `to` passes through a convex cell.
bool passes(const ConvexCell& cell, const Double2& from, const Double2& to) {
    double enter = 0.0, leave = 1.0;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const Double2 &a = cell[i], side = cell[(i + 1) % cell.size()] - a;
        const auto left_of = [&](const Double2& p) {
            return side.x * (p.y - a.y) - side.y * (p.x - a.x);
        };
        const double start = left_of(from), end = left_of(to);
        if (start < 0.0 && end < 0.0) return false;
        if (start < 0.0) enter = std::max(enter, start / (start - end));
        if (end < 0.0) leave = std::min(leave, start / (start - end));
    }
    return enter < leave;
}

}  // namespace

Svg fig_03_07(const Options&) {
    constexpr double width = 26.0, height = 13.0;
    std::vector<Segment> segments;
    Pcg32 random(27);
    while (segments.size() < 22) {
        const Point2 middle = random_point(random, Aabb2{{1.5f, 1.0f}, {24.5f, 12.0f}});
        const auto angle = static_cast<double>(random.uniform(0.0f, 3.14f));
        const double half = static_cast<double>(random.uniform(0.5f, 1.4f));
        const Vector2 way = at(half * std::cos(angle), half * std::sin(angle));
        const bool near = std::ranges::any_of(segments, [&](const Segment& other) {
            return glm::length(0.5f * (other.a + other.b) - middle) < 2.4f;
        });
        if (!near) segments.push_back({middle - way, middle + way});
    }
    const Story story = watched_build(
        segments, {.splitter = BspConfig::SplitterChoice::weighted, .split_weight = 3.0},
        {{0, 0}, {width, 0}, {width, height}, {0, height}});
    const BasicRay<2> ray{.origin = {0.7f, 11.5f}, .direction = {1.0f, -0.4f}};
    std::vector<std::size_t> crossed, tested;  // nodes; fragments
    double nearest = infinity;
    TraversalCounts counts;
    front_to_back(story.tree, ray, counts, [&](const BspTree<2>::Node& node) {
        crossed.push_back(static_cast<std::size_t>(&node - story.tree.nodes.data()));
        for (std::uint32_t i = 0; i < node.count; ++i) {
            tested.push_back(node.first + i);
            nearest = std::min(
                nearest,
                distance_along(ray,
                               story.tree.polygons[story.tree.fragments[tested.back()].polygon]));
        }
        return nearest;
    });

    const TreeLayout layout = layout_of(story);
    const double row = 26;
    Svg svg(
        "A ray walks a BSP tree front to back: both children only where it crosses a node's "
        "line, and no further than its hit",
        640, 24 + 312 + 60 + row * static_cast<double>(layout.levels - 1));
    const PlaneView view{.corner = {8, 16}, .scale = 24, .size = height};
    const Double2 start(ray.origin), end = start + nearest * Double2(ray.direction);
    for (const EmptyCell& cell : story.cells)
        if (passes(cell.cell, start, end))
            svg.polygon(view(cell.cell), {.stroke = {}, .fill = Ink::sky, .opacity = 0.3});
    const auto is_in = [](const std::vector<std::size_t>& list, std::size_t i) {
        return std::ranges::find(list, i) != list.end();
    };
    for (const bool second : {false, true})
        for (std::size_t i = 0; i < story.turns.size(); ++i) {
            if (is_in(crossed, i) != second) continue;
            const auto [from, to] = line_in_cell(story, i);
            svg.line(view(from), view(to), {.stroke = second ? Ink::blue : Ink::faint});
        }
    for (std::size_t i = 0; i < story.tree.fragments.size(); ++i) {
        const Piece& piece = story.pieces[story.fragment_pieces[i]];
        draw_segment(svg, view, piece.from, piece.to,
                     {.stroke = {}, .fill = is_in(tested, i) ? Ink::green : Ink::ink});
    }
    svg.rect(view({0, height}), at(24 * width, 24 * height), {.stroke = Ink::quiet});
    svg.line(view(start), view(end), {.stroke = Ink::vermillion, .arrow = true}, "ray");
    svg.circle(view(start), 5, {.stroke = {}, .fill = Ink::vermillion});
    svg.circle(view(end), 6, {.stroke = Ink::vermillion});

    const double slots = static_cast<double>(story.cells.size()), slot = 620.0 / slots;
    const auto place = [&](const Double2& p) { return at(10 + slot * p.x, 356 + row * p.y); };
    std::uint64_t visited = 0;
    std::vector<bool> was_visited;
    for (const Turn& turn : story.turns) {
        // Up to just beyond the hit: what touches the hit segment there may have the smaller index.
        was_visited.push_back(passes(turn.cell, start, end + 1e-9 * (end - start)));
        visited += was_visited.back();
    }
    if (visited != counts.nodes_visited)
        throw std::logic_error(
            fmt::format("a ray: {} nodes seem visited, {} were", visited, counts.nodes_visited));
    for (std::size_t i = 0; i < story.turns.size(); ++i)
        if (story.turns[i].parent != BspTree<2>::none)
            svg.line(place(layout.nodes[story.turns[i].parent]), place(layout.nodes[i]),
                     {.stroke = was_visited[i] ? Ink::ink : Ink::faint});
    for (std::size_t i = 0; i < story.turns.size(); ++i) {
        const bool both = is_in(crossed, i);
        svg.circle(place(layout.nodes[i]), 6.5,
                   {.stroke = both             ? Ink::blue
                              : was_visited[i] ? Ink::ink
                                               : Ink::faint,
                    .fill = both ? Ink::blue : Ink::paper});
    }
    const double bottom = 356 + row * static_cast<double>(layout.levels - 1) + 24;
    svg.circle(at(18, bottom - 6), 6.5, {.stroke = Ink::blue, .fill = Ink::blue});
    svg.text(at(34, bottom), fmt::format("{} crossed: both children", crossed.size()),
             {.anchor = Anchor::start, .size = 17});
    svg.circle(at(278, bottom - 6), 6.5, {.stroke = Ink::ink, .fill = Ink::paper});
    svg.text(at(294, bottom), fmt::format("{} one child", visited - crossed.size()),
             {.anchor = Anchor::start, .size = 17});
    svg.circle(at(438, bottom - 6), 6.5, {.stroke = Ink::faint, .fill = Ink::paper});
    svg.text(at(454, bottom), fmt::format("{} not visited", story.turns.size() - visited),
             {.anchor = Anchor::start, .size = 17});
    return svg;
}

}  // namespace space::ch03
