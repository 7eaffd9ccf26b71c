/// @file
/// A pre-emption, injected at the worst place, and what it does to the end of a build.
#pragma once

#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>

namespace space {

// [held_task]
/// An observer of a queue's build, which holds the worker that takes the first task: it has taken
/// it and not yet told that it works. So would a system that gives the core to another program just
/// then. It goes on when all others have quit, or when patience ends. Each that quits is asked what
/// stands: triangles in no leaf yet are missing from the tree that it believes whole.
class HeldTask : public NoObserver {
  public:
    HeldTask(std::size_t triangles, unsigned workers, std::chrono::milliseconds patience)
        : missing_(triangles), others_(workers - 1), patience_(patience) {}

    using NoObserver::observe;
    template <int D>
    void observe(const BvhChosen<D>& event) {
        const std::lock_guard guard(lock_);
        if (!event.cut) missing_ -= event.task.range.size();
    }
    template <int D>
    void observe(const BvhTaken<D>&) {
        std::unique_lock guard(lock_);
        if (is_held_) return;
        is_held_ = true;
        all_quit_.wait_for(guard, patience_, [&] { return quit_ == others_; });
        quit_while_held_ = quit_;
    }
    void observe(const BvhQuits&) {
        const std::lock_guard guard(lock_);
        ++quit_;
        if (missing_ > 0) ++too_early_, most_missing_ = std::max(most_missing_, missing_);
        all_quit_.notify_all();
    }

    unsigned too_early() const { return too_early_; }  ///< workers that quit before the end
    /// Triangles in no leaf when one of them quit.
    std::size_t most_missing() const { return most_missing_; }
    /// Who is gone when the held worker goes on.
    unsigned quit_while_held() const { return quit_while_held_; }

  private:
    std::mutex lock_;
    std::condition_variable all_quit_;
    std::size_t missing_, most_missing_ = 0;
    unsigned others_, quit_ = 0, too_early_ = 0, quit_while_held_ = 0;
    bool is_held_ = false;
    std::chrono::milliseconds patience_;
};
// [held_task]

}  // namespace space
