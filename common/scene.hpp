/// @file
/// A scene is triangles with a colour each, a camera, point lights and a background: no more than
/// the pictures need.
#pragma once

#include "common/camera.hpp"
#include "common/mesh.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace space {

/// Linear RGB, 1 = white.
using Color = glm::vec3;

/// Sends `intensity` in all directions; what arrives falls with the square of the distance.
struct PointLight {
    Point3 position{0.0f};
    Color intensity{1.0f};
};

/// All that a renderer needs to draw one picture.
struct Scene {
    std::string name;
    TriangleMesh mesh;
    std::vector<Color> colors;  ///< diffuse reflectance of each face; empty: all `default_color`
    Camera camera;
    std::vector<PointLight> lights;
    Color background{0.0f};

    static constexpr Color default_color{0.73f, 0.73f, 0.73f};
    Color color(std::uint32_t triangle) const {
        return colors.empty() ? default_color : colors[triangle];
    }
};

/// One scene that can be asked for by name; the argument is its size (spheres' depth, triangles,
/// frequency ...).
struct SceneRecipe {
    std::string_view name;
    std::string_view about;          ///< one line, with what the size means
    std::uint32_t default_size = 0;  ///< 0: the scene has no size
    std::uint32_t small_size = 0;    ///< for --small and tests
    std::uint32_t max_size = 0;
    bool from_file = false;  ///< it comes from a file that this machine may not have
};
std::span<const SceneRecipe> scene_recipes();

/// Makes the scene that `spec` names: "NAME", "NAME:SIZE", "room:FILE" (that mesh on the room's
/// table) or the path of a mesh file (which is framed by the camera and lit). The same spec and
/// seed give the same scene, bit for bit, with every compiler.
/// @throws Error (usage) for an unknown name or an absurd size, (bad_input) for a broken file
Scene make_scene(std::string_view spec, std::uint64_t seed = 1, bool small = false);

/// The file that this scene's mesh is read from; empty where it is made.
std::filesystem::path scene_file(std::string_view spec);

/// Camera and lights that show the whole mesh: for meshes that come without.
void frame_mesh(Scene& scene);

/// The seven segments A .. G of Heinonen16, figures 2-5, in this order.
std::vector<Segment> heinonen_segments();

/// 22 segments in a frame of 26 x 13, at random places and none near another: what the drawings'
/// rays go through.
std::vector<Segment> scattered_segments();

}  // namespace space
