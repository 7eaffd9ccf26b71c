// Played threads: they find what goes wrong in one order of many, and all that should not happen
// ends.
#include "tests/ch08/played_threads.hpp"

#include "tests/catch.hpp"

#include <mutex>
#include <optional>
#include <set>
#include <string>

namespace space {

TEST_CASE("two threads of three steps are played in all their 20 orders") {
    std::set<std::string> orders;
    const std::string fault = fault_in_any_order(10'000, 6, [&](Play& play) {
        std::string order;
        const auto steps = [&](char name) {
            return [&order, &play, name] {
                for (int i = 0; i < 3; ++i) {
                    order += name;
                    play.point();
                }
            };
        };
        const std::string stuck = play.run({steps('a'), steps('b')});
        orders.insert(order);
        return stuck;
    });
    CHECK(fault == "");
    CHECK(orders.size() == 20);  // 6 choose 3
}

TEST_CASE("an update without a lock is lost in some order, with one in none") {
    const auto counted = [](bool locks) {
        return fault_in_any_order(1'000, 2, [&](Play& play) {
            PlayedMutex mutex;
            int counter = 0;
            const auto add = [&] {
                std::unique_lock<PlayedMutex> guard(mutex, std::defer_lock);
                if (locks) guard.lock();
                const int value = counter;
                play.point();
                counter = value + 1;
            };
            const std::string stuck = play.run({add, add});
            return !stuck.empty() ? stuck : std::string(counter == 2 ? "" : "lost");
        });
    };
    CHECK(counted(true) == "");
    CHECK(counted(false).starts_with("lost"));
}

TEST_CASE("two locks taken crosswise block each other in some order, and the play ends") {
    const std::string fault = fault_in_any_order(1'000, 2, [](Play& play) {
        PlayedMutex a, b;
        return play.run({[&] {
                             const std::lock_guard first(a);
                             const std::lock_guard second(b);
                         },
                         [&] {
                             const std::lock_guard first(b);
                             const std::lock_guard second(a);
                         }});
    });
    CHECK(fault.starts_with("all that are left wait"));
}

TEST_CASE("a wake-up that comes before the waiting is lost, unless one looks first") {
    const auto waited = [](bool looks) {
        return fault_in_any_order(1'000, 2, [&](Play& play) {
            PlayedMutex mutex;
            PlayedCondition condition;
            bool is_there = false;
            return play.run({[&] {
                                 std::unique_lock<PlayedMutex> guard(mutex);
                                 if (looks)
                                     condition.wait(guard, [&] { return is_there; });
                                 else
                                     condition.wait(guard);
                             },
                             [&] {
                                 const std::lock_guard guard(mutex);
                                 is_there = true;
                                 condition.notify_one();
                             }});
        });
    };
    CHECK(waited(true) == "");
    CHECK(waited(false).starts_with("all that are left wait"));
}

TEST_CASE("a waiting thread is woken for no reason, too") {
    const std::string fault = fault_in_any_order(1'000, 1, [](Play& play) {
        PlayedMutex mutex;
        PlayedCondition condition;
        bool is_there = false, came_early = false;
        const std::string stuck = play.run({[&] {
                                                std::unique_lock<PlayedMutex> guard(mutex);
                                                if (!is_there) condition.wait(guard);
                                                came_early = !is_there;
                                            },
                                            [&] {
                                                const std::lock_guard guard(mutex);
                                                is_there = true;
                                                condition.notify_one();
                                            }});
        return !stuck.empty() ? stuck : std::string(came_early ? "early" : "");
    });
    CHECK(fault.starts_with("early"));
}

TEST_CASE("who polls has no end, who throws ends, and a strange unlock is told") {
    const auto fault_of = [](const auto& body) {
        return fault_in_any_order(1, 0, [&](Play& play) {
            PlayedMutex mutex;
            return play.run({[&] { body(play, mutex); }});
        });
    };
    CHECK(fault_of([](Play&, PlayedMutex& mutex) {
              for (;;) {
                  mutex.lock();
                  mutex.unlock();
              }
          }).starts_with("after a thousand steps"));
    CHECK(fault_of([](Play&, PlayedMutex&) { throw 1; }).starts_with("an exception"));
    CHECK(fault_of([](Play&, PlayedMutex& mutex) { mutex.unlock(); }).starts_with("a mutex"));
}

TEST_CASE("the same fault is found in the same order each time") {
    const auto find = [] {
        return fault_in_any_order(1'000, 1, [](Play& play) {
            int at = 0;
            bool is_met = false;
            const auto walk = [&](int step) {
                return [&at, &is_met, &play, step] {
                    for (int i = 0; i < 4; ++i) {
                        at += step;
                        is_met |= at == 7;
                        play.point();
                    }
                };
            };
            const std::string stuck = play.run({walk(1), walk(5)});
            return !stuck.empty() ? stuck : std::string(is_met ? "met" : "");
        });
    };
    CHECK(find().starts_with("met"));
    CHECK(find() == find());
}

}  // namespace space
