/// @file
/// Ends a test program whose threads hang, and says so.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

namespace space {

/// While it lives, time runs.
class Watchdog {
  public:
    explicit Watchdog(int seconds)
        : thread_([this, seconds] {
              std::unique_lock lock(mutex_);
              if (done_.wait_for(lock, std::chrono::seconds(seconds), [&] { return is_done_; }))
                  return;
              fmt::print(stderr, "a thread hangs: not done after {} seconds\n", seconds);
              std::fflush(nullptr);
              std::_Exit(1);
          }) {}
    ~Watchdog() {
        {
            const std::lock_guard lock(mutex_);
            is_done_ = true;
        }
        done_.notify_one();
    }

  private:
    std::mutex mutex_;
    std::condition_variable done_;
    bool is_done_ = false;
    std::jthread thread_;
};

}  // namespace space
