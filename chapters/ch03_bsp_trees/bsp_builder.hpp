/// @file
/// Building a BSP tree: Algorithm 2 of Heinonen16 (section 3.1.1), with a place for coplanar
/// polygons. splitter_choice.hpp chooses the splitters.
#pragma once

#include "chapters/ch03_bsp_trees/splitter_choice.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"
#include "common/zero_area.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// Makes a tree of polygons and tells an observer each step.
template <int D>
class BspBuilder {
  public:
    /// Event: a node has got its plane, which is that of a polygon unless it is free.
    struct Chosen {
        const SplitPlane<D>& plane;
        std::optional<std::uint32_t> polygon;
        std::uint32_t node, parent;
        bool in_front;  ///< of the parent
    };
    /// Event: where a fragment lies, seen from the node's plane.
    struct Placed {
        const Fragment<D>& fragment;
        PlaneSide side;
    };
    /// Event: a straddling fragment, and its pieces.
    struct Cut {
        const Fragment<D>&whole, &front, &back;
    };

    /// Polygons without extent (equal corners in the plane, zero area in space) are left out, and
    /// those whose coordinates are not all finite: they hide nothing.
    /// @throws LimitError where the tree would have more than config.max_fragments fragments, or
    /// place more than config.max_placed
    template <class Observer = NoObserver>
    static BspTree<D> build(std::span<const Simplex<D>> polygons, const BspConfig& config = {},
                            Observer&& observer = {}) {
        BspBuilder builder(polygons, config);
        builder.run(observer);
        return std::move(builder.tree_);
    }

  private:
    using Set = std::vector<Fragment<D>>;
    /// A set that waits to become a node.
    struct Task {
        Set set;
        std::uint32_t parent;
        bool in_front;
    };

    BspBuilder(std::span<const Simplex<D>> polygons, const BspConfig& config)
        : config_(config),
          thickness_(thickness_of_planes<D>(polygons, config)),
          chooser_(tree_, config, thickness_) {
        tree_.polygons.assign(polygons.begin(), polygons.end());
    }

    // [run]
    template <class Observer>
    void run(Observer& observer) {
        std::vector<Task> tasks;  // not recursion: a chain is as deep as there are polygons
        tasks.push_back({all_polygons(), BspTree<D>::none, false});
        while (!tasks.empty()) {
            Task task = std::move(tasks.back());
            tasks.pop_back();
            if (task.set.empty()) continue;
            const std::uint32_t node = next_node();
            auto [front, back] = make_node(std::move(task), observer);
            tasks.push_back({std::move(back), node, false});
            tasks.push_back({std::move(front), node, true});
        }
    }
    // [run]

    /// What lies in front of a node's plane and behind it.
    struct Parts {
        Set front, back;
    };

    // [make_node]
    /// Algorithm 2 of Heinonen16: chooses a plane, and sends every fragment of the set to the
    /// front, to the back, into the node, or in two pieces to both sides.
    template <class Observer>
    Parts make_node(Task task, Observer& observer) {
        const Splitter<D> splitter = chooser_.choose(task.set);
        const Cutter<D> cutter = add_node(splitter, task, observer);
        Parts parts;
        for (Fragment<D>& fragment : task.set) {
            const PlaneSide side = side_of(splitter, cutter, fragment, sides_);
            observer.observe(Placed{fragment, side});
            switch (side) {
                case PlaneSide::front:
                    parts.front.push_back(std::move(fragment));
                    break;
                case PlaneSide::back:
                    parts.back.push_back(std::move(fragment));
                    break;
                case PlaneSide::coplanar:
                    add_fragment(std::move(fragment));
                    break;
                case PlaneSide::straddling:
                    cut(cutter, fragment, parts, observer);
                    break;
            }
        }
        return parts;
    }
    // [make_node]

    Set all_polygons() {
        Set all;
        for (std::uint32_t i = 0; i < tree_.polygons.size(); ++i)
            if (spans_plane(tree_.polygons[i]))
                all.push_back(whole_polygon<D>(tree_.polygons[i], i));
        count_fragments(all.size());
        return all;
    }

    static bool spans_plane(const Simplex<D>& polygon) {
        if (box_if_finite<D>(polygon).is_empty()) return false;
        if constexpr (D == 2)
            return polygon.a != polygon.b;
        else
            return !has_zero_area(polygon);
    }

    std::uint32_t next_node() const { return static_cast<std::uint32_t>(tree_.nodes.size()); }

    /// Appends the node, links its parent to it, and makes what cuts by its plane.
    template <class Observer>
    Cutter<D> add_node(const Splitter<D>& splitter, const Task& task, Observer& observer) {
        count_placed(task.set.size());
        const std::uint32_t node = next_node();
        if (task.parent != BspTree<D>::none) {
            auto& parent = tree_.nodes[task.parent];
            (task.in_front ? parent.front : parent.back) = node;
        }
        tree_.nodes.push_back({.plane = static_cast<std::uint32_t>(tree_.planes.size()),
                               .first = static_cast<std::uint32_t>(tree_.fragments.size())});
        tree_.planes.push_back(splitter.plane);
        observer.observe(
            Chosen{splitter.plane, splitter.polygon, node, task.parent, task.in_front});
        return {tree_.polygons, tree_.planes, config_.grade, thickness_};
    }

    /// To the newest node.
    void add_fragment(Fragment<D> fragment) {
        tree_.fragments.push_back(std::move(fragment));
        ++tree_.nodes.back().count;
    }

    std::uint32_t newest_plane() const {
        return static_cast<std::uint32_t>(tree_.planes.size() - 1);
    }

    template <class Observer>
    void cut(const Cutter<D>& cutter, Fragment<D>& fragment, Parts& parts, Observer& observer) {
        count_fragments(1);
        if (config_.straddlers == BspConfig::Straddlers::share) {
            parts.front.push_back(fragment);
            parts.back.push_back(std::move(fragment));
            return;
        }
        auto [front, back] = cutter.split(fragment, sides_, newest_plane());
        observer.observe(Cut{fragment, front, back});
        // Exact pieces have an extent, even where it is too small for their corners to differ in
        // double.
        const bool exact = config_.grade == Grade::exact;
        if (exact || Cutter<D>::has_extent(front)) parts.front.push_back(std::move(front));
        if (exact || Cutter<D>::has_extent(back)) parts.back.push_back(std::move(back));
    }

    void count_fragments(std::size_t more) {
        fragments_ += more;
        if (fragments_ > config_.max_fragments)
            throw LimitError("BSP tree: more than " + std::to_string(config_.max_fragments) +
                             " fragments (max_fragments)");
    }
    void count_placed(std::size_t more) {
        placed_ += more;
        if (placed_ > config_.max_placed)
            throw LimitError("BSP tree: more than " + std::to_string(config_.max_placed) +
                             " polygons to place (max_placed)");
    }

    BspConfig config_;
    double thickness_;
    BspTree<D> tree_;
    SplitterChooser<D> chooser_;
    std::size_t fragments_ = 0;
    std::uint64_t placed_ = 0;
    std::vector<int> sides_;  ///< of the corners of the fragment in hand
};

}  // namespace space
