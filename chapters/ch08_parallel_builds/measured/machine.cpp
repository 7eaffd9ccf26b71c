#include "chapters/ch08_parallel_builds/measured/machine.hpp"

#include "chapters/ch08_parallel_builds/locks.hpp"
#include "chapters/ch08_parallel_builds/measured/timing.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/recorded_machines.hpp"
#include "chapters/ch08_parallel_builds/this_processor.hpp"
#include "common/scene.hpp"

#include <atomic>
#include <chrono>
#include <ctime>
#include <functional>
#include <thread>
#include <type_traits>
#include <vector>

namespace space::ch08 {
namespace {

/// How much is measured.
struct Effort {
    int rounds = 3;
    int turns = 1'000'000;                     ///< of a lock, by all threads together
    std::chrono::milliseconds preempted{200};  ///< how long a holder keeps sleeping
    std::vector<std::string> scenes = {"icosphere:122", "soup:300000"};
    int build_rounds = 9;
};

Effort effort(const Options& options) {
    if (options.amount() == Amount::full) return {};
    return {.rounds = 1,
            .turns = 20'000,
            .preempted = std::chrono::milliseconds(50),
            .scenes = {"icosphere:30"},
            .build_rounds = 5};
}

/// visit(name, type) for each kind of lock.
template <class Visit>
void for_each_lock(const Visit& visit) {
    visit("spinlock without pause", std::type_identity<Spinlock<NoPause>>{});
    visit("spinlock", std::type_identity<Spinlock<CpuPause>>{});
    visit("spinlock that yields", std::type_identity<Spinlock<PauseThenYield>>{});
    visit("std::mutex", std::type_identity<std::mutex>{});
    visit("semaphore", std::type_identity<SemaphoreLock>{});
    visit("monitor", std::type_identity<MonitorLock>{});
}

std::vector<MachineRow> machine_rows() {
    std::vector<MachineRow> rows;
    for (const RecordedMachine& machine : recorded_machines()) {
        const ApicReading apic = apic_of(machine.processors.front().leaves);
        const MachineCounts counts = count_of(view_by_cpuid(machine.processors));
        rows.push_back({.name = std::string(machine.name),
                        .from = std::string(apic.from),
                        .core_bits = apic.fields.package_shift - apic.fields.core_shift,
                        .thread_bits = apic.fields.core_shift,
                        .packages = counts.packages,
                        .cores = counts.cores,
                        .threads = counts.threads});
    }
    return rows;
}

/// Into every other update another thread comes, between its read and its write; with a lock it
/// waits.
template <Lock L>
LostUpdates lost_updates(std::string name) {
    constexpr std::uint64_t rounds = 20;
    std::atomic<std::uint64_t> counter{0};
    L lock;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        std::jthread other;
        add_one(counter, lock, [&] {
            other = std::jthread([&] { add_one(counter, lock, [] {}); });
            if constexpr (std::is_same_v<L, NoLock>)
                other.join();  // it is through
            else
                std::this_thread::yield();  // it may come as far as it can
        });
        if (other.joinable()) other.join();
    }
    return {std::move(name), 2 * rounds, 2 * rounds - counter};
}

/// Nanoseconds for each of so many turns, which the threads share. Each has its processor: turns
/// take less time than the system needs to see that two threads have one and another has none.
template <Lock L>
double turn_ns(unsigned threads, int turns) {
    L lock;
    std::uint64_t counter = 0;
    std::atomic<unsigned> ready{0};
    const std::vector<unsigned> processors = allowed_processors();
    Stopwatch stopwatch;
    const auto work = [&](unsigned thread) {
        const OnProcessor here(processors[thread % processors.size()]);
        ++ready;
        while (ready < threads) std::this_thread::yield();  // all begin together
        if (thread == 0) stopwatch.lap();
        for (int i = 0; i < turns / int(threads); ++i) {
            const std::lock_guard guard(lock);
            ++counter;
            do_not_optimize(counter);
        }
    };
    {
        std::vector<std::jthread> others;
        for (unsigned i = 1; i < threads; ++i) others.emplace_back(work, i);
        work(0);
    }
    return 1e6 * stopwatch.lap().count() / double(counter);
}

/// The time for which the calling thread has had a core.
double thread_ms() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * double(time.tv_sec) + 1e-6 * double(time.tv_nsec);
}

/// Adds to `done` until it is over: work that needs no lock.
void toil(const std::atomic<bool>& is_over, std::uint64_t& done) {
    std::uint64_t steps = 0;
    while (!is_over.load(std::memory_order_relaxed)) do_not_optimize(++steps);
    done = steps;
}

/// The work of a thread that is alone for so long.
double toil_alone(std::chrono::milliseconds time) {
    std::atomic<bool> is_over{false};
    std::uint64_t done = 0;
    {
        std::jthread worker([&] { toil(is_over, done); });
        std::this_thread::sleep_for(time);
        is_over = true;
    }
    return double(done);
}

