/// @file
/// How a build is divided among cores, and what comes of it: who did what, from when to when.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace space {

// [parallel_method]
/// Which core makes which node. The first three are BvhThesis13's, sections 4.2 to 4.4.
struct ParallelMethod {
    enum class Kind {
        asymmetric,  ///< threads start on the side that had more triangles below the root
        symmetric,   ///< the budget of threads is halved at each node
        queue,       ///< of nodes, for all threads
        stealing     ///< each thread has nodes of its own, of which idle ones take
    };
    /// From when on a thread keeps what is below a node, for a queue of |Q| nodes and T threads.
    enum class Condition {
        threads,             ///< (1) |Q| >= T
        twice_threads,       ///< (2) |Q| >= 2 T
        threads_to_threads,  ///< (3) |Q| >= T^T
        depth,               ///< (4) the node is deeper than `deepest`
        combined             ///< (4) below `big_scene` triangles, (2) from there on
    };
    Kind kind = Kind::stealing;
    Condition condition = Condition::combined;
    unsigned deepest = 4;
    std::size_t big_scene = 500'000;

    // Stealing, in triangles:
    std::size_t large = 32'768;  ///< all threads make larger nodes together
    std::size_t chunk = 4'096;   ///< of a large node, for one thread
    std::size_t grain = 2'048;   ///< one thread makes all that is below nodes up to this
};
// [parallel_method]

/// What dividing the work costs, in the unit of the graph's costs.
struct SchedulingCosts {
    double thread_start = 0.0;  ///< of the one who starts it; the new one runs after that
    double lock = 0.0;          ///< to hold the queue's lock and put nodes there or take one
    double steal = 0.0;         ///< to find an item of another thread, and to bring it over
    double chunk = 0.0;         ///< of one chunk of a divided node, beside its share of the work
    double serial_share = 0.0;  ///< of a divided node: what one core has to do
    /// b / B: of what the memory gives to all cores, the share that one core takes while it builds.
    double bandwidth_share = 0.0;
};

/// Something that a core does, or waits for.
struct CoreRun {
    enum class Doing {
        boxing,
        node,     ///< this node alone
        subtree,  ///< this node and all below
        chunk,    ///< of this node
        joining,
        starting,  ///< another thread
        locked,    ///< holds the queue's lock
        lock_wait,
        stealing,
        join_wait  ///< for a thread that it started
    };
    unsigned core;
    Doing doing;
    std::uint32_t node;  ///< where it is about one
    double begin, end;
};
std::string_view name(CoreRun::Doing doing);
/// Work of the graph, rather than what comes from its being divided.
bool is_work(CoreRun::Doing doing);

/// A simulated build.
struct Schedule {
    unsigned cores = 0;
    std::vector<CoreRun> runs = {};  ///< in the order of their ends
    double makespan = 0.0;           ///< from the start to the end of the last run

    /// The time that all cores together spend so.
    double spent(CoreRun::Doing doing) const;
    double idle() const;
};

}  // namespace space
