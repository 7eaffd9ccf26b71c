// Catalogue C1 to C4: ends that come too early, sums that depend on chunks, scratches that are
// shared; each fault shown by a schedule that is forced, and its cure.
#include "chapters/ch08_parallel_builds/endings.hpp"

#include "chapters/ch08_parallel_builds/asymmetric_builder.hpp"
#include "chapters/ch08_parallel_builds/early_end.hpp"
#include "chapters/ch08_parallel_builds/parallel_partition.hpp"
#include "chapters/ch08_parallel_builds/queue_builder.hpp"
#include "chapters/ch08_parallel_builds/shared_scratch_builder.hpp"
#include "chapters/ch08_parallel_builds/symmetric_builder.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/ch05/watchdog.hpp"
#include "tests/ch08/parallel_builders.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <numeric>
#include <set>
#include <span>
#include <thread>
#include <vector>

namespace space {
namespace {

using namespace std::chrono_literals;

/// A queue's build by so many threads, whose first task is held between pop and flag.
template <Ending E>
void build_held(const std::vector<Triangle>& triangles, unsigned threads, HeldTask& held) {
    using Builder = BasicQueueBuilder<E, std::mutex>;
    const auto tree = Builder::template build<3>(triangles, {{}, threads}, held);
    CHECK(difference(tree, BinnedBuilder::build<3>(triangles)) == "");
}

/// Triangles below the root's first side: of the task that the queue gives out first.
std::size_t in_first_side(const std::vector<Triangle>& triangles) {
    const BvhNodes<3> tree = BinnedBuilder::build<3>(triangles);
    std::size_t count = 0;
    std::vector<std::uint32_t> waiting{2};
    while (!waiting.empty()) {
        const BvhNode<3> node = tree.nodes[waiting.back()];
        waiting.pop_back();
        count += node.count;
        if (!node.is_leaf()) waiting.insert(waiting.end(), {node.first, node.first + 1});
    }
    return count;
}

/// Counts as CountTasks does, slowly: what is in the queue before it is counted is taken before.
class SlowCount {
  public:
    explicit SlowCount(unsigned) {}
    void add(std::size_t tasks) {
        std::this_thread::sleep_for(1ms);
        unfinished_ += static_cast<int>(tasks);
        untaken_ += static_cast<int>(tasks);
    }
    void begin(unsigned) { uncounted += --untaken_ < 0; }
    void end(unsigned) { --unfinished_; }
    bool is_over(unsigned) { return unfinished_ <= 0; }

    static inline std::atomic<int> uncounted{0};  ///< tasks that were taken

