#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/locks.hpp"
#include "chapters/ch08_parallel_builds/measured/schedule_runs.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "common/measure.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <functional>
#include <future>
#include <thread>
#include <utility>
#include <vector>

namespace space::ch08 {
namespace {

/// At least two: what is measured is what threads cost each other.
unsigned machine_threads() {
    return std::max(2u, std::thread::hardware_concurrency());
}

/// The middle of many, in microseconds.
double middle_us(int times, const std::function<void()>& run) {
    std::vector<double> us;
    for (int i = 0; i < times; ++i) {
        Stopwatch stopwatch;
        run();
        us.push_back(1e3 * stopwatch.lap().count());
    }
    return median(std::move(us));
}

double thread_start_us() {
    std::vector<double> us;
    for (int i = 0; i < 300; ++i) {
        Stopwatch stopwatch;
        us.push_back(
            std::async(std::launch::async, [&] { return 1e3 * stopwatch.lap().count(); }).get());
    }
    return median(std::move(us));
}

/// Two threads put two items there and take them, all the time: the time of a visit.
double lock_ns(int rounds) {
    constexpr int turns = 100'000;
    const std::function<void()> run = [] {
        int item = 0;
        TaskQueue<int*, Spinlock<>> queue;
        const auto work = [&] {
            for (int i = 0; i < turns; ++i) {
                queue.push(&item, &item);
                do_not_optimize(queue.pop());
                do_not_optimize(queue.pop());
            }
        };
        const std::jthread other(work);
        work();
    };
    return 1e6 * interleaved_medians(std::span(&run, 1), rounds).front() / (2.0 * 3.0 * turns);
}

double loop_us() {
    WorkStealing threads(machine_threads());
    return middle_us(2'000, [&] { threads.for_each(machine_threads(), [](std::size_t) {}); });
}

/// The time of all nodes that all threads make. They are made one after another.
struct LargeNodes : NoObserver {
    std::size_t large;
    double& ms;
    Stopwatch& stopwatch;

    LargeNodes(std::size_t above, double& sum, Stopwatch& clock)
        : large(above), ms(sum), stopwatch(clock) {}
    using NoObserver::observe;
    void observe(const BvhPartBegun<3>& begun) const {
        if (begun.task.range.size() > large) stopwatch.lap();
    }
    void observe(const BvhPartEnded<3>& ended) const {
        if (ended.task.range.size() > large) ms += stopwatch.lap().count();
    }
};

double large_nodes_ms(std::span<const Triangle> triangles, unsigned threads) {
    WorkStealingBuilder::Config config;
    config.threads = threads;
    double ms = 0.0;
    Stopwatch stopwatch;
    WorkStealingBuilder::build<3>(triangles, config, LargeNodes(config.large, ms, stopwatch));
    return ms;
}

/// What two threads leave of the time of one, and what one takes beyond the sequential builder. The
/// first by the least time of each: whatever else has a core for a moment looks like serial work,
/// and a wrong share here is in every schedule on many cores.
void measure_large_nodes(const RecordedBuild& build, int rounds, MeasuredCosts& costs) {
    const WorkStealingBuilder::Config config;
    double sequential_ms = 0.0, chunks = 0.0;
    for (const TaskNode& node : build.graph.nodes)
        if (node.triangles > config.large) {
            sequential_ms += 1e-6 * node.cost;
            chunks += double((node.triangles + config.chunk - 1) / config.chunk);
        }
    if (chunks == 0.0) return;
    std::vector<double> one, two;
    for (int round = 0; round < rounds; ++round) {
        one.push_back(large_nodes_ms(build.triangles, 1));
        two.push_back(large_nodes_ms(build.triangles, 2));
    }
    const double ratio = std::ranges::min(two) / std::ranges::min(one);
    costs.serial_share = std::clamp(2.0 * ratio - 1.0, 0.0, 1.0);
    costs.chunk_us = 1e3 * std::max(0.0, median(std::move(one)) - sequential_ms) / chunks;
}

/// As in chapter 7: a cut reads its references for the box around their middles, for the bins and
/// to part them, and parting writes them.
double bytes_moved(const TaskGraph& graph) {
    constexpr double reference = sizeof(BvhReference<3>);
    double bytes = double(graph.nodes.front().triangles) * (sizeof(Triangle) + reference);
    for (const TaskNode& node : graph.nodes) {
        bytes += sizeof(BvhNode<3>);
        bytes += node.triangles * (node.is_leaf() ? reference + 4.0 : 4.0 * reference);
    }
    return bytes;
}

/// Read and written, as STREAM counts, by all cores at once, from areas much larger than what is
/// near to them.
double copy_bytes_per_us(int rounds) {
    constexpr std::size_t size = std::size_t{1} << 27;
    const unsigned threads = machine_threads();
    std::vector<std::vector<char>> from(threads, std::vector<char>(size, 'a')), to = from;
    const std::function<void()> run = [&] {
        std::vector<std::jthread> workers;
        for (unsigned i = 0; i < threads; ++i)
            workers.emplace_back([&, i] { std::memcpy(to[i].data(), from[i].data(), size); });
    };
    const double ms = interleaved_medians(std::span(&run, 1), rounds).front();
    return 2.0 * double(size) * threads / (1e3 * ms);
}

}  // namespace

MeasuredCosts measure_costs(const RecordedBuild& build, int rounds) {
    MeasuredCosts costs{
        .thread_start_us = thread_start_us(), .lock_ns = lock_ns(rounds), .steal_us = loop_us()};
    measure_large_nodes(build, rounds, costs);
    costs.build_bytes_per_us = bytes_moved(build.graph) / (1e-3 * build.graph.total());
    costs.copy_bytes_per_us = copy_bytes_per_us(rounds);
    return costs;
}

}  // namespace space::ch08
