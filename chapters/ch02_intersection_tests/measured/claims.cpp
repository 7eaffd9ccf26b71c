#include "chapters/ch02_intersection_tests/measured/outcome.hpp"
#include "common/measure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace space::ch02 {
namespace {

/// Printed by Lichter23: table 1 (seconds; ten runs and the mean that stands below them), tables 2
/// to 4 (means; a dot is a thousands separator, so that 555.927 is 555927).
constexpr double table1_first_mean = 10.8130, table1_improved_mean = 9.6863;
constexpr double table1_improved[] = {9.9917, 9.6968, 9.7212, 9.8179, 9.6891,
                                      9.6616, 9.6814, 9.6910, 9.7226, 9.6863};
/// A column in the unit that fits: those that are a thousand times too small are in thousands.
constexpr double in_thousands(double column) {
    return column < 10'000.0 ? 1000.0 * column : column;
}
struct RootTable {
    int rounds;
    double library, newton, four_newtons, vectorised, v4sf;

    double newton_to_library() const { return in_thousands(newton) / library; }
};
constexpr RootTable root_tables[] = {{2, 555927, 764, 209938, 213, 232},
                                     {3, 555954, 1240, 328815, 328284, 328},
                                     {4, 557068, 1254, 330502, 328873, 341}};
/// Columns that cannot be in the same unit differ by more than this; roots that we measured differ
/// by less.
constexpr double plausible_ratio = 10.0;

double root_ns(const Measurements& measured, const std::string& form) {
    for (const TimedRoot& timed : measured.root_times)
        if (timed.test == form) return timed.ns;
    throw std::out_of_range("no time of " + form);
}

/// 100 (1 - time / before) of every scene, as text and as numbers.
struct Gains {
    std::vector<std::string> text;
    std::vector<double> percent;
};
Gains lichter_gains(const Measurements& measured, std::string_view variant) {
    Gains gains;
    for (const SceneTimes& scene : measured.triangle_times) {
        gains.percent.push_back(
            100.0 * (1.0 - ns_of(scene.lichter, variant) / ns_of(scene.lichter, "first")));
        gains.text.push_back(
            fmt::format("{} {}", scene.scene, percent(0.01 * gains.percent.back())));
    }
    return gains;
}

/// L2, by four tests: with and without the early exit, and with three roots for every ray that
/// comes so far or two for hits only. What fewer calls of the root bring is the mean of what they
/// bring without the exit and beside it (the Shapley value of a change).
ClaimAnswer answer_cause(const Measurements& measured, const std::string& scene) {
    const std::vector<double> both = lichter_gains(measured, "improved").percent,
                              roots = lichter_gains(measured, "roots for hits").percent,
                              exit = lichter_gains(measured, "exit").percent,
                              two_roots = lichter_gains(measured, "two roots").percent,
                              exit_three = lichter_gains(measured, "exit, roots last").percent;
    std::vector<double> together, beside, of_two;
    std::size_t half = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
        together.push_back(both[i] - roots[i] - exit[i]);
        beside.push_back(0.5 * (roots[i] + both[i] - exit[i]));
        of_two.push_back(both[i] - exit_three[i]);
        half += both[i] > 0.0 && beside.back() >= 0.5 * both[i];
    }
    const auto middle = [](const std::vector<double>& gains) {
        return percent(0.01 * median(gains));
    };
    return {
        "L2", verdict_of(half, both.size()),
        fmt::format("medians: roots for hits only, and two of them, gain {} without an early "
                    "exit; the exit with three roots before the edges gains {}; both {}, of "
                    "which {} only together. So fewer calls of the root bring {}, at least half "
                    "of all on {} of {} scenes. The transformation, two roots for three, brings "
                    "{} alone and {} beside all else",
                    middle(roots), middle(exit), middle(both), middle(together), middle(beside),
                    half, both.size(), middle(two_roots), middle(of_two)),
        scene,
        "confirmed if fewer calls of the root bring at least half of the whole gain (the mean "
        "of what they bring without the early exit and beside it) on every scene, refuted if on "
        "none"};
}

