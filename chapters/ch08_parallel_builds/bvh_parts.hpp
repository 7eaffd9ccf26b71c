/// @file
/// A tree in parts, each made by one thread in memory of its own, and the parts joined.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "common/limit_error.hpp"
#include "common/parallel.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space {

inline constexpr unsigned max_build_threads = 1024;  ///< more is a slip of the finger

/// @throws LimitError for more than max_build_threads; 0 is as 1
inline unsigned build_threads(unsigned asked) {
    if (asked > max_build_threads)
        throw LimitError("parallel build: more than " + std::to_string(max_build_threads) +
                         " threads");
    return std::max(asked, 1u);
}

// [bvh_part]
/// What one thread makes in one go: the nodes below a task, but for what is below the cuts whose
/// two sides it has handed out. Numbered as if there were nothing else.
template <int D>
struct BvhPart {
    /// A cut's two nodes are places in this part, filled when all are joined.
    struct HandedOut {
        std::uint32_t pair;
        std::unique_ptr<BvhPart> first, second;
    };

    BvhTask<D> task;
    BvhNodes<D> tree = {};  ///< its references are with the joined tree: their place is given
    std::vector<HandedOut> handed_out = {};  ///< pairs ascending
    std::size_t pairs_below = 0;             ///< in all nodes, counted when all are joined

    /// Parts for both sides of a cut, which are to be made by somebody.
    const HandedOut& hand_out(const BvhTask<D>& first, const BvhTask<D>& second) {
        const auto part_of = [](BvhTask<D> of) {
            of.node = 0;
            return std::make_unique<BvhPart>(BvhPart{of});
        };
        handed_out.push_back({first.node, part_of(first), part_of(second)});
        return handed_out.back();
    }
};
// [bvh_part]

/// Event: a thread begins with a part.
template <int D>
struct BvhPartBegun {
    const BvhTask<D>& task;
};
/// Event: the part is made, without what was handed out.
template <int D>
struct BvhPartEnded {
    const BvhTask<D>& task;
};

/// Makes a part. gives(first, second) says at each cut whether its sides are handed out; then
/// given(first part, second part) is told what somebody is to make.
template <int D, class Choose, class Gives, class Given, class Observer>
void make_part(BvhPart<D>& part, const BvhLimits& limits, Choose& choose, const Gives& gives,
               const Given& given, Observer& observer, std::span<std::uint32_t> references) {
    observer.observe(BvhPartBegun<D>{part.task});
    const auto hand_out = [&](const BvhTask<D>& first, const BvhTask<D>& second) {
        if (!gives(first, second)) return false;
        const auto& parts = part.hand_out(first, second);
        given(*parts.first, *parts.second);
        return true;
    };
    build_below<D>(part.task, limits, choose, hand_out, observer, part.tree, references);
    observer.observe(BvhPartEnded<D>{part.task});
}

// [join]
/// Lays parts into one array, in the order in which one thread would have made their nodes: a pair,
/// all that is below its first node, all that is below its second.
template <int D>
class BvhJoin {
  public:
    /// The tree's nodes and depth; the copying is done by so many threads.
    static void join(BvhPart<D>& root, unsigned threads, BvhNodes<D>& tree) {
        if (root.handed_out.empty()) {
            tree.nodes = std::move(root.tree.nodes);
            tree.nodes.shrink_to_fit();
            tree.depth = root.tree.depth;
            return;
        }
        BvhJoin join(tree);
        count(root);
        tree.nodes.reserve(2 + 2 * root.pairs_below);
        touch(std::as_writable_bytes(std::span(tree.nodes.data(), tree.nodes.capacity())), threads);
        tree.nodes.resize(2 + 2 * root.pairs_below);
        join.place(root, 0, 2);
        parallel_for(join.placed_.size(), threads, 1,
                     [&](std::size_t i) { join.copy(join.placed_[i]); });
    }

  private:
    /// A part, and where its root and its first pair come to lie.
    struct Placed {
        BvhPart<D>* part;
        std::uint32_t root, first_pair;
    };

    /// The system finds memory for a page when it is first written, which takes longer than to
    /// write it: so each thread writes a byte to each page of its own. (Then one may fill them
    /// all.)
    static void touch(std::span<std::byte> memory, unsigned threads) {
        constexpr std::size_t page = 4096, pages = 512;
        const std::size_t chunk = pages * page;
        parallel_for((memory.size() + chunk - 1) / chunk, threads, 1, [&](std::size_t i) {
            const std::size_t end = std::min((i + 1) * chunk, memory.size());
            for (std::size_t at = i * chunk; at < end; at += page) memory[at] = std::byte{0};
        });
    }

    explicit BvhJoin(BvhNodes<D>& tree) : tree_(tree) {}

    static std::size_t count(BvhPart<D>& part) {
        part.pairs_below = part.tree.nodes.size() / 2 - 1;
        for (auto& [pair, first, second] : part.handed_out)
            part.pairs_below += count(*first) + count(*second);
        return part.pairs_below;
    }

    void place(BvhPart<D>& part, std::uint32_t root, std::uint32_t first_pair) {
        placed_.push_back({&part, root, first_pair});
        tree_.depth = std::max(tree_.depth, part.tree.depth);
        std::uint32_t shift = first_pair - 2;
        for (const auto& [pair, first, second] : part.handed_out) {
            const std::uint32_t after = pair + shift + 2;
            const auto below_first = static_cast<std::uint32_t>(2 * first->pairs_below);
            const auto below_second = static_cast<std::uint32_t>(2 * second->pairs_below);
            place(*first, pair + shift, after);
            place(*second, pair + shift + 1, after + below_first);
            shift += below_first + below_second;
        }
    }

    /// All of the part's nodes but those whose place is another part's.
    void copy(const Placed& placed) {
        const auto& nodes = placed.part->tree.nodes;
        const auto& given = placed.part->handed_out;
        // What is below handed-out pairs lies before the pairs that come after them.
        std::vector<std::uint32_t> shifts{placed.first_pair - 2};
        for (const auto& [pair, first, second] : given)
            shifts.push_back(shifts.back() + static_cast<std::uint32_t>(
                                                 2 * (first->pairs_below + second->pairs_below)));
        const auto moved = [&](BvhNode<D> node) {
            if (node.is_leaf()) return node;
            const auto before = std::ranges::lower_bound(given, node.first, {}, &Given::pair);
            node.first += shifts[std::size_t(before - given.begin())];
            return node;
        };
        tree_.nodes[placed.root] = moved(nodes[0]);
        std::uint32_t next = 2;
        for (std::size_t i = 0; i <= given.size(); ++i) {
            const auto end = i < given.size() ? given[i].pair : std::uint32_t(nodes.size());
            for (; next < end; ++next) tree_.nodes[next + shifts[i]] = moved(nodes[next]);
            next = end + 2;
        }
        placed.part->tree = {};  // memory is given back by several threads, too
    }

    using Given = typename BvhPart<D>::HandedOut;

    BvhNodes<D>& tree_;
    std::vector<Placed> placed_;
};
// [join]

/// The tree of all references, which make(root, references) makes in parts.
template <int D, class Make>
BvhNodes<D> build_in_parts(std::span<BvhReference<D>> all, const BasicAabb<D>& box,
                           unsigned threads, const Make& make) {
    BvhNodes<D> tree;
    if (all.empty()) return tree;
    tree.references.resize(all.size());
    BvhPart<D> root{{0, 0, box, 0, all}};
    make(root, std::span(tree.references));
    BvhJoin<D>::join(root, threads, tree);
    return tree;
}

}  // namespace space
