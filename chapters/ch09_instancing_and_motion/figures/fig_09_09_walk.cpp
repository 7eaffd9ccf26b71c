// A ray's walk through a tree over instances and on in the trees of what they place, step by step:
// chapter 7's walk in both, in the plane.

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_walk.hpp"
#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/placed_house.hpp"
#include "common/program/walk_drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace space::ch09 {
namespace {

/// The object: three walls in local space.
std::vector<Segment> walls() {
    return {{{-1.0f, -0.5f}, {-0.75f, 1.0f}},
            {{-0.25f, 1.0f}, {1.0f, 0.5f}},
            {{0.25f, -1.0f}, {0.75f, -0.25f}}};
}
std::vector<ObjectPlacement> placements() {
    return {placed_in_plane({3.5, 11.9}, 0.8, 0.6, {2.5, 2.5}),
            placed_in_plane({7, 5}, 0.6, -0.8, {-2.5, 2}),
            placed_in_plane({12.25, 8.5}, 0.96, 0.28, {2.25, 3})};
}
constexpr Ray2 world_ray{.origin = {0.5f, 9.5f}, .direction = {1.0f, -0.1875f}};

Ray2 local_ray(const ObjectPlacement& placement, float tmax) {
    return {.origin = Point2(placement.to_local({Double2(world_ray.origin), 0})),
            .direction = Vector2(placement.direction_to_local({Double2(world_ray.direction), 0})),
            .tmax = tmax};
}

ConvexCell corners(const Aabb2& box) {
    const Double2 low(box.min), high(box.max);
    return {low, {high.x, low.y}, high, {low.x, high.y}};
}
std::vector<Double2> sides(const ConvexCell& cell) {
    std::vector<Double2> lines;
    for (std::size_t i = 0; i < cell.size(); ++i) {
        lines.push_back(cell[i]);
        lines.push_back(cell[(i + 1) % cell.size()]);
    }
    return lines;
}

/// One tree for the object, one over the boxes of its instances.
struct Scene2 {
    std::vector<Segment> local = walls();
    std::vector<ObjectPlacement> placed = placements();
    BvhNodes<2> object = build(local), top = build(diagonals());

    static BvhNodes<2> build(const std::vector<Segment>& segments) {
        return BinnedBuilder::build<2>(segments, {.costs = {1.0, 1.0}, .max_leaf_size = 1});
    }
    /// A diagonal has the box that its instance has.
    std::vector<Segment> diagonals() const {
        std::vector<Segment> segments;
        for (const ObjectPlacement& placement : placed) {
            Aabb2 box;
            for (const Double2& corner : corners(object.nodes[0].box))
                box.extend(Point2(to_world(placement, corner)));
            segments.push_back({box.min, box.max});
        }
        return segments;
    }
};

/// In which tree a node is: the one over instances, or that of the object, as this instance of it.
struct Where {
    std::optional<std::uint32_t> instance;
    std::uint32_t node;
};

/// What a ray met, and the nearest hit after it.
struct Met {
    Where where;
    double nearest;
};

std::vector<Met> watched_walk(const Scene2& scene) {
    std::vector<Met> all;
    double nearest = infinity;
    NoCounts none;
    struct Watcher {
        std::vector<Met>& all;
        double& nearest;
        std::optional<std::uint32_t> instance = {};
        void observe(const BvhVisit& event) { all.push_back({{instance, event.node}, nearest}); }
    };
    walk_bvh(
        scene.top, world_ray, none,
        [&](const BvhNode<2>& leaf) {
            const std::uint32_t instance = scene.top.references[leaf.first];
            const Ray2 ray = local_ray(scene.placed[instance], float(nearest));
            walk_bvh(
                scene.object, ray, none,
                [&](const BvhNode<2>& own) {
                    const Segment& wall = scene.local[scene.object.references[own.first]];
                    nearest = std::min(nearest, distance_along(ray, wall));
                    return all.back().nearest = nearest;
                },
                Watcher{all, nearest, instance});
            return nearest;
        },
        Watcher{all, nearest});
    return all;
}

/// Both levels as one drawn tree: below an instance's leaf stands the object's tree, once for each
/// instance, though it is there once.
class TwoLevels {
  public:
    explicit TwoLevels(const Scene2& scene) : scene_(scene) {
        top_.resize(scene.top.nodes.size());
        object_.resize(scene.placed.size(), std::vector<std::size_t>(scene.object.nodes.size()));
        add({{}, 0});
        for (std::uint32_t i = 0; i < scene.placed.size(); ++i)
            for (std::size_t wall = 0; wall < scene.local.size(); ++wall)
                drawn.segments.push_back({wall_name(i, wall),
                                          to_world(scene.placed[i], Double2(scene.local[wall].a)),
                                          to_world(scene.placed[i], Double2(scene.local[wall].b))});
    }
    DrawnTree drawn{.size = 16, .segments = {}, .nodes = {}};