void answer_triangles(const Measurements& measured, std::vector<ClaimAnswer>& answers) {
    const std::string scene =
        "leaves of eight triangles, random ones and those of five scenes; rays from all sides, the "
        "nearest hit of each";
    const Gains all = lichter_gains(measured, "improved");
    const double gain = median(all.percent);
    answers.push_back(
        {"L1",
         gain >= 5.0 && gain <= 20.0 ? Verdict::confirmed
         : gain > 20.0               ? Verdict::depends
                                     : Verdict::refuted,
         fmt::format("the improved test takes less time by {}; median {}", joined(all.text),
                     percent(0.01 * gain)),
         scene, "confirmed if the median gain is within 5 .. 20 %, refuted if it is smaller"});
    answers.push_back(answer_cause(measured, scene));
}

void answer_roots(const Measurements& measured, std::vector<ClaimAnswer>& answers) {
    const std::string numbers = "4096 numbers from 2^-20 to 2^20, one root after the other";
    const double library = root_ns(measured, "std::sqrt"),
                 call = root_ns(measured, "sqrtf as a call");
    const double newton2 = root_ns(measured, "Newton 2"),
                 vector2 = root_ns(measured, "vector type 2"),
                 vector4 = root_ns(measured, "vector type 4");
    answers.push_back({"L3",
                       newton2 < library ? Verdict::confirmed
                       : newton2 < call  ? Verdict::depends
                                         : Verdict::refuted,
                       fmt::format("two rounds, the fewest that Lichter23 uses, take {:.2f} ns a "
                                   "root; std::sqrt, one instruction, {:.2f} ns; "
                                   "the library's sqrtf as a call {:.2f} ns. By Lichter23's own "
                                   "table 2 they take {:.2f} times the library's time (see L11)",
                                   newton2, library, call, root_tables[0].newton_to_library()),
                       numbers,
                       "confirmed if two rounds are faster than std::sqrt as it is compiled, "
                       "depends (on how the root is called) if "
                       "they are faster than the call only, refuted if they are slower than both"});
    std::vector<std::string> ratios;
    std::size_t faster = 0;
    for (const int rounds : {2, 3, 4}) {
        const double one = root_ns(measured, fmt::format("Newton {}", rounds)),
                     four = root_ns(measured, fmt::format("vector type {}", rounds));
        ratios.push_back(fmt::format("{} rounds {:.1f} times", rounds, one / four));
        faster += four < one;
    }
    answers.push_back(
        {"L4", verdict_of(faster, ratios.size()),
         fmt::format("four in a vector are faster than one after the other: {}; the processor's "
                     "own root of four "
                     "takes {:.2f} ns a root, Newton's with two rounds {:.2f}",
                     joined(ratios), root_ns(measured, "four by the processor"), vector2),
         numbers,
         "confirmed if four at a time take less time per root than one at a time for 2, 3 and 4 "
         "rounds"});
    answers.push_back(
        {"L5",
         vector4 <= 1.1 * vector2   ? Verdict::confirmed
         : vector4 > 1.25 * vector2 ? Verdict::refuted
                                    : Verdict::depends,
         fmt::format("in vectors of four, {:.2f} ns a root for two rounds, {:.2f} for three, "
                     "{:.2f} for four; Lichter23's own tables have {}, {} and {}",
                     vector2, root_ns(measured, "vector type 3"), vector4, root_tables[0].v4sf,
                     root_tables[1].v4sf, root_tables[2].v4sf),
         numbers,
         "confirmed if four rounds cost at most 1.1 times two, refuted if more than 1.25 times"});
}

/// L8: the mean of table 1's rows.
ClaimAnswer answer_mean() {
    double mean = 0.0;
    for (const double seconds : table1_improved) mean += seconds / std::size(table1_improved);
    const auto gain = [](double seconds) { return 100.0 * (1.0 - seconds / table1_first_mean); };
    const bool last_row = table1_improved_mean == *std::rbegin(table1_improved);
    const bool off = std::abs(mean - table1_improved_mean) > 0.00005;  // more than rounding
    return {"L8", off && last_row ? Verdict::confirmed : Verdict::refuted,
            fmt::format("the ten rows have the mean {:.4f}; printed is {:.4f}, {} last row. The "
                        "gain over {:.4f} s is {:.1f} % rather than {:.1f} %",
                        mean, table1_improved_mean, last_row ? "the" : "which is not the",
                        table1_first_mean, gain(mean), gain(table1_improved_mean)),
            "the numbers printed in Lichter23's table 1",
            "confirmed if the rows' mean is not the printed one, and the printed one is the last "
            "row"};
}

