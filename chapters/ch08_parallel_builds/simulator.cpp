#include "chapters/ch08_parallel_builds/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <queue>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace space {
namespace {

using Doing = CoreRun::Doing;
using Kind = ParallelMethod::Kind;
using Condition = ParallelMethod::Condition;

// [simulated_cores]
/// The machine: which core is busy until when. All busy cores slow down alike where they need more
/// from the memory than it gives, so the ends of their runs are kept on a clock that slows with
/// them.
class Cores {
  public:
    Cores(unsigned count, double bandwidth_share)
        : share_(bandwidth_share), current_(count), schedule_{.cores = count} {}

    void run(unsigned core, Doing doing, std::uint32_t node, double cost) {
        current_[core] = {core, doing, node, now_, 0.0};
        busy_.push({clock_ + cost, core});
    }
    /// Goes to the end of the next run. Of runs that end together the lower core's is first.
    std::optional<CoreRun> next() {
        if (busy_.empty()) return {};
        const auto [end, core] = busy_.top();
        const double pace = std::max(1.0, share_ * double(busy_.size()));
        now_ += (end - clock_) * pace;
        clock_ = end;
        busy_.pop();
        current_[core].end = now_;
        schedule_.runs.push_back(current_[core]);
        return current_[core];
    }
    /// Waiting needs nothing from the memory.
    void waited(unsigned core, Doing doing, double since) {
        if (now_ > since) schedule_.runs.push_back({core, doing, 0, since, now_});
    }
    double now() const { return now_; }
    Schedule finished() {
        schedule_.makespan = now_;
        return std::move(schedule_);
    }

  private:
    struct Busy {
        double end;
        unsigned core;
        bool operator>(const Busy& other) const {
            return std::tie(end, core) > std::tie(other.end, other.core);
        }
    };
    double share_, now_ = 0.0, clock_ = 0.0;
    std::vector<CoreRun> current_;
    std::priority_queue<Busy, std::vector<Busy>, std::greater<>> busy_;
    Schedule schedule_;
};
// [simulated_cores]

/// What all methods know.
struct Build {
    const TaskGraph& graph;
    const ParallelMethod& method;
    unsigned count;  ///< of cores
    const SchedulingCosts& costs;
    Cores& cores;
    std::vector<double> subtree = subtree_costs(graph);

    const TaskNode& node(std::uint32_t index) const { return graph.nodes[index]; }
    void run_node(unsigned core, std::uint32_t index) {
        cores.run(core, Doing::node, index, node(index).cost);
    }
    void run_subtree(unsigned core, std::uint32_t index) {
        cores.run(core, Doing::subtree, index, subtree[index]);
    }
};

// [thread_budget]
/// How many threads may still be started below the two sides of a cut, of `budget` that were left
/// above it. One of them is started here.
struct Budgets {
    unsigned first, second;
};

Budgets symmetric_budgets(unsigned budget) {
    if (budget % 2 == 1) return {budget / 2, budget / 2};
    return {budget / 2 - 1, budget / 2};
}
Budgets asymmetric_budgets(unsigned budget, bool first_is_larger) {
    return first_is_larger ? Budgets{budget - 1, 0} : Budgets{0, budget - 1};
}
// [thread_budget]

// [simulate_threads]
/// The asymmetric and the symmetric method: threads that start threads, and wait for them.
class Forked {
  public:
    explicit Forked(Build& build) : b_(build), threads_(build.count) {
        const TaskNode& root = b_.node(0);
        if (!root.is_leaf())
            first_is_larger_ = b_.node(root.first).triangles > b_.node(root.first + 1).triangles;
    }
    void start() { enter(0, 0, b_.count - 1); }

    void ended(const CoreRun& run) {
        if (run.doing == Doing::starting)
            divide(run.core);
        else if (run.doing == Doing::node && !b_.node(run.node).is_leaf())
            b_.cores.run(run.core, Doing::starting, run.node, b_.costs.thread_start);
        else
            leave(run.core);
    }

