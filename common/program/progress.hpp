/// @file
/// Telling how far a long job is: a bar on a terminal, now and then a plain line elsewhere, on
/// stderr.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <limits>
#include <mutex>
#include <string>

namespace space {

/// Seconds as people say them: "8 s", "2 min 10 s", "3 h 5 min".
std::string duration_text(double seconds);

/// Steps may come from several threads. Nothing is written for jobs that end within a moment.
class Progress {
  public:
    /// `time_limit`: seconds after which the job ends with fewer steps.
    Progress(std::string job, std::size_t steps,
             double time_limit = std::numeric_limits<double>::infinity());
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void step(std::size_t count = 1);

  private:
    void draw(std::size_t done, double seconds);

    std::string job_;
    std::size_t steps_;
    double time_limit_;
    std::atomic<std::size_t> done_{0};
    std::mutex lock_;
    std::chrono::steady_clock::time_point start_, last_;
    bool drawn_ = false;
};

}  // namespace space
