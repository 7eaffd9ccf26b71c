/// @file
/// The surface area heuristic with spatial splits (Stich, Friedrich & Dietrich 2009, "Spatial
/// Splits in Bounding Volume Hierarchies"): where the two boxes of a cut would overlap, a plane may
/// cut the node instead, and a polygon on both sides of it is named by both, with the box of its
/// part there.
#pragma once

#include "chapters/ch04_kd_trees/clipped_bounds.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/object_split.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/spatial_bins.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace space {

/// What the builder may choose.
struct SpatialSplitConfig {
    BvhCosts costs = {};
    std::size_t max_leaf_size = 8;  ///< larger nodes are cut even where that does not pay
    unsigned max_depth = 64;        ///< beyond it nodes are halved
    /// Planes are tried where the boxes of the best cut by polygons overlap in more than this share
    /// of the root's surface (the paper's alpha).
    double min_overlap = 1e-4;
    /// References for each polygon that there may be in all; at 1 no polygon is named twice. The
    /// root may spend what is above 1, and what it leaves its two children share in the ratio of
    /// the surfaces of the boxes that each holds: planes are for large boxes. So do all nodes
    /// below, and there are never more. Where all polygons are long, each cut doubles most of them,
    /// and it takes 2 or 4 to gain much.
    double max_growth = 1.5;
    bool unsplits = true;  ///< a polygon on both sides stays whole on one where that costs less
};

/// Makes one tree.
///
/// *Nothing is lost.* The box of a node's reference holds all of its polygon that lies between the
/// planes that were taken above: of the polygon itself for the root, and clipped_bounds keeps it
/// so. A point on a plane lies in both halves.
template <int D>
class SpatialSplitBuild {
  public:
    using Reference = BvhReference<D>;

    /// A node with what it is to hold, and how many more references may be made of that.
    struct Task {
        std::uint32_t node = 0;
        unsigned depth = 0;
        BasicAabb<D> box = {};
        std::vector<Reference> references = {};
        std::size_t spare = 0;
    };
    /// What becomes of a node: it is cut by its references, already in order, or by a plane, or is
    /// to be a leaf.
    struct Choice {
        std::optional<BvhCut<D>> cut = {};
        std::optional<SpatialSplit> plane = {};
    };
    /// Event.
    struct Chosen {
        const Task& task;
        const Choice& choice;
    };

    SpatialSplitBuild(std::span<const Simplex<D>> polygons, const SpatialSplitConfig& config)
        : polygons_(polygons), config_(config) {}

    // [spatial_run]
    template <class Observer>
    BvhNodes<D> run(Observer& observer) {
        std::vector<Task> waiting{root()};
        if (waiting[0].references.empty()) return {};
        const HitChance<D> root_chance(waiting[0].box);
        tree_.nodes.resize(2);
        while (!waiting.empty()) {
            Task task = std::move(waiting.back());
            waiting.pop_back();
            tree_.depth = std::max(tree_.depth, task.depth);
            const Choice choice = choose(task, root_chance);
            observer.observe(Chosen{task, choice});
            tree_.nodes[task.node].box = task.box;
            if (!choice.cut && !choice.plane) {
                make_leaf(task);
                continue;
            }
            const auto pair = static_cast<std::uint32_t>(tree_.nodes.size());
            tree_.nodes[task.node].first = pair;
            tree_.nodes.resize(pair + 2);
            Task low{.node = pair, .depth = task.depth + 1};
            Task high{.node = pair + 1, .depth = task.depth + 1};
            const std::size_t before = task.references.size();
            if (choice.cut || !part(task, *choice.plane, low, high))
                divide(task, choice.cut ? *choice.cut : halved<D>(task.references), low, high);
            share_spare(task.spare, before, root_chance, low, high);
            waiting.push_back(std::move(high));
            waiting.push_back(std::move(low));
        }
        unite_boxes(tree_);  // in two parts a polygon may need less room than in one
        return std::move(tree_);
    }
    // [spatial_run]

