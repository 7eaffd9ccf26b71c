/// @file
/// What chapter 8 records of builds and simulates, as plain values: enough for its tables, charts
/// and verdicts on schedules.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch08 {

inline constexpr std::string_view queue_1 = "queue (1)", queue_2 = "queue (2)",
                                  queue_3 = "queue (3)", queue_4 = "queue (4)";
inline constexpr std::array<std::string_view, 4> queue_conditions{queue_1, queue_2, queue_3,
                                                                  queue_4};

/// A recorded build. Times in milliseconds; without a clock, by a formula.
struct GraphPoint {
    std::string scene;
    std::uint64_t n = 0, nodes = 0, depth = 0;
    double larger_share = 0.0;  ///< of the root's triangles, those on the larger side
    double total_ms = 0.0, boxing_ms = 0.0, joining_ms = 0.0;
    double critical_ms = 0.0;  ///< the dearest way from the root to a leaf
    double top_ms = 0.0;       ///< the root and the three nodes that are largest below it
    double scaled = 1.0;       ///< recorded times by this are those of a build without a clock
    double node_ns = 0.0, triangle_ns = 0.0, bin_ns = 0.0;  ///< the formula for a node's cost
    double formula_error = 0.0;  ///< largest, of a class of nodes of similar size

    bool is_large() const { return n >= 500'000; }
    bool is_symmetric() const { return larger_share < 0.55; }
    bool is_asymmetric() const { return larger_share > 0.75; }
};

/// What dividing the work costs on this machine, measured.
struct MeasuredCosts {
    double thread_start_us = 0.0;   ///< until a new thread runs
    double lock_ns = 0.0;           ///< of a queue that two threads use all the time
    double steal_us = 0.0;          ///< until all threads are at a common loop, and out again
    double chunk_us = 0.0;          ///< of a chunk of a large node, beside its share of the work
    double serial_share = 0.0;      ///< of a large node
    double build_bytes_per_us = 0;  ///< that a build on one core moves
    double copy_bytes_per_us = 0;   ///< that copies on all cores move

    double bandwidth_share() const {
        return copy_bytes_per_us > 0.0 ? build_bytes_per_us / copy_bytes_per_us : 0.0;
    }
};

/// A simulated build.
struct SimulatedPoint {
    std::string scene;
    std::string_view method;
    unsigned cores = 1;
    bool has_bandwidth = false;  ///< the memory limits it
    double ms = 0.0;
    double gain = 0.0;       ///< the graph's total over it
    double idle = 0.0;       ///< of all cores' time
    double lock_wait = 0.0;  ///< of all cores' time

    double fall() const { return 1.0 - 1.0 / gain; }
};

/// A build that was measured and simulated.
struct ValidationPoint {
    std::string scene;
    std::string_view method;
    unsigned threads = 1;
    double measured_ms = 0.0, simulated_ms = 0.0;

    double error() const { return simulated_ms / measured_ms - 1.0; }
};

/// One thread's work in a measured build, in milliseconds from its start.
struct BusyTime {
    std::string_view method;
    unsigned thread;
    double begin_ms, end_ms;
};

/// All of it. With --counts nothing but what the sources print.
struct ScheduleMeasurements {
    bool is_timed = false;  ///< else costs are by a formula, the same on every machine
    std::vector<GraphPoint> graphs = {};
    MeasuredCosts costs = {};
    std::vector<SimulatedPoint> simulated = {};
    std::vector<ValidationPoint> validation = {};  ///< none where nothing is timed
};

/// The scene's point; null where there is none.
const SimulatedPoint* simulated_point(const std::vector<SimulatedPoint>& points,
                                      std::string_view scene, std::string_view method,
                                      unsigned cores, bool has_bandwidth = false);

}  // namespace space::ch08
