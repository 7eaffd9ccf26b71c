#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch10_fast_traversal/cache_model.hpp"
#include "chapters/ch10_fast_traversal/compressed_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch10_fast_traversal/measured/fast_parts.hpp"
#include "chapters/ch10_fast_traversal/measured/tracer.hpp"
#include "chapters/ch10_fast_traversal/quick_builder.hpp"

#include <cmath>
#include <string>
#include <utility>

namespace space::ch10 {
namespace {

constexpr std::uint64_t leaves_at = std::uint64_t{1} << 40,
                        corners_at = std::uint64_t{1} << 41;  // apart from the nodes, at 0

/// Tells the model what a walk reads, and counts.
struct CacheObserver {
    CacheModel& model;
    WorkPoint& point;
    const BvhNodes<3>* binary = nullptr;
    const CompressedTree* compressed = nullptr;

    void node(std::uint64_t index, std::size_t bytes, std::uint64_t boxes) {
        model.touch(index * bytes, bytes);
        ++point.nodes;
        point.boxes += boxes;
    }
    void block(std::uint64_t address, std::size_t bytes, std::uint64_t tests) {
        model.touch(leaves_at + address, bytes);
        ++point.blocks;
        point.tests += tests;
    }
    /// An inner node's two children are read together; a leaf has been read with its sibling.
    void observe(const BvhVisit& visit) {
        const BvhNode<3>& at = binary->nodes[visit.node];
        if (at.is_leaf())
            block(std::uint64_t{at.first} * sizeof(Triangle), at.count * sizeof(Triangle),
                  at.count);
        else
            node(at.first / 2, 2 * sizeof(BvhNode<3>), 2);
    }
    void observe(const WideVisit<8>& visit) {
        node(visit.node, compressed ? sizeof(CompressedNode) : sizeof(WideNode<8>), 8);
    }
    void observe(const WideLeafVisit& visit) {
        if (!compressed) {
            for (std::uint32_t i = 0; i < visit.leaf.count(); ++i)
                block(std::uint64_t{visit.leaf.first() + i} * sizeof(TriangleBlock),
                      sizeof(TriangleBlock), TriangleBlock::size);
            return;
        }
        std::uint32_t at = CompressedTree::first_of(visit.leaf), count = 1;
        for (std::uint32_t i = at;; ++i, ++count) {
            const IndexedTriangle& triangle = compressed->triangles[i];
            for (const std::uint32_t corner : triangle.corners)
                model.touch(corners_at + std::uint64_t{corner} * sizeof(Point3), sizeof(Point3));
            if (triangle.is_last()) break;
        }
        block(std::uint64_t{at} * sizeof(IndexedTriangle), count * sizeof(IndexedTriangle), count);
    }
    static void observe(const WideSkipped&) {}
};

/// Exactly, as the accelerators' own search.
template <class Triangles>
void test_all(const Ray& ray, const Triangles& triangles, const auto& found, double& limit) {
    for (const auto& [triangle, index] : triangles)
        if (auto hit = FilteredExact::intersect(ray, triangle)) {
            hit->triangle = index;
            limit = found(*hit);
        }
}

/// Walks all rays of one kind, after some of them have filled the caches.
template <class WalkOne>
WorkPoint worked(const TracedScene& scene, RayKind kind, std::string structure, std::size_t bytes,
                 const WalkOne& walk_one) {
    WorkPoint point{.scene = scene.name, .structure = std::move(structure), .kind = kind};
    CacheModel model(stated_caches());
    const std::vector<Ray>& rays = scene.rays[kind];
    const std::size_t warm = rays.size() / 4;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (i == warm) {
            model.forget_counts();
            point.nodes = point.boxes = point.blocks = point.tests = 0;
        }
        const auto walk = [&](const auto& found) { walk_one(rays[i], found, model, point); };
        if (kind == shadow_kind)
            do_not_optimize(is_any_found(walk));
        else
            do_not_optimize(nearest_found(walk));
    }
    point.triangles = scene.triangles.size();
    point.bytes = bytes;
    point.rays = rays.size() - warm;
    point.lines = model.lines();
    for (std::size_t i = 0; i < point.misses.size(); ++i) point.misses[i] = model.misses()[i];
    return point;
}

template <class Tree>
auto wide_walk_of(const Tree& tree, const CompressedTree* compressed) {
    return [&tree, compressed](const Ray& ray, const auto& found, CacheModel& model,
                               WorkPoint& point) {
        NoCounts none;
        double limit = infinity;
        CacheObserver observer{.model = model, .point = point, .compressed = compressed};
        walk_wide_any(
            tree, ray, none,
            [&](const TriangleBlock& block) {
                std::vector<std::pair<Triangle, std::uint32_t>> some;
                for (std::size_t i = 0; i < TriangleBlock::size && block.is_used(i); ++i)
                    some.emplace_back(block.triangle(i), block.indices[i]);
                test_all(ray, some, found, limit);
                return limit;
            },
            observer);
    };
}

/// The bounds, and what was measured.
void add_times(WorkPoint& point, const MachineCosts& costs, double ns) {
    RayWork work{.nodes = point.per_ray(point.nodes), .blocks = point.per_ray(point.blocks)};
    for (std::size_t i = 0; i < work.misses.size(); ++i)
        work.misses[i] = point.per_ray(point.misses[i]);
    constexpr double lines_of_a_node_at_once = 4.0;
    point.ns = ns;
    point.nodes_ns = work.nodes * costs.node_latency;
    point.blocks_ns = work.blocks * costs.block_latency;
    point.compute_ns = compute_bound_ns(work, costs);
    point.bandwidth_ns = fetch_bound_ns(work, costs);
    point.latency_ns =
        latency_bound_ns(work, costs, point.structure == "wide" ? lines_of_a_node_at_once : 2.0);
}

}  // namespace

