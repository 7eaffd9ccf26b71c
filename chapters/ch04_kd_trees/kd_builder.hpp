/// @file
/// Building a k-d tree over segments (D = 2) or triangles (D = 3): by axes in turn, in the middle
/// or at the median (Heinonen16, section 3.1.2), or by the surface area heuristic.
#pragma once

#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "chapters/ch04_kd_trees/sah_sweep.hpp"
#include "common/limit_error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// What a builder may choose.
struct KdTreeConfig {
    /// Where a cell is cut.
    enum class Rule {
        middle,  ///< axes in turn, in the middle of the cell
        median,  ///< axes in turn, at the median of the boxes' middles
        sah,     ///< any axis, where the surface area heuristic finds the least cost
    };
    /// What becomes of polygons on both sides of a plane.
    enum class Straddlers {
        duplicate,  ///< both halves name them, wherever their bounding boxes reach
        clip,       ///< both halves name them, where the part in the cell reaches: perfect splits
        keep,       ///< the inner node names them
        split,  ///< each half names its piece, cut from the parent's piece and rounded to float:
                ///< what rounding takes away, rays lose
    };

    Rule rule = Rule::sah;
    Straddlers straddlers = Straddlers::clip;
    SahCosts costs = {};
    std::size_t max_leaf_size = 4;  ///< of middle and median
    /// Middle and median don't cut where more than this share straddles: both halves would be about
    /// as hard as the whole.
    double max_straddling = 0.75;
    /// Edges from the root to the deepest leaf: 8 + 1.3 log2 n unless it is given, and never more
    /// than KdTree's stack can hold.
    std::optional<std::size_t> max_depth = {};
    /// Limits memory.
    std::size_t max_references = KdNode::largest;
    /// Planes to take first, one for each node that has more than max_leaf_size polygons, below
    /// before above.
    std::span<const KdSplit> planned = {};
    bool mailboxes = true;  ///< no triangle is tested twice in a row by one ray (KdTree)
};

/// The largest depth of all trees, by which the stack of a ray's walk is sized.
inline constexpr std::size_t max_kd_depth = 60;

/// Makes a tree of polygons and tells an observer each step, besides SahCandidate.
template <int D>
class KdBuilder {
  public:
    using Config = KdTreeConfig;

    static constexpr std::uint32_t whole = ~0u;  ///< no piece

    /// A polygon, and the box of its part in a cell.
    struct Reference {
        std::uint32_t polygon;
        BasicAabb<D> box;
        std::uint32_t piece = whole;  ///< where polygons are split, which one
    };
    /// Event: a node is cut, or is to be a leaf.
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

