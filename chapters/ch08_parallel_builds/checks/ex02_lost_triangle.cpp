#include "ex02_lost_triangle.hpp"

#include "common/pcg32.hpp"
#include "tests/check.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

using namespace space;

namespace {

using Boxes = std::vector<BvhReference<2>>;

BvhReference<2> box_at(std::uint32_t number, float x, float y, float width, float height) {
    BasicAabb<2> box;
    box.extend({x, y});
    box.extend({x + width, y + height});
    return {box, number};
}

/// Bytes that new has given, and how much of what it gave has not come back, in all threads.
std::atomic<std::size_t> given_bytes{0};
std::atomic<std::ptrdiff_t> living{0};

/// Rows along x are cut by x, columns along y by y.
Boxes row(std::size_t size) {
    Boxes boxes;
    for (std::uint32_t i = 0; i < size; ++i)
        boxes.push_back(box_at(i, 10.0f * float(i * 7 % size), float(i % 3), 4, 2));
    return boxes;
}
Boxes column(std::size_t size) {
    Boxes boxes;
    for (std::uint32_t i = 0; i < size; ++i)
        boxes.push_back(box_at(i, float(i % 2), 10.0f * float(i * 5 % size), 3, 5));
    return boxes;
}
Boxes anywhere(std::size_t size, Pcg32& random) {
    Boxes boxes;
    for (std::uint32_t i = 0; i < size; ++i) {
        const auto x = float(random.below(100));
        const auto y = float(random.below(100));
        const auto width = float(1 + random.below(9));
        const auto height = float(1 + random.below(9));
        boxes.push_back(box_at(i, x, y, width, height));
    }
    return boxes;
}

/// The least cost over all cuts along both axes, every box made anew.
double least_cost(Boxes boxes) {
    double least = infinity;
    for (const int axis : {0, 1}) {
        std::ranges::sort(boxes, {}, [axis](const BvhReference<2>& box) {
            return std::pair(box.box.centroid()[axis], box.polygon);
        });
        const std::span<const BvhReference<2>> all(boxes);
        for (std::size_t i = 1; i < boxes.size(); ++i)
            least = std::min(least, double(box_around<2>(all.first(i)).half_area()) * double(i) +
                                        double(box_around<2>(all.subspan(i)).half_area()) *
                                            double(all.size() - i));
    }
    return least;
}

std::uint32_t lost(std::span<const BvhReference<2>> side, const BasicAabb<2>& box) {
    std::uint32_t count = 0;
    for (const BvhReference<2>& reference : side)
        for (const int axis : {0, 1})
            if (reference.box.min[axis] < box.min[axis] ||
                reference.box.max[axis] > box.max[axis]) {
                ++count;
                break;
            }
    return count;
}

/// No box lies outside of its side, and the cut is the cheapest.
void check_cut(const Boxes& boxes, const BvhCut<2>& cut, double wanted) {
    REQUIRE(cut.count >= 1);
    REQUIRE(cut.count < boxes.size());
    const std::span<const BvhReference<2>> all(boxes);
    const auto first = all.first(cut.count), second = all.subspan(cut.count);
    const std::uint32_t lost_boxes = lost(first, cut.first) + lost(second, cut.second);
    REQUIRE(lost_boxes == 0);
    REQUIRE(cut.first == box_around<2>(first));
    REQUIRE(cut.second == box_around<2>(second));
    REQUIRE(double(cut.first.half_area()) * double(first.size()) +
                double(cut.second.half_area()) * double(second.size()) ==
            wanted);
}

/// Steps that a task has; a stub that never ends is told so.
constexpr int most_steps = 1'000;
int steps_alone(Boxes boxes) {
    SharedBuilder builder;
    SweepTask task(builder, boxes);
    int steps = 1;
    while (task.step()) REQUIRE(++steps < most_steps);
    return steps;
}
/// A task from its beginning to its end.
void make_and_forget(Boxes& boxes) {
    SharedBuilder builder;
    SweepTask task(builder, boxes);
    for (int steps = 0; task.step() && steps < most_steps;) ++steps;
}

/// Both nodes are cut, the order of steps given as a text of A and B.
void play(const std::string& schedule, const Boxes& a, const Boxes& b, double cost_a,
          double cost_b) {
    Boxes boxes_a = a, boxes_b = b;
    SharedBuilder builder;
    SweepTask task_a(builder, boxes_a), task_b(builder, boxes_b);
    for (const char who : schedule) who == 'A' ? task_a.step() : task_b.step();
    const std::string& order = schedule;
    if (task_a.cut().count == 0 || task_b.cut().count == 0) FAIL("no cut after " << order);
    const auto is_right = [](const Boxes& boxes, const BvhCut<2>& cut, double wanted) {
        const std::span<const BvhReference<2>> all(boxes);
        return cut.count >= 1 && cut.count < boxes.size() &&
               cut.first == box_around<2>(all.first(cut.count)) &&
               cut.second == box_around<2>(all.subspan(cut.count)) &&
               double(cut.first.half_area()) * double(cut.count) +
                       double(cut.second.half_area()) * double(boxes.size() - cut.count) ==
                   wanted;
    };
    if (is_right(boxes_a, task_a.cut(), cost_a) && is_right(boxes_b, task_b.cut(), cost_b)) return;
    CAPTURE(order);  // made for a report alone: there are many schedules
    check_cut(boxes_a, task_a.cut(), cost_a);
    check_cut(boxes_b, task_b.cut(), cost_b);
}

std::string times(int count, char who) {
    return std::string(std::size_t(count), who);
}

}  // namespace

