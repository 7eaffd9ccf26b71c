/// @file
/// Locks: what lets one thread at a time through. Those of [BvhThesis13], sections 3.4.1 and 4.4,
/// as C++20 has them or as one writes them.
#pragma once

#include <semaphore.h>

#include <atomic>
#include <cerrno>
#include <concepts>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <system_error>
#include <thread>

namespace space {

// [lock]
/// Between lock() and unlock() at most one thread is; what it has written there, the next one sees.
/// std::mutex is one.
template <class L>
concept Lock = requires(L lock) {
    { lock.lock() } -> std::same_as<void>;
    { lock.unlock() } -> std::same_as<void>;
};
// [lock]

/// No lock at all, to see what then happens.
struct NoLock {
    void lock() {}
    void unlock() {}
};

/// What a spinning thread does between two looks: nothing.
struct NoPause {
    void operator()() {}
};

// [pause]
/// What the processor has for it: it looks less often, leaves its core's other thread more room,
/// and takes back no speculative looks when the lock comes free.
struct CpuPause {
    void operator()() {
#if defined(__x86_64__) || defined(__i386__)
        __builtin_ia32_pause();
#elif defined(__aarch64__)
        asm volatile("yield");
#endif
    }
};

/// After so many pauses, longer than a short section takes, it gives its core away: perhaps to who
/// holds the lock.
struct PauseThenYield {
    static constexpr int pauses = 64;
    int left = pauses;
    void operator()() {
        if (left == 0) return std::this_thread::yield();
        --left;
        CpuPause{}();
    }
};
// [pause]

// [spinlock]
/// Waits in a loop. Only when the lock looks free does it try to take it: an exchange takes the
/// cache line away from all others, a load shares it (test and test-and-set).
template <class Waiting = CpuPause>
class Spinlock {
  public:
    void lock() {
        Waiting wait;
        while (is_held_.exchange(true, std::memory_order_acquire))
            while (is_held_.load(std::memory_order_relaxed)) wait();
    }
    void unlock() { is_held_.store(false, std::memory_order_release); }

  private:
    std::atomic<bool> is_held_{false};
};
// [spinlock]

// [semaphore]
/// A counter of how many may still enter: here one. Anybody may release it, not only who has
/// acquired it. It is the system's: GCC 12's
/// std::counting_semaphore may sleep while it is free.
class SemaphoreLock {
  public:
    SemaphoreLock() {
        if (sem_init(&room_, 0, 1) != 0)
            throw std::system_error(errno, std::generic_category(), "sem_init");
    }
    ~SemaphoreLock() { sem_destroy(&room_); }
    SemaphoreLock(const SemaphoreLock&) = delete;
    SemaphoreLock& operator=(const SemaphoreLock&) = delete;

    void lock() {
        while (sem_wait(&room_) != 0) {  // a signal has interrupted it
        }
    }
    void unlock() { sem_post(&room_); }

  private:
    sem_t room_;
};
// [semaphore]

// [monitor]
/// A lock made of a monitor: who finds it held sleeps on a condition until who leaves signals it.
/// The mutex guards the flag alone, for a few instructions.
class MonitorLock {
  public:
    void lock() {
        std::unique_lock guard(mutex_);
        freed_.wait(guard, [&] { return !is_held_; });
        is_held_ = true;
    }
    void unlock() {
        {
            const std::lock_guard guard(mutex_);
            is_held_ = false;
        }
        freed_.notify_one();
    }

  private:
    std::mutex mutex_;
    std::condition_variable freed_;
    bool is_held_ = false;
};
// [monitor]

// [add_one]
/// Adds one in three steps, as a machine does: read, add, write. `between` is called after the
/// first, where another thread may come in. Loads and stores are atomic each, so that only the
/// update can be lost and no byte torn.
template <Lock L, class Between>
void add_one(std::atomic<std::uint64_t>& counter, L& lock, const Between& between) {
    const std::lock_guard guard(lock);
    const std::uint64_t value = counter.load(std::memory_order_relaxed);
    between();
    counter.store(value + 1, std::memory_order_relaxed);
}
// [add_one]

}  // namespace space
