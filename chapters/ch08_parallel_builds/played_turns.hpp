/// @file
/// Two threads of which one runs, by turns that follow from a seed: a race that is played, and so
/// the same again in each run.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/shared_scratch_builder.hpp"
#include "common/observer.hpp"
#include "common/pcg32.hpp"

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>

namespace space {

// [played_turns]
/// An observer of SharedScratchBuilder. Whenever a thread has written what it will read again, it
/// may have to stop, one in `patience` times, as if the system took its core away; the other one
/// goes on from where it stopped before.
class PlayedTurns : public NoObserver {
  public:
    PlayedTurns(std::uint64_t seed, std::uint32_t patience) : random_(seed), patience_(patience) {}

    using NoObserver::observe;
    template <int D>
    void observe(const BvhChosen<D>& event) {
        if (event.task.depth == 0 && event.cut) second_begin_ = event.cut->count;
    }
    template <int D>
    void observe(const BvhPartBegun<D>& event) {
        std::unique_lock guard(lock_);
        if (event.task.depth > 0) wait_for(player(event.task), guard);
    }
    template <int D>
    void observe(const ScratchWritten<D>& event) {
        std::unique_lock guard(lock_);
        const std::size_t me = player(event.task);
        if (event.task.depth == 0 || has_ended_[1 - me] || random_.below(patience_) > 0) return;
        give_to(1 - me);
        wait_for(me, guard);
    }
    template <int D>
    void observe(const BvhPartEnded<D>& event) {
        const std::lock_guard guard(lock_);
        if (event.task.depth == 0) return;
        has_ended_[player(event.task)] = true;
        give_to(1 - player(event.task));
    }

  private:
    /// 0 makes the root's first side, 1 the second.
    template <int D>
    std::size_t player(const BvhTask<D>& task) const {
        return task.begin < second_begin_ ? 0 : 1;
    }
    void give_to(std::size_t other) {
        turn_ = other;
        changed_.notify_all();
    }
    void wait_for(std::size_t me, std::unique_lock<std::mutex>& guard) {
        changed_.wait(guard, [&] { return turn_ == me; });
    }

    std::mutex lock_;
    std::condition_variable changed_;
    std::size_t second_begin_ = 0, turn_ = 0;
    std::array<bool, 2> has_ended_{};
    Pcg32 random_;
    std::uint32_t patience_;
};
// [played_turns]

}  // namespace space