  private:
    struct Thread {
        std::uint32_t node = 0;
        unsigned budget = 0;
        std::vector<unsigned> started = {};  ///< threads that have not been waited for
        std::optional<double> waits_since = {};
        std::optional<unsigned> starter = {};
        bool is_done = false;
    };

    void enter(unsigned core, std::uint32_t node, unsigned budget) {
        threads_[core].node = node;
        threads_[core].budget = budget;
        if (budget == 0)
            b_.run_subtree(core, node);
        else
            b_.run_node(core, node);
    }
    /// The first child for the new thread, the second for the one who started it.
    void divide(unsigned core) {
        const unsigned budget = threads_[core].budget;
        const std::uint32_t first = b_.node(threads_[core].node).first;
        const unsigned other = next_core_++;
        threads_[other].starter = core;
        threads_[core].started.push_back(other);
        const Budgets budgets = b_.method.kind == Kind::asymmetric
                                    ? asymmetric_budgets(budget, first_is_larger_)
                                    : symmetric_budgets(budget);
        enter(other, first, budgets.first);
        enter(core, first + 1, budgets.second);
    }
    /// Waits for the threads that it started, the last one first, then ends.
    void leave(unsigned core) {
        Thread& thread = threads_[core];
        while (!thread.started.empty() && threads_[thread.started.back()].is_done)
            thread.started.pop_back();
        if (!thread.started.empty()) {
            if (!thread.waits_since) thread.waits_since = b_.cores.now();
            return;
        }
        if (thread.waits_since) b_.cores.waited(core, Doing::join_wait, *thread.waits_since);
        thread.is_done = true;
        if (thread.starter && threads_[*thread.starter].waits_since) leave(*thread.starter);
    }

    Build& b_;
    std::vector<Thread> threads_;
    unsigned next_core_ = 1;
    bool first_is_larger_ = false;
};
// [simulate_threads]

// [simulate_queue]
/// The queue of nodes behind one lock, whose waiters get it in the order in which they came. The
/// first thread makes the root and puts its children there, then starts the others.
class Queued {
  public:
    explicit Queued(Build& build) : b_(build), own_(build.count), seeks_(build.count, false) {}
    void start() { b_.run_node(0, 0); }

    void ended(const CoreRun& run) {
        switch (run.doing) {
            case Doing::starting:
                seek(started_++);
                start_next();
                break;
            case Doing::locked:
                unlock(run.core);
                break;
            case Doing::node:
                made(run.core, run.node);
                break;
            default:
                seek(run.core);
        }
    }

  private:
    struct Visit {
        unsigned core;
        std::optional<std::uint32_t> puts;  ///< this node's children; nothing: takes a node
        double since;
    };

