/// @file
/// Threads that steal work from each other: oneTBB's, behind the little of it that we need.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace space {

/// Each thread has a deque of tasks. It puts new ones in at one end and takes them out there again,
/// the youngest first: depth first, in memory that it has just used. A thread that has none steals
/// the oldest of another's, which is the largest where tasks are halves of tasks (Blumofe &
/// Leiserson 1999, "Scheduling multithreaded computations by work stealing").
class WorkStealing {
  public:
    /// So many threads, the caller's among them; more than the machine's cores are no fault.
    explicit WorkStealing(unsigned threads);
    ~WorkStealing();
    unsigned threads() const { return threads_; }

    /// body(i) for each i in 0 .. count - 1, by all threads. The first exception is thrown on, and
    /// what has not begun then does not begin.
    void for_each(std::size_t count, const std::function<void(std::size_t)>& body);

    /// A thread of the group; to be called by its tasks.
    using Spawn = std::function<void(std::function<void()> task)>;
    /// Calls body(spawn) and ends when all tasks that it or they have spawned did; exceptions as
    /// above.
    void run(const std::function<void(const Spawn& spawn)>& body);

  private:
    struct Threads;  // TBB's headers are compiled once, and not for all who include this one
    unsigned threads_;
    std::unique_ptr<Threads> tbb_;
};

}  // namespace space
