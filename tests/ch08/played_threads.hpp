/// @file
/// Threads that run one at a time, in every order that matters: at each step of a played mutex or
/// condition variable another thread may go on. So a wake-up that is missing in one order of a
/// thousand is found, in the same order each time, and threads that would wait for ever are told of
/// and ended. After Musuvathi et al., "Finding and Reproducing Heisenbugs in Concurrent Programs",
/// OSDI 2008: few pre-emptions find most faults.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace space {

/// Thrown through a played thread to end it.
struct PlayIsOver {};

/// One run of some threads, in an order that `choices` tells; where it ends, the first choice is
/// taken and written down.
class Play {
  public:
    /// The taken one of some that there were.
    struct Choice {
        std::size_t taken, of;
    };

    /// `disturbances`: how often a thread may be pre-empted that could go on, or be woken without
    /// reason.
    Play(std::vector<Choice>& choices, int disturbances)
        : choices_(choices), disturbances_(disturbances) {}

    /// @return what went wrong: nothing, or that all wait, or that there is no end
    std::string run(const std::vector<std::function<void()>>& bodies) {
        threads_.assign(bodies.size(), Thread{});
        now() = this;
        {
            std::vector<std::jthread> threads;
            for (std::size_t i = 0; i < bodies.size(); ++i)
                threads.emplace_back([&, i] { play(i, bodies[i]); });
            std::unique_lock guard(mutex_);
            choose_next();
        }
        now() = nullptr;
        return fault_;
    }

    /// The calling thread goes on when it is its turn, and `may_go` says so. `wake` ends its
    /// waiting without reason.
    void point(std::function<bool()> may_go = {}, std::function<void()> wake = {},
               bool rests = false) {
        std::unique_lock guard(mutex_);
        if (is_over_) throw PlayIsOver{};
        threads_[here()].may_go = std::move(may_go);
        threads_[here()].wake = std::move(wake);
        threads_[here()].rests = rests;
        if (++steps_ > most_steps)
            end("after a thousand steps there is no end: somebody asks again and again");
        else
            choose_next();
        wait_for_turn(guard);
    }
    /// The calling thread goes on when no other can: all that are left sleep, or rest, too.
    void rest() { point({}, {}, true); }
    /// As in point(), one of several.
    std::size_t choose(std::size_t of) {
        if (of <= 1) return 0;
        if (depth_ == choices_.size()) choices_.push_back({0, of});
        return choices_[depth_++].taken;
    }
    /// The run in which the calling thread plays; none outside of one.
    static Play*& now() {
        static Play* play = nullptr;
        return play;
    }
    static bool is_played() { return now() != nullptr && here() != nobody; }
    bool is_over() const { return is_over_; }
    void fail(const std::string& fault) {
        std::unique_lock guard(mutex_);
        end(fault);
    }

  private:
    /// A thread of the play: where it waits it has a condition for going on.
    struct Thread {
        std::function<bool()> may_go = {};
        std::function<void()> wake = {};
        bool rests = false, is_done = false;

        bool is_ready() const { return !is_done && (!may_go || may_go()); }
    };
    static constexpr std::size_t nobody = ~std::size_t{0};
    static constexpr int most_steps = 1'000;

    static std::size_t& here() {
        static thread_local std::size_t thread = nobody;
        return thread;
    }

    void play(std::size_t thread, const std::function<void()>& body) {
        here() = thread;
        try {
            {
                std::unique_lock guard(mutex_);
                wait_for_turn(guard);
            }
            body();
        } catch (const PlayIsOver&) {
        } catch (...) {
            fail("an exception ends a thread");
        }
        std::unique_lock guard(mutex_);
        threads_[thread].is_done = true;
        if (!is_over_) choose_next();
        if (is_over_) hand_over();
    }
    void wait_for_turn(std::unique_lock<std::mutex>& guard) {
        turn_.wait(guard, [&] { return active_ == here(); });
        if (is_over_) throw PlayIsOver{};
        threads_[active_].may_go = {};
        threads_[active_].wake = {};
        threads_[active_].rests = false;
    }
    void choose_next() {
        std::vector<std::size_t> ready, resting, disturbing;
        for (std::size_t i = 0; i < threads_.size(); ++i) {
            if (threads_[i].is_ready())
                (threads_[i].rests ? resting : ready).push_back(i);
            else if (!threads_[i].is_done && threads_[i].wake)
                disturbing.push_back(i);
        }
        if (ready.empty()) ready = resting;
        if (ready.empty()) {
            const bool all_done = std::all_of(threads_.begin(), threads_.end(),
                                              [](const Thread& each) { return each.is_done; });
            return end(all_done ? "" : "all that are left wait, and nobody will wake them");
        }
        const auto active = std::find(ready.begin(), ready.end(), active_);
        const bool could_go_on = active != ready.end();
        if (could_go_on) std::iter_swap(ready.begin(), active);
        const std::size_t free = could_go_on ? 1 : ready.size();
        std::vector<std::size_t> all = ready;
        all.insert(all.end(), disturbing.begin(), disturbing.end());
        const std::size_t taken = choose(disturbances_ > 0 ? all.size() : free);
        if (taken >= free) --disturbances_;
        if (taken >= ready.size()) threads_[all[taken]].wake();
        active_ = all[taken];
        turn_.notify_all();
    }
    /// Whoever's turn it is ends at its next step, then the others, one by one.
    void end(const std::string& fault) {
        if (!is_over_) fault_ = fault;
        is_over_ = true;
    }
    void hand_over() {
        for (active_ = 0; active_ < threads_.size() && threads_[active_].is_done;) ++active_;
        turn_.notify_all();
    }