  private:
    Task root() const {
        Task task{.references = boxed<D>(polygons_)};
        task.box = box_around<D>(task.references);
        const double more = (config_.max_growth - 1.0) * double(task.references.size());
        if (more > 0.0) task.spare = static_cast<std::size_t>(std::min(more, 0x1p31));
        return task;
    }

    // [spatial_choose]
    Choice choose(Task& task, const HitChance<D>& root_chance) const {
        const std::span<Reference> range(task.references);
        const std::size_t size = range.size();
        const bool may_be_leaf = size <= std::max<std::size_t>(config_.max_leaf_size, 1);
        if (size == 1 || (may_be_leaf && task.depth >= config_.max_depth)) return {};
        if (task.depth >= config_.max_depth) {
            put_in_order(range);
            return {.cut = cut_after<D>(size / 2, range)};
        }
        const HitChance<D> chance(task.box);
        const ObjectSplit split = best_object_split(range, chance);
        sort_along(range, split.axis);
        const BvhCut<D> cut = cut_after<D>(split.count, range);
        SpatialSplit plane;
        if (task.spare > 0 && overlap(cut, root_chance) > config_.min_overlap)
            plane = best_plane(task, chance);
        if (config_.costs.cut_pays(std::min(plane.tests, split.tests), size)) {
            if (plane.tests < split.tests) return {.plane = plane};
            return {.cut = cut};
        }
        if (may_be_leaf) return {};
        return {.cut = halved<D>(range)};
    }
    // [spatial_choose]

    static double overlap(const BvhCut<D>& cut, const HitChance<D>& chance) {
        const BasicAabb<D> both{glm::max(cut.first.min, cut.second.min),
                                glm::min(cut.first.max, cut.second.max)};
        return both.is_empty() ? 0.0 : chance(both);
    }

    SpatialSplit best_plane(const Task& task, const HitChance<D>& chance) const {
        SpatialSplit best;
        for (int axis = 0; axis < D; ++axis) {
            SpatialBins<D> bins(task.box, axis, task.references.size());
            for (const Reference& reference : task.references)
                bins.add(polygons_[reference.polygon], reference);
            const SpatialSplit split = bins.best(task.references.size(), task.spare, chance);
            if (split.tests < best.tests) best = split;
        }
        return best;
    }

    static void divide(Task& task, const BvhCut<D>& cut, Task& low, Task& high) {
        const auto middle = task.references.begin() + static_cast<std::ptrdiff_t>(cut.count);
        high.references.assign(middle, task.references.end());
        task.references.erase(middle, task.references.end());
        low.references = std::move(task.references);
        low.box = cut.first;
        high.box = cut.second;
    }

    // [part]
    /// What is not on both sides of the plane goes to its side. False, and nothing done, where one
    /// side gets nothing: boxes may reach where polygons don't.
    bool part(const Task& task, const SpatialSplit& plane, Task& low, Task& high) const {
        Task below{.node = low.node, .depth = low.depth},
            above{.node = high.node, .depth = high.depth};
        std::vector<Straddler> straddlers;
        for (const Reference& reference : task.references) {
            if (reference.box.min[plane.axis] >= plane.position)
                add(above, reference);
            else if (reference.box.max[plane.axis] <= plane.position)
                add(below, reference);
            else
                straddlers.push_back(in_parts(reference, plane));
        }
        if (config_.unsplits) keep_whole(straddlers, below, above);
        for (const Straddler& straddler : straddlers) {
            if (!straddler.below.is_empty()) add(below, {straddler.below, straddler.whole.polygon});
            if (!straddler.above.is_empty()) add(above, {straddler.above, straddler.whole.polygon});
        }
        if (below.references.empty() || above.references.empty()) return false;
        low = std::move(below);
        high = std::move(above);
        return true;
    }
    // [part]

    /// A reference on both sides of a plane, and the boxes of what it has on each.
    struct Straddler {
        Reference whole;
        BasicAabb<D> below, above;

