// Locks: no two threads at once, no update lost, whatever threads do between; and what no lock
// costs.
#include "chapters/ch08_parallel_builds/locks.hpp"

#include "tests/catch.hpp"
#include "tests/ch05/watchdog.hpp"

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

namespace space {
namespace {

/// Calls body(lock, name) with one of each kind.
template <class Body>
void for_each_lock(const Body& body) {
    const auto with = [&]<Lock L>(std::string name, std::type_identity<L>) {
        L lock;
        CAPTURE(name);
        body(lock, name);
    };
    with("mutex", std::type_identity<std::mutex>{});
    with("spinlock", std::type_identity<Spinlock<NoPause>>{});
    with("spinlock with pause", std::type_identity<Spinlock<CpuPause>>{});
    with("spinlock that yields", std::type_identity<Spinlock<PauseThenYield>>{});
    with("semaphore", std::type_identity<SemaphoreLock>{});
    with("monitor", std::type_identity<MonitorLock>{});
}

template <class Body>
void on_threads(unsigned count, const Body& body) {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < count; ++i) threads.emplace_back(body, i);
}

}  // namespace

TEST_CASE("without a lock every update is lost into which another one comes") {
    std::atomic<std::uint64_t> counter{0};
    NoLock none;
    for (int round = 0; round < 50; ++round)
        add_one(counter, none, [&] { std::thread([&] { add_one(counter, none, [] {}); }).join(); });
    CHECK(counter == 50);  // of 100
}

TEST_CASE("with a lock none is, however long the one inside is delayed") {
    const Watchdog watchdog(120);
    for_each_lock([](auto& lock, const std::string&) {
        std::atomic<std::uint64_t> counter{0};
        for (int round = 0; round < 8; ++round) {
            std::thread other;
            std::atomic<bool> tries{false};
            add_one(counter, lock, [&] {
                other = std::thread([&] {
                    tries = true;
                    add_one(counter, lock, [] {});
                });
                while (!tries) std::this_thread::yield();
                for (int i = 0; i < 10; ++i) std::this_thread::yield();
            });
            other.join();
        }
        CHECK(counter == 16);
    });
}

TEST_CASE(
    "from 1 to 16 threads are inside one at a time, and see what the one before has written") {
    const Watchdog watchdog(300);
    for_each_lock([](auto& lock, const std::string&) {
        for (const unsigned threads : {1u, 2u, 3u, 8u, 16u}) {
            const int rounds = sized(200, 100);
            // Plain on purpose: ThreadSanitizer sees whether the lock orders them.
            std::uint64_t counter = 0, inside = 0, met = 0;
            on_threads(threads, [&](unsigned) {
                for (int i = 0; i < rounds; ++i) {
                    const std::lock_guard guard(lock);
                    met += ++inside != 1;
                    ++counter;
                    if (i % 64 == 0) std::this_thread::yield();  // the holder is pre-empted
                    --inside;
                }
            });
            CAPTURE(threads);
            CHECK(counter == std::uint64_t(threads) * std::uint64_t(rounds));
            CHECK(met == 0);
        }
    });
}

namespace {

/// Counts the looks of one that spins; the holder lets go when there have been enough.
struct CountedLooks {
    static inline std::atomic<int> looks{0};
    void operator()() {
        ++looks;
        std::this_thread::yield();
    }
};

}  // namespace

TEST_CASE("while its holder is away, who waits for a spinlock looks on and on") {
    const Watchdog watchdog(60);
    Spinlock<CountedLooks> lock;
    lock.lock();
    std::jthread waiting([&] {
        lock.lock();
        lock.unlock();
    });
    while (CountedLooks::looks < 500) std::this_thread::yield();
    lock.unlock();
    waiting.join();
    CHECK(CountedLooks::looks >= 500);
}

TEST_CASE("the patience of one that yields lasts for 64 pauses, of each call of lock() anew") {
    PauseThenYield wait;
    for (int i = 0; i < 100; ++i) wait();
    CHECK(wait.left == 0);
    CHECK(PauseThenYield{}.left == 64);
}

TEST_CASE("what is no lock is none by the concept") {
    STATIC_REQUIRE(Lock<std::mutex>);
    STATIC_REQUIRE(Lock<Spinlock<>>);
    STATIC_REQUIRE(Lock<SemaphoreLock>);
    STATIC_REQUIRE(Lock<MonitorLock>);
    STATIC_REQUIRE(Lock<NoLock>);
    STATIC_REQUIRE(!Lock<int>);
    STATIC_REQUIRE(!Lock<std::condition_variable>);
}

}  // namespace space