    std::vector<Choice>& choices_;
    int disturbances_;
    std::size_t depth_ = 0, active_ = nobody;
    int steps_ = 0;
    std::vector<Thread> threads_;
    std::mutex mutex_;
    std::condition_variable turn_;
    std::string fault_;
    bool is_over_ = false;
};

/// As std::mutex, for played threads. Outside of a play nobody else is there.
class PlayedMutex {
  public:
    void lock() {
        if (Play::is_played()) Play::now()->point([this] { return !is_held_; });
        is_held_ = true;
        ++times_locked();
    }
    bool try_lock() {
        if (Play::is_played()) Play::now()->point();
        return !std::exchange(is_held_, true);
    }
    void unlock() {
        if (!is_held_ && Play::is_played() && !Play::now()->is_over())
            Play::now()->fail("a mutex is unlocked that nobody has locked");
        is_held_ = false;
    }
    bool is_held() const { return is_held_; }
    /// Of all mutexes together, by lock().
    static std::size_t& times_locked() {
        static std::size_t times = 0;
        return times;
    }

  private:
    bool is_held_ = false;
};

/// As std::condition_variable, for played threads.
class PlayedCondition {
  public:
    void notify_one() {
        if (!Play::is_played()) return;
        Play::now()->point();
        std::vector<Waiter*> asleep;
        for (Waiter* each : waiters_)
            if (!each->is_woken) asleep.push_back(each);
        if (!asleep.empty()) asleep[Play::now()->choose(asleep.size())]->is_woken = true;
    }
    void notify_all() {
        if (!Play::is_played()) return;
        Play::now()->point();
        for (Waiter* each : waiters_) each->is_woken = true;
    }
    template <class Guard>
    void wait(Guard& guard) {
        Play& play = *Play::now();
        play.point();  // who has looked without the lock has looked too early
        if (!guard.owns_lock()) play.fail("it waits without the lock");
        Waiter waiter;
        waiters_.push_back(&waiter);
        guard.unlock();
        const PlayedMutex& mutex = *guard.mutex();
        const auto leave = [&] { std::erase(waiters_, &waiter); };
        try {
            play.point([&] { return waiter.is_woken && !mutex.is_held(); },
                       [&] { waiter.is_woken = true; });
            leave();
        } catch (...) {
            leave();
            throw;
        }
        guard.lock();
    }
    template <class Guard, class Predicate>
    void wait(Guard& guard, const Predicate& predicate) {
        while (!predicate()) wait(guard);
    }

  private:
    struct Waiter {
        bool is_woken = false;
    };
    std::vector<Waiter*> waiters_;
};

/// Plays every order with at most so many disturbances, up to `most_runs` of them. `one_run(play)`
/// makes what the threads share and plays them. @return the first fault, with the number of the run
/// in which it was found, or nothing
template <class OneRun>
std::string fault_in_any_order(std::size_t most_runs, int disturbances, const OneRun& one_run) {
    std::vector<Play::Choice> choices;
    for (std::size_t run = 1; run <= most_runs; ++run) {
        Play play(choices, disturbances);
        if (const std::string fault = one_run(play); !fault.empty())
            return fault + " (in order " + std::to_string(run) + ")";
        while (!choices.empty() && choices.back().taken + 1 == choices.back().of)
            choices.pop_back();
        if (choices.empty()) break;
        ++choices.back().taken;
    }
    return {};
}

}  // namespace space