    std::size_t index(const Where& where) const {
        return where.instance ? object_[*where.instance][where.node] : top_[where.node];
    }
    const BvhNodes<2>& tree(const Where& where) const {
        return where.instance ? scene_.object : scene_.top;
    }
    const BvhNode<2>& node(const Where& where) const { return tree(where).nodes[where.node]; }
    std::uint32_t named(const Where& where) const {
        return tree(where).references[node(where).first];
    }
    std::vector<Where> children(const Where& where) const {
        const BvhNode<2>& own = node(where);
        if (!own.is_leaf()) return {{where.instance, own.first}, {where.instance, own.first + 1}};
        if (!where.instance) return {{named(where), 0}};
        return {};
    }
    /// "A1", a number, or the instance's.
    std::string name(const Where& where) const {
        if (where.instance && node(where).is_leaf())
            return wall_name(*where.instance, named(where));
        if (!where.instance && node(where).is_leaf()) return fmt::format("#{}", named(where) + 1);
        return std::to_string(index(where) + 1);
    }

  private:
    static std::string wall_name(std::uint32_t instance, std::size_t wall) {
        return fmt::format("{}{}", "ABC"[wall], instance + 1);
    }
    void add(const Where& where) {
        const std::size_t number = drawn.nodes.size();
        (where.instance ? object_[*where.instance][where.node] : top_[where.node]) = number;
        ConvexCell cell = corners(node(where).box);
        if (where.instance)
            for (Double2& corner : cell) corner = to_world(scene_.placed[*where.instance], corner);
        drawn.nodes.push_back({.name = {}, .cell = cell, .lines = sides(cell)});
        std::vector<std::size_t> below;
        for (const Where& child : children(where)) {
            below.push_back(drawn.nodes.size());
            add(child);
        }
        const std::string plain = name(where);
        drawn.nodes[number].name = below.empty() ? drawn_name(plain) : plain;
        drawn.nodes[number].children = below;
    }

    const Scene2& scene_;
    std::vector<std::size_t> top_;
    std::vector<std::vector<std::size_t>> object_;
};

/// Turns what the walk met into steps.
class Script2 {
  public:
    Script2(const Scene2& scene, const TwoLevels& levels) : scene_(scene), levels_(levels) {
        waiting_.push_back(visit_of({{}, 0}));
        add({.tells = fmt::format("A ray starts at the dot. It is in the box around all instances "
                                  "for {}.",
                                  written(waiting_.back())),
             .waiting = waiting_});
        const std::vector<Met> all = watched_walk(scene);
        for (const Met& met : all) {
            take(levels_.index(met.where));
            if (!levels_.node(met.where).is_leaf())
                inner(met.where);
            else if (!met.where.instance)
                instance(met.where);
            else
                wall(met);
        }
        left_alone_.insert(left_alone_.end(), waiting_.begin(), waiting_.end());
        waiting_.clear();
        add({.tells = fmt::format(
                 "{} nodes were visited and {} of {} walls tested. In memory there are one tree of "
                 "{} nodes over the instances and one of {} nodes for all of them.",
                 all.size(), tested_.size(), levels_.drawn.segments.size(), scene.top.size(),
                 scene.object.size()),
             .waiting = left_alone_,
             .tested = tested_});
    }
    std::vector<WalkStep> steps = {};