/// L11: what tables 2 to 4 say of the text, and of themselves.
ClaimAnswer answer_tables() {
    std::vector<std::string> slower;
    std::size_t tables_slower = 0;
    for (const RootTable& table : root_tables) {
        slower.push_back(fmt::format("{:.2f}", table.newton_to_library()));
        tables_slower += table.newton_to_library() > 1.0;
    }
    const auto& [two, three, four] = root_tables;
    double most = 0.0;  // what the fourth round costs, where the third costs 1
    for (const double RootTable::*column :
         {&RootTable::newton, &RootTable::four_newtons, &RootTable::vectorised, &RootTable::v4sf}) {
        const double third = in_thousands(three.*column) - in_thousands(two.*column),
                     fourth = in_thousands(four.*column) - in_thousands(three.*column);
        most = std::max(most, fourth / third);
    }
    return {"L11",
            tables_slower == std::size(root_tables) && most < 0.5 ? Verdict::confirmed
                                                                  : Verdict::refuted,
            fmt::format("in the unit that fits (L9), one root at a time takes {} times the "
                        "library's time with 2, 3 and 4 rounds; the fourth round costs at most "
                        "{:.2f} of what the third costs, though it does the same again",
                        joined(slower), most),
            "the numbers printed in Lichter23's tables 2 to 4",
            "confirmed if one at a time is slower than the library in all three tables, and the "
            "fourth round costs less than half of the third in every column"};
}

void answer_errata(std::vector<ClaimAnswer>& answers) {
    answers.push_back(answer_mean());
    answers.push_back(answer_tables());
    // L9: the ratio of the largest to the smallest column, as printed, and with each column in the
    // unit that fits.
    double printed = 0.0, fitted = 0.0;
    for (const RootTable& table : root_tables) {
        double least = table.library, most = table.library, least_fitted = table.library,
               most_fitted = table.library;
        for (double column : {table.newton, table.four_newtons, table.vectorised, table.v4sf}) {
            least = std::min(least, column);
            most = std::max(most, column);
            column = in_thousands(column);
            least_fitted = std::min(least_fitted, column);
            most_fitted = std::max(most_fitted, column);
        }
        printed = std::max(printed, most / least);
        fitted = std::max(fitted, most_fitted / least_fitted);
    }
    answers.push_back({"L9",
                       printed > plausible_ratio && fitted < plausible_ratio ? Verdict::confirmed
                                                                             : Verdict::refuted,
                       fmt::format("with dots as thousands separators the columns of a table "
                                   "differ by up to {:.0f} times; with the small "
                                   "ones times 1000 by at most {:.1f}",
                                   printed, fitted),
                       "the numbers printed in Lichter23's tables 2 to 4",
                       fmt::format("confirmed if columns differ by more than {0:.0f} times as "
                                   "printed, and by less with a factor of 1000",
                                   plausible_ratio)});
}

