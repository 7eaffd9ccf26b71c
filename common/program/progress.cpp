#include "common/program/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace space {
namespace {

using namespace std::chrono_literals;

// A job shorter than this shows nothing; a bar moves this often; a log that nobody watches gets a
// line this often.
constexpr std::chrono::milliseconds silent_for = 700ms, bar_every = 100ms, line_every = 10s;

bool on_terminal() {
    static const bool terminal = ::isatty(STDERR_FILENO) != 0;
    return terminal;
}

}  // namespace

std::string duration_text(double seconds) {
    // Beyond a century the number of hours is no news.
    const auto whole = static_cast<std::uint64_t>(std::clamp(std::ceil(seconds), 0.0, 3e9));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

Progress::Progress(std::string job, std::size_t steps, double time_limit)
    : job_(std::move(job)),
      steps_(steps),
      time_limit_(time_limit),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

Progress::~Progress() {
    if (drawn_ && on_terminal()) std::fputs("\r\033[K", stderr);
}

void Progress::step(std::size_t count) {
    const std::size_t done = done_ += count;
    const std::unique_lock guard(lock_, std::try_to_lock);
    if (!guard) return;  // another thread is drawing
    const auto now = std::chrono::steady_clock::now();
    if (now - start_ < silent_for || now - last_ < (on_terminal() ? bar_every : line_every)) return;
    last_ = now;
    draw(done, std::chrono::duration<double>(now - start_).count());
}

void Progress::draw(std::size_t done, double seconds) {
    drawn_ = true;
    // As if the steps to come took as long as those before; or the time limit comes first.
    const double part = std::clamp(
        std::max(steps_ ? double(done) / double(steps_) : 1.0, seconds / time_limit_), 0.0, 1.0);
    const auto percent = static_cast<std::size_t>(100.0 * part);
    const std::string left =
        part > 0.0 ? fmt::format(", {} left", duration_text(seconds * (1.0 / part - 1.0))) : "";
    if (!on_terminal()) {
        std::fputs(fmt::format("{}: {} %{}\n", job_, percent, left).c_str(), stderr);
        return;
    }
    constexpr std::size_t cells = 30;
    const std::size_t full = std::min(cells, percent * cells / 100);
    const bool color = std::getenv("NO_COLOR") == nullptr;
    const std::string bar = fmt::format("\r\033[K{} {}{}{}{} {} %{}", job_, color ? "\033[34m" : "",
                                        std::string(full, '#'), color ? "\033[0m" : "",
                                        std::string(cells - full, '.'), percent, left);
    std::fputs(bar.c_str(), stderr);  // a job goes on where nobody can be told
    std::fflush(stderr);
}

}  // namespace space
