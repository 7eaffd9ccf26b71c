#include "chapters/ch10_fast_traversal/measured/walk_counts.hpp"

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch10_fast_traversal/collapse.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/kernels/kernel_table.hpp"
#include "chapters/ch10_fast_traversal/wide_walk.hpp"
#include "common/accelerator.hpp"
#include "common/pcg32.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <glm/geometric.hpp>

#define SPACE_ISA counting
#include "chapters/ch10_fast_traversal/kernels/leaf_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace space::ch10 {
namespace {

struct Sizes {
    std::size_t rays;
    std::vector<const char*> scenes;
};
Sizes sizes_for(const Options& options) {
    if (options.small) return {300, {"boxes:36", "slivers"}};
    return {30'000, {"icosphere:100", "building", "soup:100000", "slivers"}};
}

/// From all around: half at points of edges, half at vertices.
std::vector<Ray> rays_at_edges_exactly(std::span<const Triangle> triangles, std::size_t count,
                                       std::uint64_t seed) {
    std::vector<Ray> rays = rays_from_around(triangles, count, seed);
    Pcg32 random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const auto which = random.below(static_cast<std::uint32_t>(triangles.size()));
        const Triangle& triangle = triangles[which];
        Point3 aim = triangle.a;
        if (i % 2 == 1) aim += random.uniform(0.0f, 1.0f) * (triangle.b - triangle.a);
        rays[i].direction = aim - rays[i].origin;
    }
    return rays;
}

/// Walks the tree as a closest hit does; calls `visit(block)` for each block.
template <int N, class Visit, class Observer = NoObserver>
std::uint64_t walk_counting(const WideTree<N>& tree, const Ray& ray, const Visit& visit,
                            Observer&& observer = {}) {
    TraversalCounts counts;
    double limit = infinity;
    walk_wide_any(
        tree, ray, counts,
        [&](const TriangleBlock& block) {
            visit(block, limit);
            for (std::size_t lane = 0; lane < TriangleBlock::size && block.is_used(lane); ++lane)
                if (const auto hit = FilteredExact::intersect(ray, block.triangle(lane)))
                    limit = std::min(limit, double{hit->t});
            return limit;
        },
        observer);
    return counts.nodes_visited;
}

/// Nodes, and blocks that are tested, counted apart.
template <int N>
struct InnerVisits : NoObserver {
    using NoObserver::observe;
    std::uint64_t inner = 0;
    std::array<std::uint64_t, 9> by_met = {};
    void observe(const WideVisit<N>& event) {
        ++inner;
        ++by_met[event.size];
    }
};

template <int N>
CollapsePoint collapse_point(const std::string& scene, const BvhNodes<3>& binary,
                             std::span<const Triangle> triangles, const std::vector<Ray>& rays,
                             CollapseConfig::Way way) {
    const WideTree<N> tree = collapsed<N>(binary, triangles, {.way = way});
    CollapsePoint point{.scene = scene,
                        .way = way == CollapseConfig::Way::greedy ? "greedy" : "least cost",
                        .width = N,
                        .triangles = triangles.size(),
                        .nodes = tree.nodes.size(),
                        .blocks = tree.blocks.size(),
                        .bytes = tree.bytes(),
                        .rays = rays.size()};
    const HitChance<3> chance(tree.box);
    const CollapseConfig costs;
    point.cost = costs.node_cost;
    for (const WideNode<N>& node : tree.nodes)
        for (std::size_t i = 0; i < N; ++i) {
            if (!node.is_used(i)) continue;
            ++point.places_used;
            const WideChild child = node.children[i];
            point.cost += chance(node.box(i)) *
                          (child.is_leaf() ? costs.block_cost * child.count() : costs.node_cost);
        }
    InnerVisits<N> visits;
    for (const Ray& ray : rays)
        walk_counting(
            tree, ray, [&](const TriangleBlock&, double) { ++point.blocks_tested; }, visits);
    point.nodes_visited = visits.inner;
    return point;
}

/// The largest error of the volumes that decide about one triangle, over their bound, where the
/// sign of the determinant is certain. Doubles are exact enough to tell.
double error_over_bound(const Ray& ray, const Triangle& triangle,
                        const counting::LeafVolumes& floats, std::size_t lane) {
    const Double3 a{triangle.a}, d{ray.direction},
        e1 = Double3(triangle.b) - a, e2 = Double3(triangle.c) - a, s = Double3(ray.origin) - a;
    const Double3 p = glm::cross(d, e2);
    const double det = glm::dot(p, e1), bound{floats.bound[lane]}, size{floats.size[lane]};
    if (size <= bound) return 0.0;
    const double turned = det < 0.0 ? -1.0 : 1.0, u = turned * glm::dot(p, s),
                 v = turned * glm::dot(glm::cross(s, e1), d), float_u{floats.u[lane]},
                 float_v{floats.v[lane]};
    const double w = std::abs(det) - (u + v);
    const double float_w{floats.size[lane] - (floats.u[lane] + floats.v[lane])};
    return std::max({std::abs(u - float_u), std::abs(v - float_v), std::abs(w - float_w)}) / bound;
}

/// The kernels' filter, asked about every block that the walk comes to.
FilterPoint filter_point(const std::string& scene, std::string_view kind, const WideTree<8>& tree,
                         const std::vector<Ray>& rays) {
    FilterPoint point{.scene = scene, .rays = kind};
    for (const Ray& ray : rays) {
        KernelRay prepared;
        if (!prepare_kernel_ray(ray, tree.largest(), prepared)) continue;
        walk_counting(tree, ray, [&](const TriangleBlock& block, double limit) {
            const float ends = std::min(prepared.limit, static_cast<float>(limit));
            const char* const bytes = reinterpret_cast<const char*>(&block);
            const counting::LeafLanes lanes = counting::filter_leaf<true>(bytes, prepared, ends);
            const counting::LeafVolumes volumes = counting::volumes_of(bytes, prepared, ends);
            for (std::size_t i = 0; i < TriangleBlock::size && block.is_used(i); ++i) {
                const auto hit = FilteredExact::intersect(ray, block.triangle(i));
                const bool is_hit = hit && hit->t <= ends, may_hit = (lanes.may_hit >> i & 1u) != 0,
                           must_hit = (lanes.must_hit >> i & 1u) != 0;
                point.largest =
                    std::max(point.largest, error_over_bound(ray, block.triangle(i), volumes, i));
                ++point.lanes;
                point.left += may_hit;
                point.hits += may_hit && is_hit;
                point.lost += is_hit && !may_hit;
                point.sure += must_hit;
                point.invented += must_hit && !is_hit;
            }
        });
    }
    return point;
}

/// A hit where there is none, none where there is one, a triangle that is not hit or is not the
/// nearest; of equal ones any will do.
bool is_wrong(const Ray& ray, std::span<const Triangle> triangles, const std::optional<Hit>& hit,
              const std::optional<Hit>& wanted) {
    if (hit.has_value() != wanted.has_value() || !hit) return hit.has_value() != wanted.has_value();
    const auto exact = FilteredExact::intersect(ray, triangles[hit->triangle]);
    return !exact || exact->t > wanted->t;
}

/// The same tree with chapter 1's test in float.
PlainLeafPoint plain_leaf_point(const std::string& scene, std::span<const Triangle> triangles,
                                const std::vector<Ray>& rays) {
    const auto exact = WideBvh<8, BinnedBuilder>::build(triangles);
    const auto plain = WideBvh<8, BinnedBuilder, MollerTrumbore>::build(triangles);
    PlainLeafPoint point{.scene = scene, .rays = rays.size()};
    for (const Ray& ray : rays) {
        TraversalCounts counts;
        NoCounts none;
        const std::optional<Hit> wanted = exact.closest_hit(ray, counts),  // scalar, in double
            kernel = exact.closest_hit(ray, none), floats = plain.closest_hit(ray, none);
        point.wrong += kernel.has_value() != wanted.has_value() ||
                       (kernel && (kernel->triangle != wanted->triangle || kernel->t != wanted->t));
        point.plain_wrong += is_wrong(ray, triangles, floats, wanted);
    }
    return point;
}

}  // namespace

