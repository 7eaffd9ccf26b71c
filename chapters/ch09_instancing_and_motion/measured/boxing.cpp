#include "chapters/ch09_instancing_and_motion/measured/boxing.hpp"

#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_nodes.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh_walk.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/refit.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/random_placement.hpp"
#include "chapters/ch09_instancing_and_motion/transformed_box.hpp"
#include "common/measure.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>

namespace space::ch09 {
namespace {

/// A tree in the world and its triangles in the order of the leaves, as Bvh has them: but its boxes
/// may be any.
struct WorldTree {
    BvhNodes<3> nodes;
    std::vector<Triangle> triangles = {};

    WorldTree(BvhNodes<3> tree, std::span<const Triangle> world) : nodes(std::move(tree)) {
        for (const std::uint32_t i : nodes.references) triangles.push_back(world[i]);
    }
    template <class Counts>
    std::optional<PlacedHit> closest_hit(const Ray& ray, Counts& counts) const {
        std::optional<PlacedHit> nearest;
        double limit = infinity;
        walk_bvh(nodes, ray, counts, [&](const BvhNode<3>& leaf) {
            for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
                counts.test_triangle();
                const auto hit = FilteredExact::intersect(ray, triangles[i]);
                if (!hit) continue;
                const PlacedHit placed{hit->t, hit->u, hit->v, nodes.references[i]};
                if (!nearest || nearer(placed, *nearest)) nearest = placed;
                limit = double{std::nextafter(nearest->t, infinity)};
            }
            return limit;
        });
        return nearest;
    }
};

/// One scene, turned once.
class Turned {
  public:
    Turned(std::span<const Triangle> triangles, const glm::dmat3& rotation)
        : graph_({{.name = "mesh", .triangles = {triangles.begin(), triangles.end()}},
                  {.name = "turned",
                   .instances = {{.to_parent = affine({.rotation = rotation}), .object = 0}}}},
                 1),
          trees_(InstancedTrees::build(graph_)),
          world_(flatten(graph_)),
          boxed_(turned_boxes(), world_),
          refitted_(refitted_boxes(), world_),
          anew_(BinnedBuilder::build<3>(world_), world_) {}

    /// visit(way, nodes, closest) for each way, `closest` a function of ray and counts.
    template <class Visit>
    void for_each_way(const Visit& visit) const {
        constexpr InstancedWay local{.leaf = LeafTest::local}, exact{};
        visit(inverse_ray, local_nodes(), [&](const Ray& ray, auto& counts) {
            return closest_placed_hit<FilteredExact, local>(trees_, ray, counts);
        });
        visit(inverse_ray_exact, local_nodes(), [&](const Ray& ray, auto& counts) {
            return closest_placed_hit<FilteredExact, exact>(trees_, ray, counts);
        });
        const auto world = [&](std::string_view way, const WorldTree& tree) {
            visit(way, tree.nodes,
                  [&](const Ray& ray, auto& counts) { return tree.closest_hit(ray, counts); });
        };
        world(boxes_boxed, boxed_);
        world(boxes_refitted, refitted_);
        world(tree_anew, anew_);
    }
    const BvhNodes<3>& local_nodes() const { return trees_.tree(0).nodes; }

  private:
    BvhNodes<3> turned_boxes() const {
        BvhNodes<3> nodes = local_nodes();
        for (BvhNode<3>& node : nodes.nodes)
            node.box = transformed_box(graph_.object(1).instances[0].to_parent, node.box);
        return nodes;
    }
    BvhNodes<3> refitted_boxes() const {
        BvhNodes<3> nodes = local_nodes();
        refit<3>(nodes, world_);
        return nodes;
    }

