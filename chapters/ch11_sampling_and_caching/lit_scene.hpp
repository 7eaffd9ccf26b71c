/// @file
/// Scenes that are lit by their own surfaces. A surface reflects the same to all sides (Lambert) or
/// is a perfect mirror; some emit light from their front. There is no more to materials here.
#pragma once

#include "common/camera.hpp"
#include "common/geometry.hpp"
#include "common/scene.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace space {

/// A scene with what its triangles emit and which of them are mirrors. Its point lights are not
/// used: a point emits no light that a ray can hit.
struct LitScene {
    /// Colours are reflectances, of mirrors too; the background is the sky's radiance, black where
    /// the scene is closed.
    Scene scene;
    std::vector<Color> emission = {};        ///< radiance of each triangle's front; empty: none
    std::vector<std::uint8_t> mirror = {};   ///< 1 for each triangle that is one; empty: none
    std::vector<Triangle> triangles = {};    ///< those of scene.mesh
    std::vector<std::uint32_t> lights = {};  ///< the triangles that emit, in their order

    /// The part of the arriving light that leaves again, RGB in [0, 1).
    Double3 reflectance(std::uint32_t triangle) const { return Double3(scene.color(triangle)); }
    /// Radiance that leaves the side `front` or the other, the same in all directions.
    Double3 emitted(std::uint32_t triangle, bool front) const {
        return front && !emission.empty() ? Double3(emission[triangle]) : Double3(0.0);
    }
    bool is_mirror(std::uint32_t triangle) const {
        return !mirror.empty() && mirror[triangle] != 0;
    }
    Double3 sky() const { return Double3(scene.background); }
};

/// A lit scene that can be asked for by name.
struct LitSceneRecipe {
    std::string_view name;
    std::string_view about;  ///< one line
};
std::span<const LitSceneRecipe> lit_scene_recipes();

/// Makes the lit scene that `spec` names: one of lit_scene_recipes(), "room:bunny" or "room:FILE",
/// or whatever make_scene knows, which then stands in a closed studio under an area light. Seen by
/// `camera`, where there is one, and else by the scene's own; a studio holds the eyes of both. The
/// same bytes for the same arguments, with every compiler.
/// @throws Error as make_scene, and (bad_input) where floats do not reach across the studio
LitScene make_lit_scene(std::string_view spec, std::uint64_t seed = 1, bool small = false,
                        const std::optional<Camera>& camera = {});

/// Of the box around its triangles.
double diagonal_of(const LitScene& lit);

/// A scene's triangles, and which of them emit: `emission` and `mirror` as in LitScene.
LitScene lit(Scene scene, std::vector<Color> emission, std::vector<std::uint8_t> mirror = {});

}  // namespace space
