/// @file
/// Telling how far a long job is: a bar on a terminal, now and then a plain line elsewhere, on
/// stderr.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace space {

/// Steps may come from several threads. Nothing is written for jobs that end within a moment.
class Progress {
  public:
    Progress(std::string job, std::size_t steps);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void step(std::size_t count = 1);

  private:
    void draw(std::size_t done);

    std::string job_;
    std::size_t steps_;
    std::atomic<std::size_t> done_{0};
    std::mutex lock_;
    std::chrono::steady_clock::time_point start_, last_;
    bool drawn_ = false;
};

}  // namespace space
