/// @file
/// A k-d tree that is made where rays go (Johnston06): a node waits with what lies in its cell
/// until somebody enters it. Several threads may; one makes the node, the others wait for it.
#pragma once

#include "chapters/ch04_kd_trees/kd_builder.hpp"
#include "chapters/ch04_kd_trees/kd_config.hpp"
#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "chapters/ch04_kd_trees/kd_splitter.hpp"
#include "chapters/ch05_lazy_kd_trees/chunks.hpp"
#include "chapters/ch05_lazy_kd_trees/shared_limit.hpp"
#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

/// What may be chosen about a lazy tree: as of chapter 4's, but where straddlers go.
struct LazyKdTreeConfig {
    using Rule = KdTreeConfig::Rule;

    Rule rule = Rule::sah;
    bool clips = true;  ///< straddlers to their cells; else they are named where their boxes reach
    SahCosts costs = {};
    std::size_t max_leaf_size = 4;                 ///< of middle and median
    double max_straddling = 0.75;                  ///< of middle and median, as chapter 4 has it
    std::optional<std::size_t> max_depth = {};     ///< 8 + 1.3 log2 n unless it is given
    std::size_t max_references = KdNode::largest;  ///< limits memory
    /// A list that is no longer than this is not worth keeping: all below its node is made when the
    /// node is entered. 0: nothing that is not entered.
    std::size_t at_once = 256;
    bool mailboxes = true;

    /// Of the tree of chapter 4 that the lazy one becomes.
    KdTreeConfig eager() const {
        using Straddlers = KdTreeConfig::Straddlers;
        return {.rule = rule,
                .straddlers = clips ? Straddlers::clip : Straddlers::duplicate,
                .costs = costs,
                .max_leaf_size = max_leaf_size,
                .max_straddling = max_straddling,
                .max_depth = max_depth,
                .max_references = max_references,
                .mailboxes = mailboxes};
    }
};

/// Events of a node's making, besides those of chapter 4's step (KdSplitter), which number the
/// nodes of what is made at once from its own root on.
struct LazyKdEvent {
    /// This thread is the first to enter the node, and makes it.
    struct Entered {
        std::uint32_t node;
    };
    /// Another makes it: this thread waits.
    struct Waits {
        std::uint32_t node;
    };
    /// It stands, for all threads to see.
    struct Stands {
        std::uint32_t node;
    };
};

/// What stands of a lazy tree, and what waits.
struct LazyKdCounts {
    std::size_t inner = 0, leaves = 0;  ///< that stand
    std::size_t waiting = 0;            ///< nodes that nobody has entered
    std::size_t depth = 0;              ///< edges from the root to the deepest of all these
    std::size_t references = 0;         ///< in leaves
    std::size_t waiting_references = 0;
    std::size_t waiting_bytes = 0;  ///< of what waiting nodes hold: references and sorted events
    std::size_t bytes = 0;  ///< of all of it, but for the polygons and what chunks have to spare

    std::size_t standing() const { return inner + leaves; }
    bool operator==(const LazyKdCounts&) const = default;
};

/// The tree over polygons, which it knows by a span that must outlive it. It looks as if it were
/// complete: whoever asks for a node has it made. So all is const, and any thread may ask. The
/// observer is told events by the threads that make the nodes.
template <int D, class Observer = NoObserver>
class LazyKdNodes {
  public:
    using Config = LazyKdTreeConfig;
    using Splitter = KdSplitter<D>;

    /// What a node is at the moment.
    enum class State { inner, leaf, waiting };
    /// A node as it stands or waits.
    struct Cell {
        std::uint32_t node;
        BasicAabb<D> box;
        std::size_t depth;
        State state;
        std::size_t references;  ///< that a leaf names, or that wait
    };

    /// @throws LimitError for more polygons than config.max_references
    LazyKdNodes(std::span<const Simplex<D>> polygons, const Config& config, Observer observer = {})
        : box(box_of(polygons)),
          polygons_(polygons),
          config_(config),
          splitter_(polygons, config.eager()),
          words_(4 * polygons.size()),
          references_(2 * polygons.size()),
          copies_(2 * polygons.size()),
          references_left_(config.max_references),
          observer_(std::move(observer)) {
        if (empty()) return;
        count_references(polygons.size());
        words_.add(2, KdNode::largest);  // the gap makes later pairs even
        word(0).store(waiting_word(std::make_unique<Waiting>()));
    }
    LazyKdNodes(const LazyKdNodes&) = delete;
    LazyKdNodes& operator=(const LazyKdNodes&) = delete;
    ~LazyKdNodes() {
        for_each_cell([&](const Cell& cell) {
            if (cell.state == State::waiting) delete waiting_at(word(cell.node).load());
        });
    }

    const BasicAabb<D> box;  ///< the root's cell
    bool empty() const { return polygons_.empty(); }

    // [node]
    /// The node, which is made if it waits. A finished one costs a load and a comparison.
    /// @throws LimitError, std::bad_alloc where it can't be made; then it waits as before
    KdNode node(std::uint32_t index) const {
        std::uint64_t bits = word(index).load(std::memory_order_acquire);
        if (is_waiting(bits)) [[unlikely]]
            bits = finished(index, bits);
        return KdNode::of_bits(bits);
    }
    // [node]

