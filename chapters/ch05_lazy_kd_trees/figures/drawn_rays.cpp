#include "chapters/ch05_lazy_kd_trees/figures/drawn_rays.hpp"

#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "common/program/tree_layout.hpp"
#include "common/program/walk_drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace space::ch05 {
namespace {

/// A node that was made.
struct Made {
    std::uint32_t node;
    Aabb2 cell;
    std::vector<std::uint32_t> set;
    std::optional<KdSplit> split;
    std::uint32_t below = 0;  ///< its children
    int step = 0;             ///< in which it is made
};

/// Writes down what is made.
struct Watcher : NoObserver {
    std::vector<Made>* made;

    explicit Watcher(std::vector<Made>& to) : made(&to) {}
    using NoObserver::observe;
    void observe(const KdSplitter<2>::Chosen& event) const {
        Made node{event.node, event.cell, {}, event.split};
        for (const auto& reference : event.references) node.set.push_back(reference.polygon);
        made->push_back(std::move(node));
    }
};
using Nodes = LazyKdNodes<2, Watcher>;

/// Counts the nodes that a walk visits.
struct Visits {
    std::size_t count = 0;
    void observe(const KdVisit&) { ++count; }
};

/// What a step is about.
struct Step {
    std::string tells;
    std::optional<std::size_t> ray = {};
    std::optional<std::uint32_t> node = {};  ///< is made
    std::optional<double> hit = {};
};

/// The rays, what they made, and the steps in which that is told.
class Story {
  public:
    std::vector<Segment> segments;
    std::vector<Ray2> rays;
    std::vector<double> reach;  ///< of each ray: where it hits; infinity where it does not
    Aabb2 box;
    std::vector<Made> made;
    std::vector<Step> steps;

    explicit Story(const LazyRays& asked) : segments(asked.segments), rays(asked.rays) {
        const Nodes nodes(
            segments,
            {.rule = asked.rule, .max_leaf_size = 1, .max_depth = asked.max_depth, .at_once = 0},
            Watcher(made));
        box = nodes.box;
        steps.push_back(
            {.tells = fmt::format("{} segments, and the box of them all. One node waits, "
                                  "with all of them; nothing else is there.",
                                  segments.size())});
        for (std::size_t ray = 0; ray < rays.size(); ++ray) trace(nodes, ray, asked.fan);
        const LazyKdCounts counts = nodes.counts();
        const std::size_t stand = made.size();
        nodes.build_all();
        steps.push_back(
            {.tells = fmt::format(
                 "{} rays are through. {} and {} wait{}; the whole tree would "
                 "have {}.",
                 rays.size(), stand == 1 ? "1 node stands" : fmt::format("{} nodes stand", stand),
                 counts.waiting, counts.waiting == 1 ? "s" : "", nodes.counts().standing())});
        made.resize(stand);
    }

    std::string names(const std::vector<std::uint32_t>& set) const {
        std::vector<std::string> words;
        for (const std::uint32_t i : set) words.push_back(name(i));
        return fmt::format("{{{}}}", fmt::join(words, ", "));
    }
    static std::string name(std::uint32_t segment) { return std::string(1, char('A' + segment)); }

  private:
    void trace(const Nodes& nodes, std::size_t number, bool only_makers) {
        const Ray2& ray = rays[number];
        const std::size_t before = made.size();
        Visits visits;
        NoCounts none;
        double nearest = infinity;
        std::string hit = "nothing";
        walk_cells(
            nodes, ray, none,
            [&](std::uint32_t leaf) {
                for (const std::uint32_t i : nodes.own(leaf)) {
                    const double t = distance_along(ray, segments[i]);
                    if (t < nearest) nearest = t, hit = name(i);
                }
                return nearest;
            },
            visits);
        reach.push_back(nearest);
        if (only_makers && made.size() == before) return;
        for (std::size_t i = before; i < made.size(); ++i) tell(nodes, number, made[i]);
        Step end{
            .tells = fmt::format("Ray {} hits {}. It has visited {} nodes and made {} of them.",
                                 number + 1, hit, visits.count, made.size() - before),
            .ray = number};
        if (nearest < double{infinity}) end.hit = nearest;
        steps.push_back(end);
    }

