#include "chapters/ch09_instancing_and_motion/measured/motion.hpp"
#include "common/measure.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace space::ch09 {
namespace {

std::string twice_or(double ratio) {
    return fmt::format("{:.{}f}", ratio, ratio < 9.95 ? 2 : ratio < 99.5 ? 1 : 0);
}

Table works_table(const std::vector<RefitPoint>& refits) {
    Table table({"scene", "triangles", "nodes", "binned, a triangle", "refitted, a triangle",
                 "work, build / refit"});
    for (const RefitPoint& p : refits)
        table.row({p.scene, with_commas(p.n), with_commas(p.nodes),
                   fixed(double(p.binned) / double(p.n), 1), "1", fixed(p.work_ratio(), 0)});
    return table;
}

/// In milliseconds.
Table refits_table(const std::vector<RefitPoint>& refits) {
    Table table({"scene", "build by bins", "by Morton codes", "refit, chapter 7", "fetched between",
                 "refit", "with rotations", "build / refit"});
    for (const RefitPoint& p : refits)
        table.row({p.scene, fixed(p.build_ms, 1), fixed(p.morton_ms, 1), fixed(p.two_passes_ms, 2),
                   fixed(p.fetched_between_ms, 2), fixed(p.refit_ms, 2), fixed(p.rotate_ms, 2),
                   fixed(p.ratio(), 1)});
    return table;
}

Table units_table(const std::vector<RefitPoint>& refits) {
    Table table(
        {"scene", "triangles", "ns of a unit", "a binned reference", "a refitted triangle"});
    for (const RefitPoint& p : refits)
        table.row({p.scene, with_commas(p.n), fixed(p.ns_per_unit, 1), fixed(p.binned_units(), 1),
                   fixed(p.refitted_units(), 1)});
    return table;
}

Table scatters_table(const std::vector<ScatterPoint>& scatters) {
    Table table({"moved by up to", "nodes per ray, new tree = 1", "published",
                 "tests per ray, new tree = 1", "rays", "other answers"});
    for (const ScatterPoint& p : scatters)
        table.row({fmt::format("{}", p.length), twice_or(p.nodes), fmt::format("{}", p.published),
                   twice_or(p.tests), with_commas(p.rays), with_commas(p.wrong)});
    return table;
}

const FramePoint& frame_of(const std::vector<FramePoint>& frames, const FramePoint& like,
                           std::string_view way) {
    return *std::ranges::find_if(frames, [&](const FramePoint& p) {
        return p.motion == like.motion && p.frame == like.frame && p.way == way;
    });
}
double over_new(const std::vector<FramePoint>& frames, const FramePoint& point) {
    return point.per_ray() / frame_of(frames, point, built_anew).per_ray();
}
std::size_t last_frame(const std::vector<FramePoint>& frames) {
    std::size_t last = 0;
    for (const FramePoint& p : frames) last = std::max(last, p.frame);
    return last;
}

/// What rays cost, built anew and as many times as much.
Table frames_table(const std::vector<FramePoint>& frames) {
    Table table({"motion", "frame", "nodes", "tests", "refitted", "with rotations", "leaves of one",
                 "rotations", "depth"});
    const std::size_t last = last_frame(frames), step = std::max<std::size_t>(last / 4, 1);
    for (const FramePoint& anew : frames) {
        if (anew.way != built_anew || (anew.frame % step != 0 && anew.frame != 1)) continue;
        const FramePoint &follows = frame_of(frames, anew, refitted),
                         &turns = frame_of(frames, anew, rotated),
                         &singly = frame_of(frames, anew, rotated_singly);
        table.row({fmt::format("{} ({})", anew.motion, anew.scene), with_commas(anew.frame),
                   fixed(anew.nodes_per_ray(), 1), fixed(anew.tests_per_ray(), 1),
                   twice_or(over_new(frames, follows)), twice_or(over_new(frames, turns)),
                   twice_or(over_new(frames, singly)), with_commas(turns.rotations),
                   with_commas(turns.depth)});
    }
    return table;
}

std::vector<std::string> policy_names(const std::vector<PolicyPoint>& policies) {
    std::vector<std::string> names;
    for (const PolicyPoint& p : policies)
        if (std::ranges::count(names, p.policy) == 0) names.push_back(p.policy);
    return names;
}
const PolicyPoint& policy_of(const std::vector<PolicyPoint>& policies, const PolicyPoint& like,
                             std::string_view policy) {
    return *std::ranges::find_if(policies, [&](const PolicyPoint& p) {
        return p.motion == like.motion && p.rays_per_triangle == like.rays_per_triangle &&
               p.policy == policy;
    });
}

/// What all frames cost, the best in hindsight = 1.
Table policies_table(const std::vector<PolicyPoint>& policies) {
    const std::vector<std::string> names = policy_names(policies);
    std::vector<std::string> headings{"motion", "rays", "builds of the best"};
    headings.insert(headings.end(), names.begin() + 1, names.end());
    Table table(std::move(headings));
    for (const PolicyPoint& best : policies) {
        if (best.policy != names.front()) continue;
        std::vector<std::string> cells{std::string(best.motion),
                                       fmt::format("{}", best.rays_per_triangle),
                                       fmt::format("{} of {}", best.builds, best.frames)};
        for (std::size_t i = 1; i < names.size(); ++i)
            cells.push_back(twice_or(policy_of(policies, best, names[i]).over_best()));
        table.row(std::move(cells));
    }
    return table;
}

/// The worst that a policy does, over all motions and numbers of rays.
double worst_of(const std::vector<PolicyPoint>& policies, std::string_view policy) {
    double worst = 0.0;
    for (const PolicyPoint& p : policies)
        if (p.policy == policy) worst = std::max(worst, p.over_best());
    return worst;
}
Table worst_table(const std::vector<PolicyPoint>& policies) {
    Table table({"policy", "at worst, the best = 1", "on average"});
    for (const std::string& name : policy_names(policies)) {
        double sum = 0.0, count = 0.0;
        for (const PolicyPoint& p : policies)
            if (p.policy == name) sum += p.over_best(), count += 1.0;
        table.row({name, twice_or(worst_of(policies, name)), twice_or(sum / count)});
    }
    return table;
}

Table crowd_table(const std::vector<CrowdPoint>& crowd) {
    Table table({"way", "boxes a frame", "bytes", "nodes per ray", "tests per ray", "rays",
                 "other answers"});
    for (const CrowdPoint& p : crowd)
        table.row({std::string(p.way), with_commas(p.boxes), with_commas(p.bytes),
                   fixed(p.nodes_per_ray(), 1), fixed(p.tests_per_ray(), 1), with_commas(p.rays),
                   with_commas(p.wrong)});
    return table;
}

Table crowd_times_table(const std::vector<CrowdPoint>& crowd) {
    Table table({"way", "update of a frame, ms", "µs of a ray"});
    for (const CrowdPoint& p : crowd)
        table.row({std::string(p.way), fixed(p.update_ms, 2),
                   fixed(1e3 * p.trace_ms * double(p.frames) / double(p.rays), 2)});
    return table;
}

const CrowdPoint& crowd_of(const std::vector<CrowdPoint>& crowd, std::string_view way) {
    return *std::ranges::find(crowd, way, &CrowdPoint::way);
}

/// What the text says of the last frames.
void quote_frames(const std::vector<FramePoint>& frames, Numbers& numbers) {
    std::uint64_t answers = 0, wrong = 0;
    for (const FramePoint& p : frames) {
        if (p.way == built_anew) continue;
        answers += p.rays;
        wrong += p.wrong;
        if (p.frame != last_frame(frames)) continue;
        const std::string way = p.way == refitted ? "refit" : p.way == rotated ? "rotated" : "one";
        numbers.count(fmt::format("{}_{}", p.motion, way), over_new(frames, p),
                      twice_or(over_new(frames, p)));
    }
    numbers.count("motion_answers", answers);
    numbers.count("motion_wrong", wrong);
    numbers.count("motion_frames", last_frame(frames));
}

}  // namespace

