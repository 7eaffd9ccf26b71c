// A ray's walk through a tree of four, step by step: what the walk told its observer becomes the
// steps of a drawing. The segments are walls, seen from above.

#include "chapters/ch10_fast_traversal/collapse.hpp"
#include "chapters/ch10_fast_traversal/figures.hpp"
#include "chapters/ch10_fast_traversal/figures/walls.hpp"
#include "chapters/ch10_fast_traversal/wide_walk.hpp"
#include "common/accelerator.hpp"
#include "common/observer.hpp"
#include "common/program/walk_drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace space::ch10 {
namespace {

/// Where the drawn tree has what a wide tree's word means.
struct DrawnPlace {
    WideChild child;
    std::size_t node;
};

/// The wide tree as it is drawn, and which drawn node is which.
class DrawnWideTree {
  public:
    DrawnWideTree(const Walls<3>& walls, const WideTree<4>& wide)
        : tree{.size = heinonen_size, .segments = walls.named, .nodes = {}} {
        add(walls, wide, wide.root, wide.box);
    }
    std::size_t place_of(WideChild child) const {
        return std::ranges::find(places_, child, &DrawnPlace::child)->node;
    }
    std::string plain_name(std::size_t node) const {
        std::string name = tree.nodes[node].name;
        std::erase(name, '*');
        return name;
    }
    DrawnTree tree;
    std::vector<std::vector<std::size_t>> segments = {};  ///< by drawn node, of a leaf

  private:
    std::size_t add(const Walls<3>& walls, const WideTree<4>& wide, WideChild child,
                    const Aabb& box) {
        const std::size_t place = tree.nodes.size();
        places_.push_back({child, place});
        tree.nodes.push_back({.name = {},
                              .cell = box_corners(from_above(box)),
                              .lines = box_sides(from_above(box))});
        segments.emplace_back();
        if (child.is_leaf()) {
            std::string names;
            for (std::uint32_t i = 0; i < child.count(); ++i) {
                const TriangleBlock& block = wide.blocks[child.first() + i];
                for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
                    if (!block.is_used(lane)) continue;
                    segments[place].push_back(block.indices[lane]);
                    names += walls.named[block.indices[lane]].name;
                }
            }
            tree.nodes[place].name = "*" + names + "*";
            return place;
        }
        tree.nodes[place].name = std::to_string(++inner_);
        const WideNode<4>& node = wide.nodes[child.index()];
        std::vector<std::size_t> children;
        for (std::size_t i = 0; i < 4; ++i)
            if (node.is_used(i))
                children.push_back(add(walls, wide, node.children[i], node.box(i)));
        tree.nodes[place].children = children;
        return place;
    }

    std::vector<DrawnPlace> places_;
    int inner_ = 0;
};

/// Turns what the walk tells into steps.
class WideScript {
  public:
    WideScript(const Walls<3>& walls, const WideTree<4>& wide, const DrawnWideTree& drawn,
               const Ray2& ray)
        : walls_(walls),
          wide_(wide),
          drawn_(drawn),
          ray_(ray),
          prepared_({{ray.origin.x, ray.origin.y, 1.0f}, {ray.direction.x, ray.direction.y, 0.0f}},
                    BoxMargins::none) {
        waiting_.push_back(visit_of(wide.root, wide.box));
        steps.push_back({.tells = fmt::format("A ray starts at the dot. It is in the root's box "
                                              "for {}.",
                                              written(waiting_.back())),
                         .waiting = waiting_});
        NoCounts none;
        walk_wide(
            wide, prepared_, none, [&](const TriangleBlock& block) { return test(block); }, *this);
        sum_up();
    }
    std::vector<WalkStep> steps = {};

