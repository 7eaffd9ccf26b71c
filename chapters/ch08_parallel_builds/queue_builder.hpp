/// @file
/// The queue of node contexts of [BvhThesis13], section 4.4: breadth first by all workers, then
/// depth first, each its own subtree.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_boxes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/top_down.hpp"
#include "chapters/ch08_parallel_builds/bvh_parts.hpp"
#include "chapters/ch08_parallel_builds/endings.hpp"
#include "chapters/ch08_parallel_builds/locks.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <limits>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

namespace space {

/// Event: a worker has taken a task out of the queue, and has not yet told that it works.
template <int D>
struct BvhTaken {
    const BvhTask<D>& task;
    unsigned worker;
};
/// Event: a worker believes that all is done.
struct BvhQuits {
    unsigned worker;
};

/// When a node's sides are not queued, but made by who has made the node, depth first. |Q| is the
/// length of the queue, T the number of threads, L the depth.
enum class QueueCondition {
    threads,             ///< (1) |Q| >= T
    twice_threads,       ///< (2) |Q| >= 2 T
    threads_to_threads,  ///< (3) |Q| >= T^T
    depth,               ///< (4) L > 4
    combined,            ///< (4) below 500 000 triangles, (2) from there on
};

// [should_recurse]
/// A condition for a build: of so many threads and triangles.
struct QueueRule {
    QueueCondition condition;
    unsigned threads;
    std::size_t triangles;

    bool should_recurse(std::size_t queued, unsigned depth) const {
        switch (condition) {
            case QueueCondition::threads:
                return queued >= threads;
            case QueueCondition::twice_threads:
                return queued >= 2 * std::size_t{threads};
            case QueueCondition::threads_to_threads:
                return queued >= to_itself(threads);
            case QueueCondition::depth:
                return depth > 4;
            case QueueCondition::combined:
                break;
        }
        QueueRule part = *this;
        part.condition =
            triangles < 500'000 ? QueueCondition::depth : QueueCondition::twice_threads;
        return part.should_recurse(queued, depth);
    }

    /// T^T; from 16 on it is beyond 64 bits, and no queue is as long.
    static std::size_t to_itself(unsigned threads) {
        if (threads >= 16) return std::numeric_limits<std::size_t>::max();
        std::size_t power = 1;
        for (unsigned i = 0; i < threads; ++i) power *= threads;
        return power;
    }
};
// [should_recurse]

/// The workers' tasks, first in, first out.
template <class Item, Lock L>
class TaskQueue {
  public:
    void push(Item first, Item second) {
        const std::lock_guard guard(lock_);
        items_.insert(items_.end(), {first, second});
        size_.store(items_.size(), std::memory_order_relaxed);
    }
    /// @return nothing, a null pointer, where it is empty
    Item pop() {
        const std::lock_guard guard(lock_);
        if (items_.empty()) return {};
        const Item item = items_.front();
        items_.pop_front();
        size_.store(items_.size(), std::memory_order_relaxed);
        return item;
    }
    /// As it was a moment ago.
    std::size_t size() const { return size_.load(std::memory_order_relaxed); }

  private:
    L lock_;
    std::deque<Item> items_;
    std::atomic<std::size_t> size_{0};
};

/// The workers of one build.
template <int D, Ending E, Lock L, class Observer>
class QueuedBuild {
  public:
    QueuedBuild(const BinnedBuilder::Config& config, const QueueRule& rule, Observer& observer)
        : config_(config), rule_(rule), observer_(observer), ending_(rule.threads) {}

    // [queue_build]
    void build(BvhPart<D>& root, std::span<std::uint32_t> names) {
        names_ = names;
        BinnedBuilder::Choice<D> choice{config_};
        make(root, choice, [](std::size_t, unsigned) { return true; });  // the root alone
        std::vector<std::jthread> workers;
        try {
            for (unsigned i = 1; i < rule_.threads; ++i)
                workers.emplace_back([this, i] { work(i); });
        } catch (...) {
            fail();  // no more threads
        }
        work(0);
        workers.clear();  // waits for all
        if (error_) std::rethrow_exception(error_);
    }

  private:
    void work(unsigned worker) {
        try {
            BinnedBuilder::Choice<D> choice{config_};  // each worker has bins of its own
            while (!has_failed_) {
                if (BvhPart<D>* const part = queue_.pop()) {
                    observer_.observe(BvhTaken<D>{part->task, worker});
                    ending_.begin(worker);
                    make(*part, choice, [&](std::size_t queued, unsigned depth) {
                        return !rule_.should_recurse(queued, depth);
                    });
                    ending_.end(worker);
                } else if (ending_.is_over(worker)) {
                    observer_.observe(BvhQuits{worker});
                    return;
                }
            }
        } catch (...) {
            fail();
        }
    }

    /// A part; what queues(length of the queue, depth of the node) says is put into the queue.
    template <class Queues>
    void make(BvhPart<D>& part, BinnedBuilder::Choice<D>& choice, const Queues& queues) {
        make_part<D>(
            part, {config_.max_leaf_size, config_.max_depth}, choice,
            [&](const BvhTask<D>& first, const BvhTask<D>&) {
                return queues(queue_.size(), first.depth - 1);
            },
            [&](BvhPart<D>& first, BvhPart<D>& second) {
                ending_.add(2);
                queue_.push(&first, &second);
            },
            observer_, names_);
    }
    // [queue_build]

    /// The first exception is kept, and everybody stops.
    void fail() {
        const std::lock_guard guard(error_lock_);
        if (!error_) error_ = std::current_exception();
        has_failed_ = true;
    }

    const BinnedBuilder::Config& config_;
    QueueRule rule_;
    Observer& observer_;
    std::span<std::uint32_t> names_;
    E ending_;
    TaskQueue<BvhPart<D>*, L> queue_;
    std::atomic<bool> has_failed_{false};
    std::exception_ptr error_;
    std::mutex error_lock_;
};

/// The published method, with any way to end and any lock around the queue.
template <Ending E = CountTasks, Lock L = Spinlock<>>
struct BasicQueueBuilder {
    using Condition = QueueCondition;
    /// The sequential builder's, how many threads, and when they build depth first.
    struct Config : BinnedBuilder::Config {
        unsigned threads = 1;
        Condition condition = Condition::combined;
    };

    template <int D = 3, class Observer = NoObserver>
    static BvhNodes<D> build(std::span<const Simplex<D>> polygons, const Config& config = {},
                             Observer&& observer = {}) {
        const unsigned threads = build_threads(config.threads);
        std::vector<BvhReference<D>> all = boxed<D>(polygons);
        return build_in_parts<D>(all, box_around<D>(all), threads, [&](auto& root, auto names) {
            QueuedBuild<D, E, L, Observer>(config, {config.condition, threads, all.size()},
                                           observer)
                .build(root, names);
        });
    }
};
using QueueBuilder = BasicQueueBuilder<>;

}  // namespace space
