/// @file
/// Building a quadtree over segments (D = 2) or an octree over triangles (D = 3): cells with their
/// straddlers in all children or in themselves, tight or loose.
#pragma once

#include "chapters/ch06_quadtrees_and_octrees/orthtree_cell.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_config.hpp"
#include "chapters/ch06_quadtrees_and_octrees/orthtree_nodes.hpp"
#include "chapters/ch06_quadtrees_and_octrees/simplex_overlap.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// Makes a tree of polygons and tells an observer each step.
///
/// *Nothing is lost.* Each point of a polygon lies in the closed cell of a node that names the
/// polygon. The root is given all polygons that are finite; no ray can hit another one. Let a node
/// be given the polygon, and its closed cell hold the point. If the node hands it on, it is on
/// either side of each middle plane as far as its closed box reaches, or, where it lies in the
/// plane, above; so the point lies in the closed cell of a child on which no axis is against it.
/// There the overlap finds it, and the child is given the polygon. In a tree that keeps straddlers
/// the cell holds all of the polygon.
///
/// *How large it may get.* Let r be the references of the children over those of the node: at least
/// 1, since nothing is lost. The product of all r from the root to a leaf is at most max_growth.
/// Below a node with m references and product g all leaves together name at most m max_growth / g:
/// true for a leaf, and by induction for r m references with product r g. So n polygons have at
/// most max_growth n references, however many of them lie in one place; and every node that is no
/// root names one or lies above a leaf that does: at most max_depth nodes for each reference, and
/// one.
template <int D>
class OrthtreeBuilder {
  public:
    using Config = OctreeConfig;

    /// Event: a node is cut, or is to be a leaf.
    struct Chosen {
        std::uint32_t node;
        OrthtreeCell<D> cell;
        std::span<const std::uint32_t> polygons;
        /// Of each of them the children that are to name it, bit k for child k; none for those that
        /// stay.
        std::span<const std::uint8_t> children;
        bool is_cut;
    };

