/// @file
/// What the lit scenes are put together on: common/scenes' solids, each dull, shining or a mirror.
#pragma once

#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "common/camera.hpp"
#include "common/mesh.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace space {

/// A scene in the making.
struct LitStage {
    Scene scene = {};
    std::vector<Color> emission = {};
    std::vector<std::uint8_t> mirror = {};

    /// A scene that does not shine: without its point lights, before a black sky. Nothing is
    /// whiter than 0.9, as nothing is.
    void begin_with(Scene dull);
    void add(const TriangleMesh& mesh, const Color& reflectance);
    void add_mirror(const TriangleMesh& mesh, const Color& reflectance);
    /// Its front has this radiance; it reflects nothing.
    void add_light(const TriangleMesh& mesh, const Color& radiance);
    /// A square light at `centre` that faces `lit`, where a white surface that faces it becomes as
    /// bright as `brightness`.
    void add_panel(const Double3& centre, const Double3& lit, double side, const Color& brightness);
    /// Walls, floor and ceiling, seen from inside.
    void add_closed_room(const Double3& min, const Double3& max, const Color& walls,
                         const Color& left, const Color& right, const Color& floor);

  private:
    void append(const TriangleMesh& mesh, const Color& reflectance, const Color& radiance,
                bool is_mirror);
};

/// A recipe with the function behind its name; `small` asks for a coarse mesh of the same scene.
struct LitMaker {
    LitSceneRecipe recipe;
    void (*make)(LitStage& stage, bool small);
};
/// The scenes that are made here from nothing.
std::span<const LitMaker> lit_makers();

/// The book's room by daylight and lamplight, with what `spec` puts on its table ("room...").
void make_lit_room(LitStage& stage, std::string_view spec, std::uint64_t seed, bool small);

/// Any other scene of the book in a closed studio, under a square light. The studio holds the eye
/// of the scene's camera and of `camera`, where there is one.
void make_lit_studio(LitStage& stage, std::string_view spec, std::uint64_t seed, bool small,
                     const std::optional<Camera>& camera);

}  // namespace space
