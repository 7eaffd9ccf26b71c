// Figure 14 of BvhThesis13, step by step: a queue of nodes, and threads that take them.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/record_tasks.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace space::ch08 {
namespace {

using Doing = CoreRun::Doing;

constexpr unsigned queue_cores = 2;
constexpr ParallelMethod queue_method{.kind = ParallelMethod::Kind::queue,
                                      .condition = ParallelMethod::Condition::depth,
                                      .deepest = 1};

/// A simulated build, moment after moment.
class QueuePlay {
  public:
    void draw(Svg& svg) const;

  private:
    /// From when to when a node is in the queue; none that is made by who made its parent.
    struct Stay {
        double from, to;
    };
    std::optional<Stay> stay(std::uint32_t node) const;
    std::vector<std::uint32_t> queue(double time) const;
    std::string tells(const CoreRun& run) const;
    void draw_tree(Svg& svg, double time) const;
    void draw_queue(Svg& svg, double time) const;

    bool puts(const CoreRun& run) const {
        return run.doing == Doing::locked && (run.node != 0 || run.end == first_put_);
    }

    TaskGraph graph_ = counted_tasks<2>(heinonen_segments(), {1.0, 1.0, 0.0},
                                        {.costs = {1.0, 1.0}, .max_leaf_size = 1});
    Schedule schedule_ = simulate(graph_, queue_method, queue_cores, {.lock = 1.0});
    std::vector<MadeBy> made_ = makers(graph_, schedule_);
    double first_put_ = made_[0].end + 1.0;
};

std::optional<QueuePlay::Stay> QueuePlay::stay(std::uint32_t node) const {
    for (std::uint32_t parent = 0; parent < graph_.nodes.size(); ++parent) {
        const TaskNode& above = graph_.nodes[parent];
        if (above.is_leaf() || (above.first != node && above.first + 1 != node)) continue;
        for (const CoreRun& run : schedule_.runs)
            if (puts(run) && run.node == parent) return Stay{run.end, made_[node].begin};
    }
    return {};
}

/// In the order in which they came.
std::vector<std::uint32_t> QueuePlay::queue(double time) const {
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t node = 1; node < graph_.nodes.size(); ++node)
        if (const auto is = stay(node); is && is->from <= time && time < is->to)
            nodes.push_back(node);
    std::ranges::stable_sort(nodes, {}, [&](std::uint32_t node) { return stay(node)->from; });
    return nodes;
}

std::string QueuePlay::tells(const CoreRun& run) const {
    const std::string core = fmt::format("Core {} ", run.core);
    const auto makes = [&] { return core + fmt::format("makes node {}", run.node); };
    switch (run.doing) {
        case Doing::node:
        case Doing::subtree:
            if (graph_.nodes[run.node].is_leaf()) return makes() + ", a leaf.";
            if (run.doing == Doing::node) return makes() + ".";
            return makes() +
                   fmt::format(", deeper than level {}, and all below it.", queue_method.deepest);
        case Doing::starting:
            return core + "starts core 1.";
        case Doing::lock_wait:
            return core + "waits for the lock.";
        case Doing::locked:
            if (puts(run))
                return core + fmt::format(
                                  "holds the lock and puts node {}'s children into the "
                                  "queue.",
                                  run.node);
            return core + "holds the lock and takes the first node.";
        default:
            return "";
    }
}

void QueuePlay::draw_tree(Svg& svg, double time) const {
    const std::vector<Point2> places =
        tree_places(graph_, {.corner = at(26, 96), .slot = 56, .level = 62});
    draw_edges(svg, graph_, places, [&](std::size_t i) { return made_[i].end <= time; });
    const std::vector<std::uint32_t> waiting = queue(time);
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        const bool is_done = made_[i].end <= time, has_begun = made_[i].begin <= time;
        const bool waits = std::ranges::find(waiting, i) != waiting.end();
        if (!has_begun && !waits) continue;
        draw_task(svg, graph_.nodes[i], places[i], has_begun ? core_ink(made_[i].core) : Ink::quiet,
                  is_done, std::to_string(i));
    }
}

void QueuePlay::draw_queue(Svg& svg, double time) const {
    double x = 86;
    for (const std::uint32_t node : queue(time)) {
        svg.rect(at(x, 16), at(34, 34), {.stroke = Ink::quiet});
        svg.text(at(x + 17, 39), std::to_string(node), {});
        x += 40;
    }
    double y = 120;
    for (const CoreRun& run : schedule_.runs) {
        if (run.begin > time || run.end <= time) continue;
        y = 120 + 60.0 * run.core;
        const std::string what = run.doing == Doing::locked      ? (puts(run) ? "puts" : "takes")
                                 : run.doing == Doing::lock_wait ? "waits"
                                 : run.doing == Doing::node      ? fmt::format("node {}", run.node)
                                                            : fmt::format("{} and below", run.node);
        svg.text(at(560, y), what, {.anchor = Anchor::start, .ink = core_ink(run.core)});
    }
}

void QueuePlay::draw(Svg& svg) const {
    svg.text(at(10, 39), "queue", {.anchor = Anchor::start, .bold = true});
    svg.line(at(80, 10), at(80, 56), {.stroke = Ink::ink});
    for (unsigned core = 0; core < queue_cores; ++core)
        svg.text(at(470, 120 + 60.0 * core), fmt::format("core {}:", core),
                 {.anchor = Anchor::start, .ink = core_ink(core), .bold = true});
    draw_moments(
        svg, schedule_, [&](const CoreRun& run) { return tells(run); },
        fmt::format("The queue is empty and nobody works: {} nodes after {} units of time, "
                    "of which one core would take {}.",
                    graph_.nodes.size(), svg_number(schedule_.makespan),
                    svg_number(graph_.total())),
        [&](double time) {
            draw_tree(svg, time);
            draw_queue(svg, time);
        });
}

}  // namespace

Svg fig_08_08(const Options&) {
    Svg svg(
        "A queue of nodes, and two cores that take nodes from it and put their children there, "
        "step by step",
        680, 316);
    QueuePlay().draw(svg);
    return svg;
}

}  // namespace space::ch08
