/// @file
/// Exercise 8.3, our answer.
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
        {
            const std::unique_lock<Mutex> guard(mutex_);
            tasks_.push_back(task);
            ++unfinished_;
        }
        changed_.notify_one();
    }

    std::optional<int> pop() {
        std::unique_lock<Mutex> guard(mutex_);
        changed_.wait(guard, [&] { return !tasks_.empty() || unfinished_ == 0; });
        if (tasks_.empty()) return std::nullopt;
        const int task = tasks_.front();
        tasks_.pop_front();
        return task;
    }

    /// A task that the caller has popped is done.
    void finish() {
        bool is_last = false;
        {
            const std::unique_lock<Mutex> guard(mutex_);
            is_last = --unfinished_ == 0;
        }
        if (is_last) changed_.notify_all();
    }

  private:
    Mutex mutex_;
    Condition changed_;
    std::deque<int> tasks_;
    std::size_t unfinished_ = 0;  ///< pushed and not finished
};

}  // namespace space