    /// Polygons that are not finite are left out.
    /// @throws LimitError where it would name more than config.max_references, or a node more than
    /// it can
    template <class Observer = NoObserver>
    static OrthtreeNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                                  Observer&& observer = {}) {
        OrthtreeBuilder builder(polygons, config);
        if (builder.tree_.bounds.is_empty()) return {};
        return builder.run(observer);
    }

  private:
    /// A cell that waits to become a node, with what it is to name.
    struct Task {
        std::uint32_t node;
        OrthtreeCell<D> cell;
        OrthtreeCube<D> cube;
        std::vector<std::uint32_t> polygons;
        double growth = 1.0;  ///< of references, from the root to here
    };
    /// What a cut would do: of each polygon its children, and of each child how many polygons.
    struct Cut {
        std::vector<std::uint8_t> children;
        std::array<std::size_t, orthants<D>> counts{};
        std::size_t kept = 0, handed_on = 0;
    };

    OrthtreeBuilder(std::span<const Simplex<D>> polygons, const Config& config)
        : polygons_(polygons), config_(config) {
        tree_.looseness = keeps() ? config.looseness : 1.0;
        boxes_.resize(polygons.size());
        for (std::size_t i = 0; i < polygons.size(); ++i) {
            boxes_[i] = box_if_finite<D>(polygons[i]);
            tree_.bounds.extend(boxes_[i]);
        }
        tree_.frame = OrthtreeFrame<D>::around(tree_.bounds);
        max_depth_ = std::min(config.max_depth, max_orthtree_depth<D>);
    }
    bool keeps() const { return config_.straddlers == Config::Straddlers::keep; }

    // [run]
    template <class Observer>
    OrthtreeNodes<D> run(Observer& observer) {
        std::vector<Task> waiting{root()};
        while (!waiting.empty()) {
            Task task = std::move(waiting.back());
            waiting.pop_back();
            tree_.depth = std::max<std::size_t>(tree_.depth, task.cell.depth);
            const Cut cut = cut_of(task);
            const bool is_cut = pays(task, cut);
            observer.observe(Chosen{task.node, task.cell, task.polygons, cut.children, is_cut});
            if (is_cut)
                divide(task, cut, waiting);
            else
                name(task.node, task.polygons);
        }
        return std::move(tree_);
    }
    // [run]

    Task root() {
        tree_.nodes.resize(1);
        Task task{0, {}, OrthtreeCube<D>::of(tree_.frame), {}};
        for (std::uint32_t i = 0; i < polygons_.size(); ++i)
            if (!boxes_[i].is_empty()) task.polygons.push_back(i);
        count_references(task.polygons.size());
        return task;
    }

    // [pays]
    /// Where a ray that meets a cell is expected to meet a child in one of 2^(D - 1) cases, the
    /// ratio of their surfaces.
    bool pays(const Task& task, const Cut& cut) const {
        const std::size_t size = task.polygons.size();
        if (task.cell.depth >= max_depth_ || size <= config_.max_leaf_size || cut.handed_on == 0)
            return false;
        const double names = double(cut.kept + cut.handed_on);
        if (!(task.growth * names <= config_.max_growth * double(size))) return false;
        const double tests = double(cut.kept) + double(cut.handed_on) / double(1 << (D - 1));
        return config_.costs.traversal + config_.costs.intersection * tests <
               config_.costs.intersection * double(size);
    }
    // [pays]

    Cut cut_of(const Task& task) const {
        Cut cut;
        if (task.cell.depth >= max_depth_ || task.polygons.size() <= config_.max_leaf_size)
            return cut;
        std::array<OrthtreeBox<D>, orthants<D>> cells;
        for (std::uint32_t k = 0; k < orthants<D>; ++k)
            cells[k] = task.cube.child(k).box(tree_.looseness);
        for (const std::uint32_t polygon : task.polygons) {
            const std::uint32_t mask = keeps() ? child_that_holds(polygon, task.cube, cells)
                                               : overlapped(polygon, task.cube, cells);
            cut.children.push_back(static_cast<std::uint8_t>(mask));
            cut.kept += mask == 0;
            for (std::uint32_t k = 0; k < orthants<D>; ++k) cut.counts[k] += mask >> k & 1u;
        }
        for (const std::size_t count : cut.counts) cut.handed_on += count;
        return cut;
    }

    // [overlapped]
    /// The children whose closed cells the polygon overlaps. What only touches a plane from one
    /// side belongs to that side, what lies in it to the upper one. It overlaps the node's cell:
    /// where its box leaves one child, that is it.
    std::uint32_t overlapped(std::uint32_t polygon, const OrthtreeCube<D>& cube,
                             const std::array<OrthtreeBox<D>, orthants<D>>& cells) const {
        std::uint32_t mask = (1u << orthants<D>)-1u;
        for (int axis = 0; axis < D; ++axis) {
            const double low = boxes_[polygon].min[axis], high = boxes_[polygon].max[axis];
            const double middle = cube.centre[axis];
            const std::uint32_t lower = lower_children<D>(static_cast<std::uint32_t>(axis));
            if (!(low < middle)) mask &= ~lower;
            if (!(high > middle || low >= middle)) mask &= lower;
        }
        if (std::has_single_bit(mask)) return mask;
        const SimplexOverlap<D> overlap(polygons_[polygon]);
        for (std::uint32_t k = 0; k < orthants<D>; ++k)
            if ((mask >> k & 1u) != 0 && !overlap.overlaps(cells[k])) mask &= ~(1u << k);
        return mask;
    }
    // [overlapped]
    // [child_that_holds]
    /// The child in which the centre of the polygon's box lies, if its cell holds all of the box.
    std::uint32_t child_that_holds(std::uint32_t polygon, const OrthtreeCube<D>& cube,
                                   const std::array<OrthtreeBox<D>, orthants<D>>& cells) const {
        const BasicAabb<D>& box = boxes_[polygon];
        const Double<D> centre = 0.5 * (Double<D>(box.min) + Double<D>(box.max));
        std::uint32_t k = 0;
        for (int axis = 0; axis < D; ++axis)
            k |= std::uint32_t(centre[axis] >= cube.centre[axis]) << axis;
        for (int axis = 0; axis < D; ++axis)
            if (double{box.min[axis]} < cells[k].min[axis] ||
                double{box.max[axis]} > cells[k].max[axis])
                return 0;
        return 1u << k;
    }
    // [child_that_holds]

    // [divide]
    /// Makes nodes for the children that are not empty, the lowest to be the next in hand.
    void divide(Task& task, const Cut& cut, std::vector<Task>& waiting) {
        count_references(cut.kept + cut.handed_on - task.polygons.size());
        std::uint32_t mask = 0;
        for (std::uint32_t k = 0; k < orthants<D>; ++k)
            mask |= std::uint32_t(cut.counts[k] > 0) << k;
        tree_.nodes[task.node].children = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes[task.node].mask = static_cast<std::uint8_t>(mask);
        tree_.nodes.resize(tree_.nodes.size() + std::size_t(std::popcount(mask)));
        const double growth =
            task.growth * double(cut.kept + cut.handed_on) / double(task.polygons.size());
        for (std::uint32_t k = orthants<D>; k-- > 0;) {
            if (cut.counts[k] == 0) continue;
            waiting.push_back({tree_.nodes[task.node].child(k),
                               task.cell.child(k),
                               task.cube.child(k),
                               {},
                               growth});
            std::vector<std::uint32_t>& polygons = waiting.back().polygons;
            polygons.reserve(cut.counts[k]);
            for (std::size_t i = 0; i < task.polygons.size(); ++i)
                if ((cut.children[i] >> k & 1u) != 0) polygons.push_back(task.polygons[i]);
        }
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i < task.polygons.size(); ++i)
            if (cut.children[i] == 0) kept.push_back(task.polygons[i]);
        name(task.node, kept);
    }
    // [divide]

    void name(std::uint32_t node, std::span<const std::uint32_t> polygons) {
        if (polygons.size() > OrthtreeNode::largest_count)
            throw LimitError("octree: more than " + std::to_string(OrthtreeNode::largest_count) +
                             " references in one node");
        tree_.nodes[node].first = static_cast<std::uint32_t>(tree_.references.size());
        tree_.nodes[node].count = static_cast<std::uint32_t>(polygons.size()) & 0xffffffu;
        tree_.references.insert(tree_.references.end(), polygons.begin(), polygons.end());
    }

    void count_references(std::size_t more) {
        references_ += more;
        if (references_ > config_.max_references)
            throw LimitError("octree: more than " + std::to_string(config_.max_references) +
                             " references (max_references)");
    }

    std::span<const Simplex<D>> polygons_;
    Config config_;
    std::vector<BasicAabb<D>> boxes_;  ///< of the polygons; empty of those left out
    OrthtreeNodes<D> tree_;
    std::uint32_t max_depth_ = 0;
    std::size_t references_ = 0;  ///< of nodes and waiting tasks
};

}  // namespace space
