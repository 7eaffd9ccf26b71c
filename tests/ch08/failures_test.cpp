// Builds that fail: they end, nothing is lost, and the caller learns why.
#include "tests/catch.hpp"
#include "tests/ch05/watchdog.hpp"
#include "tests/ch08/parallel_builders.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <pthread.h>

#include <atomic>
#include <cstddef>
#include <new>
#include <string>
#include <system_error>
#include <vector>

namespace space {
namespace test {
// allocations.cpp
extern std::atomic<std::ptrdiff_t> living_allocations;
extern std::atomic<std::ptrdiff_t> allocations_left;
}  // namespace test

namespace {

struct Cancelled {};

/// Throws at the n-th node that is made, counted from 0, whoever makes it.
Watcher cancels_at(std::size_t n, std::atomic<std::size_t>& made) {
    Watcher watcher;
    watcher.chosen = [n, &made](const BvhChosen<3>&) {
        if (made++ == n) throw Cancelled();
    };
    return watcher;
}

/// While it lives, no thread can start: the stack that each would get is larger than the memory
/// that a process can address.
class HugeStacks {
  public:
    HugeStacks() {
        pthread_getattr_default_np(&usual_);
        pthread_attr_t huge;
        pthread_getattr_default_np(&huge);
        pthread_attr_setstacksize(&huge, std::size_t{1} << 50);
        pthread_setattr_default_np(&huge);
        pthread_attr_destroy(&huge);
    }
    ~HugeStacks() {
        pthread_setattr_default_np(&usual_);
        pthread_attr_destroy(&usual_);
    }
    HugeStacks(const HugeStacks&) = delete;
    HugeStacks& operator=(const HugeStacks&) = delete;

  private:
    pthread_attr_t usual_;
};

}  // namespace

TEST_CASE("what an observer throws in any thread, at any node, ends the build and is thrown on") {
    const Watchdog watchdog(sized(120, 600));
    const std::vector<Triangle> triangles = scenes::soup(sized(200u, 60u), 0.1f, 1);
    const BvhNodes<3> expected = BinnedBuilder::build<3>(triangles);
    for (const ParallelBuilder& builder : parallel_builders())
        for (const unsigned threads : {1u, 2u, 4u, 16u})
            for (std::size_t n = 0; n < expected.size(); n += sized(17, 20)) {
                std::atomic<std::size_t> made{0};
                Watcher watcher = cancels_at(n, made), none;
                INFO(builder.name << ", " << threads << " threads, at node " << n);
                REQUIRE_THROWS_AS(builder.build(triangles, {}, threads, watcher), Cancelled);
                if (n == 0)
                    CHECK(difference(builder.build(triangles, {}, threads, none), expected) == "");
            }
}

TEST_CASE("exceptions in all threads at once end the build with one of them") {
    const Watchdog watchdog(sized(60, 300));
    const std::vector<Triangle> triangles = scenes::soup(200, 0.1f, 2);
    for (const ParallelBuilder& builder : parallel_builders())
        for (int i = 0; i < sized(50, 5); ++i) {
            Watcher watcher;
            watcher.chosen = [](const BvhChosen<3>& event) {
                if (event.task.depth > 1) throw Cancelled();
            };
            CHECK_THROWS_AS(builder.build(triangles, {}, 8, watcher), Cancelled);
        }
}

TEST_CASE("out of memory at any allocation ends the build, and nothing is leaked") {
    const Watchdog watchdog(sized(120, 600));
    const std::vector<Triangle> triangles = scenes::soup(sized(80u, 40u), 0.1f, 3);
    const BvhNodes<3> expected = BinnedBuilder::build<3>(triangles);
    const BinnedBuilder::Config config;
    for (const ParallelBuilder& builder : parallel_builders())
        for (const unsigned threads : {1u, 3u}) {
            Watcher none;
            builder.build(triangles, config, threads, none);  // what TBB keeps, it has now
            const std::ptrdiff_t before = test::living_allocations;
            std::size_t failures = 0, leaks = 0;
            std::string fault = "never built";
            // Threads allocate in no fixed order: every third time does for them.
            for (bool is_built = false; !is_built; failures += threads == 1 ? 1 : 3) {
                try {
                    test::allocations_left = static_cast<std::ptrdiff_t>(failures);
                    const BvhNodes<3> tree = builder.build(triangles, config, threads, none);
                    test::allocations_left = -1;
                    is_built = true;
                    fault = difference(tree, expected);
                } catch (const std::bad_alloc&) {
                    test::allocations_left = -1;
                }
                leaks += test::living_allocations != before;
            }
            INFO(builder.name << ", " << threads << " threads: " << fault);
            CHECK(fault.empty());
            CHECK(failures > 5);
            CHECK(leaks == 0);
        }
}

TEST_CASE("where the system starts no more threads, builds end, say so, and leak nothing") {
    if (is_sanitized) return;  // its threads have stacks by its own rules
    const Watchdog watchdog(60);
    const std::vector<Triangle> triangles = scenes::soup(80, 0.1f, 4);
    Watcher none;
    for (const ParallelBuilder& builder : parallel_builders()) {
        if (builder.name.starts_with("work stealing")) continue;  // TBB's threads ask for less
        builder.build(triangles, {}, 3, none);
        const std::ptrdiff_t before = test::living_allocations;
        {
            const HugeStacks huge;
            INFO(builder.name);
            CHECK_THROWS_AS(builder.build(triangles, {}, 3, none), std::system_error);
            CHECK_NOTHROW(builder.build(triangles, {}, 1, none));
        }
        CHECK(test::living_allocations == before);
    }
}

}  // namespace space
