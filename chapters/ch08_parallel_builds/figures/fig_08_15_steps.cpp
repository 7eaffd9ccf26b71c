// Our build, step by step: all cores at the large nodes, then tasks that idle cores steal.

#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace space::ch08 {
namespace {

using Doing = CoreRun::Doing;

constexpr unsigned stealing_cores = 3;
constexpr ParallelMethod stealing_method{
    .kind = ParallelMethod::Kind::stealing, .large = 12, .chunk = 6, .grain = 2};

/// A simulated build, moment after moment.
class StealingPlay {
  public:
    StealingPlay() {
        const std::vector<MadeBy> made = makers(graph_, schedule_);
        for (std::uint32_t i = 0; i < made.size(); ++i)
            spans_.push_back({made[i].core, made[i].begin, made[i].end, false});
        for (const CoreRun& run : schedule_.runs) {
            if (run.doing != Doing::chunk) continue;
            Span& span = spans_[run.node];
            span.begin = span.by_all ? std::min(span.begin, run.begin) : run.begin;
            span.end = std::max(span.by_all ? span.end : run.end, run.end);
            span.by_all = true;
        }
        parents_.resize(graph_.nodes.size());
        for (std::uint32_t i = 0; i < graph_.nodes.size(); ++i)
            if (const TaskNode& node = graph_.nodes[i]; !node.is_leaf())
                parents_[node.first] = parents_[node.first + 1] = i;
    }
    void draw(Svg& svg) const;

  private:
    /// From when to when somebody makes a node.
    struct Span {
        unsigned core;
        double begin, end;
        bool by_all;
    };
    std::string tells(const CoreRun& run) const;
    void draw_tree(Svg& svg, double time) const;
    void draw_time(Svg& svg, double time) const;

    TaskGraph graph_ = lopsided_graph();
    Schedule schedule_ = simulate(graph_, stealing_method, stealing_cores, {.steal = 2.0});
    std::vector<Span> spans_;
    std::vector<std::uint32_t> parents_;
};

std::string StealingPlay::tells(const CoreRun& run) const {
    const TaskNode& node = graph_.nodes[run.node];
    const std::string task = fmt::format("node {} ({} segment{})", run.node, node.triangles,
                                         node.triangles == 1 ? "" : "s");
    switch (run.doing) {
        case Doing::chunk:
            return fmt::format("Core {} takes a part of {}.", run.core, task);
        case Doing::stealing:
            return fmt::format("Core {} has nothing to do, and steals.", run.core);
        case Doing::subtree:
            if (!node.is_leaf())
                return fmt::format("Core {} makes {} and all below.", run.core, task);
            [[fallthrough]];
        case Doing::node:
            return fmt::format(
                "Core {} makes {}{}", run.core, task,
                node.is_leaf() ? ", a leaf." : ": its sides will be tasks, on the core's deque.");
        default:
            return "";
    }
}

/// Outlined while somebody makes it, filled when it stands; grey where it waits.
void StealingPlay::draw_tree(Svg& svg, double time) const {
    const std::vector<Point2> places =
        tree_places(graph_, {.corner = at(26, 26), .slot = 39, .level = 42});
    draw_edges(svg, graph_, places, [&](std::size_t i) { return spans_[i].end <= time; });
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        const Span& span = spans_[i];
        if (i > 0 && spans_[parents_[i]].end > time) continue;
        const Ink ink = span.begin > time ? Ink::quiet
                        : span.by_all     ? Ink::ink
                                          : core_ink(span.core);
        draw_task(svg, graph_.nodes[i], places[i], ink, span.end <= time, std::to_string(i));
    }
}

/// What each core has done so far.
void StealingPlay::draw_time(Svg& svg, double time) const {
    constexpr double left = 90, top = 326, row = 30, width = 560;
    const auto x = [&](double t) { return left + width * t / schedule_.makespan; };
    for (unsigned core = 0; core < stealing_cores; ++core)
        svg.line(at(left, top + row * core + row - 2), at(left + width, top + row * core + row - 2),
                 {.stroke = Ink::faint});
    for (const CoreRun& run : schedule_.runs) {
        if (run.begin >= time) continue;
        const bool steals = run.doing == Doing::stealing;
        if (!steals && !is_work(run.doing)) continue;
        const double end = std::min(run.end, time);
        svg.rect(at(x(run.begin), top + row * run.core), at(x(end) - x(run.begin), row - 4),
                 {.stroke = Ink::paper,
                  .fill = steals ? Ink::faint : core_ink(run.core),
                  .opacity = steals ? 1.0 : 0.45});
        if (!steals && run.end <= time && x(run.end) - x(run.begin) > 26)
            svg.text(at(0.5 * (x(run.begin) + x(run.end)), top + row * run.core + 19),
                     std::to_string(run.node), {.size = 17, .bold = true});
    }
    svg.line(at(x(time), top - 8), at(x(time), top + row * stealing_cores + 2),
             {.stroke = Ink::ink, .dashed = true});
}

void StealingPlay::draw(Svg& svg) const {
    for (unsigned core = 0; core < stealing_cores; ++core)
        svg.text(at(10, 345 + 30.0 * core), fmt::format("core {}", core),
                 {.anchor = Anchor::start, .ink = core_ink(core), .bold = true});
    draw_moments(
        svg, schedule_, [&](const CoreRun& run) { return tells(run); },
        fmt::format("All {} nodes stand after {} units of time; one core would take {}, and three "
                    "at best a third of that.",
                    graph_.nodes.size(), svg_number(schedule_.makespan),
                    svg_number(graph_.total())),
        [&](double time) {
            draw_tree(svg, time);
            draw_time(svg, time);
        });
}

}  // namespace

Svg fig_08_15(const Options&) {
    Svg svg(
        "A tree of 16 segments, built by three cores that steal work from each other, step by step",
        670, 426);
    StealingPlay().draw(svg);
    return svg;
}

}  // namespace space::ch08
