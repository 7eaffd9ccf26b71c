/// @file
/// Exercise 8.3: The missing wake-up
/// Difficulty 3 of 3, about 40 minutes.
///
/// Threads build a tree from a queue of tasks. Each pops a task, may push others while it works on
/// it, and says finish() when it has done it. pop() returns the oldest task; where there is none it
/// returns nothing if all tasks that were ever pushed are finished, and otherwise waits *asleep*,
/// until one of the two is so. The stub waits, but nobody wakes it, and it trusts its waking.
/// `Mutex` and `Condition` have what std::mutex and std::condition_variable have, but no waiting
/// for a time: lock them by std::unique_lock<Mutex>. The check plays the threads, in thousands of
/// orders, wakes some without reason, as condition variables may, and tells if all sleep.
#pragma once

#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

namespace space {

/// Tasks for several threads, each of which may push more.
template <class Mutex, class Condition>
class NodeQueue {
  public:
    void push(int task) {
        const std::unique_lock<Mutex> guard(mutex_);
        tasks_.push_back(task);
        ++unfinished_;
    }

    std::optional<int> pop() {
        std::unique_lock<Mutex> guard(mutex_);
        // TODO: until when does it wait, and who wakes it?
        if (tasks_.empty() && unfinished_ > 0) changed_.wait(guard);
        if (tasks_.empty()) return std::nullopt;
        const int task = tasks_.front();
        tasks_.pop_front();
        return task;
    }

    /// A task that the caller has popped is done.
    void finish() {
        const std::unique_lock<Mutex> guard(mutex_);
        --unfinished_;
    }

  private:
    Mutex mutex_;
    Condition changed_;
    std::deque<int> tasks_;
    std::size_t unfinished_ = 0;  ///< pushed and not finished
};

}  // namespace space
