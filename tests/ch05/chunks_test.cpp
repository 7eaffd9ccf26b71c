// The array that grows while others read it.
#include "chapters/ch05_lazy_kd_trees/chunks.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <atomic>
#include <new>
#include <set>
#include <thread>
#include <vector>

namespace space {

constexpr std::uint32_t many = 1u << 29;

TEST_CASE("chunks: what is added lies side by side, never overlaps, and never moves") {
    Chunks<std::uint32_t> chunks(100);
    Pcg32 random(1);
    struct Run {
        std::uint32_t first, count;
        const std::uint32_t* at;
    };
    std::vector<Run> runs;
    std::set<std::uint32_t> used;
    for (std::uint32_t i = 0; i < 500; ++i) {
        const std::uint32_t count = i == 250 ? 5'000 : random.below(40);
        const std::uint32_t first = chunks.add(count, many);
        if (count == 0) continue;
        runs.push_back({first, count, &chunks[first]});
        for (std::uint32_t k = 0; k < count; ++k) {
            REQUIRE(&chunks[first + k] == &chunks[first] + k);
            REQUIRE(used.insert(first + k).second);
            chunks[first + k] = i;
        }
    }
    for (const Run& run : runs) {
        REQUIRE(&chunks[run.first] == run.at);
        for (std::uint32_t k = 1; k < run.count; ++k) REQUIRE(run.at[k] == run.at[0]);
    }
}

TEST_CASE("chunks: pairs begin at even places, and the first is 0") {
    Chunks<std::uint64_t> chunks(64);
    for (std::uint32_t i = 0; i < 1'000; ++i) REQUIRE(chunks.add(2, many) == 2 * i);
}

TEST_CASE("chunks: no more than allowed") {
    Chunks<char> chunks(10);
    CHECK(chunks.add(60, 100) == 0);
    CHECK_THROWS_AS(chunks.add(41, 100), std::bad_alloc);  // would begin at 64, in the next chunk
    CHECK(chunks.add(36, 100) == 64);
    CHECK_THROWS_AS(chunks.add(1, 100), std::bad_alloc);
    CHECK(chunks.add(0, 100) == 100);
}

TEST_CASE("chunks: threads that add at the same time get places of their own") {
    Chunks<std::uint32_t> chunks(100);
    constexpr unsigned threads = 4;
    std::vector<std::vector<std::uint32_t>> places(threads);
    {
        std::vector<std::jthread> all;
        for (unsigned thread = 0; thread < threads; ++thread)
            all.emplace_back([&, thread] {
                for (int i = 0; i < 2'000; ++i) {
                    places[thread].push_back(chunks.add(3, many));
                    for (std::uint32_t k = 0; k < 3; ++k)
                        chunks[places[thread].back() + k] = thread;
                }
            });
    }
    for (unsigned thread = 0; thread < threads; ++thread)
        for (const std::uint32_t place : places[thread])
            for (std::uint32_t k = 0; k < 3; ++k) REQUIRE(chunks[place + k] == thread);
}

}  // namespace space
