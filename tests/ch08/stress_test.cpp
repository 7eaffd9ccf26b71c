// Many builds whose threads are delayed at random: the same tree each time.
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/ch05/watchdog.hpp"
#include "tests/ch08/parallel_builders.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace space {
namespace {

/// Once in a while a thread loses its core, or sleeps. By the task and the seed, not by the thread,
/// so that a seed says where.
Watcher delays(std::uint64_t seed) {
    const auto delay = [seed](const BvhTask<3>& task) {
        Pcg32 random(seed ^ (std::uint64_t{task.begin} << 32 | task.range.size() << 8));
        const std::uint32_t draw = random.below(64);
        if (draw < 4) std::this_thread::yield();
        if (draw == 4) std::this_thread::sleep_for(std::chrono::microseconds(20));
    };
    Watcher watcher;
    watcher.chosen = [delay](const BvhChosen<3>& event) { delay(event.task); };
    watcher.taken = [delay](const BvhTaken<3>& event) { delay(event.task); };
    return watcher;
}

/// So many builds by each method, on 1 to 16 threads.
void check_delayed(std::uint64_t builds) {
    const std::vector<Triangle> triangles = scenes::soup(60, 0.1f, 1);
    const BvhNodes<3> expected = BinnedBuilder::build<3>(triangles);
    for (const ParallelBuilder& builder : parallel_builders()) {
        const Watchdog watchdog(300);
        std::string fault;
        std::uint64_t i = 0;
        for (; i < builds && fault.empty(); ++i) {
            Watcher watcher = delays(i);
            const auto threads = static_cast<unsigned>(1 + i % 16);
            fault = difference(builder.build(triangles, {}, threads, watcher), expected);
        }
        INFO(builder.name << ", build " << i << ": " << fault);
        CHECK(fault.empty());
    }
}

}  // namespace

TEST_CASE(
    "who counts unfinished tasks never quits before all are done, however threads are delayed") {
    const std::vector<Triangle> triangles = scenes::soup(60, 0.1f, 2);
    for (const ParallelBuilder& builder : parallel_builders()) {
        if (!builder.name.starts_with("queue (")) continue;
        const Watchdog watchdog(300);  // anew for each: a machine with other work is slow, too
        std::atomic<int> too_early{0};
        for (std::uint64_t i = 0; i < sized(100u, 20u); ++i) {
            std::atomic<std::size_t> missing{triangles.size()};
            Watcher watcher = delays(i);
            watcher.chosen = [&, delay = watcher.chosen](const BvhChosen<3>& event) {
                delay(event);
                if (!event.cut) missing -= event.task.range.size();
            };
            watcher.quits = [&](unsigned) { too_early += missing > 0; };
            builder.build(triangles, {}, static_cast<unsigned>(2 + i % 7), watcher);
        }
        CHECK(too_early == 0);
    }
}

TEST_CASE(
    "hundreds of builds by each method, on 1 to 16 threads that are delayed at random, end, and "
    "with one tree") {
    check_delayed(sized(200, 32));
}
TEST_CASE("a thousand builds by each method", "[.big]") {
    check_delayed(1'000);
}

}  // namespace space
