#include "common/program/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

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

Progress::Progress(std::string job, std::size_t steps)
    : job_(std::move(job)),
      steps_(steps),
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
    draw(done);
}

void Progress::draw(std::size_t done) {
    drawn_ = true;
    const std::size_t percent = steps_ ? 100 * done / steps_ : 100;
    if (!on_terminal()) {
        fmt::print(stderr, "{}: {} %\n", job_, percent);
        return;
    }
    constexpr std::size_t cells = 30;
    const std::size_t full = std::min(cells, percent * cells / 100);
    const bool color = std::getenv("NO_COLOR") == nullptr;
    fmt::print(stderr, "\r\033[K{} {}{}{}{} {} %", job_, color ? "\033[34m" : "",
               std::string(full, '#'), color ? "\033[0m" : "", std::string(cells - full, '.'),
               percent);
    std::fflush(stderr);
}

}  // namespace space
