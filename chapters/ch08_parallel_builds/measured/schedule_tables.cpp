#include "chapters/ch08_parallel_builds/amdahl.hpp"
#include "chapters/ch08_parallel_builds/measured/build_data.hpp"
#include "chapters/ch08_parallel_builds/measured/schedules.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace space::ch08 {
namespace {

constexpr std::array compared{symmetric, asymmetric, by_queue, ours};

/// Shares as percentages, with a sign where they are errors.
std::string in_percent(double share, int digits = 0) {
    return fixed(100.0 * share, digits) + " %";
}
std::string signed_percent(double share) {
    return (share >= 0.0005 ? "+" : "") + fixed(100.0 * share, 1) + " %";
}

Table graphs_table(const ScheduleMeasurements& measured) {
    Table table({"scene", "triangles", "nodes", "larger side", "build ms", "boxing",
                 "4 largest nodes", "critical path", "serial share", "bound"});
    for (const GraphPoint& point : measured.graphs) {
        const double serial = (point.boxing_ms + point.critical_ms) / point.total_ms;
        table.row({point.scene, with_commas(point.n), with_commas(point.nodes),
                   in_percent(point.larger_share), fixed(point.total_ms, 1),
                   in_percent(point.boxing_ms / point.total_ms, 1),
                   in_percent(point.top_ms / point.total_ms, 1),
                   in_percent(point.critical_ms / point.total_ms, 1), in_percent(serial, 1),
                   fixed(amdahl_bound(serial), 1)});
    }
    return table;
}

Table formula_table(const ScheduleMeasurements& measured) {
    Table table({"scene", "scaled by", "a node ns", "a triangle ns", "a bin ns", "largest error"});
    for (const GraphPoint& point : measured.graphs)
        table.row({point.scene, fixed(point.scaled, 2), fixed(point.node_ns, 0),
                   fixed(point.triangle_ns, 1), fixed(point.bin_ns, 0),
                   in_percent(point.formula_error)});
    return table;
}

Table costs_table(const MeasuredCosts& costs) {
    Table table({"what", "takes"});
    table.row({"a thread, until it runs", fixed(costs.thread_start_us, 1) + " µs"});
    table.row(
        {"a visit to the queue, its lock wanted by two threads", fixed(costs.lock_ns, 0) + " ns"});
    table.row({"to bring work to another thread", fixed(costs.steal_us, 1) + " µs"});
    table.row({"a chunk of a large node, beside its share", fixed(costs.chunk_us, 1) + " µs"});
    table.row({"of a large node, by one thread", in_percent(costs.serial_share, 1)});
    if (costs.copy_bytes_per_us > 0.0) {
        table.row({"bytes that a build on one core moves (b)",
                   fixed(1e-3 * costs.build_bytes_per_us, 1) + " GB/s"});
        table.row({"bytes that copies on all cores move (B)",
                   fixed(1e-3 * costs.copy_bytes_per_us, 1) + " GB/s"});
        table.row({"cores that B is enough for", fixed(1.0 / costs.bandwidth_share(), 1)});
    }
    return table;
}

template <std::size_t N>
Table gains_table(const ScheduleMeasurements& measured,
                  const std::array<std::string_view, N>& methods, unsigned cores) {
    std::vector<std::string> headings{"scene"};
    for (const std::string_view method : methods) headings.emplace_back(method);
    Table table(headings);
    for (const GraphPoint& graph : measured.graphs) {
        std::vector<std::string> row{graph.scene};
        for (const std::string_view method : methods)
            row.push_back(
                fixed(simulated_point(measured.simulated, graph.scene, method, cores)->gain, 2));
        table.row(row);
    }
    return table;
}

/// By how much build times fall on four cores, and the published shares.
Table four_cores_table(const ScheduleMeasurements& measured) {
    Table table({"scene", "symmetric", "published", "asymmetric", "published", "queue", "published",
                 "ours"});
    for (const GraphPoint& graph : measured.graphs) {
        std::vector<std::string> row{graph.scene};
        const auto add = [&](std::string_view method) {
            row.push_back(
                in_percent(simulated_point(measured.simulated, graph.scene, method, 4)->fall(), 1));
        };
        for (std::size_t i = 0; i < published_methods.size(); ++i) {
            add(published_methods[i]);
            std::string theirs;
            for (const PublishedBuild& published : published_builds())
                if (published.stand_in == graph.scene && published.threads == 4)
                    theirs = in_percent(published.fall(i), 1);
            row.push_back(theirs);
        }
        add(ours);
        table.row(row);
    }
    return table;
}

/// Each method's best, and where it first comes within a tenth of it.
Table far_table(const ScheduleMeasurements& measured) {
    Table table({"scene", "method", "on 4", "on 16", "on 64", "on 256",
                 "cores for 90 % of its best", "waits for the lock on 64",
                 "on 64 with this memory"});
    for (const GraphPoint& graph : measured.graphs)
        for (const std::string_view method : compared) {
            const auto at = [&](unsigned cores, bool bandwidth = false) {
                return simulated_point(measured.simulated, graph.scene, method, cores, bandwidth);
            };
            double best = 0.0;
            for (unsigned cores = 1; cores <= 256; cores *= 2)
                best = std::max(best, at(cores)->gain);
            unsigned enough = 1;
            while (at(enough)->gain < 0.9 * best) enough *= 2;
            const SimulatedPoint* limited = at(64, true);
            table.row({graph.scene, std::string(method), fixed(at(4)->gain, 2),
                       fixed(at(16)->gain, 2), fixed(at(64)->gain, 2), fixed(at(256)->gain, 2),
                       std::to_string(enough), in_percent(at(64)->lock_wait, 1),
                       limited ? fixed(limited->gain, 2) : ""});
        }
    return table;
}

Table validation_table(const std::vector<ValidationPoint>& points) {
    Table table({"scene", "method", "threads", "measured ms", "simulated ms", "error"});
    for (const ValidationPoint& point : points)
        table.row({point.scene, std::string(point.method), std::to_string(point.threads),
                   fixed(point.measured_ms, 1), fixed(point.simulated_ms, 1),
                   signed_percent(point.error())});
    return table;
}

/// Table 3's and 4's shares as printed and as their times give them, where they differ by more than
/// rounding.
Table erratum_table() {
    Table table({"scene", "threads", "method", "times in s", "printed", "its times give"});
    for (const PublishedBuild& row : published_builds())
        for (std::size_t i = 0; i < published_methods.size(); ++i) {
            const double given = 100.0 * row.fall(i);
            if (std::abs(given - row.printed_percent[i]) < 0.015) continue;
            table.row({std::string(row.scene), std::to_string(row.threads),
                       std::string(published_methods[i]),
                       fmt::format("{:.2f}, {:.2f}", row.sequential_s, row.parallel_s[i]),
                       fixed(row.printed_percent[i], 2) + " %", fixed(given, 2) + " %"});
        }
    return table;
}

/// What serial share would explain the published times of the queue.
Table published_shares_table() {
    Table table({"scene", "gain on 2", "serial share", "gain on 4", "serial share", "bound"});
    constexpr std::size_t queue = 2;
    for (const PublishedBuild& two : published_builds()) {
        if (two.threads != 2) continue;
        for (const PublishedBuild& four : published_builds()) {
            if (four.threads != 4 || four.scene != two.scene) continue;
            const double share = serial_share_of(four.gain(queue), 4);
            table.row({std::string(two.scene), fixed(two.gain(queue), 2),
                       in_percent(serial_share_of(two.gain(queue), 2)), fixed(four.gain(queue), 2),
                       in_percent(share), fixed(amdahl_bound(share), 1)});
        }
    }
    return table;
}

void quote_simulated(const ScheduleMeasurements& measured, Numbers& numbers) {
    const auto gain = [&](const std::string& name, std::string_view method, unsigned cores) {
        double low = 1e9, high = 0.0;
        for (const GraphPoint& graph : measured.graphs) {
            const double value =
                simulated_point(measured.simulated, graph.scene, method, cores)->gain;
            low = std::min(low, value);
            high = std::max(high, value);
        }
        numbers.time(name + "_low", low, fixed(low, 1));
        numbers.time(name + "_high", high, fixed(high, 1));
    };
    gain("sim_ours_4", ours, 4);
    gain("sim_ours_64", ours, 64);
    gain("sim_ours_256", ours, 256);
    gain("sim_queue_256", by_queue, 256);
    gain("sim_symmetric_256", symmetric, 256);
    gain("sim_asymmetric_256", asymmetric, 256);
    double lock_low = 1.0, lock_high = 0.0, worst = 0.0;
    for (const GraphPoint& graph : measured.graphs) {
        const double wait =
            simulated_point(measured.simulated, graph.scene, by_queue, 256)->lock_wait;
        lock_low = std::min(lock_low, wait);
        lock_high = std::max(lock_high, wait);
        worst = std::max(worst, graph.formula_error);
    }
    numbers.time("sim_lock_low", lock_low, in_percent(lock_low, 1));
    numbers.time("sim_lock_high", lock_high, in_percent(lock_high, 1));
    numbers.time("sim_formula_error", worst, in_percent(worst));
    std::size_t within = 0;
    double furthest = 0.0;
    for (const ValidationPoint& point : measured.validation) {
        within += std::abs(point.error()) <= 0.1;
        if (std::abs(point.error()) > std::abs(furthest)) furthest = point.error();
    }
    numbers.time("sim_within", double(within), std::to_string(within));
    numbers.time("sim_validated", double(measured.validation.size()),
                 std::to_string(measured.validation.size()));
    numbers.time("sim_furthest", furthest, signed_percent(furthest));
    const MeasuredCosts& costs = measured.costs;
    numbers.time("sim_thread_start", costs.thread_start_us, fixed(costs.thread_start_us, 0));
    numbers.time("sim_lock", costs.lock_ns, fixed(costs.lock_ns, 0));
    numbers.time("sim_b", costs.build_bytes_per_us, fixed(1e-3 * costs.build_bytes_per_us, 1));
    numbers.time("sim_B", costs.copy_bytes_per_us, fixed(1e-3 * costs.copy_bytes_per_us, 1));
    const double enough = costs.bandwidth_share() > 0.0 ? 1.0 / costs.bandwidth_share() : 0.0;
    numbers.time("sim_cores_of_B", enough, fixed(enough, 1));
}

}  // namespace