// Each new of the program passes here. Not inlined: GCC would warn of free() for what is new's.
[[gnu::noinline]] void* operator new(std::size_t size) {
    given_bytes += size;
    ++living;
    if (void* const memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    try {
        return operator new(size);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
    if (memory) --living;
    std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    operator delete(memory);
}

TEST_CASE("a task alone finds the cheapest cut of its boxes") {
    Pcg32 random(1);
    for (int i = 0; i < 200; ++i) {
        Boxes boxes = anywhere(2 + random.below(SharedBuilder::most_boxes - 1), random);
        const double wanted = least_cost(boxes);
        SharedBuilder builder;
        SweepTask task(builder, boxes);
        int steps = 1;
        while (task.step()) REQUIRE(++steps < most_steps);
        CAPTURE(i);
        check_cut(boxes, task.cut(), wanted);
    }
}

TEST_CASE("of two tasks that take turns, none loses a box") {
    const Boxes a = row(9), b = column(6);
    const int steps_a = steps_alone(a), steps_b = steps_alone(b);
    std::string schedule;
    for (int i = 0; i < std::max(steps_a, steps_b); ++i)
        schedule += std::string(i < steps_a ? "A" : "") + (i < steps_b ? "B" : "");
    play(schedule, a, b, least_cost(a), least_cost(b));
}

TEST_CASE("a task that is begun and ended while another waits disturbs nothing") {
    const Boxes a = row(8), b = column(8);
    const double cost_a = least_cost(a), cost_b = least_cost(b);
    const int steps_a = steps_alone(a), steps_b = steps_alone(b);
    for (int before = 0; before <= steps_a; ++before)
        play(times(before, 'A') + times(steps_b, 'B') + times(steps_a - before, 'A'), a, b, cost_a,
             cost_b);
    for (int before = 0; before <= steps_b; ++before)
        play(times(before, 'B') + times(steps_a, 'A') + times(steps_b - before, 'B'), a, b, cost_a,
             cost_b);
}

TEST_CASE("in whatever order two tasks make their steps, both find their own cut") {
    Pcg32 random(2);
    for (const auto& [a, b] :
         {std::pair(row(3), column(4)), std::pair(row(5), row(4)), std::pair(column(3), row(5))}) {
        const double cost_a = least_cost(a), cost_b = least_cost(b);
        const int steps_a = steps_alone(a), steps_b = steps_alone(b);
        for (int i = 0; i < sized(20'000, 500); ++i) {
            std::string schedule;
            int left_a = steps_a, left_b = steps_b;
            while (left_a + left_b > 0)
                if (int(random.below(std::uint32_t(left_a + left_b))) < left_a)
                    schedule += 'A', --left_a;
                else
                    schedule += 'B', --left_b;
            play(schedule, a, b, cost_a, cost_b);
        }
    }
}

TEST_CASE("many tasks of all sizes, step by step in any order") {
    Pcg32 random(3);
    for (int round = 0; round < sized(100, 10); ++round) {
        std::vector<Boxes> boxes;
        std::vector<double> wanted;
        for (int i = 0; i < 8; ++i) {
            boxes.push_back(anywhere(2 + random.below(SharedBuilder::most_boxes - 1), random));
            wanted.push_back(least_cost(boxes.back()));
        }
        SharedBuilder builder;
        std::vector<std::optional<SweepTask>> tasks(boxes.size());
        for (std::size_t i = 0; i < tasks.size(); ++i) tasks[i].emplace(builder, boxes[i]);
        std::vector<std::size_t> open{0, 1, 2, 3, 4, 5, 6, 7};
        for (int step = 0; !open.empty(); ++step) {
            REQUIRE(step < 8 * most_steps);
            const std::size_t i = random.below(std::uint32_t(open.size()));
            if (!tasks[open[i]]->step()) open.erase(open.begin() + std::ptrdiff_t(i));
        }
        for (std::size_t i = 0; i < tasks.size(); ++i) {
            CAPTURE(round, i);
            check_cut(boxes[i], tasks[i]->cut(), wanted[i]);
        }
    }
}

TEST_CASE("tasks may be moved between their steps, and go on in other threads") {
    Boxes boxes_a = row(20), boxes_b = column(20);
    const double cost_a = least_cost(boxes_a), cost_b = least_cost(boxes_b);
    SharedBuilder builder;
    std::optional<SweepTask> a(std::in_place, builder, boxes_a), b(std::in_place, builder, boxes_b);
    bool a_has_more = true, b_has_more = true, is_swapped = false;
    for (int steps = 0; a_has_more || b_has_more; ++steps) {
        REQUIRE(steps < most_steps);
        if (a_has_more) std::thread([&] { a_has_more = a->step(); }).join();
        if (b_has_more) std::thread([&] { b_has_more = b->step(); }).join();
        SweepTask moved = std::move(*a);  // each into the other's place
        a.emplace(std::move(*b));
        b.emplace(std::move(moved));
        std::swap(a_has_more, b_has_more);
        is_swapped = !is_swapped;
    }
    check_cut(boxes_a, (is_swapped ? b : a)->cut(), cost_a);
    check_cut(boxes_b, (is_swapped ? a : b)->cut(), cost_b);
}

TEST_CASE("a task promises to change nothing that is shared") {
    const bool takes_const =
        std::is_constructible_v<SweepTask, const SharedBuilder&, std::span<BvhReference<2>>>;
    REQUIRE(takes_const);
}

TEST_CASE("a task of few boxes keeps few bounds") {
    REQUIRE(sizeof(SweepTask) < 20 * sizeof(BasicAabb<2>));
    Boxes boxes = row(2);
    const std::size_t before = given_bytes;
    make_and_forget(boxes);
    const std::size_t bytes = given_bytes - before;
    REQUIRE(bytes < SharedBuilder::most_boxes / 2 * sizeof(BasicAabb<2>));
}

TEST_CASE("a task that is gone leaves nothing behind that others would share") {
    std::vector<Boxes> many;  // more than there have been at a time: in new places
    for (std::size_t i = 0; i < 200; ++i) many.push_back(row(3 + i % 60));
    const std::ptrdiff_t before = living;
    for (Boxes& boxes : many) make_and_forget(boxes);
    const std::ptrdiff_t left = living - before;
    REQUIRE(left == 0);
}
