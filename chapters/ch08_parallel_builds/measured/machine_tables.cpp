#include "chapters/ch08_parallel_builds/measured/machine.hpp"
#include "chapters/ch08_parallel_builds/measured/timing.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace space::ch08 {
namespace {

Table machines_table(const std::vector<MachineRow>& machines) {
    Table table({"machine", "by", "thread bits", "core bits", "room for cores", "packages", "cores",
                 "threads"});
    for (const MachineRow& row : machines)
        table.row({row.name, row.from, fmt::format("{}", row.thread_bits),
                   fmt::format("{}", row.core_bits), with_commas(row.room_for_cores()),
                   with_commas(row.packages), with_commas(row.cores), with_commas(row.threads)});
    return table;
}

Table lost_table(const std::vector<LostUpdates>& lost) {
    Table table({"lock", "updates", "lost"});
    for (const LostUpdates& each : lost)
        table.row({each.lock, with_commas(each.updates), with_commas(each.lost)});
    return table;
}

Table locks_table(const std::vector<LockPoint>& locks) {
    Table table({"lock", "alone, ns", "2 threads", "4", "8", "cores burnt", "others' work"});
    for (const LockPoint& point : locks)
        table.row({point.lock, fixed(point.alone_ns, 1), fixed(point.contended_ns[0], 0),
                   fixed(point.contended_ns[1], 0), fixed(point.contended_ns[2], 0),
                   fixed(point.burnt, 2), percent(point.others)});
    return table;
}

Table queues_table(const std::vector<QueueLockPoint>& queues) {
    Table table({"scene", "triangles", "threads", "queued", "spinlock, ms", "monitor, ms",
                 "monitor / spinlock", "middle half"});
    for (const QueueLockPoint& point : queues) {
        const Spread gain = ratio(point.monitor_ms, point.spinlock_ms);
        table.row({point.scene, with_commas(point.triangles), fmt::format("{}", point.threads),
                   point.is_all_queued ? "all nodes" : "as published",
                   fixed(median(point.spinlock_ms), 1), fixed(median(point.monitor_ms), 1),
                   fixed(gain.median, 3), fmt::format("{:.3f} to {:.3f}", gain.low, gain.high)});
    }
    return table;
}

const LockPoint* lock_named(const MachineMeasurements& measured, std::string_view name) {
    for (const LockPoint& point : measured.locks)
        if (point.lock == name) return &point;
    return nullptr;
}

}  // namespace

void print_machine(const MachineMeasurements& measured, bool times) {
    print_heading("Machines, by what cpuid says of them");
    machines_table(measured.machines).print();
    print_heading("A counter, into whose update another thread comes");
    lost_table(measured.lost).print();
    if (!times) return;
    print_heading("Locks: a turn, and two that wait for a holder that sleeps");
    locks_table(measured.locks).print();
    print_heading("The queue's lock");
    queues_table(measured.queues).print();
}

void quote_machine(const MachineMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count_table("machines", machines_table(measured.machines));
    numbers.count_table("lost_updates", lost_table(measured.lost));
    numbers.count("updates", measured.lost.front().updates);
    numbers.count("updates_lost", measured.lost.front().lost);
    if (!times || measured.locks.empty()) return;
    numbers.time_table("locks", locks_table(measured.locks));
    numbers.time_table("queue_locks", queues_table(measured.queues));
    for (const auto& [key, name] :
         {std::pair{"spinlock", "spinlock"}, {"mutex", "std::mutex"}, {"monitor", "monitor"}}) {
        const LockPoint& point = *lock_named(measured, name);
        numbers.time(fmt::format("{}_alone_ns", key), point.alone_ns, fixed(point.alone_ns, 0));
        numbers.time(fmt::format("{}_two_ns", key), point.contended_ns[0],
                     fixed(point.contended_ns[0], 0));
        numbers.time(fmt::format("{}_eight_ns", key), point.contended_ns[2],
                     fixed(point.contended_ns[2], 0));
        numbers.time(fmt::format("{}_burnt", key), point.burnt, fixed(point.burnt, 1));
        numbers.time(fmt::format("{}_others", key), point.others, percent(point.others));
    }
}

std::vector<ClaimAnswer> answer_machine(const MachineMeasurements& measured) {
    std::vector<std::string> texts, scenes;
    std::size_t agree = 0, published = 0;
    for (const QueueLockPoint& point : measured.queues) {
        const Spread gain = ratio(point.monitor_ms, point.spinlock_ms);
        if (!point.is_all_queued) {
            ++published;
            agree += std::abs(gain.median - 1.0) <= 0.05;
            if (scenes.empty() || scenes.back() != point.scene) scenes.push_back(point.scene);
        }
        texts.push_back(fmt::format("{}, {} threads{}: {:.3f} ({:.3f} to {:.3f})", point.scene,
                                    point.threads,
                                    point.is_all_queued ? ", every node through the queue" : "",
                                    gain.median, gain.low, gain.high));
    }
    if (texts.empty()) texts.emplace_back("nothing is timed in this run");
    if (scenes.empty()) scenes.emplace_back("none");
    return {
        {"P13", published == 0 ? Verdict::depends : verdict_of(agree, published),
         fmt::format("build time with a monitor around the queue over that with a spinlock, "
                     "median of interleaved rounds (middle half): {}",
                     fmt::format("{}", fmt::join(texts, "; "))),
         joined(scenes),
         "confirmed if the medians differ by at most a twentieth on every scene with the published "
         "conditions, refuted if on none"}};
}

}  // namespace space::ch08
