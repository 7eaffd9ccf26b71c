/// @file
/// A small mesh that is turned by hand and traced by any structure: what each pixel's ray sees, or
/// what it costs.
#pragma once

#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/accelerator.hpp"
#include "common/camera.hpp"
#include "common/program/image.hpp"
#include "common/program/svg.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace space::ch12 {

/// Meshes of some thousands of triangles, without the ground that they stand on.
enum class TurnedMesh { teapot, head, lattice, mountain, tetrahedron, soup, slivers };
inline constexpr std::array<std::string_view, 7> turned_mesh_names{
    "teapot",     "stone head",        "balls and rods", "mountain",
    "tetrahedra", "soup of triangles", "slivers"};
Scene turned_mesh(TurnedMesh mesh);

/// Makes the scene's camera look at the whole mesh, and two lamps go with it: as if the mesh were
/// turned before one's eyes. Degrees; at a turn of 0 it looks from where the scene's own camera is.
void turn(Scene& scene, double turn, double tilt);
inline constexpr double first_turn = 30.0, first_tilt = 25.0;

/// What a pixel shows of its ray.
enum class Shown { light, nodes, tests };
inline constexpr std::array<std::string_view, 3> shown_names{"light and shadows", "nodes visited",
                                                             "triangles tested"};
/// Of nodes and of tests: all that are more look the same.
inline constexpr std::size_t most_shown = 80;
/// The colours of 0, 1, .. most_shown of them.
std::vector<Color> shown_colors();

// [trace_row]
/// A picture, and what its rays have done; light takes shadow rays, too.
struct TracedPicture {
    Image image;
    std::uint64_t rays = 0;
    TraversalCounts counts = {};
};

/// One row of its pixels: a page that lets its reader wait traces a few at a time.
template <Accelerator A>
void trace_row(const Scene& scene, const A& accelerator, Shown shown, int y,
               TracedPicture& picture) {
    static const std::vector<Color> colors = shown_colors();
    const PixelGrid grid(scene.camera, picture.image.width(), picture.image.height());
    RenderCounts rays;
    for (int x = 0; x < grid.width; ++x) {
        const Ray ray = grid.ray(x, y);
        TraversalCounts counts;
        if (shown == Shown::light) {
            picture.image.at(x, y) = color_of_ray(scene, accelerator, ray, rays, counts);
        } else {
            accelerator.closest_hit(ray, counts);
            const std::uint64_t count =
                shown == Shown::nodes ? counts.nodes_visited : counts.triangles_tested;
            picture.image.at(x, y) = colors[std::min<std::uint64_t>(count, most_shown)];
        }
        picture.counts += counts;
        ++picture.rays;
    }
    picture.rays += rays.shadow_rays;
}
// [trace_row]

/// Where the picture is in its drawing.
inline constexpr Point2 turned_corner{8.0f, 8.0f};
inline constexpr Vector2 turned_size{640.0f, 480.0f};
/// The drawing without the picture: a frame, and the scale of what is shown.
Svg turned_drawing(Shown shown);

}  // namespace space::ch12