        bool is_on_both() const { return !below.is_empty() && !above.is_empty(); }
    };
    Straddler in_parts(const Reference& whole, const SpatialSplit& plane) const {
        BasicAabb<D> below = whole.box, above = whole.box;
        below.max[plane.axis] = above.min[plane.axis] = plane.position;
        const Simplex<D>& polygon = polygons_[whole.polygon];
        return {whole, clipped_bounds<D>(polygon, below), clipped_bounds<D>(polygon, above)};
    }
    static void add(Task& task, const Reference& reference) {
        task.box.extend(reference.box);
        task.references.push_back(reference);
    }

    // [keep_whole]
    /// Unsplitting (section 4.4): one straddler after the other goes whole to the side where that
    /// is cheaper than to be named on both.
    static void keep_whole(std::vector<Straddler>& straddlers, const Task& low, const Task& high) {
        BasicAabb<D> low_box = low.box, high_box = high.box;
        auto low_size = double(low.references.size()), high_size = double(high.references.size());
        for (const Straddler& straddler : straddlers) {
            low_box.extend(straddler.below);
            high_box.extend(straddler.above);
            low_size += !straddler.below.is_empty();
            high_size += !straddler.above.is_empty();
        }
        const HitChance<D> chance(around(low_box, high_box));
        for (Straddler& straddler : straddlers) {
            if (!straddler.is_on_both()) continue;
            const BasicAabb<D> low_with = around(low_box, straddler.whole.box),
                               high_with = around(high_box, straddler.whole.box);
            const double low_weight = chance.weight(low_box), high_weight = chance.weight(high_box);
            const double on_both = low_weight * low_size + high_weight * high_size;
            const double below = chance.weight(low_with) * low_size + high_weight * (high_size - 1);
            const double above = low_weight * (low_size - 1) + chance.weight(high_with) * high_size;
            if (std::min(below, above) >= on_both) continue;
            if (below <= above && high_size > 1) {
                straddler = {straddler.whole, straddler.whole.box, {}};
                low_box = low_with;
                --high_size;
            } else if (above < on_both && low_size > 1) {
                straddler = {straddler.whole, {}, straddler.whole.box};
                high_box = high_with;
                --low_size;
            }
        }
    }
    // [keep_whole]

    static BasicAabb<D> around(BasicAabb<D> box, const BasicAabb<D>& other) {
        box.extend(other);
        return box;
    }

    // [share_spare]
    /// What the node had, less what its plane has used, in whole references.
    static void share_spare(std::size_t spare, std::size_t before, const HitChance<D>& chance,
                            Task& low, Task& high) {
        const std::size_t after = low.references.size() + high.references.size();
        spare -= std::max(after, before) - before;
        const double of_low = surfaces(low, chance), of_high = surfaces(high, chance);
        const double share = of_low + of_high > 0.0 ? of_low / (of_low + of_high) : 0.5;
        low.spare = static_cast<std::size_t>(share * double(spare));
        high.spare = spare - low.spare;
    }
    static double surfaces(const Task& task, const HitChance<D>& chance) {
        double sum = 0.0;
        for (const Reference& reference : task.references) sum += chance.weight(reference.box);
        return sum;
    }
    // [share_spare]

    void make_leaf(Task& task) {
        put_in_order(std::span(task.references));
        BvhNode<D>& leaf = tree_.nodes[task.node];
        leaf.first = static_cast<std::uint32_t>(tree_.references.size());
        leaf.count = static_cast<std::uint32_t>(task.references.size());
        for (const Reference& reference : task.references)
            tree_.references.push_back(reference.polygon);
    }

    std::span<const Simplex<D>> polygons_;
    SpatialSplitConfig config_;
    BvhNodes<D> tree_;
};

/// The builder.
struct SpatialSplitBuilder {
    using Config = SpatialSplitConfig;

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        return SpatialSplitBuild<D>(polygons, config).run(observer);
    }
};

}  // namespace space
