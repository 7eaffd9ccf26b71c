// K7 of the catalogue of failures: two threads cut the same node, or one sees a node whose children
// do not stand yet. Here the threads are led through just these orders of events, so that nothing
// hangs on luck.
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "common/observer.hpp"
#include "tests/catch.hpp"
#include "tests/ch05/watchdog.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <atomic>
#include <functional>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

namespace space {
namespace {

/// The plain method: a node has a flag, and whoever finds it unset makes the node.
class CarelessNodes {
  public:
    /// When the flag is set.
    enum class Order { flag_last, flag_first };

    CarelessNodes(std::span<const Triangle> triangles, Order order,
                  std::function<void()> at_weak_point)
        : box(KdSplitter<3>(triangles, {}).root().cell),
          splitter_(triangles, {}),
          order_(order),
          at_weak_point_(std::move(at_weak_point)),
          slots_(10'000) {
        slots_[0].task = splitter_.root();
    }

    const Aabb box;
    bool empty() const { return false; }
    KdNode node(std::uint32_t index) const {
        if (!slots_[index].is_made) make(index);
        return slots_[index].node;
    }
    std::span<const std::uint32_t> own(std::uint32_t index) const { return slots_[index].leaf; }
    int times_made(std::uint32_t index) const { return slots_[index].times_made; }

  private:
    struct Slot {
        std::atomic<bool> is_made{false};
        KdNode node = KdNode::leaf(0, 0);
        KdSplitter<3>::Task task = {};
        std::vector<std::uint32_t> leaf = {};
        int times_made = 0;
    };

    void make(std::uint32_t index) const {
        Slot& slot = slots_[index];
        if (order_ == Order::flag_last) weak_point(index);  // both have seen the flag unset
        ++slot.times_made;
        NoObserver none;
        const std::optional<KdSplit> split = splitter_.choose(slot.task, none);
        if (split) {
            const std::uint32_t below = size_;
            size_ += 2;
            slot.node = KdNode::inner(*split, below);
            if (order_ == Order::flag_first) {
                slot.is_made = true;
                weak_point(index);  // another sees the node, and its children are empty
            }
            auto children = splitter_.divide(slot.task, *split, none);
            slot.task = {};
            slots_[below].task = std::move(children.below);
            slots_[below + 1].task = std::move(children.above);
        } else {
            slot.node = KdNode::leaf(0, static_cast<std::uint32_t>(slot.task.references.size()));
            for (const auto& reference : slot.task.references)
                slot.leaf.push_back(reference.polygon);
        }
        slot.is_made = true;
    }
    void weak_point(std::uint32_t index) const {
        if (index == 0 && at_weak_point_) std::exchange(at_weak_point_, nullptr)();
    }

    KdSplitter<3> splitter_;
    Order order_;
    mutable std::function<void()> at_weak_point_;
    mutable std::vector<Slot> slots_;
    mutable std::uint32_t size_ = 2;
};

template <class Nodes>
std::optional<Hit> nearest_in(const Nodes& nodes, std::span<const Triangle> triangles,
                              const Ray& ray) {
    NoCounts none;
    return nearest_found([&](const auto& found) {
        double limit = infinity;
        walk_cells(nodes, ray, none, [&](std::uint32_t node) {
            for (const std::uint32_t i : nodes.own(node))
                if (auto hit = FilteredExact::intersect(ray, triangles[i])) {
                    hit->triangle = i;
                    limit = found(*hit);
                }
            return limit;
        });
    });
}

/// A floor of squares at z = 0, and a ray straight down onto it.
struct Floor {
    std::vector<Triangle> triangles =
        scenes::sheet(16, 16, [](int i, int j) { return Point3(i, j, 0); });
    Ray ray{{3.25f, 5.75f, 1}, {0, 0, -1}};
    Ray other_ray{{12.25f, 9.75f, 1}, {0, 0, -1}};
    std::optional<Hit> hit = closest_hit(KdTree<>::build(triangles), ray),
                       other_hit = closest_hit(KdTree<>::build(triangles), other_ray);
};

}  // namespace

TEST_CASE("K7, the plain method: two threads that both find the flag unset make the node twice") {
    const Floor floor;
    REQUIRE((floor.hit && floor.other_hit));
    const CarelessNodes* shared = nullptr;
    std::optional<Hit> other_hit;
    const CarelessNodes nodes(floor.triangles, CarelessNodes::Order::flag_last, [&] {
        std::jthread([&] {
            other_hit = nearest_in(*shared, floor.triangles, floor.other_ray);
        }).join();
    });
    shared = &nodes;
    const auto hit = nearest_in(nodes, floor.triangles, floor.ray);
    CHECK(nodes.times_made(0) == 2);
    CHECK(other_hit == floor.other_hit);  // the one who was quicker is lucky
    CHECK(!hit);                          // the other cut a list that had been given away
}

TEST_CASE("K7, the plain method: who sees the flag before the children stand finds nothing") {
    const Floor floor;
    const CarelessNodes* shared = nullptr;
    std::optional<Hit> other_hit;
    const CarelessNodes nodes(floor.triangles, CarelessNodes::Order::flag_first, [&] {
        std::jthread([&] {
            other_hit = nearest_in(*shared, floor.triangles, floor.other_ray);
        }).join();
    });
    shared = &nodes;
    nearest_in(nodes, floor.triangles, floor.ray);
    CHECK(!other_hit);
    // Nor does anybody later: the empty child has been made a leaf.
    CHECK(nearest_in(nodes, floor.triangles, floor.other_ray) != floor.other_hit);
}

TEST_CASE("K7, the cure: one makes the node, the other waits until the children stand") {
    /// Lets another thread come to the root while it is being made, before it is cut or after.
    struct Meeting : NoObserver {
        struct Shared {
            bool after_cutting;
            std::function<void()> start_other;
            std::atomic<int> entered{0};
            std::atomic<bool> other_waits{false};
        };
        Shared* shared;

        explicit Meeting(Shared* with) : shared(with) {}
        using NoObserver::observe;
        void observe(const LazyKdEvent::Waits&) const { shared->other_waits = true; }
        void observe(const LazyKdEvent::Entered& event) const {
            if (event.node == 0) ++shared->entered;
            if (event.node == 0 && !shared->after_cutting) meet();
        }
        void observe(const KdSplitter<3>::Chosen& event) const {
            if (event.node == 0 && shared->after_cutting) meet();
        }
        void meet() const {
            shared->start_other();
            while (!shared->other_waits) std::this_thread::yield();
        }
    };
    const Watchdog watchdog(60);
    const Floor floor;
    for (const bool after_cutting : {false, true}) {
        const WatchedLazyKdTree<FilteredExact, Meeting>* tree = nullptr;
        std::optional<Hit> other_hit;
        std::jthread other;
        Meeting::Shared shared{
            .after_cutting = after_cutting, .start_other = [&] {
                other = std::jthread([&] { other_hit = closest_hit(*tree, floor.other_ray); });
            }};
        const auto built = WatchedLazyKdTree<FilteredExact, Meeting>::build(
            floor.triangles, {.at_once = 0}, Meeting(&shared));
        tree = &built;
        const auto hit = closest_hit(built, floor.ray);
        other.join();
        CHECK(shared.entered == 1);
        CHECK(hit == floor.hit);
        CHECK(other_hit == floor.other_hit);
    }
}

}  // namespace space
