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
#include <optional>

namespace space::live {
namespace {

using namespace std::string_view_literals;
using ch12::Shown;
using ch12::TracedPicture;

/// A structure that stands, whatever its type.
struct Standing {
    std::function<void(const Scene&, Shown, int, TracedPicture&)> trace_row;
    std::function<TreeShape()> shape;
};

template <class A>
Standing standing(std::span<const Triangle> triangles, const typename A::Config& config = {}) {
    const auto tree = std::make_shared<const A>(A::build(triangles, config));
    return {[tree](const Scene& scene, Shown shown, int y, TracedPicture& picture) {
                ch12::trace_row(scene, *tree, shown, y, picture);
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

/// What a picture is of.
struct View {
    std::size_t structure;
    Shown shown;
    bool in_full;
    double turn, tilt;

    bool operator==(const View&) const = default;
};

/// A picture that is made in parts: so many of its rows stand.
struct Begun {
    View view;
    TracedPicture picture;
    int rows = 0;
};

/// One mesh, the structures over it that were asked for, and the picture that is being made.
struct Kept {
    std::size_t mesh;
    Scene scene;
    Camera first_camera;  ///< the scene's own, from which it is turned
    std::vector<Triangle> triangles;
    std::map<std::size_t, Standing> standing = {};
    std::optional<Begun> begun = {};
};

Kept& kept(std::size_t mesh) {
    static Kept kept{ch12::turned_mesh_names.size(), {}, {}, {}};
    if (kept.mesh != mesh) {
        Scene scene = ch12::turned_mesh(ch12::TurnedMesh(mesh));
        std::vector<Triangle> triangles = scene.mesh.triangles();
        const Camera camera = scene.camera;
        kept = {mesh, std::move(scene), camera, std::move(triangles)};
    }
    return kept;
}

/// Of a picture that is moved, or of a part of one that rests; and of all its parts.
constexpr double cost_at_once = 1.5e6, cost_in_full = 12e6;

/// What a picture has taken, in tests of a triangle: a node costs as much as two, and a ray as much
/// as ten besides.
double cost(const TracedPicture& picture) {
    return 2.0 * double(picture.counts.nodes_visited) + double(picture.counts.triangles_tested) +
           10.0 * double(picture.rays);
}

/// Traces rows from the first one on, until that has cost enough; the row after them.
int trace_rows(const Standing& standing, const Scene& scene, Shown shown, int y,
               TracedPicture& picture, double enough) {
    const double before = cost(picture);
    while (y < picture.image.height() && cost(picture) - before < enough)
        standing.trace_row(scene, shown, y++, picture);
    return y;
}

/// As many pixels as cost about so much, by what a small picture costs.
TracedPicture empty_picture(const Standing& standing, const Scene& scene, Shown shown,
                            double affordable) {
    constexpr std::array widths{640, 480, 400, 320, 240, 200, 160, 120, 100, 80, 60, 40, 24};
    constexpr int smallest = 16;
    TracedPicture small{.image = {smallest, smallest * 3 / 4}};
    trace_rows(standing, scene, shown, 0, small, infinity);
    for (const int width : widths)
        if (cost(small) * width * width <= affordable * smallest * smallest)
            return {.image = {width, width * 3 / 4}};
    return {.image = {smallest, smallest * 3 / 4}};
}

/// Some of its rows, from one on.
std::vector<std::uint8_t> rgba(const Image& image, int first, int end) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(4 * std::size_t(image.width()) * std::size_t(end - first));
    for (int y = first; y < end; ++y)
        for (int x = 0; x < image.width(); ++x) {
            const glm::vec3& color = image.at(x, y);
            bytes.insert(bytes.end(),
                         {srgb_byte(color.x), srgb_byte(color.y), srgb_byte(color.z), 255});
        }
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
    static constexpr std::array details{"low"sv, "more"sv};
    const bool in_full = state.choice("detail", 0, details) == 1;
    const double enough = cost_at_once * state.number("effort", 1.0, 1e-3, 1.0);

    Kept& mesh_kept = kept(mesh);
    mesh_kept.scene.camera = mesh_kept.first_camera;
    ch12::turn(mesh_kept.scene, turn, tilt);
    auto found = mesh_kept.standing.find(structure);
    if (found == mesh_kept.standing.end())
        found = mesh_kept.standing.emplace(structure, built(structure, mesh_kept.triangles)).first;
    const Standing& standing = found->second;
    const Scene& scene = mesh_kept.scene;
    const View view{structure, Shown(show), in_full, turn, tilt};
    std::optional<Begun>& begun = mesh_kept.begun;
    if (!in_full || !begun || begun->view != view)
        begun = Begun{view,
                      empty_picture(standing, scene, view.shown, in_full ? cost_in_full : enough)};
    auto& [of, picture, rows] = *begun;
    const int first_row = rows;
    const double rays_before = double(picture.rays);
    rows = trace_rows(standing, scene, view.shown, first_row, picture, in_full ? enough : infinity);
    return {.drawing = ch12::turned_drawing(view.shown),
            .summary = told(mesh_kept, standing, picture),
            .choices = {{"mesh", "Mesh", ch12::turned_mesh_names, mesh},
                        {"structure", "Structure", structures, structure},
                        {"show", "Each pixel shows", ch12::shown_names, show}},
            .sliders = {{"turn", "Turn", turn, -180.0, 180.0, 1.0},
                        {"tilt", "Tilt", tilt, -85.0, 85.0, 1.0}},
            .picture = Picture{.corner = ch12::turned_corner,
                               .size = ch12::turned_size,
                               .width = picture.image.width(),
                               .height = picture.image.height(),
                               .rgba = rgba(picture.image, first_row, rows),
                               .first_row = first_row,
                               .rays = double(picture.rays) - rays_before}};
}

}  // namespace space::live