    void tell(const Nodes& nodes, std::size_t ray, Made& node) {
        node.step = int(steps.size());
        Step step{.tells = {}, .ray = ray, .node = node.node};
        if (node.split) {
            node.below = nodes.node(node.node).below();
            step.tells = fmt::format(
                "Ray {} enters a node that waits with {}. It is made: a plane at {} = {}, and two "
                "children that wait. What it held is given back.",
                ray + 1, names(node.set), "xy"[node.split->axis],
                svg_number(double{node.split->position}));
        } else {
            step.tells = fmt::format("Ray {} enters a node that waits with {}: a leaf.", ray + 1,
                                     names(node.set));
        }
        steps.push_back(step);
    }
};

/// The story on paper: the plane on the left, the tree on the right.
class Stage {
  public:
    Stage(const Story& story, bool fan) : story_(story), fan_(fan) {
        std::vector<std::vector<std::size_t>> children{{}};
        numbers_[0] = 0;
        nodes_.push_back({.index = 0, .cell = whole(), .from = 0});
        for (const Made& made : story_.made) {  // parents come before their children
            Drawn& node = nodes_[numbers_[made.node]];
            node.made = &made;
            if (!made.split) continue;
            const auto [below, above] = halves(made.cell, *made.split);
            add(made.below, below, made.step, children, made.node);
            add(made.below + 1, above, made.step, children, made.node);
        }
        places_ = tree_layout(children);
        paper_ = TreePaper(places_, {372, 32}, {296, 290});
    }

    void draw(Svg& svg) const {
        draw_cells(svg);
        svg.rect(view_({0, heinonen_size}), at(336, 336), {.stroke = Ink::quiet});
        draw_planes(svg);
        draw_segments(svg);
        draw_rays(svg);
        for (std::size_t i = 0; i < nodes_.size(); ++i) draw_node(svg, i);
    }

  private:
    /// A node as it waits, and from some step on stands.
    struct Drawn {
        std::uint32_t index;
        Aabb2 cell;
        int from;  ///< the step from which on it waits
        std::optional<std::size_t> parent = {};
        const Made* made = nullptr;
    };

    Aabb2 whole() const { return story_.box; }
    void add(std::uint32_t index, const Aabb2& cell, int from,
             std::vector<std::vector<std::size_t>>& children, std::uint32_t parent) {
        const std::size_t above = numbers_[parent];
        numbers_[index] = nodes_.size();
        children[above].push_back(nodes_.size());
        children.emplace_back();
        nodes_.push_back({.index = index, .cell = cell, .from = from, .parent = above});
    }
    Point2 place(std::size_t node) const { return paper_(places_[node]); }
    /// Up to where a ray that hits nothing is drawn: a unit before the square's side, but not less
    /// than a unit.
    static double end_of(const Ray2& ray) {
        const Double2 from(ray.origin), way(ray.direction);
        double end = infinity;
        for (int axis = 0; axis < 2; ++axis)
            if (way[axis] != 0.0)
                end = std::min(
                    end, ((way[axis] > 0.0 ? heinonen_size - 1 : 1) - from[axis]) / way[axis]);
        return std::max(end, 1 / glm::length(way));
    }
    static ConvexCell corners(const Aabb2& box) {
        const Double2 low(box.min), high(box.max);
        return {low, {high.x, low.y}, high, {low.x, high.y}};
    }

