/// @file
/// Exercise 5.2: Whose memory may go
/// Difficulty 2 of 3, about 25 minutes.
///
/// A node that waits has a list of what lies in its cell, somewhere in a block of memory. When it
/// is made, its children get theirs, in new blocks, or, where a plane cuts off empty space, the
/// child that has everything keeps the list where it is: in the parent's block. Sometimes both
/// children have their lists in one block, its two ends.
///
/// You are told `waits(node, block)` when a node begins to wait, for children before their parent
/// is made, and `stands(node)` when a node is made, inner node or leaf, which it is once. Call
/// `give_back(block)` as soon as nobody needs the block any more: not later, and once. After that
/// the number of the block may come again, for another one. The check sees every call.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace space {

/// A piece of memory that holds the list of one or more nodes that wait.
using Block = std::uint32_t;

class ListKeeper {
  public:
    explicit ListKeeper(std::function<void(Block)> give_back) : give_back_(std::move(give_back)) {}

    void waits(std::uint32_t node, Block block) {
        nodes_.insert(node);
        blocks_.insert(block);
    }

    void stands(std::uint32_t node) {
        // TODO: this keeps everything until nothing waits any more
        nodes_.erase(node);
        if (!nodes_.empty()) return;
        for (const Block block : blocks_) give_back_(block);
        blocks_.clear();
    }

  private:
    std::function<void(Block)> give_back_;
    std::set<std::uint32_t> nodes_;
    std::set<Block> blocks_;
};

}  // namespace space