void print_motion(const MotionMeasurements& measured, bool times) {
    const auto print = [](const std::string& heading, const Table& table) {
        print_heading(heading);
        table.print();
    };
    print("Building anew, and refitting: what has to be done", works_table(measured.refits));
    if (times) {
        print("The same by the clock, in ms", refits_table(measured.refits));
        print("Work in units of a triangle test", units_table(measured.refits));
    }
    print("Triangles moved by random vectors: refitted trees", scatters_table(measured.scatters));
    print("Frame by frame: what rays cost in new trees, and in others as many times as much",
          frames_table(measured.frames));
    if (!measured.policies.empty()) {
        print(
            "When to build anew: all frames' cost against rays a triangle, the best in hindsight = "
            "1",
            policies_table(measured.policies));
        print("The same at worst", worst_table(measured.policies));
    }
    print(fmt::format("A crowd of {} walkers: {} triangles", measured.crowd.front().walkers,
                      with_commas(measured.crowd.front().n)),
          crowd_table(measured.crowd));
    if (times) print("The same by the clock", crowd_times_table(measured.crowd));
}

void quote_motion(const MotionMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count_table("refit_work", works_table(measured.refits));
    numbers.count_table("scatters", scatters_table(measured.scatters));
    numbers.count_table("frames", frames_table(measured.frames));
    quote_frames(measured.frames, numbers);
    if (!measured.policies.empty()) {
        numbers.count_table("policies", policies_table(measured.policies));
        numbers.count_table("policies_worst", worst_table(measured.policies));
        numbers.count("policy_frames", measured.policies.front().frames);
        for (const auto& [name, policy] : {std::pair{"rent_worst", "rent or buy"},
                                           {"cost_worst", "cost > 1.5"},
                                           {"never_worst", "never"},
                                           {"always_worst", "always"},
                                           {"every_worst", "every 10 frames"}})
            numbers.count(name, worst_of(measured.policies, policy),
                          twice_or(worst_of(measured.policies, policy)));
    }
    numbers.count("unit_binned", MotionUnits::binned, fixed(MotionUnits::binned, 1));
    numbers.count("unit_refitted", MotionUnits::refitted, fixed(MotionUnits::refitted, 1));
    numbers.count_table("crowd", crowd_table(measured.crowd));
    numbers.count("crowd_walkers", measured.crowd.front().walkers);
    numbers.count("crowd_triangles", measured.crowd.front().n);
    if (!times) return;
    numbers.time_table("refits", refits_table(measured.refits));
    numbers.time_table("motion_units", units_table(measured.refits));
    numbers.time_table("crowd_times", crowd_times_table(measured.crowd));
    double least = std::numeric_limits<double>::infinity(), with_rotations = least, fetched = 0.0,
           rotating = 0.0;
    for (const RefitPoint& p : measured.refits) {
        least = std::min(least, p.ratio());
        with_rotations = std::min(with_rotations, p.build_ms / p.rotate_ms);
        fetched = std::max(fetched, p.fetched_between_ms / p.refit_ms);
        rotating = std::max(rotating, p.rotate_ms / p.refit_ms);
    }
    // "At least so many times": rounded down.
    numbers.time("refit_gain", least, fixed(std::floor(least), 0));
    numbers.time("rotate_gain", with_rotations, fixed(std::floor(with_rotations), 0));
    numbers.time("fetch_gain", fetched, fixed(fetched, 1));
    numbers.time("rotate_cost", rotating, fixed(rotating, 1));
    const double crowd_gain = crowd_of(measured.crowd, refitted).update_ms /
                              crowd_of(measured.crowd, two_levels).update_ms;
    numbers.time("crowd_gain", crowd_gain, fixed(crowd_gain, 0));
}