void measure_work(const TracedScene& scene, const FastEffort& effort, FastMeasurements& measured) {
    const BvhNodes<3> binary = BinnedBuilder::build<3>(scene.triangles);
    const BvhNodes<3> quick = QuickBuilder::build<3>(scene.triangles);
    const FastBvh<> wide = FastBvh<>::over(quick, scene.triangles);
    const CompressedBvh<> compressed = CompressedBvh<>::over(quick, scene.triangles);
    const MachineCosts costs = machine_costs(measured);
    const std::vector<Tracer> tracers{our_tracer("wide", wide),
                                      our_tracer("compressed", compressed)};
    for (const RayKind kind : {camera_kind, shadow_kind, diffuse_kind}) {
        if (scene.rays[kind].size() < 8) continue;
        const std::vector<double> ns = ray_times(tracers, scene, kind, effort.rounds);
        measured.work.push_back(worked(
            scene, kind, "binary",
            binary.size() * sizeof(BvhNode<3>) + binary.references.size() * sizeof(Triangle),
            [&](const Ray& ray, const auto& found, CacheModel& model, WorkPoint& point) {
                NoCounts none;
                double limit = infinity;
                CacheObserver observer{.model = model, .point = point, .binary = &binary};
                walk_bvh(
                    binary, ray, none,
                    [&](const BvhNode<3>& leaf) {
                        std::vector<std::pair<Triangle, std::uint32_t>> some;
                        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                            const std::uint32_t index = binary.references[i];
                            some.emplace_back(scene.triangles[index], index);
                        }
                        test_all(ray, some, found, limit);
                        return limit;
                    },
                    observer);
            }));
        measured.work.push_back(
            worked(scene, kind, "wide", wide.tree().bytes(), wide_walk_of(wide.tree(), nullptr)));
        add_times(measured.work.back(), costs, ns[0]);
        measured.work.push_back(worked(scene, kind, "compressed", compressed.tree().bytes(),
                                       wide_walk_of(compressed.tree(), &compressed.tree())));
        add_times(measured.work.back(), costs, ns[1]);
    }
}

}  // namespace space::ch10