void print_schedules(const ScheduleMeasurements& measured, bool times) {
    print_heading("Table 3 of [BvhThesis13]: shares that their own times do not give");
    erratum_table().print();
    if (measured.graphs.empty()) return;
    print_heading(times ? "Recorded builds" : "Builds by a formula for a node's cost");
    graphs_table(measured).print();
    if (times) {
        formula_table(measured).print();
        print_heading("What dividing the work costs");
        costs_table(measured.costs).print();
        print_heading("Simulated and measured");
        validation_table(measured.validation).print();
    }
    print_heading("Simulated: by how much four cores shorten a build");
    four_cores_table(measured).print();
    print_heading("Simulated gains of the queue on four cores, by condition");
    gains_table(measured, queue_conditions, 4).print();
    print_heading("Simulated gains");
    far_table(measured).print();
}

void quote_schedules(const ScheduleMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count_table("erratum", erratum_table());
    numbers.count_table("published_shares", published_shares_table());
    numbers.count("amdahl_15", amdahl_bound(0.15), fixed(amdahl_bound(0.15), 2));
    if (!times || measured.graphs.empty()) return;
    numbers.time_table("graphs", graphs_table(measured));
    numbers.time_table("formula", formula_table(measured));
    numbers.time_table("sim_costs", costs_table(measured.costs));
    numbers.time_table("validation", validation_table(measured.validation));
    numbers.time_table("four_cores", four_cores_table(measured));
    numbers.time_table("conditions", gains_table(measured, queue_conditions, 4));
    numbers.time_table("far", far_table(measured));
    quote_simulated(measured, numbers);
}

}  // namespace space::ch08