    /// What a leaf names.
    std::span<const std::uint32_t> own(std::uint32_t index) const {
        const KdNode leaf = node(index);
        if (!leaf.is_leaf() || leaf.count() == 0) return {};
        return {&references_[leaf.first()], leaf.count()};
    }
    /// The same polygons, copied: what a ray tests one after the other lies together in memory.
    std::span<const Simplex<D>> copies(std::uint32_t index) const {
        const KdNode leaf = node(index);
        if (!leaf.is_leaf() || leaf.count() == 0) return {};
        return {&copies_[leaf.first()], leaf.count()};
    }

    /// Enters every node.
    void build_all() const {
        std::vector<std::uint32_t> open;
        if (!empty()) open.push_back(0);
        while (!open.empty()) {
            const KdNode next = node(open.back());
            open.pop_back();
            if (!next.is_leaf()) open.insert(open.end(), {next.below() + 1, next.below()});
        }
    }

    /// Calls visit(cell) for each node that stands or waits, below before above; it makes none. Not
    /// while others do.
    template <class Visit>
    void for_each_cell(const Visit& visit) const {
        if (!empty()) for_each_cell(0, box, 0, visit);
    }
    LazyKdCounts counts() const;

  private:
    using Task = typename Splitter::Task;

    /// A task, and where its node's children will be.
    struct alignas(8) Waiting {
        Task task = {};
        std::uint32_t below = 0;  ///< 0: not known yet
    };

    // [word]
    /// A node's eight bytes are KdNode's once it stands. Its third bit says there that an inner
    /// node keeps polygons, and none of this tree does. Here the bit says that the node waits; the
    /// lowest says that somebody makes it, and the rest is the address of what waits.
    static constexpr std::uint64_t waits = 4, is_being_made = 1;

    std::atomic_ref<std::uint64_t> word(std::uint32_t index) const {
        return std::atomic_ref(words_[index]);
    }
    static bool is_waiting(std::uint64_t word) { return (word & waits) != 0; }
    static std::uint64_t waiting_word(std::unique_ptr<Waiting> waiting) {
        static_assert(alignof(Waiting) >= 8);
        return reinterpret_cast<std::uintptr_t>(waiting.release()) | waits;
    }
    static Waiting* waiting_at(std::uint64_t word) {
        return reinterpret_cast<Waiting*>(static_cast<std::uintptr_t>(word & ~std::uint64_t{7}));
    }
    // [word]

    // [finished]
    /// Makes the node, or waits until it stands. Whoever makes a node waits for no other, so this
    /// comes to an end.
    std::uint64_t finished(std::uint32_t index, std::uint64_t bits) const {
        while (is_waiting(bits)) {
            if ((bits & is_being_made) != 0) {
                observer_.observe(LazyKdEvent::Waits{index});
                word(index).wait(bits, std::memory_order_acquire);
                bits = word(index).load(std::memory_order_acquire);
            } else if (word(index).compare_exchange_weak(bits, bits | is_being_made,
                                                         std::memory_order_acquire)) {
                return made(index, bits);
            }
        }
        return bits;
    }

    /// What waited is given back when the node stands. Where it can't be made it waits on, for
    /// whoever comes next, and those who wait now.
    std::uint64_t made(std::uint32_t index, std::uint64_t bits) const {
        std::unique_ptr<Waiting> waiting(waiting_at(bits));
        const auto publish = [&](std::uint64_t next) {
            word(index).store(next, std::memory_order_release);
            word(index).notify_all();
        };
        try {
            observer_.observe(LazyKdEvent::Entered{index});
            bits = node_of(index, *waiting).bits();
        } catch (...) {
            publish(waiting_word(std::move(waiting)));
            throw;
        }
        publish(bits);
        observer_.observe(LazyKdEvent::Stands{index});
        return bits;
    }
    // [finished]

    KdNode node_of(std::uint32_t index, Waiting& waiting) const {
        Task& task = waiting.task;
        if (index == 0 && task.references.empty()) task = splitter_.root();
        return task.references.size() > config_.at_once ? step(index, waiting) : all_below(task);
    }

    // [step]
    /// Chapter 4's step. All that may throw comes before `divide` takes from the task; where it
    /// takes, nothing is shared, and there is nothing to count.
    KdNode step(std::uint32_t index, Waiting& waiting) const {
        Task& task = waiting.task;
        const std::optional<KdSplit> split = splitter_.choose(task, observer_);
        observer_.observe(
            typename Splitter::Chosen{index, task.depth, task.cell, task.references, split});
        if (!split) return leaf(task);
        if (waiting.below == 0) waiting.below = words_.add(2, KdNode::largest);
        auto below = std::make_unique<Waiting>(), above = std::make_unique<Waiting>();
        auto children = splitter_.divide(task, *split, observer_);
        count_references(children.shared);
        below->task = std::move(children.below);
        above->task = std::move(children.above);
        word(waiting.below).store(waiting_word(std::move(below)), std::memory_order_relaxed);
        word(waiting.below + 1).store(waiting_word(std::move(above)), std::memory_order_relaxed);
        return KdNode::inner(*split, waiting.below);
    }
    // [step]

