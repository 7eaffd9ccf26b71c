#include "ex02_whose_memory_may_go.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <fmt/format.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace space;

namespace {

/// A keeper, and what it has given back.
struct Watched {
    std::vector<Block> given = {};
    ListKeeper keeper{[this](Block block) { given.push_back(block); }};

    /// What is given back while the node comes to stand.
    std::vector<Block> stands(std::uint32_t node) {
        given.clear();
        keeper.stands(node);
        return given;
    }
    void waits(std::uint32_t node, Block block) {
        given.clear();
        keeper.waits(node, block);
        if (!given.empty()) FAIL("a block is given back when a node begins to wait");
    }
};
using Blocks = std::vector<Block>;

}  // namespace

TEST_CASE("a leaf's block goes when the leaf stands") {
    Watched lists;
    lists.waits(0, 7);
    CHECK(lists.stands(0) == Blocks{7});
}

TEST_CASE("an inner node's block goes when it stands, while its children wait") {
    Watched lists;
    lists.waits(0, 7);
    lists.waits(1, 8);
    lists.waits(2, 9);
    CHECK(lists.stands(0) == Blocks{7});
}

TEST_CASE("each child's block goes with that child, whatever its sibling does") {
    Watched lists;
    lists.waits(0, 0);
    lists.waits(1, 1);
    lists.waits(2, 2);
    CHECK(lists.stands(0) == Blocks{0});
    CHECK(lists.stands(2) == Blocks{2});
    CHECK(lists.stands(1) == Blocks{1});
}

TEST_CASE("a block stays while a child has its list there") {
    Watched lists;
    lists.waits(0, 5);
    lists.waits(1, 5);
    lists.waits(2, 6);
    CHECK(lists.stands(0) == Blocks{});
    CHECK(lists.stands(2) == Blocks{6});
    CHECK(lists.stands(1) == Blocks{5});
}

TEST_CASE("a block that is handed down several times goes with its last user") {
    Watched lists;
    lists.waits(0, 5);
    lists.waits(1, 5);
    lists.waits(2, 6);
    CHECK(lists.stands(0) == Blocks{});
    lists.waits(3, 5);
    lists.waits(4, 7);
    CHECK(lists.stands(1) == Blocks{});
    CHECK(lists.stands(3) == Blocks{5});
    CHECK(lists.stands(4) == Blocks{7});
}

TEST_CASE("where both children's lists are in one block, it goes with the second of them") {
    for (const bool below_first : {true, false}) {
        Watched lists;
        lists.waits(0, 5);
        lists.waits(1, 6);
        lists.waits(2, 6);
        CHECK(lists.stands(0) == Blocks{5});
        CHECK(lists.stands(below_first ? 1 : 2) == Blocks{});
        CHECK(lists.stands(below_first ? 2 : 1) == Blocks{6});
    }
}

TEST_CASE("the number of a block that went may come again") {
    Watched lists;
    lists.waits(0, 5);
    lists.waits(1, 6);
    lists.waits(2, 7);
    CHECK(lists.stands(0) == Blocks{5});
    lists.waits(3, 5);
    lists.waits(4, 8);
    CHECK(lists.stands(1) == Blocks{6});
    CHECK(lists.stands(3) == Blocks{5});
}

TEST_CASE("two keepers know nothing of each other") {
    Watched one, other;
    one.waits(0, 5);
    other.waits(0, 5);
    other.waits(1, 5);
    CHECK(one.stands(0) == Blocks{5});
    CHECK(other.stands(0) == Blocks{});
    CHECK(other.stands(1) == Blocks{5});
}

TEST_CASE("random trees: every block goes at the first moment at which nobody needs it") {
    Pcg32 random(52);
    std::size_t handed_down = 0;
    for (int tree = 0; tree < 2'000; ++tree) {
        Watched lists;
        std::vector<std::pair<std::uint32_t, Block>> waiting{{0, 0}};
        std::set<Block> unused;
        Block next_block = 1;
        std::uint32_t next_node = 1;
        const auto new_block = [&] {
            if (unused.empty() || random.below(2) == 0) return next_block++;
            const Block block = *unused.begin();
            unused.erase(unused.begin());
            return block;
        };
        const auto add = [&](Block block) {
            lists.waits(next_node, block);
            waiting.push_back({next_node++, block});
        };
        lists.waits(0, 0);
        std::string told = "0 waits in 0; ";
        while (!waiting.empty()) {
            const std::size_t i = random.below(std::uint32_t(waiting.size()));
            const auto [node, block] = waiting[i];
            if (next_node < 40 && random.below(3) > 0) {
                const std::uint32_t way = random.below(4);
                const Block first = way == 0 ? block : new_block();
                const Block second = way == 1 ? block : way == 2 ? first : new_block();
                add(first), add(second);
                handed_down += way < 2;
                told += fmt::format("{} waits in {}; {} waits in {}; ", next_node - 2, first,
                                    next_node - 1, second);
            }
            waiting.erase(waiting.begin() + std::ptrdiff_t(i));
            bool needed = false;
            for (const auto& [other, where] : waiting) needed = needed || where == block;
            told += fmt::format("{} stands; ", node);
            CAPTURE(told);
            REQUIRE(lists.stands(node) == (needed ? Blocks{} : Blocks{block}));
            if (!needed) unused.insert(block);
        }
    }
    CHECK(handed_down > 5'000);
}