std::vector<ClaimAnswer> answer_motion(const MotionMeasurements& measured) {
    constexpr double much = 10.0;
    std::vector<std::string> texts, scenes;
    std::size_t agree = 0;
    for (const RefitPoint& p : measured.refits) {
        const bool is_timed = p.refit_ms > 0.0;
        agree += (is_timed ? p.ratio() : p.work_ratio()) >= much;
        scenes.push_back(p.scene);
        texts.push_back(is_timed ? fmt::format("{} {:.1f} ms / {:.2f} ms = {:.0f}", p.scene,
                                               p.build_ms, p.refit_ms, p.ratio())
                                 : fmt::format("{} {:.0f} (by work)", p.scene, p.work_ratio()));
    }
    std::vector<std::string> later;
    for (const FramePoint& p : measured.frames)
        if (p.way == refitted && p.frame == last_frame(measured.frames))
            later.push_back(fmt::format("{} {}", p.motion, twice_or(over_new(measured.frames, p))));
    return {
        {"O11", verdict_of(agree, measured.refits.size()),
         fmt::format("binned build over refit: {}. What rays cost after {} frames, a new tree "
                     "= 1: {}",
                     fmt::join(texts, "; "), last_frame(measured.frames), fmt::join(later, ", ")),
         joined(scenes),
         fmt::format("confirmed if a build takes at least {:.0f} times as long as a refit on "
                     "each scene, refuted if on none",
                     much)}};
}

