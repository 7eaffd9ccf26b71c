#include "common/program/walk_drawing.hpp"

#include "common/program/tree_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace space {
namespace {

constexpr double frame = 336, row = 28;

/// Where a line through the square leaves it.
double exit_of(const BasicRay<2>& ray, double size) {
    double exit = infinity;
    for (int axis = 0; axis < 2; ++axis) {
        const auto o = static_cast<double>(ray.origin[axis]),
                   d = static_cast<double>(ray.direction[axis]);
        if (d != 0.0) exit = std::min(exit, ((d > 0.0 ? size : 0.0) - o) / d);
    }
    return exit;
}

/// The drawing's parts, and where they stand on the paper.
class WalkPaper {
  public:
    WalkPaper(const DrawnTree& tree, const BasicRay<2>& ray, const std::vector<WalkStep>& steps)
        : tree_(tree),
          ray_(ray),
          steps_(steps),
          view_(walk_view(tree.size)),
          exit_(exit_of(ray, tree.size)) {
        std::vector<std::vector<std::size_t>> children;
        for (const DrawnTree::Node& node : tree.nodes) children.push_back(node.children);
        places_ = tree_layout(children);
        tree_paper_ = TreePaper(places_);
        for (const WalkStep& step : steps) rows_ = std::max(rows_, 1 + step.waiting.size());
    }

    double height() const { return strip + row * static_cast<double>(rows_) + 8; }
    void draw(Svg& svg) const;

  private:
    static constexpr double strip = 386;  ///< below it stand the rows

    void draw_cells(Svg& svg, std::size_t k) const;
    void draw_lines(Svg& svg, const DrawnTree::Node& node, Ink ink) const;
    void draw_segments(Svg& svg) const;
    void draw_ray(Svg& svg, std::size_t k) const;
    void draw_tree(Svg& svg) const;
    void draw_rows(Svg& svg, std::size_t k) const;
    template <class InkOf, class Draw>
    void in_inks(Svg& svg, const InkOf& ink_of, const Draw& draw) const;
    void draw_node(Svg& svg, std::size_t i, Ink ink) const;
    void draw_bar(Svg& svg, std::size_t place, const WalkStep::Visit& visit, Ink ink) const;

    Point2 place(std::size_t node) const { return tree_paper_(places_[node]); }
    Point2 on_ray(double t) const {
        return view_(Double2(ray_.origin) + std::min(t, exit_) * Double2(ray_.direction));
    }
    Point2 on_axis(double t, double y) const {
        return at(exit_ > 0.0 ? 56 + 430 / exit_ * std::min(t, exit_) : 56, y);
    }
    bool waits(std::size_t k, std::size_t node) const {
        return std::ranges::find(steps_[k].waiting, node, &WalkStep::Visit::node) !=
               steps_[k].waiting.end();
    }
    bool visited_before(std::size_t k, std::size_t node) const {
        return std::any_of(
            steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(k),
            [&](const WalkStep& step) { return step.in_hand && step.in_hand->node == node; });
    }
    Ink node_ink(std::size_t k, std::size_t node) const {
        const WalkStep& step = steps_[k];
        if (step.in_hand && step.in_hand->node == node) return Ink::green;
        if (step.next == node) return Ink::blue;
        if (waits(k, node)) return Ink::orange;
        return visited_before(k, node) ? Ink::ink : Ink::quiet;
    }