  private:
    void take(std::size_t number) {
        while (waiting_.back().node != number) {
            left_alone_.push_back(waiting_.back());
            waiting_.pop_back();
        }
        waiting_.pop_back();
    }
    void inner(const Where& where) {
        std::vector<WalkStep::Visit> met;
        std::vector<std::string> parts;
        for (const Where& child : levels_.children(where)) {
            const WalkStep::Visit part = visit_of(child);
            const bool beyond = part.enter > nearest_;
            if (part.enter <= part.leave && !beyond) met.push_back(part);
            parts.push_back(levels_.name(child) + (part.enter > part.leave ? " is not met"
                                                   : beyond ? " begins beyond the hit"
                                                            : " for " + written(part)));
        }
        if (met.size() == 2 && met[0].enter <= met[1].enter) std::swap(met[0], met[1]);
        waiting_.insert(waiting_.end(), met.begin(), met.end());
        step_to(where,
                fmt::format("{} {}: {}.", where.instance ? "In local space, node" : "Node",
                            levels_.name(where), fmt::join(parts, ", ")),
                !met.empty());
    }
    /// From one level to the next.
    void instance(const Where& where) {
        const Where root{levels_.named(where), 0};
        const WalkStep::Visit part = visit_of(root);
        const bool met = part.enter <= part.leave && part.enter <= nearest_;
        if (met) waiting_.push_back(part);
        step_to(where,
                fmt::format("Instance {}: the ray is taken into its local space. There it {} the "
                            "object's own box{}.",
                            levels_.name(where), met ? "meets" : "passes by",
                            met ? " for " + written(part) : ""),
                met);
    }
    void step_to(const Where& where, std::string tells, bool goes_on) {
        WalkStep step{.tells = std::move(tells), .in_hand = visit_of(where), .waiting = waiting_};
        if (goes_on) {
            step.next = waiting_.back().node;
            step.waiting.pop_back();
        }
        add(std::move(step));
    }
    void wall(const Met& met) {
        const bool hit = met.nearest < nearest_;
        nearest_ = met.nearest;
        const std::size_t number =
            *met.where.instance * scene_.local.size() + levels_.named(met.where);
        tested_.push_back(number);
        add({.tells = fmt::format(
                 "The wall {}: {}.", levels_.name(met.where),
                 hit ? fmt::format("a hit, at t = {} in both spaces", written_t(nearest_))
                     : "tested and missed"),
             .in_hand = visit_of(met.where),
             .waiting = waiting_,
             .tested = {number}});
    }
    void add(WalkStep step) {
        if (nearest_ < double{infinity}) step.hit = nearest_;
        steps.push_back(std::move(step));
    }
    WalkStep::Visit visit_of(const Where& where) const {
        const Ray2 ray =
            where.instance ? local_ray(scene_.placed[*where.instance], infinity) : world_ray;
        const auto [enter, leave] =
            BvhRay<2>(ray, BoxMargins::none).span_in(levels_.node(where).box, infinity);
        return {levels_.index(where), double{enter}, double{leave}};
    }
    static std::string written(const WalkStep::Visit& part) {
        return interval(part.enter, part.leave);
    }

    const Scene2& scene_;
    const TwoLevels& levels_;
    std::vector<WalkStep::Visit> waiting_, left_alone_;
    std::vector<std::size_t> tested_;
    double nearest_ = infinity;
};

}  // namespace

Svg fig_09_09(const Options&) {
    const Scene2 scene;
    const TwoLevels levels(scene);
    return walk_drawing(
        "A ray's walk through three instances of one object, step by step, with what waits",
        levels.drawn, world_ray, Script2(scene, levels).steps);
}

}  // namespace space::ch09