/// A holder that has been taken off its core inside: it sleeps. Two threads wait for it, a fourth
/// one works.
template <Lock L>
void measure_preempted(LockPoint& point, std::chrono::milliseconds time) {
    L lock;
    std::atomic<bool> is_over{false};
    std::atomic<int> waiting{0};
    std::array<double, 2> waited_ms{};
    std::uint64_t done = 0;
    Stopwatch stopwatch;
    double elapsed = 0.0;
    {
        lock.lock();
        std::vector<std::jthread> threads;
        for (double& ms : waited_ms)
            threads.emplace_back([&] {
                const double before = thread_ms();
                ++waiting;
                lock.lock();
                ms = thread_ms() - before;
                lock.unlock();
            });
        while (waiting < 2) std::this_thread::yield();
        threads.emplace_back([&] { toil(is_over, done); });
        stopwatch.lap();
        std::this_thread::sleep_for(time);
        is_over = true;
        elapsed = stopwatch.lap().count();
        lock.unlock();
    }
    point.burnt = (waited_ms[0] + waited_ms[1]) / elapsed;
    point.others = double(done);
}

/// Interleaved: each round all locks, one after the other.
std::vector<LockPoint> measure_locks(const Effort& effort) {
    std::vector<std::vector<LockPoint>> rounds;
    for (int round = 0; round <= effort.rounds; ++round) {  // one to warm up
        std::vector<LockPoint> points;
        const double alone = toil_alone(effort.preempted);
        for_each_lock([&]<Lock L>(const char* name, std::type_identity<L>) {
            LockPoint point{.lock = name, .alone_ns = turn_ns<L>(1, effort.turns)};
            for (std::size_t i = 0; i < contending.size(); ++i)
                point.contended_ns[i] = turn_ns<L>(contending[i], effort.turns);
            measure_preempted<L>(point, effort.preempted);
            point.others /= alone;
            points.push_back(point);
        });
        if (round > 0) rounds.push_back(points);
    }
    std::vector<LockPoint> medians = rounds.front();
    for (std::size_t i = 0; i < medians.size(); ++i) {
        const auto middle = [&](const auto& of) {
            std::vector<double> values;
            for (const auto& points : rounds) values.push_back(of(points[i]));
            return median(values);
        };
        LockPoint& point = medians[i];
        point.alone_ns = middle([](const LockPoint& p) { return p.alone_ns; });
        for (std::size_t k = 0; k < contending.size(); ++k)
            point.contended_ns[k] = middle([k](const LockPoint& p) { return p.contended_ns[k]; });
        point.burnt = middle([](const LockPoint& p) { return p.burnt; });
        point.others = middle([](const LockPoint& p) { return p.others; });
    }
    return medians;
}

/// The queue builder with a spinlock and with a monitor around its queue, in turn.
QueueLockPoint measure_queue(const std::string& scene, std::span<const Triangle> triangles,
                             unsigned threads, QueueCondition condition, int rounds) {
    const auto build = [&]<Lock L>(std::type_identity<L>) -> std::function<void()> {
        return [=] {
            typename BasicQueueBuilder<CountTasks, L>::Config config;
            config.threads = threads;
            config.condition = condition;
            do_not_optimize(BasicQueueBuilder<CountTasks, L>::template build<3>(triangles, config));
        };
    };
    const std::vector<std::function<void()>> candidates{
        build(std::type_identity<Spinlock<CpuPause>>{}), build(std::type_identity<MonitorLock>{})};
    std::vector<Times> times = interleaved_times(candidates, rounds);
    return {.scene = scene,
            .triangles = triangles.size(),
            .threads = threads,
            .is_all_queued = condition == QueueCondition::threads_to_threads,
            .spinlock_ms = std::move(times[0]),
            .monitor_ms = std::move(times[1])};
}

}  // namespace

MachineMeasurements measure_machine(const Options& options) {
    MachineMeasurements measured{.machines = machine_rows(), .lost = {}, .locks = {}, .queues = {}};
    measured.lost.push_back(lost_updates<NoLock>("none"));
    for_each_lock([&]<Lock L>(const char* name, std::type_identity<L>) {
        measured.lost.push_back(lost_updates<L>(name));
    });
    if (options.small || options.counts) return measured;
    const Effort amount = effort(options);
    measured.locks = measure_locks(amount);
    for (const std::string& scene : amount.scenes) {
        const std::vector<Triangle> triangles = make_scene(scene, options.seed).mesh.triangles();
        for (const unsigned threads : {2u, 4u})
            measured.queues.push_back(measure_queue(scene, triangles, threads,
                                                    QueueCondition::combined, amount.build_rounds));
        // 8^8: the queue is never as long, so every node goes through it.
        measured.queues.push_back(measure_queue(
            scene, triangles, 8, QueueCondition::threads_to_threads, amount.build_rounds / 3));
    }
    return measured;
}

}  // namespace space::ch08
