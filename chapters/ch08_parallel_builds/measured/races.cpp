#include "chapters/ch08_parallel_builds/measured/races.hpp"

#include "chapters/ch08_parallel_builds/played_turns.hpp"
#include "chapters/ch08_parallel_builds/shared_scratch_builder.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>

namespace space::ch08 {
namespace {

constexpr std::uint32_t patience = 50;

/// Over all schedules: what is lost of so many triangles.
RacePoint point_of_losses(const std::string& scene, std::string_view schedule, bool is_cured,
                          std::uint64_t triangles, std::vector<std::uint64_t> lost) {
    std::ranges::sort(lost);
    return {.scene = scene,
            .schedule = schedule,
            .is_cured = is_cured,
            .n = triangles,
            .schedules = lost.size(),
            .losing = lost.size() - std::uint64_t(std::ranges::count(lost, 0)),
            .least = lost.front(),
            .median = lost[lost.size() / 2],
            .most = lost.back()};
}

template <class Observer>
std::uint64_t losses(std::span<const Triangle> triangles, bool is_shared, Observer&& observer) {
    return lost_polygons<3>(
               SharedScratchBuilder<>::build<3>(triangles, {.is_shared = is_shared}, observer),
               triangles)
        .size();
}

/// Two schedules that are forced, and some by seed.
std::vector<RacePoint> races_of(const std::string& scene, std::span<const Triangle> triangles,
                                std::uint64_t schedules) {
    std::vector<RacePoint> races;
    for (const bool is_cured : {false, true}) {
        const auto add = [&](std::string_view schedule, std::vector<std::uint64_t> lost) {
            races.push_back(
                point_of_losses(scene, schedule, is_cured, triangles.size(), std::move(lost)));
        };
        add("held at right bounds",
            {losses(triangles, !is_cured, HeldCut(ScratchPart::right_bounds))});
        add("held at dimension", {losses(triangles, !is_cured, HeldCut(ScratchPart::dimension))});
        std::vector<std::uint64_t> lost;
        for (std::uint64_t seed = 1; seed <= schedules; ++seed)
            lost.push_back(losses(triangles, !is_cured, PlayedTurns(seed, patience)));
        add("by turns", std::move(lost));
    }
    return races;
}

Table races_table(const std::vector<RacePoint>& races) {
    Table table({"scene", "triangles", "scratch", "schedule", "runs", "that lose triangles",
                 "fewest lost", "median", "most"});
    for (const RacePoint& p : races)
        table.row({p.scene, with_commas(p.n), p.is_cured ? "one each" : "shared",
                   std::string(p.schedule), with_commas(p.schedules), with_commas(p.losing),
                   with_commas(p.least), with_commas(p.median), with_commas(p.most)});
    return table;
}

}  // namespace

std::vector<RacePoint> measure_races(const Options& options) {
    const std::vector<std::string> scenes = options.small
                                                ? std::vector<std::string>{"soup:200"}
                                                : std::vector<std::string>{"soup:2000", "room:3"};
    std::vector<RacePoint> races;
    Progress progress("races", scenes.size());
    for (const std::string& scene : scenes) {
        const std::vector<Triangle> triangles = make_scene(scene, options.seed).mesh.triangles();
        for (RacePoint& race : races_of(scene, triangles, options.small ? 5 : 15))
            races.push_back(std::move(race));
        progress.step();
    }
    return races;
}

void print_races(const std::vector<RacePoint>& races) {
    print_heading("Two threads and one scratch: what is lost, schedule by schedule");
    races_table(races).print();
}

void quote_races(const std::vector<RacePoint>& races, Numbers& numbers) {
    numbers.count_table("races", races_table(races));
    std::uint64_t schedules = 0, losing = 0;
    for (const RacePoint& p : races) {
        if (p.is_cured) continue;
        schedules += p.schedules;
        losing += p.losing;
    }
    numbers.count("race_schedules", schedules);
    numbers.count("race_losing", losing);
}

std::vector<ClaimAnswer> answer_races(const std::vector<RacePoint>& races) {
    std::vector<std::string> texts, scenes;
    std::size_t agree = 0, shared = 0;
    std::uint64_t cured_losing = 0;
    for (const RacePoint& p : races) {
        if (std::ranges::count(scenes, p.scene) == 0) scenes.push_back(p.scene);
        if (p.is_cured) {
            cured_losing += p.losing;
            continue;
        }
        ++shared;
        agree += p.losing > 0;
        texts.push_back(fmt::format("{}, {}: in {} of {} runs, up to {} of {} triangles", p.scene,
                                    p.schedule, p.losing, p.schedules, p.most, p.n));
    }
    return {
        {"P16", cured_losing > 0 ? Verdict::depends : verdict_of(agree, shared),
         fmt::format("triangles outside of boxes above them: {}; with a scratch each: in {} "
                     "runs",
                     fmt::join(texts, "; "), cured_losing),
         joined(scenes),
         "confirmed if a shared scratch loses triangles by each kind of schedule in every scene, "
         "and one each never"}};
}

}  // namespace space::ch08