    SceneGraph graph_;
    InstancedTrees trees_;
    std::vector<Triangle> world_;
    WorldTree boxed_, refitted_, anew_;
};

double volume(const Aabb& box) {
    const Double3 edges(box.extent());
    return edges.x * edges.y * edges.z;
}

/// Volumes and surfaces of all nodes' boxes, and the root's volume.
struct Sizes {
    double volumes = 0.0, surfaces = 0.0, root = 0.0;

    explicit Sizes(const BvhNodes<3>& tree) : root(volume(tree.nodes[0].box)) {
        tree.for_each_node([&](std::uint32_t index, unsigned) {
            volumes += volume(tree.nodes[index].box);
            surfaces += tree.nodes[index].box.half_area();
        });
    }
};

/// Adds up what one turned scene costs by each way.
void count_turned(const Turned& turned, std::span<const Ray> rays, std::span<TurnedTree> rows,
                  double share) {
    const Sizes before(turned.local_nodes());
    std::vector<std::vector<std::optional<PlacedHit>>> answers;
    std::size_t k = 0;
    turned.for_each_way([&](std::string_view way, const BvhNodes<3>& nodes, const auto& closest) {
        TurnedTree& row = rows[k++];
        row.way = way;
        const Sizes sizes(nodes);
        row.volume += share * sizes.volumes / before.volumes;
        row.surface += share * sizes.surfaces / before.surfaces;
        row.root_volume += share * sizes.root / before.root;
        TraversalCounts counts;
        answers.emplace_back();
        for (const Ray& ray : rays) answers.back().push_back(closest(ray, counts));
        row.rays += rays.size();
        row.nodes += counts.nodes_visited;
        row.tests += counts.triangles_tested;
    });
    for (std::size_t i = 0; i < answers.size(); ++i)
        for (std::size_t ray = 0; ray < rays.size(); ++ray) {
            const auto &answer = answers[i][ray], &wanted = answers.back()[ray];
            rows[i].others += answer != wanted;
            rows[i].other_triangles += answer.has_value() != wanted.has_value() ||
                                       (answer && answer->triangle != wanted->triangle);
        }
}

/// Half of them from around, half from within, chosen in local space and turned with the scene.
std::vector<Ray> turned_rays(std::span<const Triangle> local, const glm::dmat3& rotation,
                             std::size_t count, std::uint64_t seed) {
    std::vector<Ray> rays = rays_from_around(local, count / 2, seed);
    for (const Ray& ray : rays_within(local, count - count / 2, seed)) rays.push_back(ray);
    for (Ray& ray : rays) {
        ray.origin = Point3(rotation * Double3(ray.origin));
        ray.direction = Vector3(rotation * Double3(ray.direction));
    }
    return rays;
}

/// Nanoseconds of a ray by each way.
std::vector<double> time_turned(const Turned& turned, std::span<const Ray> rays) {
    std::vector<std::function<void()>> candidates;
    turned.for_each_way([&](std::string_view, const BvhNodes<3>&, const auto& closest) {
        candidates.push_back([&rays, closest] {
            NoCounts none;
            for (const Ray& ray : rays) do_not_optimize(closest(ray, none));
        });
    });
    std::vector<double> ns = interleaved_medians(candidates, 5);
    for (double& each : ns) each *= 1e6 / double(rays.size());
    return ns;
}

std::vector<TurnedTree> measure_turned(const std::string& name, std::size_t turns, std::size_t rays,
                                       bool timed, std::uint64_t seed) {
    const std::vector<Triangle> triangles = make_scene(name, seed).mesh.triangles();
    constexpr std::size_t ways = 5;
    std::vector<TurnedTree> rows(ways, {.scene = name, .way = {}, .triangles = triangles.size()});
    std::array<std::vector<double>, ways> times;
    Pcg32 random(seed);
    for (std::size_t i = 0; i < turns; ++i) {
        const glm::dmat3 rotation = random_rotation(random);
        const Turned turned(triangles, rotation);
        const std::vector<Ray> some = turned_rays(triangles, rotation, rays, seed + i);
        count_turned(turned, some, rows, 1.0 / double(turns));
        if (!timed) continue;
        const std::vector<double> ns = time_turned(turned, some);
        for (std::size_t way = 0; way < ways; ++way) times[way].push_back(ns[way]);
    }
    for (std::size_t way = 0; timed && way < ways; ++way) rows[way].ns = median(times[way]);
    return rows;
}

// ---- tables and claim -------------------------------------------------------------------------

std::vector<std::span<const TurnedTree>> by_scene(const std::vector<TurnedTree>& all) {
    std::vector<std::span<const TurnedTree>> scenes;
    for (std::size_t first = 0; first < all.size();) {
        std::size_t end = first;
        while (end < all.size() && all[end].scene == all[first].scene) ++end;
        scenes.push_back(std::span(all).subspan(first, end - first));
        first = end;
    }
    return scenes;
}
bool is_timed(const BoxingMeasurements& measured) {
    return measured.trees.front().ns > 0.0;
}
const TurnedTree& turned_way(std::span<const TurnedTree> scene, std::string_view way) {
    return *std::ranges::find(scene, way, &TurnedTree::way);
}

/// The two ways of the inverse ray walk alike.
Table boxing_table(const BoxingMeasurements& measured) {
    Table table({"scene", "triangles", "way", "volume of boxes", "surface", "nodes per ray",
                 "tests per ray"});
    for (const TurnedTree& row : measured.trees)
        if (row.way != inverse_ray_exact)
            table.row({row.scene, with_commas(row.triangles), std::string(row.way),
                       fixed(row.volume, 2), fixed(row.surface, 2), fixed(row.nodes_per_ray(), 1),
                       fixed(row.tests_per_ray(), 1)});
    return table;
}

/// A column for each way.
Table boxing_times_table(const BoxingMeasurements& measured) {
    const auto scenes = by_scene(measured.trees);
    std::vector<std::string> headings{"scene"};
    for (const TurnedTree& row : scenes.front()) headings.push_back(fmt::format("{}, ns", row.way));
    Table table(std::move(headings));
    for (const auto& scene : scenes) {
        std::vector<std::string> cells{scene.front().scene};
        for (const TurnedTree& row : scene) cells.push_back(fixed(row.ns, 0));
        table.row(std::move(cells));
    }
    return table;
}

/// From the smallest to the largest over the scenes.
template <class Value>
std::pair<double, double> range_over(const std::vector<std::span<const TurnedTree>>& scenes,
                                     const Value& value) {
    double least = infinity, most = 0.0;
    for (const auto& scene : scenes) {
        least = std::min(least, value(scene));
        most = std::max(most, value(scene));
    }
    return {least, most};
}

}  // namespace