  private:
    std::atomic<int> unfinished_{0}, untaken_{0};
};

}  // namespace

TEST_CASE("C1: who polls flags quits while a task is in hand, though it looks again and again") {
    const Watchdog watchdog(120);
    const auto triangles = scenes::soup(300, 0.1f, 1);
    for (const unsigned threads : {2u, 4u, 8u}) {
        HeldTask held(triangles.size(), threads, 60s);
        build_held<PollFlags>(triangles, threads, held);
        CHECK(held.too_early() == threads - 1);
        CHECK(held.quit_while_held() == threads - 1);
        CHECK(held.most_missing() >= in_first_side(triangles));
        if (threads == 2) CHECK(held.most_missing() == in_first_side(triangles));
    }
}

TEST_CASE(
    "who polls looks twice more after it has seen nobody run, and waits for who says it runs") {
    PollFlags ending(2);
    ending.begin(1);
    for (int i = 0; i < 10; ++i) CHECK_FALSE(ending.is_over(0));
    ending.end(1);
    CHECK_FALSE(ending.is_over(0));
    CHECK_FALSE(ending.is_over(0));
    CHECK(ending.is_over(0));
}

TEST_CASE("C1, the cure: who counts unfinished tasks waits for the one in hand") {
    const Watchdog watchdog(120);
    const auto triangles = scenes::soup(300, 0.1f, 1);
    for (const unsigned threads : {2u, 4u, 8u}) {
        HeldTask held(triangles.size(), threads, 30ms);
        build_held<CountTasks>(triangles, threads, held);
        CHECK(held.too_early() == 0);
        CHECK(held.quit_while_held() == 0);
        CHECK(held.most_missing() == 0);
    }
}

TEST_CASE(
    "C1: a task's children are counted before it is subtracted, or the count is 0 too early") {
    CountTasks ending(2);
    ending.add(1);  // the root
    CHECK_FALSE(ending.is_over(1));
    ending.add(2);
    ending.end(0);
    CHECK_FALSE(ending.is_over(1));
    ending.end(0);
    ending.end(1);
    CHECK(ending.is_over(1));

    CountTasks wrong(2);
    wrong.add(1);
    wrong.end(0);
    CHECK(wrong.is_over(1));  // and the root's children are still to come
}

TEST_CASE("C1: the queue's tasks are counted before anybody can take them") {
    const Watchdog watchdog(120);
    const auto triangles = scenes::soup(200, 0.1f, 2);
    BasicQueueBuilder<SlowCount, std::mutex>::Config config;
    config.threads = 4, config.condition = QueueCondition::twice_threads;
    BasicQueueBuilder<SlowCount, std::mutex>::build<3>(triangles, config);
    CHECK(SlowCount::uncounted == 0);
}

TEST_CASE("C2: who quits when the queue is empty leaves the work to the others") {
    const Watchdog watchdog(120);
    const auto triangles = scenes::soup(300, 0.1f, 1);
    for (const unsigned threads : {2u, 4u}) {
        HeldTask held(triangles.size(), threads, 60s);
        build_held<QuitWhenEmpty>(triangles, threads, held);
        CHECK(held.too_early() == threads - 1);
    }
}

TEST_CASE("C3: a float sum depends on the chunks that it is made in; a box and a count do not") {
    Pcg32 random(2);
    const auto triangles = scenes::soup(sized(100'000u, 10'000u), 0.1f, 3);
    std::set<float> sums;
    std::set<std::size_t> counts;
    std::vector<BasicAabb<3>> boxes;
    for (std::size_t chunks = 1; chunks <= 64; ++chunks) {
        float sum = 0.0f;
        std::size_t count = 0;
        Aabb box;
        const ChunksOf parts{triangles.size(), (triangles.size() + chunks - 1) / chunks};
        for (std::size_t i = 0; i < parts.count(); ++i) {
            float sum_of_part = 0.0f;
            Aabb box_of_part;
            for (const Triangle& t : parts(std::span(triangles), i)) {
                sum_of_part += static_cast<float>(bounds(t).half_area());
                box_of_part.extend(bounds(t));
                ++count;
            }
            sum += sum_of_part;
            box.extend(box_of_part);
        }
        sums.insert(sum), counts.insert(count), boxes.push_back(box);
    }
    CHECK(sums.size() > sized(10u, 5u));
    CHECK(counts.size() == 1);
    CHECK(std::ranges::count(boxes, boxes[0]) == 64);
}

TEST_CASE("C4: a scratch that two threads share loses triangles, without any data race") {
    const Watchdog watchdog(60);
    const auto triangles = scenes::soup(400, 0.1f, 3);
    for (const ScratchPart part : {ScratchPart::right_bounds, ScratchPart::dimension}) {
        HeldCut held(part), again(part), cured(part);
        const auto tree = SharedScratchBuilder<>::build<3>(triangles, {}, held);
        const auto lost = lost_polygons<3>(tree, triangles);
        CHECK(lost.size() > 90);
        CHECK(lost.size() < triangles.size());
        CHECK(lost ==
              lost_polygons<3>(SharedScratchBuilder<>::build<3>(triangles, {}, again), triangles));
        // All are in the tree, each once: what is wrong is boxes.
        std::vector<std::uint32_t> all = tree.references, expected(triangles.size());
        std::ranges::sort(all);
        std::iota(expected.begin(), expected.end(), 0u);
        CHECK(all == expected);
        const auto right = SharedScratchBuilder<>::build<3>(triangles, {.is_shared = false}, cured);
        CHECK(lost_polygons<3>(right, triangles).empty());
    }
}

TEST_CASE("of a budget, each thread is one, and what is left is divided as in the thesis") {
    CHECK(SymmetricBuilder::divide(1) == ThreadBudgets{0, 0});
    CHECK(SymmetricBuilder::divide(2) == ThreadBudgets{0, 1});
    CHECK(SymmetricBuilder::divide(3) == ThreadBudgets{1, 1});
    CHECK(SymmetricBuilder::divide(6) == ThreadBudgets{2, 3});
    CHECK(SymmetricBuilder::divide(7) == ThreadBudgets{3, 3});
    for (unsigned budget = 1; budget < 100; ++budget) {
        const auto [first, second] = SymmetricBuilder::divide(budget);
        CHECK(first + second + 1 == budget);
    }
    AsymmetricBuilder::Divide divide;
    CHECK(divide(3, 10, 4) == ThreadBudgets{2, 0});
    CHECK(divide(2, 4, 6) == ThreadBudgets{1, 0});  // the root has decided
}

TEST_CASE("the queue's conditions") {
    using Condition = QueueCondition;
    const auto recurses = [](Condition condition, unsigned threads, std::size_t queued,
                             unsigned depth, std::size_t triangles = 1000) {
        return QueueRule{condition, threads, triangles}.should_recurse(queued, depth);
    };
    CHECK_FALSE(recurses(Condition::threads, 4, 3, 99));
    CHECK(recurses(Condition::threads, 4, 4, 0));
    CHECK_FALSE(recurses(Condition::twice_threads, 4, 7, 99));
    CHECK(recurses(Condition::twice_threads, 4, 8, 0));
    CHECK_FALSE(recurses(Condition::threads_to_threads, 4, 255, 99));
    CHECK(recurses(Condition::threads_to_threads, 4, 256, 0));
    CHECK_FALSE(recurses(Condition::threads_to_threads, 1024, std::size_t{1} << 60, 99));
    CHECK_FALSE(recurses(Condition::depth, 4, 999, 4));
    CHECK(recurses(Condition::depth, 4, 0, 5));
    CHECK(recurses(Condition::combined, 2, 0, 5, 499'999));
    CHECK_FALSE(recurses(Condition::combined, 2, 0, 5, 500'000));
    CHECK(recurses(Condition::combined, 2, 4, 0, 500'000));
}

TEST_CASE("a partition by all threads puts as many first as one by one thread, and all of them") {
    Pcg32 random(5);
    WorkStealing threads(3);
    for (int round = 0; round < sized(300, 30); ++round) {
        const std::uint32_t size = random.below(200), limit = random.below(100);
        const std::size_t chunk = 1 + random.below(30);
        std::vector<std::uint32_t> values;
        for (std::uint32_t i = 0; i < size; ++i) values.push_back(random.below(100));
        std::vector<std::uint32_t> parted = values;
        const auto is_first = [&](std::uint32_t value) { return value < limit; };
        ParallelPartition(std::span(parted), chunk, threads).run(is_first);
        CHECK(std::ranges::is_partitioned(parted, is_first));
        std::ranges::sort(values), std::ranges::sort(parted);
        CHECK(values == parted);
    }
}

}  // namespace space
