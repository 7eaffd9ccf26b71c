#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"

#include "chapters/ch11_sampling_and_caching/lit_stage.hpp"
#include "common/program/error.hpp"

#include <algorithm>
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

LitScene make_lit_scene(std::string_view spec, std::uint64_t seed, bool small) {
    LitStage stage;
    const std::span<const LitMaker> makers = lit_makers();
    const auto maker =
        std::ranges::find(makers, spec, [](const LitMaker& m) { return m.recipe.name; });
    if (maker != makers.end())
        maker->make(stage, small);
    else if (spec.substr(0, spec.find(':')) == "room")
        make_lit_room(stage, spec, seed, small);
    else
        make_lit_studio(stage, spec, seed, small);
    if (stage.scene.name.empty()) stage.scene.name = spec;
    return lit(std::move(stage.scene), std::move(stage.emission), std::move(stage.mirror));
}

}  // namespace space