    KdNode leaf(const Task& task) const {
        const auto count = static_cast<std::uint32_t>(task.references.size());
        const std::uint32_t first = add_list(count);
        for (std::uint32_t i = 0; i < count; ++i) name(first + i, task.references[i].polygon);
        return KdNode::leaf(first, count);
    }
    std::uint32_t add_list(std::size_t count) const {
        const std::uint32_t first = references_.add(count, KdNode::largest);
        if (count > 0) copies_.make(first);
        return first;
    }
    void name(std::uint32_t place, std::uint32_t polygon) const {
        references_[place] = polygon;
        copies_[place] = polygons_[polygon];
    }

    // [all_below]
    /// Chapter 4's builder makes the rest, and its nodes and lists are moved to where ours are.
    KdNode all_below(const Task& task) const {
        const std::size_t size = task.references.size();
        KdBuilder<D> builder(splitter_, config_.eager());
        const KdNodes<D> part = builder.run(task, observer_);
        const std::size_t shared = builder.references() - size;
        count_references(shared);  // first, because places that are added are not given back
        std::uint32_t named, place;
        try {
            named = add_list(part.references.size());
            place = words_.add(part.nodes.size() - 2, KdNode::largest) - 2;
        } catch (...) {
            references_left_.give_back(shared);
            throw;
        }
        const auto moved = [&](const KdNode& node) {
            return node.is_leaf()
                       ? KdNode::leaf(named + node.first(), node.count())
                       : KdNode::inner({node.axis(), node.position()}, place + node.below());
        };
        for (std::uint32_t i = 0; i < part.references.size(); ++i)
            name(named + i, part.references[i]);
        for (std::uint32_t i = 2; i < part.nodes.size(); ++i)
            word(place + i).store(moved(part.nodes[i]).bits(), std::memory_order_relaxed);
        return moved(part.nodes[0]);
    }
    // [all_below]

    void count_references(std::size_t more) const {
        if (!references_left_.take(more))
            throw LimitError("lazy k-d tree: more than " + std::to_string(config_.max_references) +
                             " references (max_references)");
    }

    template <class Visit>
    void for_each_cell(std::uint32_t index, const BasicAabb<D>& cell, std::size_t depth,
                       const Visit& visit) const {
        const std::uint64_t bits = word(index).load(std::memory_order_acquire);
        const KdNode now = KdNode::of_bits(bits);
        if (is_waiting(bits)) {
            const std::size_t size = waiting_at(bits)->task.references.size();
            visit(Cell{index, cell, depth, State::waiting, index == 0 ? polygons_.size() : size});
        } else if (now.is_leaf()) {
            visit(Cell{index, cell, depth, State::leaf, now.count()});
        } else {
            visit(Cell{index, cell, depth, State::inner, 0});
            const auto [below, above] = halves(cell, {now.axis(), now.position()});
            for_each_cell(now.below(), below, depth + 1, visit);
            for_each_cell(now.below() + 1, above, depth + 1, visit);
        }
    }

    static BasicAabb<D> box_of(std::span<const Simplex<D>> polygons) {
        BasicAabb<D> all;
        for (const Simplex<D>& polygon : polygons)
            for (int corner = 0; corner < D; ++corner) all.extend(polygon[corner]);
        return all;
    }

    std::span<const Simplex<D>> polygons_;
    Config config_;
    Splitter splitter_;
    mutable Chunks<std::uint64_t> words_;       ///< the nodes, by atomic access alone
    mutable Chunks<std::uint32_t> references_;  ///< polygons, by leaf
    mutable Chunks<Simplex<D>> copies_;         ///< of them, at the same places
    mutable SharedLimit<> references_left_;
    [[no_unique_address]] mutable Observer observer_;
};

template <int D, class Observer>
LazyKdCounts LazyKdNodes<D, Observer>::counts() const {
    LazyKdCounts counts;
    for_each_cell([&](const Cell& cell) {
        counts.depth = std::max(counts.depth, cell.depth);
        if (cell.state == State::inner) ++counts.inner;
        if (cell.state == State::leaf) {
            ++counts.leaves;
            counts.references += cell.references;
        }
        if (cell.state != State::waiting) return;
        ++counts.waiting;
        counts.waiting_references += cell.references;
        const Task& task = waiting_at(word(cell.node).load())->task;
        counts.waiting_bytes += task.references.size() * sizeof task.references[0];
        for (const auto& list : task.events)
            counts.waiting_bytes += list.size() * sizeof(SplitEvent);
    });
    counts.bytes = sizeof *this + (counts.standing() + counts.waiting) * sizeof(KdNode) +
                   counts.references * (sizeof(std::uint32_t) + sizeof(Simplex<D>)) +
                   counts.waiting * sizeof(Waiting) + counts.waiting_bytes;
    return counts;
}

}  // namespace space