    const DrawnTree& tree_;
    const BasicRay<2>& ray_;
    const std::vector<WalkStep>& steps_;
    PlaneView view_;
    double exit_;  ///< 0 where the ray leaves the square at once
    TreePaper tree_paper_{0, 0};
    std::size_t rows_ = 1;
    std::vector<Double2> places_;
};

/// Where the ray goes next, and what waits.
void WalkPaper::draw_cells(Svg& svg, std::size_t k) const {
    const WalkStep& step = steps_[k];
    if (step.next)
        svg.polygon(view_(tree_.nodes[*step.next].cell),
                    {.stroke = {}, .fill = Ink::sky, .opacity = 0.4});
    for (const WalkStep::Visit& visit : step.waiting)
        svg.polygon(view_(tree_.nodes[visit.node].cell),
                    {.stroke = {}, .fill = Ink::orange, .opacity = 0.3});
}

void WalkPaper::draw_lines(Svg& svg, const DrawnTree::Node& node, Ink ink) const {
    for (std::size_t i = 0; i + 1 < node.lines.size(); i += 2)
        svg.line(view_(node.lines[i]), view_(node.lines[i + 1]), {.stroke = ink});
}

/// What is drawn once for each run of steps that give it the same ink.
template <class InkOf, class Draw>
void WalkPaper::in_inks(Svg& svg, const InkOf& ink_of, const Draw& draw) const {
    for (std::size_t first = 0, next = 0; first < steps_.size(); first = next) {
        const Ink ink = ink_of(first);
        while (next < steps_.size() && ink_of(next) == ink) ++next;
        svg.begin_step(static_cast<int>(first),
                       next == steps_.size() ? std::optional<int>() : static_cast<int>(next) - 1);
        draw(ink);
        svg.end_group();
    }
}

void WalkPaper::draw_segments(Svg& svg) const {
    for (std::size_t i = 0; i < tree_.segments.size(); ++i) {
        const NamedSegment& segment = tree_.segments[i];
        const auto ink_of = [&](std::size_t k) {
            return std::ranges::count(steps_[k].tested, i) > 0 ? Ink::vermillion : Ink::ink;
        };
        in_inks(svg, ink_of, [&](Ink ink) {
            draw_segment(svg, view_, segment.from, segment.to, {.stroke = {}, .fill = ink});
            svg.text(heinonen_name_place(view_, segment), drawn_name(segment.name),
                     {.ink = ink, .size = 24, .halo = true});
        });
    }
}

/// Its part in hand, where it meets the node's line, and the hit.
void WalkPaper::draw_ray(Svg& svg, std::size_t k) const {
    const WalkStep& step = steps_[k];
    const Double2 origin(ray_.origin), way(ray_.direction);
    if (step.in_hand) {
        const double leave = std::min(step.in_hand->leave, exit_);
        const double enter = std::min(step.in_hand->enter, exit_);
        draw_segment(svg, view_, origin + enter * way, origin + leave * way,
                     {.stroke = {}, .fill = Ink::green});
    }
    for (const double t : step.crossings)
        if (t >= 0.0 && t <= exit_)
            svg.circle(on_ray(t), 5, {.stroke = Ink::paper, .fill = Ink::green});
    if (step.hit) svg.circle(on_ray(*step.hit), 8, {.stroke = Ink::vermillion});
}

void WalkPaper::draw_tree(Svg& svg) const {
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i)
        for (const std::size_t child : tree_.nodes[i].children)
            in_inks(
                svg,
                [&](std::size_t k) {
                    const Ink ink = node_ink(k, child);
                    return ink == Ink::green ? Ink::ink : ink;
                },
                [&](Ink ink) {
                    svg.line(place(i), place(child),
                             {.stroke = ink, .dashed = tree_.nodes[child].name.empty()});
                });
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i)
        in_inks(
            svg, [&](std::size_t k) { return node_ink(k, i); },
            [&](Ink ink) { draw_node(svg, i, ink); });
}

void WalkPaper::draw_node(Svg& svg, std::size_t i, Ink ink) const {
    const DrawnTree::Node& node = tree_.nodes[i];
    const Style style{.stroke = ink, .fill = Ink::paper};
    const double shrink = tree_paper_.shrink;
    const auto marks = std::ranges::count_if(node.name, [](char c) {
        return std::string_view("*_{}").find(c) != std::string_view::npos;
    });
    const auto letters = static_cast<double>(node.name.size()) - static_cast<double>(marks);
    double size = 24 * shrink;
    if (node.children.empty()) {
        const bool has_subscript = node.name.find('_') != std::string::npos;
        const double half = shrink * std::max(14.0, (has_subscript ? 7.0 : 9.0) * letters);
        svg.rect(moved(place(i), -half, -14 * shrink), at(2 * half, 28 * shrink), style);
    } else {
        svg.circle(place(i), 20 * shrink, style);
        if (letters > 2) size = 19 * shrink;
    }
    if (!node.name.empty())
        svg.text(moved(place(i), 0, 8 * shrink), node.name, {.ink = ink, .size = size});
}

