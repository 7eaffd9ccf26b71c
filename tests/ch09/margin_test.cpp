// The margin of a ray in local space: above every error, by rational numbers, and not far above the
// largest.
#include "common/random_rays.hpp"
#include "tests/catch.hpp"
#include "tests/ch09/graphs.hpp"
#include "tests/exact_vector.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace space {
namespace {

/// A world triangle where a ray's line meets it: the exact t, and the same mean of the mesh's
/// corners as the point is of the flattened ones.
struct ExactCrossing {
    bool is_met = false;
    mpq_class t;
    ExactVector<3> local;

    ExactCrossing(const Ray& ray, const Triangle& world, const Triangle& mesh) {
        const ExactVector<3> a = exact(world.a), d = exact(ray.direction), e1 = exact(world.b) - a,
                             e2 = exact(world.c) - a, s = exact(ray.origin) - a, p = cross(d, e2),
                             q = cross(s, e1);
        const mpq_class det = dot(p, e1);
        if (det == 0) return;
        const mpq_class u = dot(p, s) / det, v = dot(q, d) / det;
        if (u < 0 || v < 0 || u + v > 1) return;
        is_met = true;
        t = dot(q, e2) / det;
        for (int i = 0; i < 3; ++i)
            local[i] =
                (1 - u - v) * double{mesh.a[i]} + u * double{mesh.b[i]} + v * double{mesh.c[i]};
    }
};

/// The local ray of a triangle's mesh, down the path on which it is.
struct Descent {
    LocalRay ray;
    std::uint32_t mesh;

    Descent(const InstancedTrees& trees, std::uint32_t root, const Ray& world,
            std::uint64_t triangle, const SceneGraph& graph)
        : ray(world, trees.tree(root).box()), mesh(root) {
        while (trees.tree(mesh).is_group()) {
            const ObjectTree& group = trees.tree(mesh);
            const auto down = std::ranges::find_if(group.instances, [&](const PlacedInstance& one) {
                return one.first_triangle <= triangle &&
                       triangle < one.first_triangle + graph.triangle_count(one.object);
            });
            ray = ray.within(*down, mesh == root ? down->world_margin : ray.margin);
            triangle -= down->first_triangle;
            mesh = down->object;
        }
    }
};

/// The largest error by its bound, of rays at a graph's triangles; and whether the float ray meets
/// a box that holds nothing but the point.
struct Sharpness {
    double largest = 0.0;
    std::size_t points = 0, missed = 0, unsafe = 0;

    void add(const LocalRay& local, const Ray& ray, const ExactCrossing& at) {
        ++points;
        for (int i = 0; i < 3; ++i) {
            const mpq_class off =
                at.local[i] - mpq_class(local.origin[i]) - at.t * mpq_class(local.direction[i]);
            largest = std::max(largest, std::abs(off.get_d()) / local.margin[i]);
        }
        // The nearest floats around the point: a box that no bound of a tree could undercut.
        Aabb box;
        for (int i = 0; i < 3; ++i) {
            box.min[i] = float_below(at.local[i].get_d());
            box.max[i] = float_above(at.local[i].get_d());
            if (mpq_class(double{box.min[i]}) > at.local[i])
                box.min[i] = std::nextafter(box.min[i], -infinity);
            if (mpq_class(double{box.max[i]}) < at.local[i])
                box.max[i] = std::nextafter(box.max[i], infinity);
        }
        const auto t = static_cast<float>(at.t.get_d());
        const InstancedRay in_float(local, ray.tmin, infinity);
        if (in_float.is_safe(local, box))
            missed += !in_float.span_in(box, t).is_met();
        else
            ++unsafe;
        // In double the limit is not rounded as t is: that of a hit is a place farther.
        const double limit = std::nextafter(t, infinity);
        missed += !InstancedDoubleRay(local, ray, infinity).span_in(box, limit).is_met();
    }
};

void measure(const SceneGraph& graph, int rays, std::uint64_t seed, Sharpness& sharpness) {
    const InstancedTrees trees = InstancedTrees::build(graph);
    const std::vector<Triangle> flat = flatten(graph);
    RayMaker maker(flat, seed);
    Pcg32 random(seed);
    for (int i = 0; i < rays; ++i) {
        Ray ray = i % 2 == 0 ? maker.at_vertex().ray : maker.at_edge().ray;
        if (i % 5 == 0) {  // from close by
            const Point3 origin = ray.at(0.99f);
            ray = {origin, ray.at(1.0f) - origin};
            if (!is_valid(ray)) continue;
        } else if (i % 5 == 1) {  // from so far away that doubles hardly know where it is
            ray = maker.axis_parallel().ray;
            ray.origin -= 1e12f * ray.direction;
        }
        NoCounts none;
        const auto hit = closest_placed_hit(trees, ray, none);
        if (!hit) continue;
        const Located at = graph.locate(hit->triangle);
        const Triangle& mesh = graph.object(at.mesh).triangles[at.triangle];
        const ExactCrossing crossing(ray, flat[hit->triangle], mesh);
        REQUIRE(crossing.is_met);
        sharpness.add(Descent(trees, graph.root(), ray, hit->triangle, graph).ray, ray, crossing);
    }
}

ExactVector<3> exact_point(const Affine& map, const ExactVector<3>& p) {
    ExactVector<3> q;
    for (int i = 0; i < 3; ++i) {
        q[i] = map.at(i, 3);
        for (int j = 0; j < 3; ++j) q[i] += mpq_class(map.at(i, j)) * p[j];
    }
    return q;
}

/// Calls visit(path, mesh, to_world) for each mesh below a group, `path` from the mesh up.
template <class Visit>
void for_each_path(const InstancedTrees& trees, std::uint32_t object, const Affine& to_world,
                   std::vector<const PlacedInstance*>& path, const Visit& visit) {
    const ObjectTree& tree = trees.tree(object);
    for (const PlacedInstance& one : tree.instances) {
        path.insert(path.begin(), &one);
        for_each_path(trees, one.object, composed(to_world, one.to_parent), path, visit);
        path.erase(path.begin());
    }
    if (!tree.is_group()) visit(path, tree, to_world);
}

/// The parts of the margin by themselves, over all vertices of a graph.
struct Parts {
    double world = 0.0, local = 0.0;  ///< the largest error by its bound
    std::size_t outside = 0;          ///< of the root's box

