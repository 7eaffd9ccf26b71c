#include "chapters/ch08_parallel_builds/measured/endings.hpp"

#include "chapters/ch08_parallel_builds/early_end.hpp"
#include "chapters/ch08_parallel_builds/endings.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdint>
#include <span>

namespace space::ch08 {
namespace {

/// visit(name, its queue's builder, kind) for each way to end.
template <class Visit>
void for_each_ending(const Visit& visit) {
    visit("quit when the queue is empty", BasicQueueBuilder<QuitWhenEmpty>{}, EndingKind::hasty);
    visit("poll flags twice (published)", BasicQueueBuilder<PollFlags>{}, EndingKind::published);
    visit("count unfinished tasks", BasicQueueBuilder<CountTasks>{}, EndingKind::cure);
}

template <class Builder>
void build(std::span<const Triangle> triangles, unsigned threads, auto& observer) {
    typename Builder::Config config;
    config.threads = threads;
    Builder::template build<3>(triangles, config, observer);
}

/// Who quits when, with nothing held.
class EndWatch : public NoObserver {
  public:
    explicit EndWatch(std::size_t triangles) : missing_(triangles) {}

    using NoObserver::observe;
    void observe(const BvhChosen<3>& event) {
        if (!event.cut) missing_ -= event.task.range.size();
    }
    void observe(const BvhTaken<3>& event) { workers_ |= std::uint64_t{1} << event.worker; }
    void observe(const BvhQuits&) {
        if (missing_ > 0) is_early_ = true;
    }
    bool is_early() const { return is_early_; }
    bool is_by_one() const { return std::has_single_bit(workers_.load()); }

  private:
    std::atomic<std::size_t> missing_;
    std::atomic<std::uint64_t> workers_{0};  ///< a bit for each that has taken a task
    std::atomic<bool> is_early_{false};
};

Table held_table(const EndingMeasurements& measured) {
    Table table({"workers", "threads", "that quit too early", "triangles missing then"});
    for (const HeldEnd& end : measured.held)
        table.row({std::string(end.ending), fmt::format("{}", end.threads),
                   fmt::format("{} of {}", end.too_early, end.threads - 1),
                   end.threads == 2 ? with_commas(end.most_missing) : ""});
    return table;
}

Table natural_table(const EndingMeasurements& measured) {
    Table table({"workers", "threads", "builds", "in which one quit too early",
                 "in which one did everything"});
    for (const NaturalEnds& ends : measured.natural)
        table.row({std::string(ends.ending), fmt::format("{}", ends.threads),
                   with_commas(ends.builds), percent(double(ends.with_early_quits) / ends.builds),
                   percent(double(ends.by_one_worker) / ends.builds)});
    return table;
}

}  // namespace

EndingMeasurements measure_endings(const Options& options) {
    using namespace std::chrono_literals;
    EndingMeasurements measured{.scene = options.small ? "soup:300" : "soup:3000"};
    const auto triangles = make_scene(measured.scene, options.seed).mesh.triangles();
    measured.triangles = triangles.size();
    for_each_ending([&]<class Builder>(std::string_view name, Builder, EndingKind kind) {
        for (const unsigned threads : {2u, 4u, 8u}) {
            HeldTask held(triangles.size(), threads, kind == EndingKind::cure ? 50ms : 60s);
            build<Builder>(triangles, threads, held);
            measured.held.push_back({name, kind, threads, held.too_early(), held.most_missing()});
        }
        if (options.small || options.counts) return;
        for (const unsigned threads : {2u, 4u}) {
            NaturalEnds ends{.ending = name, .threads = threads, .builds = 300};
            for (unsigned i = 0; i < ends.builds; ++i) {
                EndWatch watch(triangles.size());
                build<Builder>(triangles, threads, watch);
                ends.with_early_quits += watch.is_early();
                ends.by_one_worker += watch.is_by_one();
            }
            measured.natural.push_back(ends);
        }
    });
    return measured;
}

void print_endings(const EndingMeasurements& measured, bool times) {
    print_heading(
        fmt::format("When workers believe that a build has ended ({}, {} triangles): one "
                    "task is held between pop and flag",
                    measured.scene, with_commas(measured.triangles)));
    held_table(measured).print();
    if (!times) return;
    print_heading("The same, with nothing held");
    natural_table(measured).print();
}

void quote_endings(const EndingMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count("end_triangles", measured.triangles);
    for (const HeldEnd& end : measured.held)
        if (end.kind == EndingKind::published && end.threads == 2)
            numbers.count("end_missing", end.most_missing);
    numbers.count_table("held_ends", held_table(measured));
    if (times) numbers.time_table("natural_ends", natural_table(measured));
}

std::vector<ClaimAnswer> answer_endings(const EndingMeasurements& measured) {
    std::vector<HeldEnd> published, cure;
    for (const HeldEnd& end : measured.held) {
        if (end.kind == EndingKind::published) published.push_back(end);
        if (end.kind == EndingKind::cure) cure.push_back(end);
    }
    const auto right = std::ranges::count(published, 0u, &HeldEnd::too_early);
    unsigned by_cure = 0;
    for (const HeldEnd& end : cure) by_cure += end.too_early;
    return {{.claim = "P15",
             .verdict = verdict_of(std::size_t(right), published.size()),
             .measured = fmt::format(
                 "with one task held between pop and flag, {} of {} threads quit while {} of {} "
                 "triangles were in no leaf; with {} threads {} did; by a counter of unfinished "
                 "tasks {} did",
                 published.front().too_early, published.front().threads,
                 with_commas(published.front().most_missing), with_commas(measured.triangles),
                 published.back().threads, published.back().too_early, by_cure),
             .scene = measured.scene,
             .rule = "confirmed if in none of the forced schedules a worker quits too early, "
                     "refuted if in all"}};
}

}  // namespace space::ch08