    /// @throws LimitError where leaves and nodes would name more than config.max_references
    template <class Observer = NoObserver>
    static KdNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                            Observer&& observer = {}) {
        KdBuilder builder(polygons, config);
        builder.run(observer);
        return std::move(builder.tree_);
    }

  private:
    /// A cell that waits to become a node, with what lies in it.
    struct Task {
        std::uint32_t node = 0;
        std::size_t depth = 0;
        BasicAabb<D> cell;
        std::vector<Reference> references = {};
        SplitEvents<D> events = {};  ///< of the references, by their places; for the sweep only
    };

    KdBuilder(std::span<const Simplex<D>> polygons, const Config& config)
        : polygons_(polygons), config_(config) {
        const double n = std::max<double>(1.0, double(polygons.size()));
        const auto usual = static_cast<std::size_t>(8.0 + 1.3 * std::log2(n));
        max_depth_ = std::min(config.max_depth.value_or(usual), max_kd_depth);
    }

    // [run]
    template <class Observer>
    void run(Observer& observer) {
        if (polygons_.empty()) return;
        std::vector<Task> tasks;
        tasks.push_back(root());
        tree_.nodes.assign(2, KdNode::leaf(0, 0));  // the gap makes later pairs even
        while (!tasks.empty()) {
            Task task = std::move(tasks.back());
            tasks.pop_back();
            tree_.depth = std::max(tree_.depth, task.depth);
            const std::optional<KdSplit> split = choose(task, observer);
            observer.observe(Chosen{task.node, task.depth, task.cell, task.references, split});
            if (!split) {
                make_leaf(task);
                continue;
            }
            auto [below, above] = make_inner(std::move(task), *split, observer);
            tasks.push_back(std::move(above));
            tasks.push_back(std::move(below));
        }
    }
    // [run]

    Task root() {
        Task task;
        for (std::uint32_t i = 0; i < polygons_.size(); ++i) {
            BasicAabb<D> box;
            for (int corner = 0; corner < D; ++corner) box.extend(polygons_[i][corner]);
            task.references.push_back({i, box});
            task.cell.extend(box);
            if (sweeps()) add_events<D>(task.events, box, i);
        }
        for (auto& list : task.events) std::sort(list.begin(), list.end());
        tree_.box = task.cell;
        count_references(task.references.size());
        return task;
    }

    bool sweeps() const { return config_.rule == Config::Rule::sah; }

    template <class Observer>
    std::optional<KdSplit> choose(const Task& task, Observer& observer) {
        const std::size_t size = task.references.size();
        if (task.depth >= max_depth_) return std::nullopt;
        if (next_planned_ < config_.planned.size() && size > config_.max_leaf_size)
            return config_.planned[next_planned_++];
        if (sweeps()) {
            SahCosts costs = config_.costs;
            costs.straddlers_stay = config_.straddlers == Config::Straddlers::keep;
            return best_split<D>(task.events, task.cell, size, costs, observer);
        }
        return size > config_.max_leaf_size ? in_turn(task) : std::nullopt;
    }

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

    struct Children {
        Task below, above;
    };

    // [make_inner]
    /// Sends every reference below, above, or in parts to both; a straddler may stay in the node.
    template <class Observer>
    Children make_inner(Task task, const KdSplit& split, Observer& observer) {
        Children children = add_children(task, split);
        std::vector<Place> places(task.references.size());
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i < task.references.size(); ++i) {
            const Reference& reference = task.references[i];
            const Half half = half_of(reference, split);
            observer.observe(Placed{reference, half});
            if (half != Half::both) {
                Task& child = half == Half::below ? children.below : children.above;
                places[i] = {half, static_cast<std::uint32_t>(child.references.size())};
                child.references.push_back(reference);
            } else if (config_.straddlers == Config::Straddlers::keep) {
                kept.push_back(reference.polygon);
            } else {
                add_part(children.below, reference, split, 1.0);
                add_part(children.above, reference, split, -1.0);
                count_references(1);
            }
        }
        if (sweeps()) hand_down(task.events, places, children);
        tree_.nodes[task.node] = KdNode::inner(split, children.below.node, !kept.empty());
        if (!kept.empty()) keep(task.node, kept);
        return children;
    }
    // [make_inner]

    Children add_children(const Task& task, const KdSplit& split) {
        const std::size_t pair = tree_.nodes.size();
        if (pair + 1 > KdNode::largest)
            throw LimitError("k-d tree: more than " + std::to_string(KdNode::largest) + " nodes");
        tree_.nodes.insert(tree_.nodes.end(), 2, KdNode::leaf(0, 0));
        const auto [below, above] = halves(task.cell, split);
        const auto node = static_cast<std::uint32_t>(pair);
        return {{.node = node, .depth = task.depth + 1, .cell = below},
                {.node = node + 1, .depth = task.depth + 1, .cell = above}};
    }

    // [add_part]
    /// The part of a straddler in the child's cell, if there is one.
    void add_part(Task& child, const Reference& straddler, const KdSplit& split, double sign) {
        Reference part{straddler.polygon,
                       {glm::max(straddler.box.min, child.cell.min),
                        glm::min(straddler.box.max, child.cell.max)}};
        if (config_.straddlers == Config::Straddlers::clip)
            part.box = clipped_bounds<D>(polygons_[part.polygon], part.box);
        if (config_.straddlers == Config::Straddlers::split) cut(part, straddler, split, sign);
        if (part.box.is_empty()) return;
        if (sweeps())
            add_events<D>(child.events, part.box,
                          static_cast<std::uint32_t>(child.references.size()));
        child.references.push_back(part);
    }
    // [add_part]

    /// Makes the piece on one side of the plane.
    void cut(Reference& part, const Reference& straddler, const KdSplit& split, double sign) {
        ClippedPolygon<D> polygon;
        if (straddler.piece == whole)
            for (int corner = 0; corner < D; ++corner)
                polygon.push_back(Double<D>(polygons_[part.polygon][corner]));
        else
            for (const Point<D>& corner : pieces_[straddler.piece])
                polygon.push_back(Double<D>(corner));
        polygon = polygon.clipped(split.axis, split.position, sign);
        part.piece = static_cast<std::uint32_t>(pieces_.size());
        part.box = BasicAabb<D>::empty();
        std::vector<Point<D>> piece;
        for (std::size_t i = 0; i < polygon.size; ++i) {
            const Point<D> corner(polygon.corners[i]);
            if (!piece.empty() && corner == piece.back()) continue;
            piece.push_back(corner);
            part.box.extend(corner);
        }
        pieces_.push_back(std::move(piece));
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

    void make_leaf(const Task& task) {
        tree_.nodes[task.node] = KdNode::leaf(static_cast<std::uint32_t>(tree_.references.size()),
                                              static_cast<std::uint32_t>(task.references.size()));
        for (const Reference& reference : task.references)
            tree_.references.push_back(reference.polygon);
    }
    void keep(std::uint32_t node, std::span<const std::uint32_t> polygons) {
        tree_.kept.resize(tree_.nodes.size());
        tree_.kept[node] = {static_cast<std::uint32_t>(tree_.references.size()),
                            static_cast<std::uint32_t>(polygons.size())};
        tree_.references.insert(tree_.references.end(), polygons.begin(), polygons.end());
    }

    void count_references(std::size_t more) {
        references_ += more;
        if (references_ > config_.max_references)
            throw LimitError("k-d tree: more than " + std::to_string(config_.max_references) +
                             " references (max_references)");
    }

    std::span<const Simplex<D>> polygons_;
    Config config_;
    KdNodes<D> tree_;
    std::size_t max_depth_ = 0;
    std::size_t references_ = 0;  ///< in leaves, nodes and waiting tasks, but for lost parts
    std::size_t next_planned_ = 0;
    std::vector<std::vector<Point<D>>> pieces_;  ///< corners
};

}  // namespace space