    explicit Parts(const SceneGraph& graph) {
        const InstancedTrees trees = InstancedTrees::build(graph);
        std::vector<const PlacedInstance*> way;
        for_each_path(trees, graph.root(), {}, way,
                      [&](const auto& path, const ObjectTree& mesh, const Affine& to_world) {
                          for (const Triangle& triangle : mesh.triangles)
                              add(path, triangle.a, flattened(to_world, triangle).a,
                                  trees.root().box());
                      });
    }

  private:
    void add(const std::vector<const PlacedInstance*>& path, const Point3& vertex,
             const Point3& world_vertex, const Aabb& scene) {
        ExactVector<3> p = exact(vertex);
        for (const PlacedInstance* instance : path) {
            const ExactVector<3> up = exact_point(instance->to_parent, p),
                                 back = exact_point(instance->to_local, up);
            for (int i = 0; i < 3; ++i) {
                const mpq_class off = back[i] - p[i];
                local = std::max(local, std::abs(off.get_d()) / instance->local_margin[i]);
            }
            p = up;
        }
        for (int i = 0; i < 3; ++i) {
            const mpq_class off = p[i] - double{world_vertex[i]};
            world = std::max(world, std::abs(off.get_d()) / path.back()->world_margin[i]);
        }
        outside += !scene.contains(world_vertex);
    }
};

}  // namespace

TEST_CASE("what flattening rounds and what an inverse misses are within their margins, by part") {
    double world = 0.0, local = 0.0;
    for (const auto& [name, graph] : test_graphs()) {
        if (graph.object(graph.root()).instances.empty()) continue;
        INFO(name);
        const Parts parts(graph);
        CHECK(parts.world <= 1.0);
        CHECK(parts.local <= 1.0);
        CHECK(parts.outside == 0);
        world = std::max(world, parts.world);
        local = std::max(local, parts.local);
    }
    fmt::print("  largest error / margin: in the world {:.3f}, of inverses {:.3f}\n", world, local);
    CHECK(world > 0.8);
    CHECK(local > 0.05);
}

TEST_CASE("a local ray's margin is never less than that of the inverse that brought it there") {
    Pcg32 random(15);
    for (const auto& [name, graph] : test_graphs()) {
        const InstancedTrees trees = InstancedTrees::build(graph);
        for (const PlacedInstance& instance : trees.root().instances) {
            const Ray ray{.origin = Point3(0.0f), .direction = random_vector(random) * 1e-30f};
            const LocalRay local = LocalRay(ray, trees.root().box()).within(instance, Double3(0.0));
            for (int i = 0; i < 3; ++i) REQUIRE(local.margin[i] >= instance.local_margin[i]);
        }
    }
}

TEST_CASE("no error of a local ray is larger than its margin, and the largest are not much less") {
    double largest = 0.0;
    for (const auto& [name, graph] : test_graphs()) {
        if (graph.object(graph.root()).instances.empty()) continue;
        INFO(name);
        Sharpness sharpness;
        measure(graph, sized(4000, 100), 17, sharpness);
        fmt::print("  {}: largest error / margin {:.3f}, {} points, {} unsafe\n", name,
                   sharpness.largest, sharpness.points, sharpness.unsafe);
        CHECK(sharpness.points > sized(400u, 10u));
        CHECK(sharpness.missed == 0);
        CHECK(sharpness.largest <= 1.0);
        largest = std::max(largest, sharpness.largest);
    }
    CHECK(largest > sized(0.9, 0.2));
}

}  // namespace space
