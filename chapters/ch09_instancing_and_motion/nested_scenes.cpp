#include "chapters/ch09_instancing_and_motion/nested_scenes.hpp"

#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/forest.hpp"
#include "chapters/ch09_instancing_and_motion/placement.hpp"
#include "common/program/error.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>
#include <glm/mat3x3.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace space {
namespace {

// [nested]
/// One group a level: the shape, and the level below in each of the places.
SceneGraph nested(std::string_view name, const TriangleMesh& shape, std::span<const Affine> places,
                  std::uint32_t levels) {
    std::vector<GraphObject> objects{{std::string(name), shape.triangles()}};
    for (std::uint32_t level = 1; level <= levels; ++level) {
        GraphObject group{fmt::format("{} {}", name, level)};
        group.instances.push_back({Affine{}, 0});
        for (const Affine& place : places) group.instances.push_back({place, level - 1});
        objects.push_back(std::move(group));
    }
    return {std::move(objects), levels};
}
// [nested]

/// The rotation that takes +z to the direction, about an axis perpendicular to both.
glm::dmat3 from_z_to(const Double3& direction) {
    const double c = direction.z, s = std::hypot(direction.x, direction.y);
    const Double3 axis{-direction.y / s, direction.x / s, 0.0};
    return rotation(axis, std::atan2(s, c) * 180.0 / std::numbers::pi);
}

}  // namespace

SceneGraph nested_sphereflake(std::uint32_t levels) {
    const double a = 1.0 / std::sqrt(2.0), radius = 0.5;
    const glm::dmat3 tilt =
        rotation({a, -a, 0}, std::asin(2.0 / std::sqrt(6.0)) * 180.0 / std::numbers::pi);
    std::vector<Affine> places;
    for (int turn = 0; turn < 3; ++turn)
        for (const Double3& d : {Double3{a, a, 0}, Double3{a, 0, -a}, Double3{0, a, -a}}) {
            const Double3 outwards = glm::normalize(rotation({0, 0, 1}, 120 * turn) * (tilt * d));
            places.push_back(affine({.translation = outwards * (radius * (1.0 + 1.0 / 3.0)),
                                     .rotation = from_z_to(outwards),
                                     .scale = Double3(1.0 / 3.0)}));
        }
    return nested("sphereflake", ball({0, 0, 0}, radius, 4), places, levels);
}

SceneGraph nested_tetra(std::uint32_t levels) {
    const std::array<Double3, 4> corners{Double3{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    TriangleMesh mesh;
    for (const Double3& corner : corners) mesh.vertices.emplace_back(corner);
    mesh.faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    std::vector<GraphObject> objects{{"tetra", mesh.triangles()}};
    for (std::uint32_t level = 1; level <= levels; ++level) {
        GraphObject group{fmt::format("tetra {}", level)};
        for (const Double3& corner : corners)
            group.instances.push_back({affine({.translation = 0.5 * corner,
                                               .rotation = glm::dmat3(1.0),
                                               .scale = Double3(0.5)}),
                                       level - 1});
        objects.push_back(std::move(group));
    }
    return {std::move(objects), levels};
}

SceneGraph nested_jacks(std::uint32_t levels) {
    TriangleMesh jack;
    for (int axis = 0; axis < 3; ++axis) {
        Double3 end{0.0};
        end[axis] = 0.75;
        jack.append(tube({-end, 0.075}, {end, 0.075}, 8, false));
        jack.append(ball(end, 0.15, 2));
        jack.append(ball(-end, 0.15, 2));
    }
    std::vector<Affine> places;
    for (int octant = 0; octant < 8; ++octant)
        places.push_back(affine({.translation = {octant & 1 ? 0.5 : -0.5, octant & 2 ? 0.5 : -0.5,
                                                 octant & 4 ? 0.5 : -0.5},
                                 .rotation = glm::dmat3(1.0),
                                 .scale = Double3(0.5)}));
    return nested("jack", jack, places, levels);
}

namespace {

constexpr NestedRecipe recipes[] = {
    {"sphereflake", "spheres on spheres; SIZE: levels, each with nine times as many", 7, 10,
     nested_sphereflake},
    {"tetra", "Sierpinski's tetrahedron; SIZE: levels, 4^(SIZE + 1) triangles", 14, 20,
     nested_tetra},
    {"jacks", "bars and balls, eight of half the size around each; SIZE: levels", 7, 11,
     nested_jacks},
    {"forest", "SIZE x SIZE trees on hills", 320, 1000,
     [](std::uint32_t size) { return make_forest_graph(size); }},
};

}  // namespace

std::span<const NestedRecipe> nested_recipes() {
    return recipes;
}

SceneGraph make_nested_scene(std::string_view spec) {
    const std::size_t colon = spec.find(':');
    const std::string_view name = spec.substr(0, colon);
    std::string names;
    for (const NestedRecipe& recipe : recipes) {
        names += fmt::format("{}{}", names.empty() ? "" : ", ", recipe.name);
        if (recipe.name != name) continue;
        if (colon == spec.npos) return recipe.make(recipe.default_size);
        const std::string_view text = spec.substr(colon + 1);
        std::uint32_t size = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
        if (error != std::errc{} || end != text.data() + text.size() || size > recipe.max_size)
            throw usage_error(
                fmt::format("nested scene {}: the size must be a whole number up to {}, not '{}'",
                            name, recipe.max_size, text));
        return recipe.make(size);
    }
    throw usage_error(fmt::format("no nested scene is called '{}': give one of {}", name, names));
}

}  // namespace space