    /// Whether what is below this node stays with the thread that makes it.
    bool keeps(std::uint32_t node) const {
        const auto size = double(queue_.size()), threads = double(b_.count);
        switch (condition()) {
            case Condition::threads:
                return size >= threads;
            case Condition::twice_threads:
                return size >= 2 * threads;
            case Condition::threads_to_threads:
                return size >= std::pow(threads, threads);
            default:
                return b_.node(node).depth > b_.method.deepest;
        }
    }
    Condition condition() const {
        if (b_.method.condition != Condition::combined) return b_.method.condition;
        return b_.node(0).triangles < b_.method.big_scene ? Condition::depth
                                                          : Condition::twice_threads;
    }
    void make(unsigned core, std::uint32_t node) {
        // Once too deep, always too deep: no need to ask at each node.
        if (condition() == Condition::depth && keeps(node))
            b_.run_subtree(core, node);
        else
            b_.run_node(core, node);
    }
    void made(unsigned core, std::uint32_t node) {
        const std::uint32_t first = b_.node(node).first;
        if (first == 0) return node == 0 ? start_next() : seek(core);
        if (!keeps(node)) return lock({core, node, b_.cores.now()});
        own_[core].push_back(first + 1);
        own_[core].push_back(first);
        if (node == 0)
            start_next();
        else
            seek(core);
    }
    void start_next() {
        if (started_ < b_.count)
            b_.cores.run(0, Doing::starting, 0, b_.costs.thread_start);
        else
            seek(0);
    }
    /// Its own nodes first, the last one first: the recursion's order.
    void seek(unsigned core) {
        if (!own_[core].empty()) {
            const std::uint32_t node = own_[core].back();
            own_[core].pop_back();
            make(core, node);
        } else if (queue_.empty())
            seeks_[core] = true;
        else
            lock({core, std::nullopt, b_.cores.now()});
    }
    void lock(Visit visit) {
        visits_.push_back(visit);
        if (visits_.size() == 1) hold(visit);
    }
    void hold(const Visit& visit) {
        b_.cores.waited(visit.core, Doing::lock_wait, visit.since);
        b_.cores.run(visit.core, Doing::locked, visit.puts.value_or(0), b_.costs.lock);
    }
    void unlock(unsigned core) {
        const Visit visit = visits_.front();
        visits_.pop_front();
        std::optional<std::uint32_t> taken;
        if (visit.puts) {
            const std::uint32_t first = b_.node(*visit.puts).first;
            queue_.push_back(first);
            queue_.push_back(first + 1);
        } else if (!queue_.empty()) {
            taken = queue_.front();
            queue_.pop_front();
        }
        if (!visits_.empty()) hold(visits_.front());
        if (visit.puts) wake();
        if (taken)
            make(core, *taken);
        else if (visit.puts == 0u)
            start_next();
        else
            seek(core);
    }
    /// One idle thread for each node that waits.
    void wake() {
        std::size_t left = queue_.size();
        for (unsigned core = 0; core < b_.count && left > 0; ++core)
            if (seeks_[core]) {
                seeks_[core] = false;
                --left;
                seek(core);
            }
    }

    Build& b_;
    std::deque<std::uint32_t> queue_;
    std::deque<Visit> visits_;  ///< the first one holds the lock
    std::vector<std::vector<std::uint32_t>> own_;
    std::vector<bool> seeks_;  ///< found the queue empty
    unsigned started_ = 1;
};
// [simulate_queue]

// [simulate_stealing]
/// Large nodes one after another, each by all threads, which take its chunks. What is below them is
/// for work stealing: a thread takes the latest of its own nodes, or else the oldest of another's.
class Stealing {
  public:
    explicit Stealing(Build& build) : b_(build), own_(build.count), idle_(build.count, false) {}

    void start() {
        add(0);
        next_large();
    }
    void ended(const CoreRun& run) {
        if (run.doing == Doing::stealing)
            enter(run.core, run.node);
        else if (run.doing == Doing::chunk)
            chunk_ended(run.core, run.node);
        else if (run.doing == Doing::node && !b_.node(run.node).is_leaf())
            go_below(run.core, run.node);
        else
            seek(run.core);
    }

