#include "chapters/ch11_sampling_and_caching/measured/convergence.hpp"
#include "common/measure.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>

namespace space::ch11 {
namespace {

const Convergence& scene_named(const std::vector<Convergence>& measured, std::string_view scene) {
    return *std::ranges::find(measured, scene, &Convergence::scene);
}

/// Three digits, also of long times.
std::string seconds_text(std::optional<double> seconds) {
    if (!seconds) return "never";
    if (*seconds >= 100.0) return with_commas(static_cast<std::uint64_t>(*seconds + 0.5));
    return fixed(*seconds, *seconds < 1.0 ? 3 : *seconds < 10.0 ? 2 : 1);
}
std::string gain_text(std::optional<double> gain) {
    if (!gain) return "never";
    return fmt::format("{}", *gain >= 9.95 ? with_commas(static_cast<std::uint64_t>(*gain + 0.5))
                                           : fixed(*gain, 1));
}
/// An error, or below what it is.
std::string error_text(double error, const Convergence& found) {
    return error < found.resolution ? "< " + percent(found.resolution) : percent(error);
}
bool is_random_only(const std::string& method) {
    return method.starts_with("paths");
}
std::string bias_text(const ErrorPoint& p, const Convergence& found) {
    return is_random_only(p.method) ? "none" : error_text(p.bias, found);
}
std::string slope_text(const std::vector<ErrorPoint>& line) {
    std::vector<double> x, y;
    for (const ErrorPoint& p : line)
        if (p.error > 0.0) {
            x.push_back(p.seconds);
            y.push_back(p.error);
        }
    return x.size() < 2 ? "" : fixed(log_log_slope(x, y), 2);
}

Table points_table(const Convergence& found) {
    Table table({"method", "setting", "work", "seconds", "error", "bias"});
    for (const ErrorPoint& p : found.points)
        table.row({p.method, p.setting, with_commas(p.work), seconds_text(p.seconds),
                   error_text(p.error, found), bias_text(p, found)});
    return table;
}

/// A line for each method: where it begins and ends, how steeply, and when it is good enough.
Table methods_table(const Convergence& found) {
    Table table({"method", "first", "error", "last", "error", "slope", "bias at last",
                 "seconds to " + percent(found.target)});
    for (const std::string& method : found.methods()) {
        const std::vector<ErrorPoint> line = found.of(method);
        const ErrorPoint &first = line.front(), &last = line.back();
        table.row({method, first.setting, error_text(first.error, found), last.setting,
                   error_text(last.error, found), slope_text(line), bias_text(last, found),
                   seconds_text(found.seconds_to(method, found.target))});
    }
    return table;
}

Table cache_table(const Convergence& found) {
    Table table({"setting", "records, constant", "error", "seconds", "records, gradients", "error",
                 "seconds"});
    const std::vector<ErrorPoint> constant = found.of("cache, constant"),
                                  gradients = found.of("cache, gradients");
    for (const ErrorPoint& g : gradients) {
        std::vector<std::string> row{g.setting, "", "", ""};
        const auto c = std::ranges::find(constant, g.setting, &ErrorPoint::setting);
        if (c != constant.end())
            row = {c->setting, with_commas(c->work), error_text(c->error, found),
                   seconds_text(c->seconds)};
        for (const std::string& text :
             {with_commas(g.work), error_text(g.error, found), seconds_text(g.seconds)})
            row.push_back(text);
        table.row(row);
    }
    return table;
}

/// What the chapter set out for, and what came of it.
struct ConvergenceGoal {
    const char* scene;
    const char* methods;
    double error, wanted;
};
constexpr ConvergenceGoal goals[] = {{"ring", "photons", 0.05, 10.0},
                                     {"interior", "cache", 0.02, 5.0}};

Table goals_table(const std::vector<Convergence>& measured) {
    Table table({"scene", "to an error of", "by", "seconds", "by paths", "times as fast: wanted",
                 "reached"});
    for (const ConvergenceGoal& goal : goals) {
        const Convergence& found = scene_named(measured, goal.scene);
        table.row({goal.scene, percent(goal.error), goal.methods,
                   seconds_text(found.least_seconds_to(goal.methods, goal.error)),
                   seconds_text(found.least_seconds_to("paths", goal.error)), fixed(goal.wanted, 0),
                   gain_text(found.gain(goal.methods, goal.error))});
    }
    return table;
}

/// The fastest method to each of some errors.
Table winners_table(const std::vector<Convergence>& measured) {
    Table table({"scene", "error", "fastest", "seconds", "by paths"});
    for (const Convergence& found : measured)
        for (const double error : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01}) {
            std::string fastest = "none";
            std::optional<double> least;
            for (const std::string& method : found.methods()) {
                const auto seconds = found.seconds_to(method, error);
                if (!seconds || (least && *least <= *seconds)) continue;
                least = seconds;
                fastest = method;
            }
            table.row({found.scene, percent(error), fastest, seconds_text(least),
                       seconds_text(found.seconds_to("paths", error))});
        }
    return table;
}

/// What a claim's methods gain in each scene, at its target and at five times that error.
ClaimAnswer answer(const std::vector<Convergence>& measured, const std::string& claim,
                   const std::string& methods) {
    std::size_t agree = 0, all = 0;
    std::vector<std::string> said, scenes;
    for (const Convergence& found : measured) {
        if (!found.least_seconds_to(methods, 1e9)) continue;
        scenes.push_back(found.scene);
        for (const double error : {5.0 * found.target, found.target}) {
            const std::optional<double> gain = found.gain(methods, error);
            ++all;
            agree += gain && *gain > 1.0;
            said.push_back(fmt::format("{} to {}: {}", found.scene, percent(error),
                                       gain ? gain_text(gain) + " times as fast" : "never"));
        }
    }
    return {.claim = claim,
            .verdict = verdict_of(agree, all),
            .measured = "beside paths, " + joined(said),
            .scene = joined(scenes),
            .rule =
                "faster than paths to the error that a scene is judged by and to five times "
                "that, in every scene"};
}

}  // namespace