    void observe(const WideVisit<4>& event) {
        const WalkStep::Visit in_hand = take();
        const WideNode<4>& node = wide_.nodes[event.node];
        std::vector<std::string> met;
        for (std::size_t i = event.size; i-- > 0;) {
            const std::size_t place = event.met[i].place;
            waiting_.push_back(visit_of(node.children[place], node.box(place)));
            met.insert(met.begin(), fmt::format("{} at {}", name(waiting_.back().node),
                                                written_t(waiting_.back().enter)));
        }
        std::size_t used = 0;
        for (std::size_t i = 0; i < 4; ++i) used += node.is_used(i);
        ++visited_;
        boxes_ += used;
        WalkStep step{
            .tells = fmt::format("Node {}: {} boxes at once. {}{}", name(in_hand.node), used,
                                 met.empty() ? std::string(nearest_ < double{infinity}
                                                               ? "None is met before the hit."
                                                               : "None is met.")
                                             : fmt::format("Met: {}.", fmt::join(met, ", ")),
                                 met.size() > 1 ? " The nearest comes first, the others wait, the "
                                                  "nearest of them on top."
                                                : ""),
            .in_hand = in_hand,
            .waiting = waiting_};
        if (!met.empty()) {
            step.next = waiting_.back().node;
            step.waiting.pop_back();
        }
        add(std::move(step));
    }
    void observe(const WideLeafVisit&) {
        const WalkStep::Visit in_hand = take();
        const std::vector<std::size_t>& tested = drawn_.segments[in_hand.node];
        tested_.insert(tested_.end(), tested.begin(), tested.end());
        double nearest = nearest_;
        for (const std::size_t i : tested)
            nearest = std::min(nearest, distance_along(ray_, walls_.segments[i]));
        const std::string result = nearest < nearest_
                                       ? fmt::format("a hit, at t = {}", written_t(nearest))
                                       : "tested and missed";
        nearest_ = nearest;
        add({.tells = fmt::format("The leaf {}: {} at once, {}.", name(in_hand.node),
                                  counted_segments(tested.size()), result),
             .in_hand = in_hand,
             .waiting = waiting_,
             .tested = tested});
    }
    void observe(const WideSkipped&) {
        const WalkStep::Visit skipped = take();
        left_alone_.push_back(skipped);
        add({.tells = fmt::format("{} begins at {}, beyond the hit: it is passed over.",
                                  name(skipped.node), written_t(skipped.enter)),
             .waiting = waiting_});
    }

  private:
    double test(const TriangleBlock&) const { return nearest_; }

    WalkStep::Visit take() {
        const WalkStep::Visit top = waiting_.back();
        waiting_.pop_back();
        return top;
    }
    void sum_up() {
        add({.tells = fmt::format(
                 "{} wide nodes were visited and {} boxes asked, and {} of {} segments tested.",
                 visited_, boxes_, tested_.size(), walls_.segments.size()),
             .waiting = left_alone_,
             .tested = tested_});
    }
    void add(WalkStep step) {
        if (nearest_ < double{infinity}) step.hit = nearest_;
        steps.push_back(std::move(step));
    }
    WalkStep::Visit visit_of(WideChild child, const Aabb& box) const {
        const auto [enter, leave] = prepared_.span_in(box, infinity);
        return {drawn_.place_of(child), double{enter}, double{leave}};
    }
    std::string name(std::size_t node) const { return drawn_.plain_name(node); }
    static std::string written(const WalkStep::Visit& part) {
        return interval(part.enter, part.leave);
    }
    static std::string counted_segments(std::size_t count) {
        return count == 1 ? "1 segment" : fmt::format("{} segments", count);
    }

    const Walls<3>& walls_;
    const WideTree<4>& wide_;
    const DrawnWideTree& drawn_;
    const Ray2& ray_;
    BvhRay<3> prepared_;  ///< without margins: what is written has two places
    std::vector<WalkStep::Visit> waiting_, left_alone_;
    std::vector<std::size_t> tested_;
    std::size_t visited_ = 0, boxes_ = 0;
    double nearest_ = infinity;
};

}  // namespace

Svg fig_10_16(const Options&) {
    const Walls<3> walls = walls_on<3>(clustered_segments(7, 5, 2));
    const WideTree<4> wide = collapsed<4>(walls.binary, walls.polygons, {.max_leaf = 2});
    const DrawnWideTree drawn(walls, wide);
    const Ray2 ray{.origin = {0.5f, 7.5f}, .direction = {1.0f, 0.0625f}};
    return walk_drawing("A ray's walk through a tree of four, step by step, with what waits",
                        drawn.tree, ray, WideScript(walls, wide, drawn, ray).steps);
}

}  // namespace space::ch10
