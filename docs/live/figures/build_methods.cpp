#include "chapters/ch08_parallel_builds/figures/drawn_methods.hpp"
#include "common/scenes/makers.hpp"
#include "docs/live/live.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space::live {

Answer build_methods(const State& state) {
    static const TaskGraph graph = [] {
        Scene scene;
        make_building(scene, 1, 1);
        return ch08::formula_graph(scene.mesh.triangles());
    }();
    const std::size_t cores = state.whole("cores", 4, 2, 16);
    std::vector<Slider> sliders{{"cores", "Cores", double(cores), 2.0, 16.0, 1.0}};
    const auto slider = [&](std::string name, std::string label, double first, double least,
                            double most, double step) {
        const double value = state.number(name, first, least, most);
        sliders.push_back({std::move(name), std::move(label), value, least, most, step});
        return value;
    };
    SchedulingCosts costs = ch08::formula_costs;
    costs.thread_start = 1e3 * slider("start", "To start a thread, µs", 15.0, 0.0, 200.0, 5.0);
    costs.lock = slider("lock", "To hold the queue's lock, ns", 100.0, 0.0, 2'000.0, 50.0);
    costs.steal = 1e3 * slider("steal", "To steal, µs", 2.0, 0.0, 50.0, 0.5);
    costs.bandwidth_share =
        slider("memory", "One core's share of the memory's speed", 0.0, 0.0, 1.0, 0.05);
    const auto schedules = ch08::four_schedules(graph, static_cast<unsigned>(cores), costs);
    const auto best = std::min_element(schedules.begin(), schedules.end(),
                                       [](const auto& one, const auto& other) {
                                           return one.schedule.makespan < other.schedule.makespan;
                                       });
    return {.drawing = ch08::drawn_methods(graph, schedules),
            .summary = fmt::format(
                "First is {}, {:.2f} times as fast as one core, which takes {:.2f} ms. Where each "
                "node is made by one core, as in the first three, no number of cores gains more "
                "than {:.2f} times.",
                best->name, graph.total() / best->schedule.makespan, 1e-6 * graph.total(),
                graph.total() / critical_path(graph)),
            .sliders = std::move(sliders)};
}

}  // namespace space::live
