#include "chapters/ch08_parallel_builds/measured/build_series.hpp"
#include "chapters/ch08_parallel_builds/measured/builds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <tuple>

namespace space::ch08 {
namespace {

/// Gains of the published methods with 2 threads, as measured here.
std::vector<double> published_gains(const std::vector<BuildPoint>& scenes) {
    std::vector<double> gains;
    for (const BuildPoint& p : scenes)
        if (p.threads == 2 && std::ranges::count(published_methods, p.method) > 0)
            gains.push_back(p.gain.median);
    return gains;
}

void quote_range(const std::string& name, std::vector<double> values, int digits,
                 Numbers& numbers) {
    if (values.empty()) return;
    const auto [low, high] = std::ranges::minmax(values);
    numbers.time(name + "_least", low, fmt::format("{:.{}f}", low, digits));
    numbers.time(name + "_most", high, fmt::format("{:.{}f}", high, digits));
}

}  // namespace

std::vector<ClaimAnswer> answer_builds(const BuildMeasurements& measured) {
    constexpr double least = 0.04, most = 0.46;
    std::vector<std::string> texts;
    std::size_t agree = 0, all = 0;
    for (const BuildPoint& p : measured.scenes) {
        if (p.threads != 2 || std::ranges::count(published_methods, p.method) == 0) continue;
        const double fall = 1.0 - 1.0 / p.gain.median;
        agree += least <= fall && fall <= most;
        ++all;
        const std::string published = published_fall(p.scene, p.method, 2);
        texts.push_back(
            fmt::format("{} {} {:.1f} %{}", p.scene, p.method, 100 * fall,
                        published.empty() ? "" : fmt::format(" (published {})", published)));
    }
    return {{"P8", all == 0 ? Verdict::depends : verdict_of(agree, all),
             all == 0 ? std::string("nothing is timed in this run")
                      : fmt::format("with 2 threads times fall by: {}", fmt::join(texts, "; ")),
             all == 0 ? std::string("none") : joined(scenes_of(measured.scenes)),
             "confirmed if by 4 to 46 % for each method on every scene, refuted if for none"}};
}

void quote_build_goals(const BuildMeasurements& measured, Numbers& numbers) {
    const std::vector<BuildGoal> goals = build_goals(measured.scenes);
    std::vector<double> one, two, beside, ceilings, copies;
    for (const BuildGoal& goal : goals) {
        one.push_back(goal.one.median);
        two.push_back(goal.two.median);
        if (goal.beside_embree) beside.push_back(*goal.beside_embree);
    }
    for (const CeilingPoint& p : measured.ceilings) {
        ceilings.push_back(p.gain.median);
        copies.push_back(p.copy_gain.median);
    }
    const auto met = [&](const std::string& name, std::ptrdiff_t count) {
        numbers.time(name, double(count), fmt::format("{} of {}", count, goals.size()));
    };
    met("met_twice", std::ranges::count_if(goals, &BuildGoal::is_twice));
    met("met_not_slower", std::ranges::count_if(goals, &BuildGoal::is_not_slower));
    met("met_embree", std::ranges::count_if(goals, &BuildGoal::is_near_embree));
    quote_range("ours_one", one, 2, numbers);
    quote_range("ours_two", two, 2, numbers);
    quote_range("ours_embree", beside, 2, numbers);
    quote_range("ceiling", ceilings, 2, numbers);
    quote_range("copies", copies, 2, numbers);
    quote_range("published_two", published_gains(measured.scenes), 2, numbers);
    for (const auto& [name, method, threads] : {std::tuple{"slope_sequential", sequential, 1u},
                                                {"slope_ours_one", ours, 1u},
                                                {"slope_ours_two", ours, 2u},
                                                {"slope_queue_two", by_queue, 2u}}) {
        const double slope = growth_slope(measured.growth, method, threads);
        numbers.time(name, slope, fmt::format("{:.2f}", slope));
    }
    for (const QualityPoint& p : qualities(measured.scenes)) {
        if (p.method != parallel_morton && p.method != by_sweep && p.method != morton) continue;
        const std::string name = p.method == by_sweep ? "sweep"
                                 : p.method == morton ? "morton"
                                                      : fmt::format("morton_{}", p.threads);
        numbers.time(name + "_time", p.time, fmt::format("{:.2f}", p.time));
        numbers.time(name + "_cost", p.cost, fmt::format("{:.2f}", p.cost));
    }
}

}  // namespace space::ch08