BoxingMeasurements measure_boxing(const Options& options) {
    const Amount amount = options.amount();
    std::vector<std::string> scenes{"tree:9",    "building:2",    "stadium",
                                    "lattice:3", "sphereflake:2", "soup:20000"};
    if (amount == Amount::small) scenes = {"boxes:36"};
    const std::size_t turns = amount == Amount::full ? 9 : 3;
    const std::size_t rays = amount == Amount::small ? 200 : 10'000;
    BoxingMeasurements measured;
    Progress progress("turned trees", scenes.size());
    for (const std::string& scene : scenes) {
        for (TurnedTree& row : measure_turned(
                 scene, turns, rays, amount != Amount::small && !options.counts, options.seed))
            measured.trees.push_back(std::move(row));
        progress.step();
    }
    return measured;
}

void print_boxing(const BoxingMeasurements& measured, bool times) {
    print_heading("Scenes that stand there turned: the inverse ray, and boxes in the world");
    boxing_table(measured).print();
    if (!times || !is_timed(measured)) return;
    print_heading("A ray in them");
    boxing_times_table(measured).print();
}

void quote_boxing(const BoxingMeasurements& measured, bool times, Numbers& numbers) {
    numbers.count_table("boxing", boxing_table(measured));
    std::uint64_t rays = 0, other_bits = 0, other_triangles = 0;
    for (const TurnedTree& row : measured.trees) {
        if (row.way != inverse_ray) continue;
        rays += row.rays;
        other_bits += row.others;
        other_triangles += row.other_triangles;
    }
    numbers.count("turned_rays", rays);
    numbers.count("turned_other_bits", other_bits);
    numbers.count("turned_other_triangles", other_triangles);
    const auto scenes = by_scene(measured.trees);
    const auto quote = [&](const std::string& name, std::pair<double, double> range, bool timed) {
        const std::string least = fixed(range.first, 1), most = fixed(range.second, 1);
        if (timed) {
            numbers.time(name + "_least", range.first, least);
            numbers.time(name + "_most", range.second, most);
        } else {
            numbers.count(name + "_least", range.first, least);
            numbers.count(name + "_most", range.second, most);
        }
    };
    const auto ratio = [&](std::string_view way, auto member) {
        return range_over(scenes, [&](std::span<const TurnedTree> scene) {
            return std::invoke(member, turned_way(scene, way)) /
                   std::invoke(member, turned_way(scene, inverse_ray));
        });
    };
    quote("boxing_root", ratio(boxes_boxed, &TurnedTree::root_volume), false);
    quote("boxing_volume", ratio(boxes_boxed, &TurnedTree::volume), false);
    quote("boxing_nodes", ratio(boxes_boxed, &TurnedTree::nodes_per_ray), false);
    quote("boxing_tests", ratio(boxes_boxed, &TurnedTree::tests_per_ray), false);
    quote("refit_nodes", ratio(boxes_refitted, &TurnedTree::nodes_per_ray), false);
    quote("anew_nodes", ratio(tree_anew, &TurnedTree::nodes_per_ray), false);
    if (!times || !is_timed(measured)) return;
    numbers.time_table("boxing_times", boxing_times_table(measured));
    quote("boxing_time", ratio(boxes_boxed, &TurnedTree::ns), true);
    quote("refit_time", ratio(boxes_refitted, &TurnedTree::ns), true);
    quote("anew_time", ratio(tree_anew, &TurnedTree::ns), true);
}