void answer_branches(const Measurements& measured, std::vector<ClaimAnswer>& answers) {
    std::vector<std::string> branchless, reciprocal, orders;
    std::size_t branchless_wins = 0, reciprocal_wins = 0, cheap_wins = 0;
    for (const PatternTimes& times : measured.pattern_times) {
        const double branching = ns_of(times.boxes, "branching"),
                     min_max = ns_of(times.boxes, "min/max"),
                     multiplied = ns_of(times.boxes, "reciprocal");
        branchless.push_back(fmt::format("{} {:.2f}", name(times.pattern), min_max / branching));
        branchless_wins += min_max < branching;
        reciprocal.push_back(fmt::format("{} {:.2f}", name(times.pattern), multiplied / min_max));
        reciprocal_wins += multiplied < min_max;
        const double cheap = ns_of(times.orders, "cheap first"),
                     expensive = ns_of(times.orders, "expensive first"),
                     last = ns_of(times.orders, "decide last");
        orders.push_back(fmt::format("{} {:.2f} and {:.2f}", name(times.pattern), expensive / cheap,
                                     last / cheap));
        cheap_wins += cheap <= 1.05 * std::min(expensive, last);
    }
    const std::size_t all = measured.pattern_times.size();
    answers.push_back(
        {"O4", verdict_of(branchless_wins, all),
         fmt::format("time of the branchless box test over that of the branching one: {}",
                     joined(branchless)),
         "64 rays and 512 boxes of three kinds",
         "confirmed if min/max is faster on inputs that hit, that miss, and that nobody can "
         "predict, refuted if on none"});
    answers.push_back({"O5", verdict_of(cheap_wins, all),
                       fmt::format("time of the expensive test first, and of one decision at the "
                                   "end, over that of the cheap test first: {}",
                                   joined(orders)),
                       "one ray-triangle test in three orders, 32,768 triangles of three kinds",
                       "confirmed if cheap tests first take at most 1.05 times the fastest order "
                       "on each kind, refuted if on none"});
    answers.push_back(
        {"O12", verdict_of(reciprocal_wins, all),
         fmt::format("time with the reciprocal over time with divisions: {}", joined(reciprocal)),
         "64 rays and 512 boxes of three kinds; the reciprocal once per ray",
         "confirmed if the reciprocal is faster on each kind, refuted if on none"});
}

void answer_counts(const Measurements& measured, std::vector<ClaimAnswer>& answers) {
    const RaysFromInside& inside = measured.from_inside;
    std::uint64_t safe = 0, printed = 0;
    for (std::size_t i = 0; i < box_tests_measured; ++i) {
        const std::string_view test = measured.boxes.wrong[i].test;
        if (test == "safe") safe = inside.rejected[i];
        if (test == "as printed") printed = inside.rejected[i];
    }
    answers.push_back(
        {"O13", printed > 0 && safe == 0 ? Verdict::confirmed : Verdict::refuted,
         fmt::format("of {} rays that start inside a box {} are rejected as printed, {} without "
                     "the condition",
                     with_commas(inside.rays), with_commas(printed), with_commas(safe)),
         "random boxes and rays from inside",
         "confirmed if the condition rejects rays that the same test without it does not"});
    const RaysInFaces& faces = measured.in_faces;
    std::uint64_t kept = 0, lost_to_nan = 0;
    for (std::size_t i = 0; i < box_tests_measured; ++i) {
        const std::string_view test = measured.boxes.wrong[i].test;
        if (test == "conservative") kept = faces.rays - faces.rejected[i];
        if (test == "reciprocal") lost_to_nan = faces.rejected[i];
    }
    answers.push_back(
        {"O16",
         faces.rays > 0 && faces.in_closed_box == faces.rays && kept == faces.rays
             ? Verdict::refuted
             : Verdict::confirmed,
         fmt::format("{} rays lie in the plane of a face of a triangle's box and hit the triangle, "
                     "in a vertex there; {} of them meet the closed box, so that a tree which "
                     "counts them as no intersection loses all these hits. The conservative test "
                     "keeps {}; with the reciprocal alone NaN loses {}",
                     with_commas(faces.rays), with_commas(faces.in_closed_box), with_commas(kept),
                     with_commas(lost_to_nan)),
         "triangles and rays on a grid",
         "refuted, as a rule for trees, if such rays hit triangles in the box and a test of closed "
         "boxes keeps all of them"});
    const SpheresBehind& behind = measured.behind;
    answers.push_back({"H15", behind.behind > 0 ? Verdict::confirmed : Verdict::refuted,
                       fmt::format("of {} rays {} hit their sphere in exact arithmetic; as printed "
                                   "{} do, {} of them spheres behind the origin",
                                   with_commas(behind.rays), with_commas(behind.exact_hits),
                                   with_commas(behind.printed_hits), with_commas(behind.behind)),
                       "rays in all directions, three radii from the centre",
                       "confirmed if one sphere behind the origin is hit"});
}

}  // namespace

std::vector<ClaimAnswer> answer_claims(const Measurements& measured) {
    std::vector<ClaimAnswer> answers;
    answer_triangles(measured, answers);
    answer_roots(measured, answers);
    answer_errata(answers);
    answer_branches(measured, answers);
    answer_counts(measured, answers);
    return answers;
}

}  // namespace space::ch02
