#include "docs/live/same_bits.hpp"

#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/linear_octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/middle_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/sweep_builder.hpp"
#include "common/pcg32.hpp"
#include "common/program/walk_drawing.hpp"
#include "common/random.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace space::live {
namespace {

/// FNV-1a over the bytes of values that have no padding and are no NaN, whose bits are the
/// machine's choice.
class Fingerprint {
  public:
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        for (const std::byte byte : std::as_bytes(std::span(&value, 1)))
            hash_ = (hash_ ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3u;
    }
    template <class Items>
    void add_all(const Items& items) {
        for (const auto& item : items) add(item);
    }
    std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// What is told of a builder.
struct Bits {
    Fingerprint trees, answers;
    std::uint32_t built = 0, asked = 0, hits = 0;
};

/// Small, on a grid so that corners and planes are shared, without extent, across an axis, or the
/// same as one before.
template <int D>
Simplex<D> random_polygon(Pcg32& random, const std::vector<Simplex<D>>& before) {
    const std::uint32_t kind = random.below(8);
    if (kind == 0 && !before.empty())
        return before[random.below(static_cast<std::uint32_t>(before.size()))];
    const BasicAabb<D> world{Point<D>(0.0f), Point<D>(16.0f)};
    const Point<D> centre = random_point(random, world);
    std::array<Point<D>, 3> corners;
    for (Point<D>& corner : corners) {
        corner = random_point(random, world);
        if (kind < 4) corner = centre + (corner - 8.0f) * 0.1f;
        if (kind == 4 || kind == 5) corner = glm::floor(corner * 0.25f) * 4.0f;
        if (kind == 7) corner[D - 1] = corners[0][D - 1];
    }
    if (kind == 6) corners[1] = corners[0];
    if constexpr (D == 2)
        return {corners[0], corners[1]};
    else
        return {corners[0], corners[1], corners[2]};
}

template <int D>
std::vector<Simplex<D>> random_polygons(Pcg32& random) {
    const std::uint32_t count = 1 + random.below(150);
    std::vector<Simplex<D>> polygons;
    while (polygons.size() < count) polygons.push_back(random_polygon<D>(random, polygons));
    return polygons;
}

/// Anywhere, through a corner, between points of the grid, or along an axis.
template <int D>
BasicRay<D> random_ray(Pcg32& random, const std::vector<Simplex<D>>& polygons) {
    const BasicAabb<D> around{Point<D>(-4.0f), Point<D>(20.0f)};
    Point<D> from = random_point(random, around), to = random_point(random, around);
    const std::uint32_t kind = random.below(4);
    if (kind == 1) to = polygons[random.below(static_cast<std::uint32_t>(polygons.size()))][0];
    if (kind == 2) {
        from = glm::floor(from);
        to = glm::floor(to);
    }
    if (kind == 3) {
        const auto axis = static_cast<int>(random.below(D));
        to = from;
        to[axis] = 8.0f;
    }
    return {.origin = from, .direction = to - from};
}

void add_counts(Bits& bits, const TraversalCounts& counts) {
    bits.answers.add(counts.nodes_visited);
    bits.answers.add(counts.triangles_tested);
    ++bits.asked;
}

/// A tree over triangles.
template <class Tree, auto... config>
void in_space(Bits& bits, Pcg32& random, std::uint32_t rays) {
    typename Tree::Config chosen;
    ((chosen.rule = config), ...);
    const std::vector<Triangle> triangles = random_polygons<3>(random);
    const Tree tree = Tree::build(triangles, chosen);
    for (std::uint32_t i = 0; i < rays; ++i) {
        const Ray ray = random_ray<3>(random, triangles);
        TraversalCounts counts;
        if (const std::optional<Hit> hit = tree.closest_hit(ray, counts)) {
            bits.answers.add(*hit);
            ++bits.hits;
        }
        bits.answers.add(tree.any_hit(ray, counts));
        add_counts(bits, counts);
    }
    const TreeShape shape = tree.shape();
    for (const std::size_t number : {shape.nodes.value_or(0), shape.leaves.value_or(0),
                                     shape.depth.value_or(0), shape.references})
        bits.trees.add(std::uint64_t{number});
    bits.trees.add(shape.sah_cost.value_or(0.0));
    if constexpr (requires { tree.nodes().references; }) {
        bits.trees.add_all(tree.nodes().nodes);
        bits.trees.add_all(tree.nodes().references);
    }
    if constexpr (requires { tree.tree().planes; })
        for (const auto& plane : tree.tree().planes) bits.trees.add(plane.normal);
    ++bits.built;
}

/// How a ray walks a tree over segments: calls look(polygon) for each that it comes to, which
/// returns the t beyond which nothing matters any more.
template <class Look>
void walk(const BvhNodes<2>& tree, const Ray2& ray, TraversalCounts& counts, const Look& look) {
    walk_bvh(tree, ray, counts, [&](const BvhNode<2>& leaf) {
        return look(std::span(tree.references).subspan(leaf.first, leaf.count));
    });
}
template <class Look>
void walk(const KdNodes<2>& tree, const Ray2& ray, TraversalCounts& counts, const Look& look) {
    walk_cells(tree, ray, counts, [&](std::uint32_t node) { return look(tree.own(node)); });
}
template <class Look>
void walk(const OrthtreeNodes<2>& tree, const Ray2& ray, TraversalCounts& counts,
          const Look& look) {
    walk_orthtree(tree, OctreeConfig::Walk::parametric, ray, counts,
                  [&](std::uint32_t node) { return look(tree.own(node)); });
}
template <class Look>
void walk(const BspTree<2>& tree, const Ray2& ray, TraversalCounts& counts, const Look& look) {
    front_to_back(tree, ray, counts, [&](const BspTree<2>::Node& node) {
        std::vector<std::uint32_t> own;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            own.push_back(tree.fragments[i].polygon);
        return look(std::span<const std::uint32_t>(own));
    });
}

/// A tree over segments, as the drawings have them.
template <class Build>
void in_plane(Bits& bits, Pcg32& random, std::uint32_t rays, const Build& build) {
    const std::vector<Segment> segments = random_polygons<2>(random);
    const auto tree = build(std::span<const Segment>(segments));
    for (std::uint32_t i = 0; i < rays; ++i) {
        const Ray2 ray = random_ray<2>(random, segments);
        TraversalCounts counts;
        double nearest = infinity;
        walk(tree, ray, counts, [&](std::span<const std::uint32_t> own) {
            for (const std::uint32_t polygon : own)
                nearest = std::min(nearest, distance_along(ray, segments[polygon]));
            return nearest;
        });
        bits.answers.add(nearest);
        bits.hits += nearest < double{infinity};
        add_counts(bits, counts);
    }
    bits.trees.add_all(tree.nodes);
    if constexpr (requires { tree.references; }) bits.trees.add_all(tree.references);
    if constexpr (requires { tree.planes; })
        for (const auto& plane : tree.planes) bits.trees.add(plane.normal);
    ++bits.built;
}
template <class Builder>
void flat_bvh(Bits& bits, Pcg32& random, std::uint32_t rays) {
    in_plane(bits, random, rays, [](std::span<const Segment> segments) {
        return Builder::template build<2>(segments);
    });
}
template <class Builder>
void flat_cells(Bits& bits, Pcg32& random, std::uint32_t rays) {
    in_plane(bits, random, rays,
             [](std::span<const Segment> segments) { return Builder::build(segments); });
}

/// One of the builders.
struct Kind {
    std::string_view name;
    void (*build_and_ask)(Bits&, Pcg32&, std::uint32_t rays);
};
constexpr std::array kinds{
    Kind{"BSP tree, 2D", flat_cells<BspBuilder<2>>},
    Kind{"k-d tree, 2D", flat_cells<KdBuilder<2>>},
    Kind{"quadtree", flat_cells<OrthtreeBuilder<2>>},
    Kind{"BVH, bins, 2D", flat_bvh<BinnedBuilder>},
    Kind{"BVH, all cuts, 2D", flat_bvh<SweepBuilder>},
    Kind{"BVH, median, 2D", flat_bvh<MedianBuilder>},
    Kind{"BVH, middle, 2D", flat_bvh<MiddleBuilder>},
    Kind{"BSP tree", in_space<Bsp<>>},
    Kind{"k-d tree", in_space<KdTree<>>},
    Kind{"k-d tree, middle", in_space<KdTree<>, KdTreeConfig::Rule::middle>},
    Kind{"lazy k-d tree", in_space<LazyKdTree<>>},
    Kind{"octree", in_space<Octree<>>},
    Kind{"linear octree", in_space<LinearOctree<>>},
    Kind{"BVH, bins", in_space<Bvh<BinnedBuilder>>},
    Kind{"BVH, median", in_space<Bvh<MedianBuilder>>},
    Kind{"BVH, Morton codes", in_space<Bvh<MortonBuilder>>},
};

}  // namespace

std::string same_bits(std::uint32_t seed, std::uint32_t rays) {
    constexpr std::uint32_t trees = 100;
    std::array<Bits, kinds.size()> bits;
    for (std::uint32_t i = 0; i < trees; ++i) {
        Pcg32 random(seed, i);
        const std::size_t kind = i % kinds.size();
        kinds[kind].build_and_ask(bits[kind], random, rays / trees + (i < rays % trees));
    }
    std::string text;
    for (std::size_t i = 0; i < kinds.size(); ++i)
        text += fmt::format("{}: {} trees {:016x}, {} rays {:016x}, {} hits\n", kinds[i].name,
                            bits[i].built, bits[i].trees.value(), bits[i].asked,
                            bits[i].answers.value(), bits[i].hits);
    return text;
}

}  // namespace space::live