std::uint64_t wrong_boxing(const BoxingMeasurements& measured) {
    std::uint64_t wrong = 0;
    for (const TurnedTree& row : measured.trees)
        if (row.way != inverse_ray) wrong += row.others;
    return wrong;
}

std::vector<ClaimAnswer> answer_boxing(const BoxingMeasurements& measured) {
    std::size_t agree = 0, all = 0;
    std::vector<std::string> texts, names;
    for (const auto& scene : by_scene(measured.trees)) {
        const TurnedTree &inverse = turned_way(scene, inverse_ray),
                         &boxed = turned_way(scene, boxes_boxed);
        const bool timed = inverse.ns > 0.0;
        ++all;
        agree += boxed.nodes > inverse.nodes && boxed.volume > inverse.volume &&
                 (!timed || boxed.ns > inverse.ns);
        names.push_back(inverse.scene);
        texts.push_back(fmt::format(
            "{}: {:.1f} times the volume, {:.1f} times the nodes{}", inverse.scene,
            boxed.volume / inverse.volume, boxed.nodes_per_ray() / inverse.nodes_per_ray(),
            timed ? fmt::format(", {:.1f} times the time", boxed.ns / inverse.ns) : ""));
    }
    return {{"O8", verdict_of(agree, all),
             fmt::format("boxes of the turned boxes against the inverse ray: {}",
                         fmt::join(texts, "; ")),
             joined(names),
             "confirmed if in every scene the tree with boxes of turned boxes has more volume, "
             "visits more nodes and, where times are taken, takes longer than the inverse ray; "
             "refuted if in none"}};
}

}  // namespace space::ch09
