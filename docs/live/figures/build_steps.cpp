#include "chapters/ch08_parallel_builds/figures/drawn_stealing.hpp"
#include "chapters/ch08_parallel_builds/figures/schedule_drawing.hpp"
#include "chapters/ch08_parallel_builds/simulator.hpp"
#include "docs/live/live.hpp"

#include <fmt/format.h>

namespace space::live {
namespace {

using namespace std::string_view_literals;

constexpr std::array rows{"denser to one side"sv, "two rows, each the other's mirror image"sv};

}  // namespace

Answer build_steps(const State& state) {
    std::vector<Slider> sliders;
    const auto whole = [&](std::string name, std::string label, std::size_t first,
                           std::size_t least, std::size_t most) {
        const std::size_t value = state.whole(name, first, least, most);
        sliders.push_back(
            {std::move(name), std::move(label), double(value), double(least), double(most), 1.0});
        return static_cast<unsigned>(value);
    };
    ParallelMethod method = ch08::stealing_method;
    const unsigned cores = whole("cores", "Cores", ch08::stealing_cores, 2, 8);
    const double steal = whole("steal", "Time to steal", ch08::stealing_cost, 0, 20);
    method.grain = whole("grain", "One core makes all below nodes of at most so many segments",
                         method.grain, 1, 16);
    method.chunk = whole("chunk", "Segments in a part of such a node", method.chunk, 1, 16);
    method.large =
        whole("large", "All cores together make nodes of more segments than", method.large, 1, 16);
    const std::size_t row = state.choice("row", 0, rows);
    const TaskGraph graph = row == 0 ? ch08::lopsided_graph() : ch08::mirrored_graph();
    const Schedule schedule = simulate(graph, method, cores, {.steal = steal});
    return {
        .drawing = ch08::drawn_stealing(graph, schedule),
        .summary = fmt::format("Built after {} units of time, {:.2f} times as fast as by one core; "
                               "{:.0f} % of the cores' time was work.",
                               svg_number(schedule.makespan), graph.total() / schedule.makespan,
                               100.0 * graph.total() / (schedule.makespan * cores)),
        .choices = {{"row", "Segments", rows, row}},
        .sliders = std::move(sliders)};
}

}  // namespace space::live
