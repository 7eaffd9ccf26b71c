/// @file
/// One step of the build of a k-d tree over segments (D = 2) or triangles (D = 3): whether a cell
/// is cut and where, by axes in turn, in the middle or at the median (Heinonen16, section 3.1.2),
/// or by the surface area heuristic; and what goes to which half.
#pragma once

#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "chapters/ch04_kd_trees/kd_config.hpp"
#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "chapters/ch04_kd_trees/sah_sweep.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// The step, the same for every node and in whatever order the nodes are made. It tells an observer
/// the planes that it tries (SahCandidate) and where references go (Placed).
template <int D>
class KdSplitter {
  public:
    using Config = KdTreeConfig;

    static constexpr std::uint32_t whole = ~0u;  ///< no piece

    /// A polygon, and the box of its part in a cell.
    struct Reference {
        std::uint32_t polygon;
        BasicAabb<D> box;
        std::uint32_t piece = whole;  ///< where polygons are split, which one of the task's
    };
    /// A cell that waits to become a node, with what lies in it.
    struct Task {
        std::size_t depth = 0;
        BasicAabb<D> cell;
        std::vector<Reference> references = {};
        SplitEvents<D> events = {};  ///< of the references, by their places; for the sweep only
        std::vector<std::vector<Point<D>>> pieces = {};  ///< corners; where polygons are split only
    };
    /// Event of a builder: a node is cut, or is to be a leaf.
    struct Chosen {
        std::uint32_t node;
        std::size_t depth;
        const BasicAabb<D>& cell;
        std::span<const Reference> references;
        const std::optional<KdSplit>& split;
    };
    /// Where a polygon goes.
    enum class Half { below, above, both };
    /// Event: where a reference goes, seen from the node's plane.
    struct Placed {
        const Reference& reference;
        Half half;
    };
    /// What becomes of a task that is cut.
    struct Children {
        Task below, above;
        std::vector<std::uint32_t> kept = {};  ///< straddlers that stay in the node
        std::size_t shared = 0;                ///< straddlers that both children were given
    };

    KdSplitter(std::span<const Simplex<D>> polygons, const Config& config)
        : polygons_(polygons), config_(config) {
        const double n = std::max<double>(1.0, double(polygons.size()));
        const auto usual = static_cast<std::size_t>(8.0 + 1.3 * std::log2(n));
        max_depth_ = std::min(config.max_depth.value_or(usual), max_kd_depth);
    }
    std::size_t max_depth() const { return max_depth_; }

    /// All polygons, in the box of them all.
    Task root() const {
        Task task;
        task.references.reserve(polygons_.size());
        if (sweeps())
            for (auto& list : task.events) list.reserve(2 * polygons_.size());
        for (std::uint32_t i = 0; i < polygons_.size(); ++i) {
            BasicAabb<D> box;
            for (int corner = 0; corner < D; ++corner) box.extend(polygons_[i][corner]);
            task.references.push_back({i, box});
            task.cell.extend(box);
            if (sweeps()) add_events<D>(task.events, box, i);
        }
        for (auto& list : task.events) sort_events(list);
        return task;
    }

    /// The plane that cuts the task; none where it is to be a leaf.
    template <class Observer>
    std::optional<KdSplit> choose(const Task& task, Observer& observer) const {
        const std::size_t size = task.references.size();
        if (task.depth >= max_depth_) return std::nullopt;
        if (sweeps()) {
            SahCosts costs = config_.costs;
            costs.straddlers_stay = config_.straddlers == Config::Straddlers::keep;
            return best_split<D>(task.events, task.cell, size, costs, observer);
        }
        return size > config_.max_leaf_size ? in_turn(task) : std::nullopt;
    }

    // [divide]
    /// Sends every reference below, above, or in parts to both; a straddler may stay in the node.
    /// What the task holds is taken where it can be; if something is thrown, it is as it was (but
    /// for pieces).
    template <class Observer>
    Children divide(Task& task, const KdSplit& split, Observer& observer) const {
        Children children = empty_children(task, split);
        const Sizes sizes = sizes_of(task, split, observer);
        if (sizes.below == task.references.size() || sizes.above == task.references.size()) {
            take_all(sizes.above == 0 ? children.below : children.above, task);
            return children;
        }
        children.below.references.reserve(sizes.below + sizes.both);
        children.above.references.reserve(sizes.above + sizes.both);
        std::vector<Place> places(task.references.size());
        for (std::size_t i = 0; i < task.references.size(); ++i) {
            const Reference& reference = task.references[i];
            const Half half = half_of(reference, split);
            if (half != Half::both) {
                Task& child = half == Half::below ? children.below : children.above;
                places[i] = {half, static_cast<std::uint32_t>(child.references.size())};
                add_whole(child, task, reference);
            } else if (config_.straddlers == Config::Straddlers::keep) {
                children.kept.push_back(reference.polygon);
            } else {
                add_part(children.below, task, reference, split, 1.0);
                add_part(children.above, task, reference, split, -1.0);
                ++children.shared;
            }
        }
        if (sweeps()) hand_down(task.events, places, children);
        return children;
    }
    // [divide]

  private:
    bool sweeps() const { return config_.rule == Config::Rule::sah; }