void WalkPaper::draw_bar(Svg& svg, std::size_t place, const WalkStep::Visit& visit, Ink ink) const {
    const double y = strip + row * static_cast<double>(place);
    const Point2 from = on_axis(std::max(visit.enter, 0.0), y + 6),
                 to = on_axis(visit.leave, y + 6);
    svg.rect(from, at(static_cast<double>(to.x - from.x), 12), {.stroke = {}, .fill = ink});
    const std::string& name = tree_.nodes[visit.node].name;
    if (name.empty())
        svg.rect(at(21, y + 4), at(16, 16), {.stroke = Ink::quiet, .fill = Ink::paper});
    else
        svg.text(at(29, y + 19), name, {.size = 20});
    svg.text(at(500, y + 18), interval(visit.enter, visit.leave),
             {.anchor = Anchor::start, .size = 18});
}

/// What is in hand and what waits, each with its part of the ray.
void WalkPaper::draw_rows(Svg& svg, std::size_t k) const {
    const WalkStep& step = steps_[k];
    if (step.in_hand) draw_bar(svg, 0, *step.in_hand, Ink::green);
    for (std::size_t i = 0; i < step.waiting.size(); ++i)
        draw_bar(svg, step.waiting.size() - i, step.waiting[i], Ink::orange);
    if (step.hit)
        svg.line(on_axis(*step.hit, strip - 16), on_axis(*step.hit, height() - 8),
                 {.stroke = Ink::vermillion});
}

void WalkPaper::draw(Svg& svg) const {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        svg.begin_step_alone(k, steps_.size(), steps_[k].tells);
        draw_cells(svg, k);
        svg.end_group();
    }
    svg.rect(view_({0, tree_.size}), at(frame, frame), {.stroke = Ink::quiet});
    for (const DrawnTree::Node& node : tree_.nodes)
        if (node.ink) draw_lines(svg, node, *node.ink);
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        svg.begin_step_alone(k, steps_.size());
        if (steps_[k].in_hand) draw_lines(svg, tree_.nodes[steps_[k].in_hand->node], Ink::green);
        svg.end_group();
    }
    draw_segments(svg);
    draw_tree(svg);
    svg.line(on_axis(0.0, strip - 8), on_axis(exit_, strip - 8),
             {.stroke = Ink::quiet, .arrow = true});
    svg.text(at(29, strip - 4), "*t*", {.size = 20});
    svg.line(on_ray(0.0), on_ray(exit_), {.stroke = Ink::quiet, .arrow = true});
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        svg.begin_step_alone(k, steps_.size());
        draw_ray(svg, k);
        draw_rows(svg, k);
        svg.end_group();
    }
    svg.circle(on_ray(0.0), 5, {.fill = Ink::ink});
}

}  // namespace

std::string written_t(double t) {
    if (t == double{infinity}) return "∞";
    const std::string text = svg_number(t);
    return text.starts_with('-') ? "−" + text.substr(1) : text;
}

std::string interval(double enter, double leave) {
    return fmt::format("[{}, {}{}", written_t(enter), written_t(leave),
                       leave == double{infinity} ? ")" : "]");
}

double distance_along(const BasicRay<2>& ray, const Segment& segment) {
    const Double2 o(ray.origin), d(ray.direction), a(segment.a), way = Double2(segment.b) - a;
    const double turn = d.x * way.y - d.y * way.x;
    if (turn == 0.0) return infinity;
    const Double2 from = a - o;
    const double t = (from.x * way.y - from.y * way.x) / turn,
                 s = (from.x * d.y - from.y * d.x) / turn;
    return t >= 0.0 && s >= 0.0 && s <= 1.0 ? t : double{infinity};
}

PlaneView walk_view(double size) {
    return {.corner = {8, 10}, .scale = frame / size, .size = size};
}

Svg walk_drawing(std::string title, const DrawnTree& tree, const BasicRay<2>& ray,
                 const std::vector<WalkStep>& steps) {
    const WalkPaper paper(tree, ray, steps);
    Svg svg(std::move(title), 676, paper.height());
    paper.draw(svg);
    return svg;
}

}  // namespace space
