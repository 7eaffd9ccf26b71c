/// @file
/// How workers that share a queue learn that nothing more will come. An empty queue does not say
/// it: who holds a task may put more in.
#pragma once

#include <atomic>
#include <chrono>
#include <concepts>
#include <cstddef>
#include <thread>
#include <vector>

namespace space {

/// What a queue's workers tell, and ask when they have found it empty. is_over may make them wait.
template <class E>
concept Ending = std::constructible_from<E, unsigned> && requires(E ending, unsigned worker) {
    {ending.add(std::size_t{})};  // tasks, before they are in the queue
    {ending.begin(worker)};       // with a task that it has taken
    {ending.end(worker)};         // with it, and all that it has put in is counted
    { ending.is_over(worker) } -> std::same_as<bool>;
};

// [count_tasks]
/// The cure: a counter of the tasks that are not done, be they in the queue or in hand (a simple
/// case of Dijkstra & Scholten 1980, "Termination detection for diffusing computations"). A task's
/// children are added before it is subtracted, so it is 0 only when all is done.
class CountTasks {
  public:
    explicit CountTasks(unsigned) {}

    void add(std::size_t tasks) { unfinished_.fetch_add(tasks, std::memory_order_relaxed); }
    void begin(unsigned) {}
    void end(unsigned) { unfinished_.fetch_sub(1, std::memory_order_release); }
    bool is_over(unsigned) {
        if (unfinished_.load(std::memory_order_acquire) == 0) return true;
        std::this_thread::yield();
        return false;
    }

  private:
    std::atomic<std::size_t> unfinished_{0};
};
// [count_tasks]

// [poll_flags]
/// As published ([BvhThesis13], section 4.4): each worker says whether it is running. Who finds the
/// queue empty, and nobody running, sleeps and looks again, twice; then it quits. Who has taken a
/// task and not yet said so is seen by nobody, however often they look.
class PollFlags {
  public:
    static constexpr std::chrono::microseconds nap{50};

    explicit PollFlags(unsigned workers) : workers_(workers) {}

    void add(std::size_t) {}
    void begin(unsigned worker) {
        workers_[worker].is_running = true;
        workers_[worker].attempts = 0;
    }
    void end(unsigned worker) { workers_[worker].is_running = false; }
    bool is_over(unsigned worker) {
        for (const Worker& each : workers_)
            if (each.is_running) {
                std::this_thread::sleep_for(nap);
                return false;
            }
        if (workers_[worker].attempts++ == 2) return true;
        std::this_thread::sleep_for(nap);
        return false;
    }

  private:
    /// In cache lines of its own: others look at it all the time.
    struct alignas(64) Worker {
        std::atomic<bool> is_running{false};
        int attempts = 0;  ///< its own business
    };
    std::vector<Worker> workers_;
};
// [poll_flags]

/// What must not be done: who finds the queue empty quits. The tree is whole, for who puts tasks in
/// takes them out again; but perhaps all by itself.
struct QuitWhenEmpty {
    explicit QuitWhenEmpty(unsigned) {}
    void add(std::size_t) {}
    void begin(unsigned) {}
    void end(unsigned) {}
    bool is_over(unsigned) { return true; }
};

}  // namespace space