// --- charts ---

Chart motion_frames_chart(const std::vector<FramePoint>& frames) {
    Chart chart{.title = "What a ray costs as the motion goes on, beside a tree built anew",
                .x_label = "frame",
                .y_label = "cost of a ray, new tree = 1",
                .log_y = true,
                .series = {}};
    const std::size_t step = std::max<std::size_t>(last_frame(frames) / 15, 1);
    const auto add = [&](std::string_view motion, std::string_view way, const char* name) {
        Series series{.name = fmt::format("{}, {}", motion, name), .x = {}, .y = {}};
        for (const FramePoint& p : frames) {
            if (p.motion != motion || p.way != way || p.frame % step != 0) continue;
            series.x.push_back(double(p.frame));
            series.y.push_back(over_new(frames, p));
        }
        chart.series.push_back(std::move(series));
    };
    add("explosion", refitted, "refit");
    add("explosion", rotated, "rotations");
    add("explosion", rotated_singly, "leaves of one");
    add("twist", refitted, "refit");
    add("twist", rotated, "rotations");
    add("wave", refitted, "refit");
    return chart;
}

Chart motion_policies_chart(const std::vector<PolicyPoint>& policies) {
    Chart chart{.title = "What policies cost against the number of rays, the worst of all motions",
                .x_label = "rays a frame, for each triangle",
                .y_label = "cost of all frames, best in hindsight = 1",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string& name : policy_names(policies)) {
        // Six lines have six colours; the table has them all.
        if (name == policy_names(policies).front() || name == "cost > 2.0") continue;
        Series series{.name = name, .x = {}, .y = {}};
        for (const PolicyPoint& p : policies) {
            if (p.policy != name) continue;
            const auto at = std::ranges::find(series.x, p.rays_per_triangle);
            if (at == series.x.end()) {
                series.x.push_back(p.rays_per_triangle);
                series.y.push_back(p.over_best());
            } else {
                double& worst = series.y[std::size_t(at - series.x.begin())];
                worst = std::max(worst, p.over_best());
            }
        }
        chart.series.push_back(std::move(series));
    }
    return chart;
}

Chart motion_refits_chart(const std::vector<RefitPoint>& refits) {
    Chart chart{.title = "Times of builds and refits against triangles",
                .x_label = "triangles (soup)",
                .y_label = "ms",
                .log_x = true,
                .log_y = true,
                .series = {}};
    const auto add = [&](const char* name, double RefitPoint::*ms) {
        Series series{.name = name, .x = {}, .y = {}};
        for (const RefitPoint& p : refits) {
            if (!p.scene.starts_with("soup")) continue;
            series.x.push_back(double(p.n));
            series.y.push_back(p.*ms);
        }
        chart.series.push_back(with_slope(std::move(series)));
    };
    add("binned build", &RefitPoint::build_ms);
    add("Morton build", &RefitPoint::morton_ms);
    add("fetched between", &RefitPoint::fetched_between_ms);
    add("refit with rotations", &RefitPoint::rotate_ms);
    add("refit", &RefitPoint::refit_ms);
    return chart;
}

}  // namespace space::ch09