    // [in_turn]
    /// The axis whose turn it is, or the next one on which a plane parts the polygons.
    std::optional<KdSplit> in_turn(const Task& task) const {
        for (int turn = 0; turn < D; ++turn) {
            const int axis = (static_cast<int>(task.depth) + turn) % D;
            const KdSplit split{axis, config_.rule == Config::Rule::middle
                                          ? task.cell.centroid()[axis]
                                          : median(task.references, axis)};
            if (!(task.cell.min[axis] < split.position && split.position < task.cell.max[axis]))
                continue;
            const auto straddling = static_cast<double>(
                std::count_if(task.references.begin(), task.references.end(),
                              [&](const Reference& r) { return half_of(r, split) == Half::both; }));
            if (straddling <= config_.max_straddling * double(task.references.size())) return split;
        }
        return std::nullopt;
    }
    static float median(std::span<const Reference> references, int axis) {
        std::vector<float> middles;
        for (const Reference& reference : references)
            middles.push_back(reference.box.centroid()[axis]);
        const auto half = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
        std::nth_element(middles.begin(), half, middles.end());
        return *half;
    }
    // [in_turn]

    // [half_of]
    /// Closed cells: what only touches the plane from one side belongs to that side, what lies in
    /// it to the side that the split says. A ray that meets the plane in the cell visits both.
    static Half half_of(const Reference& reference, const KdSplit& split) {
        const float low = reference.box.min[split.axis], high = reference.box.max[split.axis];
        if (low < split.position && high > split.position) return Half::both;
        if (low < split.position) return Half::below;
        if (high > split.position) return Half::above;
        return split.coplanar_below ? Half::below : Half::above;
    }
    // [half_of]

    static Children empty_children(const Task& task, const KdSplit& split) {
        const auto [below, above] = halves(task.cell, split);
        return {.below = {.depth = task.depth + 1, .cell = below},
                .above = {.depth = task.depth + 1, .cell = above}};
    }

    /// How many references go where.
    struct Sizes {
        std::size_t below = 0, above = 0, both = 0;
    };
    template <class Observer>
    static Sizes sizes_of(const Task& task, const KdSplit& split, Observer& observer) {
        Sizes sizes;
        for (const Reference& reference : task.references) {
            const Half half = half_of(reference, split);
            observer.observe(Placed{reference, half});
            ++(half == Half::below ? sizes.below : half == Half::above ? sizes.above : sizes.both);
        }
        return sizes;
    }

    /// A plane that cuts off empty space copies nothing.
    static void take_all(Task& child, Task& task) {
        child.references = std::move(task.references);
        child.events = std::move(task.events);
        child.pieces = std::move(task.pieces);
    }

    static void add_whole(Task& child, Task& task, Reference reference) {
        if (reference.piece != whole) {
            child.pieces.push_back(std::move(task.pieces[reference.piece]));
            reference.piece = static_cast<std::uint32_t>(child.pieces.size() - 1);
        }
        child.references.push_back(reference);
    }

    // [add_part]
    /// The part of a straddler in the child's cell, if there is one.
    void add_part(Task& child, const Task& task, const Reference& straddler, const KdSplit& split,
                  double sign) const {
        Reference part{straddler.polygon,
                       {glm::max(straddler.box.min, child.cell.min),
                        glm::min(straddler.box.max, child.cell.max)}};
        if (config_.straddlers == Config::Straddlers::clip)
            part.box = clipped_bounds<D>(polygons_[part.polygon], part.box);
        if (config_.straddlers == Config::Straddlers::split)
            cut(part, child, task, straddler, split, sign);
        if (part.box.is_empty()) return;
        if (sweeps())
            add_events<D>(child.events, part.box,
                          static_cast<std::uint32_t>(child.references.size()));
        child.references.push_back(part);
    }
    // [add_part]

    /// Makes the piece on one side of the plane.
    void cut(Reference& part, Task& child, const Task& task, const Reference& straddler,
             const KdSplit& split, double sign) const {
        ClippedPolygon<D> polygon;
        if (straddler.piece == whole)
            for (int corner = 0; corner < D; ++corner)
                polygon.push_back(Double<D>(polygons_[part.polygon][corner]));
        else
            for (const Point<D>& corner : task.pieces[straddler.piece])
                polygon.push_back(Double<D>(corner));
        polygon = polygon.clipped(split.axis, split.position, sign);
        part.piece = static_cast<std::uint32_t>(child.pieces.size());
        part.box = BasicAabb<D>::empty();
        std::vector<Point<D>> piece;
        for (std::size_t i = 0; i < polygon.size; ++i) {
            const Point<D> corner(polygon.corners[i]);
            if (!piece.empty() && corner == piece.back()) continue;
            piece.push_back(corner);
            part.box.extend(corner);
        }
        child.pieces.push_back(std::move(piece));
    }

    /// Where a reference has gone as it is; nowhere where only parts of it have.
    struct Place {
        Half half = Half::both;
        std::uint32_t index = 0;  ///< among the child's references
    };

    // [hand_down]
    /// The events of what goes down whole keep their order; those of new parts are few, and are
    /// merged in.
    static void hand_down(const SplitEvents<D>& events, std::span<const Place> places,
                          Children& children) {
        for (std::size_t axis = 0; axis < D; ++axis) {
            std::vector<SplitEvent> below, above;
            for (const SplitEvent& event : events[axis]) {
                const Place place = places[event.box()];
                if (place.half != Half::both)
                    (place.half == Half::below ? below : above)
                        .emplace_back(event.position(), event.kind(), place.index);
            }
            merge_into(children.below.events[axis], below);
            merge_into(children.above.events[axis], above);
        }
    }
    static void merge_into(std::vector<SplitEvent>& parts, const std::vector<SplitEvent>& whole) {
        std::sort(parts.begin(), parts.end());
        std::vector<SplitEvent> all(parts.size() + whole.size());
        std::merge(parts.begin(), parts.end(), whole.begin(), whole.end(), all.begin());
        parts = std::move(all);
    }
    // [hand_down]

    std::span<const Simplex<D>> polygons_;
    Config config_;
    std::size_t max_depth_ = 0;
};

}  // namespace space