void print_convergence(const std::vector<Convergence>& measured) {
    for (const Convergence& found : measured) {
        print_heading(fmt::format("{}: {} x {} pixels, {} judged; errors below {} are not told",
                                  found.scene, found.width, found.height, with_commas(found.judged),
                                  percent(found.resolution)));
        points_table(found).print();
        print_heading(found.scene + ": by method");
        methods_table(found).print();
    }
    print_heading("The fastest to an error");
    winners_table(measured).print();
    print_heading("Goals");
    goals_table(measured).print();
}

void quote_convergence(const std::vector<Convergence>& measured, Numbers& numbers) {
    numbers.time_table("caustic", methods_table(scene_named(measured, "ring")));
    numbers.time_table("interior", methods_table(scene_named(measured, "interior")));
    numbers.time_table("box", methods_table(scene_named(measured, "box")));
    numbers.time_table("cache_settings", cache_table(scene_named(measured, "interior")));
    numbers.time_table("winners", winners_table(measured));
    numbers.time_table("goals", goals_table(measured));
    for (const ConvergenceGoal& goal : goals) {
        const Convergence& found = scene_named(measured, goal.scene);
        const std::optional<double> gain = found.gain(goal.methods, goal.error);
        numbers.time(std::string(goal.methods) + "_gain", gain.value_or(0.0), gain_text(gain));
        numbers.time(std::string(goal.methods) + "_resolution", found.resolution,
                     percent(found.resolution));
    }
}

std::vector<ClaimAnswer> answer_convergence(const std::vector<Convergence>& measured) {
    return {answer(measured, "O2", "photons"), answer(measured, "O3", "cache")};
}

Chart convergence_chart(const std::vector<Convergence>& measured, std::string_view scene) {
    const Convergence& found = scene_named(measured, scene);
    Chart chart{.title = fmt::format("Error against time, scene {}", scene),
                .x_label = "seconds for the picture",
                .y_label = "relative error",
                .log_x = true,
                .log_y = true,
                .series = {}};
    for (const std::string& method : found.methods())
        chart.series.push_back(with_slope(
            series_along(method, found.of(method), &ErrorPoint::seconds, &ErrorPoint::error)));
    return chart;
}

}  // namespace space::ch11