    /// Grey: nobody has been there. Green: the node that is made.
    void draw_cells(Svg& svg) const {
        for (std::size_t k = 0; k < story_.steps.size(); ++k) {
            svg.begin_step_alone(k, story_.steps.size(), story_.steps[k].tells);
            for (const Drawn& node : nodes_) {
                const int step = int(k);
                if (step < node.from) continue;
                const bool stands = node.made && node.made->step <= step;
                const bool is_new = node.made && node.made->step == step;
                const auto fill = [&](Ink ink, double opacity) {
                    svg.polygon(view_(corners(node.cell)),
                                {.stroke = {}, .fill = ink, .opacity = opacity});
                };
                if (is_new) fill(Ink::green, 0.3);
                if (!stands) fill(Ink::quiet, 0.3);
            }
            svg.end_group();
        }
    }
    void draw_planes(Svg& svg) const {
        svg.polygon(view_(corners(whole())), {.stroke = Ink::quiet, .dashed = true});
        for (const Made& made : story_.made) {
            if (!made.split) continue;
            Double2 from(made.cell.min), to(made.cell.max);
            from[made.split->axis] = to[made.split->axis] = double{made.split->position};
            svg.begin_step(made.step);
            svg.line(view_(from), view_(to), {.stroke = Ink::blue});
            svg.end_group();
        }
    }
    void draw_segments(Svg& svg) const {
        for (std::uint32_t i = 0; i < story_.segments.size(); ++i) {
            const NamedSegment segment{Story::name(i), Double2(story_.segments[i].a),
                                       Double2(story_.segments[i].b)};
            draw_segment(svg, view_, segment.from, segment.to, {.stroke = {}, .fill = Ink::ink});
            svg.text(heinonen_name_place(view_, segment), drawn_name(segment.name),
                     {.size = 24, .halo = true});
        }
    }
    /// A ray up to its hit, from its last step on; all of its line before.
    void draw_rays(Svg& svg) const {
        for (std::size_t ray = 0; ray < story_.rays.size(); ++ray) {
            const Ray2& r = story_.rays[ray];
            const auto on = [&](double t) {
                return view_(Double2(r.origin) + t * Double2(r.direction));
            };
            const double all = end_of(r);
            if (fan_) svg.line(on(0), on(std::min(story_.reach[ray], all)), {.stroke = Ink::faint});
            const auto is_of = [&](const Step& step) { return step.ray == ray; };
            const auto first = std::ranges::find_if(story_.steps, is_of);
            if (first == story_.steps.end()) continue;
            const auto last = std::find_if(first, story_.steps.end(),
                                           [&](const Step& s) { return s.ray == ray && !s.node; });
            const int begins = int(first - story_.steps.begin()),
                      ends = int(last - story_.steps.begin());
            if (begins < ends) {
                svg.begin_step(begins, ends - 1);
                svg.line(on(0), on(all), {.stroke = Ink::green, .dashed = true, .arrow = true});
                svg.end_group();
            }
            svg.begin_step(ends);
            svg.line(on(0), on(last->hit.value_or(all)),
                     {.stroke = Ink::vermillion, .arrow = true});
            svg.end_group();
        }
    }
    /// Dashed while it waits.
    void draw_node(Svg& svg, std::size_t i) const {
        const Drawn& node = nodes_[i];
        const auto draw = [&](int from, std::optional<int> to, Ink ink, bool waits) {
            svg.begin_step(from, to);
            const Style style{.stroke = ink, .fill = Ink::paper, .dashed = waits};
            if (node.parent)
                svg.line(moved(place(*node.parent), 0, paper_.shrunk(18)),
                         moved(place(i), 0, paper_.shrunk(-16)),
                         {.stroke = waits ? Ink::quiet : ink, .dashed = waits});
            const bool leaf = !waits && !node.made->split;
            const double needed = leaf ? std::max(17.0, 7.0 * double(node.made->set.size())) : 17.0,
                         half = std::min(paper_.shrunk(needed), 0.5 * paper_.slot - 1),
                         size = 18 * (leaf ? half / needed : paper_.shrunk(1));
            if (waits || leaf)
                svg.rect(moved(place(i), -half, paper_.shrunk(-16)),
                         at(2 * half, paper_.shrunk(32)), style);
            else
                svg.circle(place(i), paper_.shrunk(18), style);
            svg.text(moved(place(i), 0, paper_.shrunk(7)), label(node, waits),
                     {.ink = ink, .size = size});
            svg.end_group();
        };
        if (!node.made) return draw(node.from, {}, Ink::quiet, true);
        if (node.from < node.made->step) draw(node.from, node.made->step - 1, Ink::quiet, true);
        draw(node.made->step, node.made->step, Ink::green, false);
        draw(node.made->step + 1, {}, Ink::ink, false);
    }
    /// A plane's axis, a leaf's segment, or that it waits.
    std::string label(const Drawn& node, bool waits) const {
        if (waits) return "?";
        if (node.made->split) return std::string("*") + "xy"[node.made->split->axis] + "*";
        std::string names;
        for (const std::uint32_t i : node.made->set) names += drawn_name(Story::name(i));
        return names;
    }

    const Story& story_;
    bool fan_;
    PlaneView view_ = rays_view();
    std::vector<Drawn> nodes_;
    std::map<std::uint32_t, std::size_t> numbers_;  ///< of nodes, by their index in the tree
    std::vector<Double2> places_;
    TreePaper paper_{0, 0};
};

}  // namespace

PlaneView rays_view() {
    return {.corner = {8, 10}, .scale = 21, .size = heinonen_size};
}

DrawnRays drawn_rays(const LazyRays& asked) {
    const Story story(asked);
    Svg svg("The segments A to G and a lazy k-d tree over them, ray by ray", 684, 356);
    Stage(story, asked.fan).draw(svg);
    return {.drawing = std::move(svg), .tells = story.steps.back().tells};
}

}  // namespace space::ch05
