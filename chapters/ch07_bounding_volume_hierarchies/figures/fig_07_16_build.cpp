// The build of a tree by bins, step by step: what the builder told its observer becomes the steps
// of a drawing, with the cost of each cut that it compared.

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/figures/recorded_bvh.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace space::ch07 {
namespace {

/// A place between two bins, and what a cut there costs.
struct Candidate {
    double place, cost;
    std::size_t bin;  ///< the first one after it
};

/// What the builder looked at in a turn: the same bins, filled again.
struct Binned {
    std::array<std::vector<Candidate>, 2> cuts = {};
    BvhBins<2>::Candidate best = {};
    double least;

    Binned(const Turn& turn, const BinnedBuilder::Config& config) {
        const std::size_t count = std::min(config.bins, turn.set.size());
        BvhBins<2> bins;
        bins.fill(turn.set, count);
        best = bins.best(turn.box, turn.set.size());
        least = cost_of(best.tests, config);
        const Aabb2 middles = box_around_centroids<2>(turn.set);
        const HitChance<2> chance(turn.box);
        for (int axis = 0; axis < 2; ++axis)
            for (std::size_t i = 1; i < count; ++i) {
                std::vector<BvhReference<2>> sides[2];
                for (const BvhReference<2>& reference : turn.set)
                    sides[bins.bin_of(reference.box.centroid(), axis) >= i].push_back(reference);
                if (sides[0].empty() || sides[1].empty()) continue;
                const double low = double{middles.min[axis]}, high = double{middles.max[axis]};
                double tests = 0.0;
                for (const auto& side : sides)
                    tests += chance(box_around<2>(side)) * double(side.size());
                cuts[std::size_t(axis)].push_back(
                    {low + double(i) / double(count) * (high - low), cost_of(tests, config), i});
            }
    }
    static double cost_of(double tests, const BinnedBuilder::Config& config) {
        return config.costs.traversal + config.costs.intersection * tests;
    }
};

/// What a step is about: a turn of the builder; none at the start and at the end.
struct Step {
    std::size_t turn;
    bool cut;  ///< the children have their boxes
    std::string tells;
};

class Stage {
  public:
    Stage() {
        for (const Turn& turn : story_.turns) binned_.emplace_back(turn, config());
        write_script();
    }
    void draw(Svg& svg) const;

  private:
    static BinnedBuilder::Config config() { return {.costs = {1.0, 1.0}, .max_leaf_size = 1}; }
    void write_script();
    std::string tells_bins(std::size_t turn) const;
    void add(std::size_t turn, bool cut, std::string tells) {
        steps_.push_back({turn, cut, std::move(tells)});
    }
    int next_step() const { return static_cast<int>(steps_.size()); }
    std::span<const BvhReference<2>> part(const Turn& turn, bool second) const {
        const std::span<const BvhReference<2>> all(turn.set);
        return second ? all.subspan(turn.first) : all.first(turn.first);
    }
    Ink ink_of(std::size_t step, std::uint32_t segment) const;

    void draw_boxes(Svg& svg, std::size_t k) const;
    void draw_costs(Svg& svg, const Turn& turn, const Binned& binned) const;
    void draw_segments(Svg& svg) const;
    void draw_tree(Svg& svg) const;
    void draw_node(Svg& svg, const Turn& turn, Ink ink) const;
    Point2 place(std::uint32_t node) const {
        return at(416 + 41 * layout_[node].x, 34 + 76 * layout_[node].y);
    }

    Story story_ = watched_build<BinnedBuilder>(heinonen_segments(), config());
    std::vector<Binned> binned_;
    std::vector<Double2> layout_ = layout_of(story_.tree);
    std::vector<Step> steps_;
    std::vector<int> since_;  ///< by turn: its first step
    static constexpr double side = 280;
    PlaneView view_{.corner = {8, 10}, .scale = side / heinonen_size, .size = heinonen_size};
};

std::string Stage::tells_bins(std::size_t i) const {
    const Turn& turn = story_.turns[i];
    const Binned& binned = binned_[i];
    return fmt::format(
        "Node {}, {}: the middles in {} bins along each axis. Of {} cuts between bins the cheapest "
        "is across {} and costs {:.2f}. A leaf would cost {}.",
        plain_node_name(story_, turn.node), plain_set(story_, turn.set), turn.set.size(),
        binned.cuts[0].size() + binned.cuts[1].size(), "xy"[binned.best.axis], binned.least,
        svg_number(config().costs.intersection * double(turn.set.size())));
}

void Stage::write_script() {
    const std::size_t none = story_.turns.size();
    add(none, false,
        fmt::format("{} segments with their boxes, and the box around all of them: the root. One "
                    "range of references waits.",
                    story_.segments.size()));
    for (std::size_t i = 0; i < story_.turns.size(); ++i) {
        const Turn& turn = story_.turns[i];
        since_.push_back(next_step());
        if (turn.first == 0) {
            add(i, false, fmt::format("{} is alone: a leaf.", plain_set(story_, turn.set)));
            continue;
        }
        add(i, false, tells_bins(i));
        add(i, true,
            fmt::format("{} first, {} second, each with a box that fits. The two nodes stand side "
                        "by side; the first is next.",
                        plain_set(story_, part(turn, false)), plain_set(story_, part(turn, true))));
    }
    add(none, true,
        fmt::format("Nothing waits any more: {} nodes, {} of them leaves. The expected cost of a "
                    "ray that meets the root is {:.2f}.",
                    story_.tree.size(), story_.segments.size(),
                    story_.tree.sah_cost(config().costs)));
}

Ink Stage::ink_of(std::size_t step, std::uint32_t segment) const {
    if (steps_[step].turn >= story_.turns.size()) return Ink::ink;
    const Turn& turn = story_.turns[steps_[step].turn];
    const auto in = [&](std::span<const BvhReference<2>> set) {
        return std::ranges::find(set, segment, &BvhReference<2>::polygon) != set.end();
    };
    if (!in(turn.set)) return Ink::quiet;
    if (turn.first == 0) return Ink::green;
    if (!steps_[step].cut) return Ink::ink;
    return in(part(turn, false)) ? Ink::blue : Ink::vermillion;
}

/// The boxes that a step is about: the node's, or its children's; at the end all of them.
void Stage::draw_boxes(Svg& svg, std::size_t k) const {
    const Step& step = steps_[k];
    if (step.turn >= story_.turns.size()) {
        story_.tree.for_each_node([&](std::uint32_t index, unsigned) {
            const BvhNode<2>& node = story_.tree.nodes[index];
            if (step.cut || index == 0)
                draw_box(svg, view_, node.box, 3,
                         {.stroke = node.is_leaf() ? Ink::faint : Ink::blue});
        });
        return;
    }
    const Turn& turn = story_.turns[step.turn];
    draw_box(svg, view_, turn.box, 5,
             {.stroke = Ink::green,
              .fill = step.cut ? std::nullopt : std::optional(Ink::green),
              .opacity = 0.14});
    if (step.cut) {
        draw_box(svg, view_, box_around<2>(part(turn, false)), 2,
                 {.stroke = Ink::blue, .fill = Ink::sky, .opacity = 0.3});
        draw_box(svg, view_, box_around<2>(part(turn, true)), 2,
                 {.stroke = Ink::vermillion, .fill = Ink::orange, .opacity = 0.3});
    }
    if (turn.first > 0) draw_costs(svg, turn, binned_[step.turn]);
}

/// Where bins meet, and bars as long as the cut there is dear: below for x, on the right for y. The
/// dashed line is what a leaf costs.
void Stage::draw_costs(Svg& svg, const Turn& turn, const Binned& binned) const {
    constexpr double longest = 64;
    const double leaf = config().costs.intersection * double(turn.set.size());
    const Double2 low(turn.box.min), high(turn.box.max);
    const double bottom = 10 + side + 14, right = 8 + side + 14;
    svg.line(moved(view_({low.x, 0}), 0, 14 + longest), moved(view_({high.x, 0}), 0, 14 + longest),
             {.stroke = Ink::quiet, .dashed = true});
    svg.line(moved(view_({heinonen_size, low.y}), 14 + longest, 0),
             moved(view_({heinonen_size, high.y}), 14 + longest, 0),
             {.stroke = Ink::quiet, .dashed = true});
    for (int axis = 0; axis < 2; ++axis)
        for (const auto& [place, cost, bin] : binned.cuts[std::size_t(axis)]) {
            const bool best = axis == binned.best.axis && bin == binned.best.bin;
            const Ink ink = best ? Ink::green : Ink::sky;
            const double length = longest * cost / leaf;
            if (axis == 0) {
                const double x = view_({place, 0}).x;
                svg.line(view_({place, low.y}), view_({place, high.y}),
                         {.stroke = ink, .dashed = true});
                svg.rect(at(x - 3, bottom), at(6, length), {.stroke = {}, .fill = ink});
                if (best)
                    svg.text(at(x, bottom + longest + 22), fmt::format("{:.2f}", cost),
                             {.ink = ink, .size = 18});
            } else {
                const double y = view_({0, place}).y;
                svg.line(view_({low.x, place}), view_({high.x, place}),
                         {.stroke = ink, .dashed = true});
                svg.rect(at(right, y - 3), at(length, 6), {.stroke = {}, .fill = ink});
                if (best)
                    svg.text(at(right + longest + 6, y + 6), fmt::format("{:.2f}", cost),
                             {.anchor = Anchor::start, .ink = ink, .size = 18});
            }
        }
}

void Stage::draw_segments(Svg& svg) const {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        svg.begin_step_alone(k, steps_.size());
        for (std::uint32_t i = 0; i < story_.named.size(); ++i) {
            const NamedSegment& segment = story_.named[i];
            const Ink ink = ink_of(k, i);
            draw_segment(svg, view_, segment.from, segment.to, {.stroke = {}, .fill = ink});
            svg.text(heinonen_name_place(view_, segment), drawn_name(segment.name),
                     {.ink = ink, .size = 22, .halo = true});
        }
        svg.end_group();
    }
}

void Stage::draw_node(Svg& svg, const Turn& turn, Ink ink) const {
    const Style style{.stroke = ink, .fill = Ink::paper};
    if (turn.first > 0)
        svg.circle(place(turn.node), 18, style);
    else
        svg.rect(moved(place(turn.node), -16, -16), at(32, 32), style);
    svg.text(moved(place(turn.node), 0, 7), drawn_node_name(story_, turn.node),
             {.ink = ink, .size = 22});
}

/// Nodes that wait show how many references they have.
void Stage::draw_tree(Svg& svg) const {
    for (const Turn& parent : story_.turns) {
        if (parent.first == 0) continue;
        const std::uint32_t first = story_.tree.nodes[parent.node].first;
        svg.begin_step(since_[story_.turn_of(parent.node)] + 1);
        for (const std::uint32_t child : {first, first + 1})
            svg.line(place(parent.node), place(child), {.stroke = Ink::quiet});
        for (const std::uint32_t child : {first, first + 1}) {
            svg.circle(place(child), 16, {.stroke = Ink::orange, .fill = Ink::paper});
            svg.text(moved(place(child), 0, 7),
                     std::to_string(story_.turns[story_.turn_of(child)].set.size()),
                     {.ink = Ink::ink, .size = 20});
        }
        svg.end_group();
    }
    for (std::size_t i = 0; i < story_.turns.size(); ++i) {
        const Turn& turn = story_.turns[i];
        const int last = since_[i] + (turn.first > 0 ? 1 : 0);
        svg.begin_step(since_[i], last);
        draw_node(svg, turn, Ink::green);
        svg.end_group();
        svg.begin_step(last + 1);
        draw_node(svg, turn, Ink::ink);
        svg.end_group();
    }
}

void Stage::draw(Svg& svg) const {
    for (std::size_t k = 0; k < steps_.size(); ++k) {
        svg.begin_step_alone(k, steps_.size(), steps_[k].tells);
        draw_boxes(svg, k);
        svg.end_group();
    }
    svg.rect(view_({0, heinonen_size}), at(side, side), {.stroke = Ink::faint});
    draw_segments(svg);
    draw_tree(svg);
}

}  // namespace

Svg fig_07_16(const Options&) {
    Svg svg("The segments A to G and the tree that the binned builder makes of them, step by step",
            708, 404);
    Stage().draw(svg);
    return svg;
}

}  // namespace space::ch07