  private:
    bool is_large(std::uint32_t node) const {
        return !b_.node(node).is_leaf() && b_.node(node).triangles > b_.method.large;
    }
    void add(std::uint32_t node) {
        if (is_large(node))
            large_.push_back(node);
        else
            own_[0].push_back(node);
    }
    void next_large() {
        if (large_.empty()) {
            for (unsigned core = 0; core < b_.count; ++core) seek(core);
            return;
        }
        const std::uint32_t node = large_.back();
        large_.pop_back();
        const std::size_t size = b_.node(node).triangles;
        const std::size_t chunk = std::clamp<std::size_t>(b_.method.chunk, 1, size);
        chunks_ = (size + chunk - 1) / chunk;
        not_taken_ = not_ended_ = chunks_;
        for (unsigned core = 0; core < b_.count; ++core)
            take_chunk(core, node, core == 0 ? 0.0 : b_.costs.steal);
    }
    void take_chunk(unsigned core, std::uint32_t node, double delay) {
        if (not_taken_ == 0) return;
        --not_taken_;
        const double share = (1.0 - b_.costs.serial_share) / double(chunks_);
        b_.cores.run(core, Doing::chunk, node, delay + b_.costs.chunk + b_.node(node).cost * share);
    }
    void chunk_ended(unsigned core, std::uint32_t node) {
        if (--not_ended_ == 0)
            b_.cores.run(0, Doing::node, node, b_.node(node).cost * b_.costs.serial_share);
        else
            take_chunk(core, node, 0.0);
    }
    void go_below(unsigned core, std::uint32_t index) {
        const std::uint32_t first = b_.node(index).first;
        if (is_large(index)) {
            add(first);
            add(first + 1);
            return next_large();
        }
        offer(core, first);
        enter(core, first + 1);
    }
    void enter(unsigned core, std::uint32_t node) {
        if (b_.node(node).triangles <= b_.method.grain)
            b_.run_subtree(core, node);
        else
            b_.run_node(core, node);
    }
    void offer(unsigned core, std::uint32_t node) {
        own_[core].push_back(node);
        const auto other = std::find(idle_.begin(), idle_.end(), true);
        if (other != idle_.end()) seek(static_cast<unsigned>(other - idle_.begin()));
    }
    void seek(unsigned core) {
        idle_[core] = false;
        if (!own_[core].empty()) {
            const std::uint32_t node = own_[core].back();
            own_[core].pop_back();
            return enter(core, node);
        }
        for (unsigned away = 1; away < b_.count; ++away) {
            auto& theirs = own_[(core + away) % b_.count];
            if (theirs.empty()) continue;
            const std::uint32_t node = theirs.front();
            theirs.pop_front();
            return b_.cores.run(core, Doing::stealing, node, b_.costs.steal);
        }
        idle_[core] = true;
    }

    Build& b_;
    std::vector<std::uint32_t> large_;                        ///< that wait
    std::size_t chunks_ = 0, not_taken_ = 0, not_ended_ = 0;  ///< of the one in hand
    std::vector<std::deque<std::uint32_t>> own_;
    std::vector<bool> idle_;  ///< found nothing to steal
};
// [simulate_stealing]

/// Before the root or after the last node: by one core, or in equal parts by all.
void run_end(Build& build, Doing doing, double cost, bool divided) {
    const unsigned parts = divided ? build.count : 1;
    for (unsigned core = 0; core < parts; ++core) build.cores.run(core, doing, 0, cost / parts);
    while (build.cores.next()) {
    }
}

template <class Method>
void run_nodes(Build& build) {
    Method method(build);
    method.start();
    while (const auto run = build.cores.next()) method.ended(*run);
}

/// With what is no time, events would have no order, or go back.
void check_times(const TaskGraph& graph, const SchedulingCosts& costs) {
    const auto check = [](double cost) {
        if (!(cost >= 0.0 && std::isfinite(cost)))
            throw std::invalid_argument("simulate: a cost that is negative or not finite");
    };
    for (const double cost : {graph.boxing, graph.joining, costs.thread_start, costs.lock,
                              costs.steal, costs.chunk, costs.bandwidth_share})
        check(cost);
    for (const TaskNode& node : graph.nodes) check(node.cost);
    if (!(costs.serial_share >= 0.0 && costs.serial_share <= 1.0))
        throw std::invalid_argument("simulate: a share that is not between 0 and 1");
}

}  // namespace

Schedule simulate(const TaskGraph& graph, const ParallelMethod& method, unsigned cores,
                  const SchedulingCosts& costs) {
    if (cores == 0) throw std::invalid_argument("simulate: no core");
    check_times(graph, costs);
    Cores machine(cores, costs.bandwidth_share);
    Build build{graph, method, cores, costs, machine};
    run_end(build, Doing::boxing, graph.boxing, method.kind == Kind::stealing);
    if (!graph.nodes.empty()) {
        if (method.kind == Kind::queue)
            run_nodes<Queued>(build);
        else if (method.kind == Kind::stealing)
            run_nodes<Stealing>(build);
        else
            run_nodes<Forked>(build);
    }
    run_end(build, Doing::joining, graph.joining, true);
    return machine.finished();
}

}  // namespace space
