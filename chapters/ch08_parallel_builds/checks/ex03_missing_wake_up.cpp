#include "ex03_missing_wake_up.hpp"

#include "tests/ch08/played_threads.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace space;

namespace {

using PlayedQueue = NodeQueue<PlayedMutex, PlayedCondition>;

/// Task n has the children 2 n + 1 and 2 n + 2, as far as there are so many.
struct TaskTree {
    int tasks;
    bool is_left_early = false;  ///< pop() has returned nothing too soon
    std::vector<int> done = std::vector<int>(std::size_t(tasks), 0);

    void work(PlayedQueue& queue) {
        while (const std::optional<int> task = queue.pop()) {
            for (const int child : {2 * *task + 1, 2 * *task + 2})
                if (child < tasks) queue.push(child);
            ++done[std::size_t(*task)];
            queue.finish();
        }
        is_left_early |= !is_done();
    }
    bool is_done() const { return std::count(done.begin(), done.end(), 1) == tasks; }
};

/// So many threads that do a tree, in any order.
std::string fault_with(std::size_t threads, int tasks, int disturbances, std::size_t most_orders) {
    return fault_in_any_order(most_orders, disturbances, [&](Play& play) {
        PlayedQueue queue;
        TaskTree tree{.tasks = tasks};
        queue.push(0);
        const std::vector<std::function<void()>> bodies(threads, [&] { tree.work(queue); });
        const std::string fault = play.run(bodies);
        if (!fault.empty()) return fault;
        if (tree.is_left_early)
            return std::string("pop() returns nothing while tasks are unfinished");
        return std::string(tree.is_done() ? "" : "a task is done twice, or not at all");
    });
}

bool is_played_well = false;  ///< else real threads might hang

}  // namespace

TEST_CASE("a thread alone gets the oldest task first, and at the end nothing") {
    std::vector<std::optional<int>> popped;
    const std::string fault = fault_in_any_order(1, 0, [&](Play& play) {
        PlayedQueue queue;
        return play.run({[&] {
            popped.push_back(queue.pop());
            queue.push(7), queue.push(8);
            for (int i = 0; i < 2; ++i) popped.push_back(queue.pop()), queue.finish();
            popped.push_back(queue.pop());
            queue.push(9);  // the end is no end for ever
            popped.push_back(queue.pop());
            queue.finish();
            popped.push_back(queue.pop());
        }});
    });
    CHECK(fault == "");
    const std::vector<std::optional<int>> expected{{}, 7, 8, {}, 9, {}};
    const bool are_right = popped == expected;
    CHECK(are_right);
}

TEST_CASE("each of the three functions locks the mutex, and leaves it unlocked") {
    PlayedQueue queue;
    const auto locked = [](const auto& call) {
        const std::size_t before = PlayedMutex::times_locked();
        call();
        return PlayedMutex::times_locked() > before;
    };
    // Outside of a play: a mutex that is locked already would say so in the next one.
    CHECK(locked([&] { queue.push(1); }));
    CHECK(locked([&] { queue.pop(); }));
    CHECK(locked([&] { queue.finish(); }));
    CHECK(locked([&] { queue.pop(); }));  // also where nothing is left
    const std::string fault =
        fault_in_any_order(1, 0, [&](Play& play) { return play.run({[&] { queue.pop(); }}); });
    CHECK(fault == "");
}

TEST_CASE("who waits is woken when a task comes") {
    CHECK(fault_with(2, 2, 1, 1'000) == "");
}

TEST_CASE("when the last task is finished, all who wait go home") {
    CHECK(fault_with(4, 1, 1, 1'000) == "");
}

TEST_CASE("two tasks wake two: each that has one works until the other is at work, too") {
    const std::string fault = fault_in_any_order(2'000, 1, [](Play& play) {
        PlayedQueue queue;
        int at_work = 0;
        queue.push(0);
        const auto work = [&] {
            const std::optional<int> task = queue.pop();
            if (!task) return;
            if (*task == 0) queue.push(1), queue.push(2);
            ++at_work;
            play.point([&] { return at_work == 3; });
            queue.finish();
        };
        return play.run({work, work, work});
    });
    CHECK(fault == "");
}

TEST_CASE("while another works one sleeps, and does not ask again and again") {
    const std::string fault = fault_in_any_order(500, 1, [](Play& play) {
        PlayedQueue queue;
        queue.push(0);
        const auto work = [&] {
            if (!queue.pop()) return;
            play.rest();  // until the other sleeps
            queue.finish();
        };
        return play.run({work, work});
    });
    CHECK(fault == "");
}

TEST_CASE("in all orders of two and three threads, with vain wakings, each task is done once") {
    const std::string by_two = fault_with(2, 3, 3, sized<std::size_t>(3'000, 300)),
                      by_three = fault_with(3, 5, 2, sized<std::size_t>(3'000, 300));
    CHECK(by_two == "");
    CHECK(by_three == "");
    is_played_well = by_two.empty() && by_three.empty();
}

namespace {

/// Real, but it gives up after half a minute.
class PatientCondition : public std::condition_variable {
  public:
    void wait(std::unique_lock<std::mutex>& guard) {
        if (wait_for(guard, std::chrono::seconds(30)) == std::cv_status::timeout)
            throw std::runtime_error("it waits for ever");
    }
    template <class Predicate>
    void wait(std::unique_lock<std::mutex>& guard, const Predicate& predicate) {
        while (!predicate()) wait(guard);
    }
};

}  // namespace

TEST_CASE("with real threads, too") {
    if (!is_played_well) return;
    for (int round = 0; round < sized(200, 20); ++round) {
        NodeQueue<std::mutex, PatientCondition> queue;
        std::atomic<int> done{0}, waited_in_vain{0};
        queue.push(0);
        {
            std::vector<std::jthread> threads;
            for (int i = 0; i < 4; ++i)
                threads.emplace_back([&] {
                    try {
                        while (const std::optional<int> task = queue.pop()) {
                            for (const int child : {2 * *task + 1, 2 * *task + 2})
                                if (child < 31) queue.push(child);
                            ++done;
                            queue.finish();
                        }
                    } catch (const std::runtime_error&) {
                        ++waited_in_vain;
                    }
                });
        }
        REQUIRE(waited_in_vain == 0);
        REQUIRE(done == 31);
    }
}
