/// @file
/// Rays through the trees of a scene graph, two levels or more: into an instance's space and on in
/// its tree. Exactly, with the answers of the flattened mesh; or as is usual.
#pragma once

#include "chapters/ch01_naive_ray_tracing/moller_trumbore.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_ray.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_walk.hpp"
#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_ray.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "common/geometry.hpp"
#include "common/observer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace space {

/// Where a ray meets a triangle of a graph: as Hit, with an index that counts on where 32 bits end.
struct PlacedHit {
    float t = infinity;
    float u = 0.0f, v = 0.0f;
    std::uint64_t triangle = 0;  ///< in the order of the flattened mesh

    bool operator==(const PlacedHit&) const = default;
};

/// Of equal t the smaller index wins.
inline bool nearer(const PlacedHit& hit, const PlacedHit& other) {
    return hit.t < other.t || (hit.t == other.t && hit.triangle < other.triangle);
}

/// Which triangle is tested, with which ray.
enum class LeafTest {
    world,  ///< the flattened triangle and the ray as it is: the flattened mesh's answers
    local,  ///< the mesh's triangle and the transformed ray, rounded to float: as is usual
};

/// How a ray walks. All but the first two are for measurements of what goes wrong.
struct InstancedWay {
    LeafTest leaf = LeafTest::world;
    BoxMargins margins = BoxMargins::conservative;
    /// LeafTest::local: the transformed direction is made to have length 1, which changes t.
    bool normalised = false;
};

// [instanced_search]
/// The search of one ray. found(PlacedHit) returns the t beyond which nothing matters any more, as
/// nearest_found has it.
template <TriangleTest Test, InstancedWay way, class Counts, class Found>
class InstancedSearch {
  public:
    InstancedSearch(const InstancedTrees& trees, const Ray& ray, Counts& counts, const Found& found)
        : trees_(trees), ray_(ray), counts_(counts), found_(found) {}

    void run() {
        const ObjectTree& root = trees_.root();
        if (root.nodes.empty() || !is_valid(ray_)) return;
        const Place world{LocalRay(ray_, root.box()), {}, 0, false};
        walk_bvh<BvhWay{.margins = way.margins}>(
            root.nodes, ray_, counts_, [&](const BvhNode<3>& leaf) {
                if (!root.is_group()) return test(root, leaf, world, ray_);
                return enter(root, leaf, [&](const PlacedInstance& instance) {
                    return inside(instance, world, instance.world_margin);
                });
            });
    }

  private:
    /// The space that the search is in: the ray there, the way back, and the triangles before it.
    struct Place {
        LocalRay ray;
        Affine to_world;
        std::uint64_t first_triangle;
        bool may_overflow;
    };
    Place inside(const PlacedInstance& instance, const Place& place, const Double3& margin) const {
        return {place.ray.within(instance, margin), composed(place.to_world, instance.to_parent),
                place.first_triangle + instance.first_triangle,
                place.may_overflow || instance.may_overflow};
    }

    /// The instances of a group's leaf.
    template <class Inside>
    double enter(const ObjectTree& group, const BvhNode<3>& leaf, const Inside& inside_of) {
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i)
            walk(trees_.tree(group.instances[i].object), inside_of(group.instances[i]));
        return limit_;
    }

    /// The tree of an object, in its own space.
    void walk(const ObjectTree& tree, const Place& place) {
        if constexpr (way.leaf == LeafTest::local) {
            Ray local = local_ray(place.ray), until = local;
            until.tmax = std::min(static_cast<float>(limit_), local.tmax);  // NaN after any hit
            walk_bvh<BvhWay{.margins = way.margins}>(
                tree.nodes, until, counts_,
                [&](const BvhNode<3>& leaf) { return own(tree, leaf, place, local); });
        } else {
            const auto own_of = [&](const BvhNode<3>& leaf) {
                return own(tree, leaf, place, ray_);
            };
            const auto limit = std::min(static_cast<float>(limit_), ray_.tmax);
            const InstancedRay ray(place.ray, ray_.tmin, limit, way.margins);
            if (way.margins == BoxMargins::none || ray.is_safe(place.ray, tree.box()))
                walk_nearest_first(tree.nodes, ray, counts_, own_of, NoObserver{});
            else
                walk_nearest_first(tree.nodes, InstancedDoubleRay(place.ray, ray_, limit_), counts_,
                                   own_of, NoObserver{});
        }
    }
    double own(const ObjectTree& tree, const BvhNode<3>& leaf, const Place& place, const Ray& ray) {
        if (!tree.is_group()) return test(tree, leaf, place, ray);
        return enter(tree, leaf, [&](const PlacedInstance& instance) {
            return inside(instance, place, place.ray.margin);
        });
    }

    /// The triangles of a mesh's leaf.
    double test(const ObjectTree& mesh, const BvhNode<3>& leaf, const Place& place,
                const Ray& ray) {
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
            counts_.test_triangle();
            Triangle triangle = mesh.triangles[i];
            if constexpr (way.leaf == LeafTest::world) {
                triangle = flattened(place.to_world, triangle);
                if (place.may_overflow && box_if_finite<3>(triangle).is_empty()) continue;
            }
            if (const auto hit = Test::intersect(ray, triangle))
                limit_ = found_(PlacedHit{hit->t, hit->u, hit->v,
                                          place.first_triangle + mesh.nodes.references[i]});
        }
        return limit_;
    }

    Ray local_ray(const LocalRay& ray) const {
        const Double3 direction = way.normalised ? glm::normalize(ray.direction) : ray.direction;
        return {Point3(ray.origin), Vector3(direction), ray_.tmin, ray_.tmax};
    }

    const InstancedTrees& trees_;
    const Ray& ray_;
    Counts& counts_;
    const Found& found_;
    double limit_ = infinity;
};
// [instanced_search]

/// The hit with the smallest t, of equal t that with the smallest index.
template <TriangleTest Test = FilteredExact, InstancedWay way = InstancedWay{}, class Counts>
std::optional<PlacedHit> closest_placed_hit(const InstancedTrees& trees, const Ray& ray,
                                            Counts& counts) {
    std::optional<PlacedHit> nearest;
    const auto found = [&](const PlacedHit& hit) {
        if (!nearest || nearer(hit, *nearest)) nearest = hit;
        return double{std::nextafter(nearest->t, infinity)};
    };
    InstancedSearch<Test, way, Counts, decltype(found)>(trees, ray, counts, found).run();
    return nearest;
}

/// Whether there is a hit.
template <TriangleTest Test = FilteredExact, InstancedWay way = InstancedWay{}, class Counts>
bool any_placed_hit(const InstancedTrees& trees, const Ray& ray, Counts& counts) {
    bool is_found = false;
    const auto found = [&](const PlacedHit&) {
        is_found = true;
        return std::nan("");
    };
    InstancedSearch<Test, way, Counts, decltype(found)>(trees, ray, counts, found).run();
    return is_found;
}

}  // namespace space
