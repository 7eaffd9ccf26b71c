#include "chapters/ch10_fast_traversal/cache_model.hpp"

#include "chapters/ch10_fast_traversal/pointer_chase.hpp"
#include "chapters/ch10_fast_traversal/ray_bound.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <vector>

namespace space {
namespace {

/// The same by its definition: of each set the lines in the order of their last use.
struct PlainCache {
    std::size_t sets, ways;
    std::map<std::uint64_t, std::deque<std::uint64_t>> lines = {};

    bool touch(std::uint64_t line) {
        std::deque<std::uint64_t>& set = lines[line % sets];
        const auto found = std::ranges::find(set, line);
        const bool is_there = found != set.end();
        if (is_there) set.erase(found);
        set.push_front(line);
        if (set.size() > ways) set.pop_back();
        return is_there;
    }
};

TEST_CASE("a cache keeps of each set the lines that were used last") {
    // The first fits one set, the second has a number of sets that is no power of two.
    for (const CacheShape& shape : {CacheShape{64, 1}, CacheShape{256, 4},
                                    CacheShape{64 * 11 * 3, 11}, CacheShape{4096, 2}}) {
        CacheLevel level(shape);
        PlainCache plain{shape.bytes / (64 * shape.ways), shape.ways};
        Pcg32 random(5);
        for (int i = 0; i < 20'000; ++i) {
            const std::uint64_t line = random.below(200);
            REQUIRE(level.touch(line) == plain.touch(line));
        }
    }
}

TEST_CASE("what fits a cache misses once a line, what is a line too large for it always") {
    const std::vector<CacheShape> caches{{1024, 16}, {4096, 64}};  // one set each
    const auto misses = [&](std::uint64_t lines) {
        CacheModel model(caches);
        for (int round = 0; round < 10; ++round)
            for (std::uint64_t line = 0; line < lines; ++line) model.touch(line * 64, 64);
        CHECK(model.lines() == 10 * lines);
        return model.misses();
    };
    CHECK(misses(16) == std::vector<std::uint64_t>{16, 16});
    CHECK(misses(17) == std::vector<std::uint64_t>{170, 17});
    CHECK(misses(64) == std::vector<std::uint64_t>{640, 64});
    CHECK(misses(65) == std::vector<std::uint64_t>{650, 650});
}

TEST_CASE("bytes touch each line that they lie in") {
    CacheModel model(stated_caches());
    model.touch(60, 4);
    CHECK(model.lines() == 1);
    model.touch(60, 5);
    CHECK(model.lines() == 3);
    model.touch(64, 128);
    CHECK(model.lines() == 5);
    CHECK(model.misses().front() == 3);
    model.forget_counts();
    model.touch(0, 192);
    CHECK(model.misses().back() == 0);
}

TEST_CASE("a chase comes to every line before it comes home") {
    for (const std::size_t lines : {1, 2, 3, 64, 1000}) {
        const auto circle = make_chase_circle(lines, 3);
        std::vector<int> seen(lines);
        std::uint32_t at = 0;
        for (std::size_t i = 0; i < lines; ++i) {
            ++seen[at];
            at = chase(circle, 1, at);
        }
        CHECK(at == 0);
        CHECK(std::ranges::count(seen, 1) == static_cast<std::ptrdiff_t>(lines));
        CHECK(chase(circle, lines) == 0);
    }
}

TEST_CASE("a ray's bounds add what waits, and take the longer of what does not") {
    const MachineCosts costs{.node_latency = 4.0,
                             .block_latency = 8.0,
                             .node_throughput = 1.0,
                             .block_throughput = 2.0,
                             .line_latency = {5.0, 20.0, 100.0},
                             .line_throughput = {1.0, 4.0, 10.0}};
    // Of six lines beyond the first cache two are in the second, three in the last, one in memory.
    const RayWork work{.nodes = 10.0, .blocks = 2.0, .misses = {6.0, 4.0, 1.0}};
    CHECK(latency_bound_ns(work, costs, 1.0) == 10 * 4.0 + 2 * 8.0 + 2 * 5.0 + 3 * 20.0 + 100.0);
    CHECK(latency_bound_ns(work, costs, 2.0) == 56.0 + 85.0);
    CHECK(compute_bound_ns(work, costs) == 14.0);
    CHECK(fetch_bound_ns(work, costs) == 2 * 1.0 + 3 * 4.0 + 10.0);
}

}  // namespace
}  // namespace space
