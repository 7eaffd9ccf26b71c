#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_ray.hpp"
#include "chapters/ch10_fast_traversal/measured/walk_counts.hpp"
#include "chapters/ch10_fast_traversal/wide_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

namespace space::ch10 {
namespace {

/// By what a node's children are sorted.
enum class ChildOrder { distance, octant, place };
constexpr std::array<std::string_view, 3> order_names{"nearest first", "by the octant",
                                                      "as they stand"};

/// What waits: `key` decides which of a node's children comes first.
struct WaitingBox {
    WideChild child;
    float enter, key;
};

/// How far a box lies in the direction of the ray's octant: the same for all rays in it.
float octant_key(const Aabb& box, const Ray& ray) {
    const Point3 middle = box.centroid();
    float sum = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
        sum += ray.direction[axis] < 0.0f ? -middle[axis] : middle[axis];
    return sum;
}

/// The nearest hit, with children in this order; counts what is visited.
void walk_in_order(const WideTree<8>& tree, const Ray& ray, ChildOrder order, OrderPoint& point) {
    const BvhRay<3> prepared(ray);
    float limit = prepared.limit();
    std::vector<WaitingBox> waiting{{tree.root, 0.0f, 0.0f}};
    while (!waiting.empty()) {
        const WaitingBox in_hand = waiting.back();
        waiting.pop_back();
        if (!(in_hand.enter <= limit)) continue;
        if (in_hand.child.is_leaf()) {
            for (std::uint32_t i = 0; i < in_hand.child.count(); ++i, ++point.blocks) {
                const TriangleBlock& block = tree.blocks[in_hand.child.first() + i];
                for (std::size_t k = 0; k < TriangleBlock::size && block.is_used(k); ++k)
                    if (const auto hit = FilteredExact::intersect(ray, block.triangle(k)))
                        limit = std::min(limit, hit->t);
            }
            continue;
        }
        ++point.nodes;
        const WideNode<8>& node = tree.nodes[in_hand.child.index()];
        const std::size_t before = waiting.size();
        for (std::size_t i = 0; i < 8; ++i) {
            if (!node.is_used(i)) continue;
            const Aabb box = node.box(i);
            const auto span = prepared.span_in(box, limit);
            if (!span.is_met()) continue;
            const float key = order == ChildOrder::distance ? span.enter
                              : order == ChildOrder::octant ? octant_key(box, ray)
                                                            : float(i);
            waiting.push_back({node.children[i], span.enter, key});
        }
        std::sort(waiting.begin() + static_cast<std::ptrdiff_t>(before), waiting.end(),
                  [](const WaitingBox& a, const WaitingBox& b) { return a.key > b.key; });
    }
}

}  // namespace

std::vector<OrderPoint> order_points(const std::string& scene, const WideTree<8>& tree,
                                     const std::vector<Ray>& rays) {
    std::vector<OrderPoint> points;
    for (const ChildOrder order : {ChildOrder::distance, ChildOrder::octant, ChildOrder::place}) {
        OrderPoint point{.scene = scene, .order = order_names[static_cast<std::size_t>(order)]};
        for (const Ray& ray : rays) {
            ++point.rays;
            walk_in_order(tree, ray, order, point);
        }
        points.push_back(point);
    }
    return points;
}

}  // namespace space::ch10
