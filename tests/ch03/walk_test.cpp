// What a ray's walk tells its observer: enough to go through it step by step.
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"

#include <vector>

namespace space {
namespace {

using Tree = BspTree<2>;

std::vector<Segment> some_segments(Pcg32& random) {
    const Aabb2 square{{-1, -1}, {1, 1}};
    std::vector<Segment> segments(12);
    for (Segment& segment : segments) {
        segment.a = random_point(random, square);
        segment.b = random_point(random, square);
    }
    return segments;
}

/// Keeps a stack by what it is told, as a reader of the steps does.
struct Reader {
    const Tree& tree;
    const double& limit;  ///< beyond which nothing matters
    /// A part of the ray that waits behind a node's plane.
    struct Waiting {
        std::uint32_t crossed, cell;
        double enter, leave;
    };
    std::vector<Waiting> waiting = {};
    std::uint32_t next = 0;  ///< the node that is visited next
    std::size_t visited = 0, crossed = 0, dropped = 0;
    bool right = true;

    void observe(const BspWalk::Visited& event) {
        ++visited;
        right = right && event.node == next && event.enter <= event.leave;
        const Tree::Node& node = tree.nodes[event.node];
        const PlaneCrossing& crossing = event.crossing;
        const std::uint32_t near = crossing.starts_in_front ? node.front : node.back,
                            far = crossing.starts_in_front ? node.back : node.front;
        next = crossing.latest < event.enter ? far : near;
        if (crossing.latest >= event.enter && crossing.earliest <= event.leave)
            waiting.push_back(
                {event.node, far, std::max(event.enter, crossing.earliest), event.leave});
    }
    template <class Event>
    bool is_on_top(const Event& event) const {
        return next == Tree::none && !waiting.empty() && waiting.back().crossed == event.node &&
               waiting.back().enter == event.enter && waiting.back().leave == event.leave;
    }
    void observe(const BspWalk::Crossed& event) {
        ++crossed;
        right = right && is_on_top(event);
        if (!waiting.empty()) next = waiting.back().cell, waiting.pop_back();
    }
    void observe(const BspWalk::Dropped& event) {
        ++dropped;
        right = right && is_on_top(event) && event.enter > limit;
        if (!waiting.empty()) waiting.pop_back();
    }
};

}  // namespace

TEST_CASE("a ray's walk tells every node, crossing and part left alone, in the stack's order") {
    Pcg32 random(11);
    std::size_t dropped = 0;
    for (int i = 0; i < 2'000; ++i) {
        const Tree tree = BspBuilder<2>::build(some_segments(random));
        const Point2 from = random_point(random, Aabb2{{-2, -2}, {2, 2}}),
                     to = random_point(random, Aabb2{{-1, -1}, {1, 1}});
        const double end = random.uniform_double();  // as if the ray had hit there
        double limit = infinity;
        std::size_t crossed = 0;
        TraversalCounts counts;
        Reader reader{tree, limit};
        front_to_back(
            tree, BasicRay<2>{from, to - from}, counts,
            [&](const Tree::Node&) {
                if (++crossed == 3) limit = end;
                return limit;
            },
            reader);
        CHECK(reader.right);
        CHECK(reader.waiting.empty());
        CHECK(reader.visited == counts.nodes_visited);
        CHECK(reader.crossed == crossed);
        dropped += reader.dropped;
    }
    CHECK(dropped > 1'000);
}

}  // namespace space
