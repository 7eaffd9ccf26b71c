#include "common/parallel.hpp"

#include "tests/catch.hpp"

#include <set>
#include <stdexcept>

namespace space {

TEST_CASE("every index is visited exactly once, for any number of threads and any chunk") {
    for (const std::size_t count : {0u, 1u, 2u, 7u, 64u, 1000u})
        for (const unsigned threads : {0u, 1u, 2u, 3u, 8u, 64u})
            for (const std::size_t chunk : {1u, 3u, 64u, 5000u}) {
                std::vector<std::atomic<int>> visits(count);
                parallel_for(count, threads, chunk, [&](std::size_t i) { ++visits[i]; });
                INFO(count << " indices, " << threads << " threads, chunks of " << chunk);
                CHECK(std::all_of(visits.begin(), visits.end(),
                                  [](const auto& visit) { return visit == 1; }));
            }
}

TEST_CASE("results that each index writes for itself need no lock") {
    std::vector<std::size_t> squares(10'000);
    parallel_for(squares.size(), 4, 16, [&](std::size_t i) { squares[i] = i * i; });
    for (std::size_t i = 0; i < squares.size(); ++i) REQUIRE(squares[i] == i * i);
}

TEST_CASE("no more threads are used than asked for; with one, the caller does the work in order") {
    std::mutex lock;
    std::set<std::thread::id> ids;
    parallel_for(1000, 3, 1, [&](std::size_t) {
        const std::lock_guard guard(lock);
        ids.insert(std::this_thread::get_id());
    });
    CHECK(ids.size() >= 1);
    CHECK(ids.size() <= 3);

    std::vector<std::size_t> order;
    parallel_for(100, 1, 7, [&](std::size_t i) {
        CHECK(std::this_thread::get_id() != std::thread::id());
        order.push_back(i);
    });
    CHECK(std::is_sorted(order.begin(), order.end()));
    CHECK(order.size() == 100);
}

TEST_CASE(
    "an exception comes through after all threads have ended, and stops the rest of the work") {
    for (const unsigned threads : {1u, 2u, 8u}) {
        std::atomic<std::size_t> visits{0};
        std::atomic<int> running{0};
        const auto work = [&](std::size_t i) {
            ++running;
            ++visits;
            if (i == 10) {
                --running;
                throw std::runtime_error("ten");
            }
            --running;
        };
        CHECK_THROWS_WITH(parallel_for(1'000'000, threads, 1, work), "ten");
        CHECK(running == 0);
        CHECK(visits < 1'000'000);
    }
}

TEST_CASE("of several exceptions one comes through") {
    CHECK_THROWS_AS(parallel_for(100, 8, 1, [](std::size_t) { throw std::out_of_range("each"); }),
                    std::out_of_range);
}

}  // namespace space
