/// Chapter 8: one tree, built by many threads.
///     ch08_parallel_builds --out pictures
///     ch08_parallel_builds --figure fig_08_01 --out figures
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch08_parallel_builds/asymmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/measured/builds.hpp"
#include "chapters/ch08_parallel_builds/measured/endings.hpp"
#include "chapters/ch08_parallel_builds/measured/machine.hpp"
#include "chapters/ch08_parallel_builds/measured/races.hpp"
#include "chapters/ch08_parallel_builds/measured/schedules.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/work_stealing_builder.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace space::ch08 {
namespace {

constexpr const char* default_scene = "building:3";

Options read_options(int argc, char** argv) {
    Options options = parse_options(argc, argv,
                                    {.name = this_chapter.name,
                                     .about = "Chapter 8: parallel builds",
                                     .defaults = {.scene = default_scene}});
    if (options.small && options.scene == default_scene) options.scene = "stadium:3";
    return options;
}

/// One scene by each method, with as many threads as asked for. @return trees that are not the
/// sequential builder's
std::uint64_t build_one_scene(const Options& options, bool times) {
    const std::vector<Triangle> triangles = asked_scene(options).mesh.triangles();
    TimedTable table({"method", "nodes", "depth", "the same tree"}, {"ms"}, times);
    BvhNodes<3> wanted;
    std::uint64_t others = 0;
    const auto show = [&](const std::string& name, const auto& build) {
        Stopwatch stopwatch;
        const BvhNodes<3> tree = build();
        const double ms = stopwatch.lap().count();
        if (wanted.empty()) wanted = tree;
        const bool is_same =
            std::ranges::equal(tree.nodes, wanted.nodes) && tree.references == wanted.references;
        others += !is_same;
        table.row({name, with_commas(tree.size()), with_commas(tree.depth), is_same ? "yes" : "no"},
                  {fixed(ms, 1)});
    };
    show("sequential", [&] { return BinnedBuilder::build<3>(triangles); });
    const auto parallel = [&]<class Builder>(const std::string& name, Builder) {
        typename Builder::Config config;
        config.threads = options.threads;
        show(name, [&] { return Builder::template build<3>(triangles, config); });
    };
    parallel("asymmetric", AsymmetricBuilder{});
    parallel("symmetric", SymmetricBuilder{});
    parallel("queue", QueueBuilder{});
    parallel("ours: work stealing", WorkStealingBuilder{});

    print_heading(fmt::format("{}: {} triangles{}", options.scene, with_commas(triangles.size()),
                              times ? fmt::format(", {} threads", options.threads) : ""));
    table.table().print();
    return others;
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;

    std::uint64_t wrong = options.counts ? 0 : build_one_scene(options, times);
    const MachineMeasurements machine = measure_machine(options);
    print_machine(machine, times);
    const BuildMeasurements builds = measure_builds(options);
    print_builds(builds, times);
    wrong += other_trees(builds);
    const EndingMeasurements endings = measure_endings(options);
    print_endings(endings, times);
    const std::vector<RacePoint> races = measure_races(options);
    print_races(races);
    const ScheduleMeasurements& schedules = measured_once<measure_schedules>(options);
    print_schedules(schedules, times);

    Numbers numbers;
    quote_machine(machine, times, numbers);
    quote_builds(builds, times, numbers);
    quote_endings(endings, times, numbers);
    quote_races(races, numbers);
    quote_schedules(schedules, times, numbers);
    numbers.write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} trees that are not the sequential builder's.\n", wrong);

    std::vector<ClaimAnswer> answers;
    const auto add = [&](std::vector<ClaimAnswer> some) {
        for (ClaimAnswer& answer : some) answers.push_back(std::move(answer));
    };
    add(answer_machine(machine));
    add(answer_builds(builds));
    add(answer_endings(endings));
    add(answer_races(races));
    add(answer_schedules(schedules));
    return finish(options, answers, wrong);
}

}  // namespace
}  // namespace space::ch08

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch08::run, argc, argv);
}
