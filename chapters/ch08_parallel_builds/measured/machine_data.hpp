/// @file
/// What chapter 8 counts and times of machines and locks, as plain values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch08 {

/// A machine as its recorded leaves describe it.
struct MachineRow {
    std::string name, from;  ///< and the leaves that tell the fields
    unsigned core_bits = 0, thread_bits = 0;
    std::uint64_t packages = 0, cores = 0, threads = 0;

    std::uint64_t room_for_cores() const { return packages << core_bits; }
};

/// Updates of a counter into which another thread comes.
struct LostUpdates {
    std::string lock;
    std::uint64_t updates = 0, lost = 0;
};

inline constexpr std::array<unsigned, 3> contending{2, 4, 8};

/// What one kind of lock costs.
struct LockPoint {
    std::string lock;
    double alone_ns = 0.0;                    ///< lock() and unlock() by one thread
    std::array<double, 3> contended_ns = {};  ///< the same, by so many threads in turn
    double burnt = 0.0;   ///< cores that two threads use up who wait for one that sleeps
    double others = 0.0;  ///< what a fourth thread does meanwhile, of what it does alone
};

/// The queue builder on one scene with each of two locks around its queue.
struct QueueLockPoint {
    std::string scene;
    std::uint64_t triangles = 0;
    unsigned threads = 0;
    bool is_all_queued = false;  ///< every node goes through the queue; else as published
    std::vector<double> spinlock_ms, monitor_ms;  ///< one for each run, interleaved
};

/// All of it. With --counts there are no times, and no locks are timed.
struct MachineMeasurements {
    std::vector<MachineRow> machines;
    std::vector<LostUpdates> lost;
    std::vector<LockPoint> locks;
    std::vector<QueueLockPoint> queues;
};

}  // namespace space::ch08
