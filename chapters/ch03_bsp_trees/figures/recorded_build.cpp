#include "chapters/ch03_bsp_trees/figures/recorded_build.hpp"

#include "common/program/tree_layout.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <utility>

namespace space::ch03 {
namespace {

/// Writes the builder's events down.
class BuildWatcher {
  public:
    BuildWatcher(Story& story, std::span<const Segment> segments) : story_(story) {
        for (std::uint32_t i = 0; i < segments.size(); ++i)
            story_.pieces.push_back({std::string(1, static_cast<char>('A' + static_cast<int>(i))),
                                     i, Double2(segments[i].a), Double2(segments[i].b)});
    }
    void observe(const BspBuilder<2>::Chosen& event) {
        story_.turns.push_back(
            {event.parent, event.in_front, event.polygon, {}, {}, {}, {}, {}, {}});
    }
    void observe(const BspBuilder<2>::Placed& event) {
        const std::size_t piece = number_of(event.fragment);
        Turn& turn = story_.turns.back();
        turn.set.push_back(piece);
        if (event.side == PlaneSide::front) turn.front.push_back(piece);
        if (event.side == PlaneSide::back) turn.back.push_back(piece);
        if (event.side == PlaneSide::coplanar) turn.own.push_back(piece);
    }
    void observe(const BspBuilder<2>::Cut& event) {
        const std::size_t piece = number_of(event.whole);
        Turn& turn = story_.turns.back();
        turn.cuts.push_back({piece, add(piece, event.front, '1'), add(piece, event.back, '2')});
        turn.front.push_back(turn.cuts.back().front);
        turn.back.push_back(turn.cuts.back().back);
    }
    std::size_t number_of(const Fragment<2>& fragment) const {
        const auto same = [&](const Piece& piece) {
            return piece.polygon == fragment.polygon && piece.from == fragment.corners[0].at &&
                   piece.to == fragment.corners[1].at;
        };
        const auto& pieces = story_.pieces;
        return static_cast<std::size_t>(std::ranges::find_if(pieces, same) - pieces.begin());
    }

  private:
    std::size_t add(std::size_t whole, const Fragment<2>& fragment, char suffix) {
        story_.pieces.push_back({story_.pieces[whole].name + suffix, fragment.polygon,
                                 fragment.corners[0].at, fragment.corners[1].at});
        return story_.pieces.size() - 1;
    }
    Story& story_;
};

double distance(const Double2& p, const Double2& from, const Double2& to) {
    const Double2 way = to - from;
    const double along = std::clamp(glm::dot(p - from, way) / glm::dot(way, way), 0.0, 1.0);
    return glm::length(p - from - along * way);
}

/// Of a grid of points the one of the cell that is farthest from its sides and from all pieces;
/// those have names, and count as nearer than they are.
Double2 roomy_place(const ConvexCell& cell, std::span<const Piece> pieces) {
    Double2 low(infinity), high(-infinity), best = cell.front();
    for (const Double2& corner : cell) low = glm::min(low, corner), high = glm::max(high, corner);
    double most = 0.0;
    constexpr int steps = 48;
    for (int i = 1; i < steps * steps; ++i) {
        const Double2 p = low + Double2(i % steps, i / steps) / double{steps} * (high - low);
        double room = infinity;
        for (std::size_t k = 0; k < cell.size(); ++k) {
            const Double2 &a = cell[k], &b = cell[(k + 1) % cell.size()];
            const bool inside = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0.0;
            room = std::min(room, inside ? distance(p, a, b) : 0.0);
        }
        for (const Piece& piece : pieces) {
            if (room <= most) break;
            room = std::min(room, 0.5 * distance(p, piece.from, piece.to));
        }
        if (room > most) most = room, best = p;
    }
    return best;
}

}  // namespace

bool Story::left_out() const {
    return std::ranges::any_of(tree.polygons, [](const Segment& s) { return s.a == s.b; });
}

Double2 cut_point(const Story& story, const Turn::Cut& cut) {
    const Piece &front = story.pieces[cut.front], &back = story.pieces[cut.back];
    return front.from == back.to ? front.from : front.to;
}

ConvexCell part_of(const ConvexCell& cell, const SplitPlane<2>& line, bool in_front) {
    return part_above(
        cell, [&](const Double2& p) { return in_front ? line.distance(p) : -line.distance(p); });
}

Story watched_build(std::span<const Segment> segments, const BspConfig& config,
                    const ConvexCell& frame) {
    Story story;
    BuildWatcher watcher(story, segments);
    story.tree = BspBuilder<2>::build(segments, config, watcher);
    for (const Fragment<2>& fragment : story.tree.fragments)
        story.fragment_pieces.push_back(watcher.number_of(fragment));
    const auto line_of = [&](std::uint32_t node) {
        return story.tree.planes[story.tree.nodes[node].plane];
    };
    for (Turn& turn : story.turns)
        turn.cell = turn.parent == BspTree<2>::none ? frame
                                                    : part_of(story.turns[turn.parent].cell,
                                                              line_of(turn.parent), turn.in_front);

    // From left to right: behind a node, then before it.
    const auto visit = [&](const auto& self, std::uint32_t node) -> void {
        const auto& children = story.tree.nodes[node];
        for (const bool in_front : {false, true}) {
            const std::uint32_t child = in_front ? children.front : children.back;
            if (child != BspTree<2>::none)
                self(self, child);
            else
                story.cells.push_back(
                    {node, in_front, part_of(story.turns[node].cell, line_of(node), in_front), {}});
        }
    };
    if (!story.tree.nodes.empty()) visit(visit, 0);
    for (EmptyCell& cell : story.cells)
        cell.place = cell.cell.empty() ? story.splitter(cell.node).from
                                       : roomy_place(cell.cell, story.pieces);
    return story;
}

Story heinonen_story() {
    static constexpr std::uint32_t order[] = {6, 4, 1, 0};  // G, E, B, A
    constexpr double size = heinonen_size;
    return watched_build(heinonen_segments(),
                         {.splitter = BspConfig::SplitterChoice::first, .order = order},
                         {{0.0, 0.0}, {size, 0.0}, {size, size}, {0.0, size}});
}

std::string written(const Piece& piece) {
    return drawn_name(piece.name);
}

std::string written(const Story& story, std::span<const std::size_t> set) {
    std::string text = "{";
    for (const std::size_t piece : set)
        text += (text.size() > 1 ? ", " : "") + written(story.pieces[piece]);
    return text + "}";
}

std::vector<std::vector<std::size_t>> children_of(const Story& story) {
    const std::size_t nodes = story.turns.size();
    std::vector<std::vector<std::size_t>> children(nodes + story.cells.size());
    for (std::size_t i = 0; i < story.cells.size(); ++i)
        children[story.cells[i].node].push_back(nodes + i);
    for (std::size_t i = 1; i < nodes; ++i) children[story.turns[i].parent].push_back(i);
    // Behind a node on the left, before it on the right.
    const auto in_front = [&](std::size_t child) {
        return child < nodes ? story.turns[child].in_front : story.cells[child - nodes].in_front;
    };
    for (std::vector<std::size_t>& pair : children) std::ranges::sort(pair, {}, in_front);
    return children;
}

TreeLayout layout_of(const Story& story) {
    const std::vector<Double2> places = tree_layout(children_of(story));
    TreeLayout layout;
    for (std::size_t i = 0; i < places.size(); ++i) {
        (i < story.turns.size() ? layout.nodes : layout.cells).push_back(places[i]);
        layout.levels = std::max(layout.levels, static_cast<std::size_t>(places[i].y) + 1);
    }
    return layout;
}

}  // namespace space::ch03
