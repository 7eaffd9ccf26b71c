/// @file
/// A lazy tree beside the eager one that it becomes.
#pragma once

#include "chapters/ch04_kd_trees/kd_nodes.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace space {

/// Node by node from the root on: the same cells, planes and leaves' lists in the same order. Where
/// a node of the lazy tree waits, the eager one has more.
template <int D, class Observer>
class SameTree {
  public:
    SameTree(const KdNodes<D>& eager, const LazyKdNodes<D, Observer>& lazy)
        : eager_(eager), lazy_(lazy) {
        if (eager.box != lazy.box || eager.empty() != lazy.empty()) fault_ = "another root";
        lazy.for_each_cell([&](const auto& cell) { cells_.push_back(cell); });
        if (!eager.empty()) compare(0);
        if (fault_.empty() && next_ != cells_.size()) fault_ = "more nodes";
    }

    /// The first difference; empty where there is none.
    const std::string& fault() const { return fault_; }
    /// Of the eager tree: what stands in the lazy one.
    const std::vector<std::uint32_t>& standing() const { return standing_; }
    std::size_t waiting() const { return waiting_; }

  private:
    using State = typename LazyKdNodes<D, Observer>::State;

    void compare(std::uint32_t eager_node) {
        if (!fault_.empty()) return;
        const auto cell = cells_[next_++];
        if (cell.state == State::waiting) {
            ++waiting_;
            return;
        }
        standing_.push_back(eager_node);
        const KdNode is = lazy_.node(cell.node), expected = eager_.node(eager_node);
        if (is.is_leaf() != expected.is_leaf()) {
            fault_ = fmt::format("node {}: only one is a leaf", eager_node);
        } else if (is.is_leaf()) {
            if (!std::ranges::equal(lazy_.own(cell.node), eager_.own(eager_node)))
                fault_ = fmt::format("leaf {}: another list", eager_node);
        } else if (is.axis() != expected.axis() ||
                   std::bit_cast<std::uint32_t>(is.position()) !=
                       std::bit_cast<std::uint32_t>(expected.position())) {
            fault_ = fmt::format("node {}: another plane", eager_node);
        } else {
            compare(expected.below());
            compare(expected.below() + 1);
        }
    }

    const KdNodes<D>& eager_;
    const LazyKdNodes<D, Observer>& lazy_;
    std::vector<typename LazyKdNodes<D, Observer>::Cell> cells_;
    std::size_t next_ = 0, waiting_ = 0;
    std::vector<std::uint32_t> standing_;
    std::string fault_;
};

}  // namespace space