WalkCounts measure_walk_counts(const Options& options) {
    WalkCounts counts;
    const Sizes sizes = sizes_for(options);
    for (const char* const name : sizes.scenes) {
        const std::vector<Triangle> triangles = make_scene(name, options.seed).mesh.triangles();
        const std::vector<Ray> rays = rays_within(triangles, sizes.rays, options.seed),
                               aimed = rays_at_edges_exactly(triangles, sizes.rays, options.seed);
        const BvhNodes<3> binary = BinnedBuilder::build<3>(triangles);
        for (const auto way : {CollapseConfig::Way::greedy, CollapseConfig::Way::least_cost}) {
            counts.collapses.push_back(collapse_point<4>(name, binary, triangles, rays, way));
            counts.collapses.push_back(collapse_point<8>(name, binary, triangles, rays, way));
        }
        const WideTree<8> tree = collapsed<8>(binary, triangles);
        InnerVisits<8> visits;
        for (const Ray& ray : rays)
            walk_counting(
                tree, ray, [](const TriangleBlock&, double) {}, visits);
        counts.met.push_back({.scene = name, .visits = visits.by_met});
        for (OrderPoint& point : order_points(name, tree, rays))
            counts.orders.push_back(std::move(point));
        counts.filter.push_back(filter_point(name, "anywhere", tree, rays));
        counts.filter.push_back(filter_point(name, "at edges and vertices", tree, aimed));
        counts.plain_leaves.push_back(plain_leaf_point(name, triangles, aimed));
    }
    counts.slabs = measure_slab_errors(options);
    counts.returns = measure_returns(options);
    return counts;
}

}  // namespace space::ch10
