#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"

#include "chapters/ch11_sampling_and_caching/lit_stage.hpp"
#include "common/geometry.hpp"
#include "common/program/error.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace space {

std::span<const LitSceneRecipe> lit_scene_recipes() {
    static const std::vector<LitSceneRecipe> recipes = [] {
        std::vector<LitSceneRecipe> list;
        for (const LitMaker& maker : lit_makers()) list.push_back(maker.recipe);
        list.push_back({"room", "the book's room by daylight and the light of its lamp"});
        return list;
    }();
    return recipes;
}

LitScene lit(Scene scene, std::vector<Color> emission, std::vector<std::uint8_t> mirror) {
    LitScene lit{
        .scene = std::move(scene), .emission = std::move(emission), .mirror = std::move(mirror)};
    lit.triangles = lit.scene.mesh.triangles();
    for (std::uint32_t i = 0; i < lit.emission.size(); ++i)
        if (lit.emission[i] != Color(0.0f)) lit.lights.push_back(i);
    return lit;
}

double diagonal_of(const LitScene& lit) {
    Aabb box;
    for (const Triangle& triangle : lit.triangles) box.extend(bounds(triangle));
    return glm::length(Double3(box.extent()));
}

namespace {

/// @throws Error (usage) for a name that is neither here nor among the book's scenes
void check_name(std::string_view spec) {
    const std::string_view name = spec.substr(0, spec.find(':'));
    std::string names;
    for (const LitSceneRecipe& recipe : lit_scene_recipes()) {
        if (recipe.name == name && name != "room")
            throw usage_error(
                fmt::format("scene {}: it has no size, '{}'", name, spec.substr(name.size() + 1)));
        names += fmt::format("{}, ", recipe.name);
    }
    for (const SceneRecipe& recipe : scene_recipes()) {
        if (recipe.name == name) return;
        if (recipe.name != "room") names += fmt::format("{}, ", recipe.name);
    }
    if (spec.find_first_of("./") != std::string_view::npos) return;  // a file
    throw usage_error(fmt::format(
        "no scene is called '{}': give a mesh file (.obj, .off, .ply, .stl) or one of {}", name,
        names.substr(0, names.size() - 2)));
}

}  // namespace

LitScene make_lit_scene(std::string_view spec, std::uint64_t seed, bool small,
                        const std::optional<Camera>& camera) {
    LitStage stage;
    const std::span<const LitMaker> makers = lit_makers();
    const auto maker =
        std::ranges::find(makers, spec, [](const LitMaker& m) { return m.recipe.name; });
    if (maker == makers.end()) check_name(spec);
    if (maker != makers.end())
        maker->make(stage, small);
    else if (spec.substr(0, spec.find(':')) == "room")
        make_lit_room(stage, spec, seed, small);
    else
        make_lit_studio(stage, spec, seed, small, camera);
    if (camera) stage.scene.camera = *camera;
    if (stage.scene.name.empty()) stage.scene.name = spec;
    return lit(std::move(stage.scene), std::move(stage.emission), std::move(stage.mirror));
}

}  // namespace space
