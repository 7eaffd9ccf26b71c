#include "chapters/ch08_parallel_builds/asymmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/measured/build_data.hpp"
#include "chapters/ch08_parallel_builds/measured/schedules.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "common/measure.hpp"
#include "common/observer.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <thread>
#include <vector>

namespace space::ch08 {
namespace {

constexpr unsigned watched_threads = 2;

/// Writes down when each thread begins and ends what it makes in one go.
class BusyWatcher : public NoObserver {
  public:
    explicit BusyWatcher(std::string_view method) : method_(method) {}
    using NoObserver::observe;
    void observe(const BvhPartBegun<3>&) {
        const std::lock_guard guard(lock_);
        worker().begin_ms = now();
    }
    void observe(const BvhPartEnded<3>&) {
        const std::lock_guard guard(lock_);
        const Worker& ended = worker();
        busy_.push_back({method_, ended.number, ended.begin_ms, now()});
    }
    /// A thread's times, gaps below a hundredth of all closed.
    std::vector<BusyTime> busy_times() const {
        const double narrow = 0.01 * busy_.back().end_ms;
        std::vector<BusyTime> times;
        for (unsigned number = 0; number < workers_.size(); ++number) {
            bool is_first = true;
            for (const BusyTime& busy : busy_) {
                if (busy.thread != number) continue;
                if (!is_first && busy.begin_ms - times.back().end_ms < narrow)
                    times.back().end_ms = busy.end_ms;
                else
                    times.push_back(busy);
                is_first = false;
            }
        }
        return times;
    }

  private:
    struct Worker {
        std::thread::id id;
        unsigned number;
        double begin_ms;
    };

    Worker& worker() {
        const auto id = std::this_thread::get_id();
        const auto known = std::ranges::find(workers_, id, &Worker::id);
        if (known != workers_.end()) return *known;
        workers_.push_back({id, static_cast<unsigned>(workers_.size()), 0.0});
        return workers_.back();
    }
    double now() {
        now_ms_ += stopwatch_.lap().count();
        return now_ms_;
    }

    std::string_view method_;
    std::mutex lock_;
    Stopwatch stopwatch_;
    double now_ms_ = 0.0;
    std::vector<Worker> workers_;
    std::vector<BusyTime> busy_;
};

/// The middle one of some builds, by its length.
template <class Builder>
void add_busy_times(std::string_view method, std::span<const Triangle> triangles, int rounds,
                    std::vector<BusyTime>& times) {
    typename Builder::Config config;
    config.threads = watched_threads;
    std::vector<std::vector<BusyTime>> builds;
    for (int round = 0; round < rounds; ++round) {
        BusyWatcher watcher(method);
        Builder::template build<3>(triangles, config, watcher);
        builds.push_back(watcher.busy_times());
    }
    const auto length = [](const std::vector<BusyTime>& build) {
        return std::ranges::max_element(build, {}, &BusyTime::end_ms)->end_ms;
    };
    std::ranges::sort(builds, {}, length);
    const auto& middle = builds[builds.size() / 2];
    times.insert(times.end(), middle.begin(), middle.end());
}

}  // namespace

std::vector<BusyTime> measure_busy_times(const Options& options) {
    const auto triangles =
        make_scene(options.quick ? "building:3" : "building:20", options.seed).mesh.triangles();
    std::vector<BusyTime> times;
    const int rounds = options.quick ? 3 : 5;
    add_busy_times<AsymmetricBuilder>(asymmetric, triangles, rounds, times);
    add_busy_times<SymmetricBuilder>(symmetric, triangles, rounds, times);
    add_busy_times<QueueBuilder>(by_queue, triangles, rounds, times);
    return times;
}

Chart busy_chart(const std::vector<BusyTime>& busy) {
    Chart chart{.title = "Who works when in measured builds by two threads",
                .x_label = "ms since the root was begun",
                .y_label = "a line that is up: the thread works",
                .series = {}};
    double level = 0.0;
    for (const std::string_view method : {by_queue, symmetric, asymmetric})
        for (unsigned thread = watched_threads; thread-- > 0; level += 1.0) {
            Series series{fmt::format("{}, {}", method, thread), {}, {}};
            for (const BusyTime& time : busy) {
                if (time.method != method || time.thread != thread) continue;
                for (const double x : {time.begin_ms, time.begin_ms, time.end_ms, time.end_ms})
                    series.x.push_back(x);
                for (const double up : {0.0, 0.7, 0.7, 0.0}) series.y.push_back(level + up);
            }
            chart.series.push_back(series);
        }
    return chart;
}

}  // namespace space::ch08
