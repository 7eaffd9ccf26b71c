/// @file
/// Exercise 5.2, a near miss: a node that stands gives its block back, even if a child has its list
/// there. Nothing is lost as long as nobody else takes the memory: the fault shows later,
/// elsewhere.
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
        block_of_[node] = block;
        ++users_[block];
    }

    void stands(std::uint32_t node) {
        const auto found = block_of_.find(node);
        const Block block = found->second;
        block_of_.erase(found);
        if (users_.erase(block) > 0) give_back_(block);
    }

  private:
    std::function<void(Block)> give_back_;
    std::map<std::uint32_t, Block> block_of_;  ///< of nodes that wait
    std::map<Block, int> users_;
};

}  // namespace space
