/// @file
/// Building a k-d tree over segments (D = 2) or triangles (D = 3), all of it at once.
#pragma once

#include "chapters/ch04_kd_trees/kd_config.hpp"
#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "chapters/ch04_kd_trees/kd_splitter.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// Makes a tree of polygons and tells an observer each step: what KdSplitter tells, and Chosen.
template <int D>
class KdBuilder {
  public:
    using Config = KdTreeConfig;
    using Splitter = KdSplitter<D>;
    using Chosen = typename Splitter::Chosen;
    using Placed = typename Splitter::Placed;
    using Half = typename Splitter::Half;
    using Task = typename Splitter::Task;

    /// @throws LimitError where leaves and nodes would name more than config.max_references
    template <class Observer = NoObserver>
    static KdNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                            Observer&& observer = {}) {
        if (polygons.empty()) return {};
        const Splitter splitter(polygons, config);
        return KdBuilder(splitter, config).run(splitter.root(), observer);
    }

    /// Makes one tree; the splitter must outlive it.
    KdBuilder(const Splitter& splitter, const Config& config)
        : config_(config), splitter_(splitter) {}

    // [run]
    /// All of the tree below a task.
    template <class Observer>
    KdNodes<D> run(Task root, Observer& observer) {
        tree_.box = root.cell;
        tree_.nodes.assign(2, KdNode::leaf(0, 0));  // the gap makes later pairs even
        count_references(root.references.size());
        std::vector<Waiting> waiting;
        waiting.push_back({0, std::move(root)});
        while (!waiting.empty()) {
            auto [node, task] = std::move(waiting.back());
            waiting.pop_back();
            tree_.depth = std::max(tree_.depth, task.depth);
            const std::optional<KdSplit> split = choose(task, observer);
            observer.observe(Chosen{node, task.depth, task.cell, task.references, split});
            if (!split) {
                make_leaf(node, task);
                continue;
            }
            auto children = splitter_.divide(task, *split, observer);
            const std::uint32_t below = make_inner(node, *split, children);
            waiting.push_back({below + 1, std::move(children.above)});
            waiting.push_back({below, std::move(children.below)});
        }
        return std::move(tree_);
    }
    // [run]
    /// Of all leaves and inner nodes, and parts that were lost when they were cut.
    std::size_t references() const { return references_; }

  private:
    /// A task, and the node that it is to become.
    struct Waiting {
        std::uint32_t node;
        Task task;
    };

    template <class Observer>
    std::optional<KdSplit> choose(const Task& task, Observer& observer) {
        if (next_planned_ < config_.planned.size() && task.depth < splitter_.max_depth() &&
            task.references.size() > config_.max_leaf_size)
            return config_.planned[next_planned_++];
        return splitter_.choose(task, observer);
    }

    void make_leaf(std::uint32_t node, const Task& task) {
        tree_.nodes[node] = KdNode::leaf(static_cast<std::uint32_t>(tree_.references.size()),
                                         static_cast<std::uint32_t>(task.references.size()));
        for (const auto& reference : task.references) tree_.references.push_back(reference.polygon);
    }

    /// The index of the first of its two children.
    std::uint32_t make_inner(std::uint32_t node, const KdSplit& split,
                             const typename Splitter::Children& children) {
        count_references(children.shared);
        const std::size_t pair = tree_.nodes.size();
        if (pair + 1 > KdNode::largest)
            throw LimitError("k-d tree: more than " + std::to_string(KdNode::largest) + " nodes");
        tree_.nodes.insert(tree_.nodes.end(), 2, KdNode::leaf(0, 0));
        const auto below = static_cast<std::uint32_t>(pair);
        tree_.nodes[node] = KdNode::inner(split, below, !children.kept.empty());
        if (!children.kept.empty()) keep(node, children.kept);
        return below;
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

    Config config_;
    const Splitter& splitter_;
    KdNodes<D> tree_;
    std::size_t references_ = 0;  ///< in leaves, nodes and waiting tasks, and lost parts
    std::size_t next_planned_ = 0;
};

}  // namespace space
