#include "chapters/ch08_parallel_builds/record_tasks.hpp"

#include <glm/glm.hpp>

#include <bit>
#include <cmath>

namespace space {
namespace {

double since(Stopwatch& stopwatch) {
    return 1e6 * stopwatch.lap().count();
}

/// The middle time between two looks at the clock.
double clock_ns() {
    Stopwatch stopwatch;
    std::vector<double> looks(1001);
    for (double& look : looks) look = since(stopwatch);
    return median(std::move(looks));
}

TaskGraph timed_once(std::span<const Triangle> triangles, const BinnedBuilder::Config& config) {
    Stopwatch stopwatch;
    do_not_optimize(boxed<3>(triangles));
    const double boxing = since(stopwatch);
    const double look = clock_ns();
    bool is_first = true;
    const auto cost = [&](std::size_t, bool) {
        // The builder makes its boxes, too, before its first node.
        const double ns = since(stopwatch) - (std::exchange(is_first, false) ? boxing : look);
        return std::max(0.0, ns);
    };
    TaskRecorder<3, decltype(cost)> recorder(cost);
    stopwatch.lap();
    const BvhNodes<3> tree = BinnedBuilder::build<3>(triangles, config, recorder);
    recorder.graph.joining = since(stopwatch);
    recorder.graph.boxing = boxing;
    return std::move(recorder.graph);
}

/// Nodes of similar size.
struct SizeClass {
    double nodes = 0.0, triangles = 0.0, bins = 0.0, cost = 0.0;
};

/// Leaves, and cut nodes by the power of two below their size.
std::vector<SizeClass> size_classes(const TaskGraph& graph) {
    std::vector<SizeClass> classes(34);
    for (const TaskNode& node : graph.nodes) {
        SizeClass& of = classes[node.is_leaf() ? 0 : std::bit_width(node.triangles)];
        of.nodes += 1.0;
        of.triangles += node.triangles;
        if (!node.is_leaf()) of.bins += std::min(node.triangles, 16u);
        of.cost += node.cost;
    }
    std::erase_if(classes, [](const SizeClass& of) { return of.cost <= 0.0; });
    return classes;
}

}  // namespace

TaskGraph timed_tasks(std::span<const Triangle> triangles, int rounds,
                      const BinnedBuilder::Config& config) {
    std::vector<TaskGraph> builds;
    for (int round = 0; round < rounds; ++round) builds.push_back(timed_once(triangles, config));
    TaskGraph graph = builds.front();
    const auto middle = [&](const auto& part) {
        std::vector<double> values;
        for (const TaskGraph& build : builds) values.push_back(part(build));
        return median(std::move(values));
    };
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
        graph.nodes[i].cost = middle([i](const TaskGraph& build) { return build.nodes[i].cost; });
    graph.boxing = middle([](const TaskGraph& build) { return build.boxing; });
    graph.joining = middle([](const TaskGraph& build) { return build.joining; });
    return graph;
}

CostFormula fitted_cost(const TaskGraph& graph) {
    const std::vector<SizeClass> classes = size_classes(graph);
    double all = 0.0;
    for (const SizeClass& of : classes) all += of.cost;
    glm::dmat3 normal(0.0);
    glm::dvec3 right(0.0);
    for (const SizeClass& of : classes) {
        // Relative error 1 - row . costs, weighed by the class's share of the work.
        const glm::dvec3 row = glm::dvec3(of.nodes, of.triangles, of.bins) / of.cost;
        const double weight = of.cost / all;
        normal += weight * glm::outerProduct(row, row);
        right += weight * row;
    }
    const glm::dvec3 fit = glm::inverse(normal) * right;
    CostFormula formula{.cost = {fit.x, fit.y, fit.z}};
    for (const SizeClass& of : classes) {
        const double told = glm::dot(fit, glm::dvec3(of.nodes, of.triangles, of.bins));
        if (of.cost >= 0.01 * all)
            formula.largest_error =
                std::max(formula.largest_error, std::abs(told - of.cost) / of.cost);
    }
    return formula;
}

}  // namespace space
