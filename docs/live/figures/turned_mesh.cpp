#include "chapters/ch12_comparison/figures/turned_mesh.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch03_bsp_trees/bsp.hpp"
#include "chapters/ch04_kd_trees/kd_tree.hpp"
#include "chapters/ch05_lazy_kd_trees/lazy_kd_tree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/linear_octree.hpp"
#include "chapters/ch06_quadtrees_and_octrees/octree.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/median_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/morton_builder.hpp"
#include "docs/live/live.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <memory>

namespace space::live {
namespace {

using namespace std::string_view_literals;
using ch12::Shown;
using ch12::TracedPicture;

/// A structure that stands, whatever its type.
struct Standing {
    std::function<TracedPicture(const Scene&, Shown, int, int)> traced;
    std::function<TreeShape()> shape;
};

template <class A>
Standing standing(std::span<const Triangle> triangles, const typename A::Config& config = {}) {
    const auto tree = std::make_shared<const A>(A::build(triangles, config));
    return {[tree](const Scene& scene, Shown shown, int width, int height) {
                return ch12::traced_picture(scene, *tree, shown, width, height);
            },
            [tree] { return tree->shape(); }};
}

constexpr std::array structures{
    "BVH, bins"sv, "BVH, Morton codes"sv,       "BVH, halved by count"sv,
    "k-d tree"sv,  "k-d tree, in the middle"sv, "k-d tree, made where rays go"sv,
    "octree"sv,    "linear octree"sv,           "BSP tree"sv,
    "none"sv};

Standing built(std::size_t structure, std::span<const Triangle> triangles) {
    switch (structure) {
        case 0:
            return standing<Bvh<BinnedBuilder>>(triangles);
        case 1:
            return standing<Bvh<MortonBuilder>>(triangles);
        case 2:
            return standing<Bvh<MedianBuilder>>(triangles);
        case 3:
            return standing<KdTree<>>(triangles);
        case 4:
            return standing<KdTree<>>(triangles, {.rule = KdTreeConfig::Rule::middle});
        case 5:
            return standing<LazyKdTree<>>(triangles);
        case 6:
            return standing<Octree<>>(triangles);
        case 7:
            return standing<LinearOctree<>>(triangles);
        case 8:
            return standing<Bsp<>>(triangles);
        default:
            return standing<Naive<FilteredExact>>(triangles);
    }
}

/// One mesh, and the structures over it that were asked for.
struct Kept {
    std::size_t mesh;
    Scene scene;
    std::vector<Triangle> triangles;
    std::map<std::size_t, Standing> standing = {};
};

Kept& kept(std::size_t mesh) {
    static Kept kept{ch12::turned_mesh_names.size(), {}, {}};
    if (kept.mesh != mesh) {
        Scene scene = ch12::turned_mesh(ch12::TurnedMesh(mesh));
        std::vector<Triangle> triangles = scene.mesh.triangles();
        kept = {mesh, std::move(scene), std::move(triangles)};
    }
    return kept;
}

/// As many pixels as there is time for: about so many tests, by what a coarse picture took. A node
/// costs as much as two tests, and a ray as much as ten besides.
TracedPicture in_time(const Standing& standing, const Scene& scene, Shown shown, double tests) {
    constexpr std::array widths{640, 480, 400, 320, 240, 200, 160, 120, 100, 80, 60, 40};
    constexpr int coarse_width = 24, coarse_height = 18;
    TracedPicture coarse = standing.traced(scene, shown, coarse_width, coarse_height);
    const double pixel = (2.0 * double(coarse.counts.nodes_visited) +
                          double(coarse.counts.triangles_tested) + 10.0 * double(coarse.rays)) /
                         (coarse_width * coarse_height);
    for (const int width : widths)
        if (pixel * width * width * 0.75 <= tests)
            return standing.traced(scene, shown, width, width * 3 / 4);
    return coarse;
}

std::vector<std::uint8_t> rgba(const Image& image) {
    const std::vector<std::uint8_t> rgb = srgb_bytes(image);
    std::vector<std::uint8_t> bytes;
    bytes.reserve(rgb.size() / 3 * 4);
    for (std::size_t i = 0; i < rgb.size(); i += 3)
        bytes.insert(bytes.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 255});
    return bytes;
}

std::string told(const Kept& kept, const Standing& standing, const TracedPicture& picture) {
    const TreeShape shape = standing.shape();
    const auto rays = double(picture.rays);
    std::string text = fmt::format("{} triangles", kept.triangles.size());
    if (shape.nodes) text += fmt::format(" in a tree of {} nodes", *shape.nodes);
    return text + fmt::format(
                      ", {} KiB. A ray visits {:.1f} nodes and is tested against {:.1f} "
                      "triangles; {} × {} pixels.",
                      shape.bytes >> 10, double(picture.counts.nodes_visited) / rays,
                      double(picture.counts.triangles_tested) / rays, picture.image.width(),
                      picture.image.height());
}

}  // namespace

Answer turned_mesh(const State& state) {
    const std::size_t mesh = state.choice("mesh", 0, ch12::turned_mesh_names),
                      structure = state.choice("structure", 0, structures),
                      show = state.choice("show", 1, ch12::shown_names);
    // Round and round by the hand; never over the top.
    double turn = state.number("turn", ch12::first_turn, -1e6, 1e6);
    turn -= 360.0 * std::floor((turn + 180.0) / 360.0);
    const double tilt = state.number("tilt", ch12::first_tilt, -85.0, 85.0);
    static constexpr std::array details{"high"sv, "low"sv};
    const bool is_held = state.choice("detail", 0, details) == 1;

    Kept& mesh_kept = kept(mesh);
    ch12::turn(mesh_kept.scene, turn, tilt);
    auto found = mesh_kept.standing.find(structure);
    if (found == mesh_kept.standing.end())
        found = mesh_kept.standing.emplace(structure, built(structure, mesh_kept.triangles)).first;
    const Shown shown{static_cast<int>(show)};
    const TracedPicture picture =
        in_time(found->second, mesh_kept.scene, shown, is_held ? 1.5e6 : 12e6);
    return {.drawing = ch12::turned_drawing(shown),
            .summary = told(mesh_kept, found->second, picture),
            .choices = {{"mesh", "Mesh", ch12::turned_mesh_names, mesh},
                        {"structure", "Structure", structures, structure},
                        {"show", "Each pixel shows", ch12::shown_names, show}},
            .sliders = {{"turn", "Turn", turn, -180.0, 180.0, 1.0},
                        {"tilt", "Tilt", tilt, -85.0, 85.0, 1.0}},
            .picture = Picture{ch12::turned_corner, ch12::turned_size, picture.image.width(),
                               picture.image.height(), rgba(picture.image), double(picture.rays)}};
}

}  // namespace space::live
