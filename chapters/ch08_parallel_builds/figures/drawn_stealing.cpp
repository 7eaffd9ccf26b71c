#include "chapters/ch08_parallel_builds/figures/drawn_stealing.hpp"

#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch08 {
namespace {

using Doing = CoreRun::Doing;

/// Some cores, and the part of the work that is each one's at best.
struct CoreWords {
    std::string_view cores, share;
};
constexpr std::array<CoreWords, 7> core_words{{{"two", "half"},
                                               {"three", "a third"},
                                               {"four", "a quarter"},
                                               {"five", "a fifth"},
                                               {"six", "a sixth"},
                                               {"seven", "a seventh"},
                                               {"eight", "an eighth"}}};
const CoreWords& words_of(const Schedule& schedule) {
    return core_words.at(schedule.cores - 2);
}

/// A simulated build, moment after moment.
class StealingPlay {
  public:
    StealingPlay(const TaskGraph& graph, const Schedule& schedule)
        : graph_(graph), schedule_(schedule) {
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

    const TaskGraph& graph_;
    const Schedule& schedule_;
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
    for (unsigned core = 0; core < schedule_.cores; ++core)
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
    svg.line(at(x(time), top - 8), at(x(time), top + row * schedule_.cores + 2),
             {.stroke = Ink::ink, .dashed = true});
}

void StealingPlay::draw(Svg& svg) const {
    for (unsigned core = 0; core < schedule_.cores; ++core)
        svg.text(at(10, 345 + 30.0 * core), fmt::format("core {}", core),
                 {.anchor = Anchor::start, .ink = core_ink(core), .bold = true});
    draw_moments(
        svg, schedule_, [&](const CoreRun& run) { return tells(run); },
        fmt::format("All {} nodes stand after {} units of time; one core would take {}, and {} "
                    "at best {} of that.",
                    graph_.nodes.size(), svg_number(schedule_.makespan), svg_number(graph_.total()),
                    words_of(schedule_).cores, words_of(schedule_).share),
        [&](double time) {
            draw_tree(svg, time);
            draw_time(svg, time);
        });
}

}  // namespace

Svg drawn_stealing(const TaskGraph& graph, const Schedule& schedule) {
    Svg svg(fmt::format("A tree of 16 segments, built by {} cores that steal work from each other, "
                        "step by step",
                        words_of(schedule).cores),
            670, 336 + 30.0 * schedule.cores);
    StealingPlay(graph, schedule).draw(svg);
    return svg;
}

}  // namespace space::ch08
