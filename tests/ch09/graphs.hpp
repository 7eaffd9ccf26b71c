/// @file
/// Scene graphs on which instancing fails, and what a flattened mesh answers.
#pragma once

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch09_instancing_and_motion/affine.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_trees.hpp"
#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/random_placement.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/random.hpp"
#include "tests/suite/adversarial_scenes.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace space {

inline Affine moved(const Double3& by, Affine map = {}) {
    for (int axis = 0; axis < 3; ++axis) map.rows[std::size_t(axis)][3] += by[axis];
    return map;
}
inline Affine scaled(const Double3& by) {
    Affine map;
    for (int axis = 0; axis < 3; ++axis) map.rows[std::size_t(axis)][std::size_t(axis)] = by[axis];
    return map;
}
/// About a unit vector (Rodrigues).
inline Affine rotated(const Double3& about, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    Affine map;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int k = 3 - i - j;
            map.rows[std::size_t(i)][std::size_t(j)] =
                about[i] * about[j] * (1.0 - c) +
                (i == j ? c : about[k] * s * ((j + 1) % 3 == i ? 1.0 : -1.0));
        }
    return map;
}
inline Affine rotated(Pcg32& random) {
    const glm::dmat3 columns = random_rotation(random);
    Affine map;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) map.rows[std::size_t(i)][std::size_t(j)] = columns[j][i];
    return map;
}

/// Each instance of `object` under a map of its own.
template <class Map>
std::vector<Instance> copies(std::uint32_t object, int count, const Map& map) {
    std::vector<Instance> instances;
    for (int i = 0; i < count; ++i) instances.push_back({map(i), object});
    return instances;
}

struct TestGraph {
    std::string name;
    SceneGraph graph;
};

/// A mesh, and a group that is the root.
inline SceneGraph two_levels(std::vector<Triangle> mesh, std::vector<Instance> instances) {
    return {{{.name = "mesh", .triangles = std::move(mesh)},
             {.name = "root", .instances = std::move(instances)}},
            1};
}

/// Three levels of groups, each turned, stretched and moved.
inline SceneGraph nested(std::vector<Triangle> mesh, Pcg32& random, const Double3& away) {
    const auto somewhere = [&](int) {
        const Affine turn = rotated(random);
        const Double3 size = 0.5 + Double3(random_point(random, 0.0f, 1.0f));
        return moved(2.0 * Double3(random_vector(random)), composed(turn, scaled(size)));
    };
    std::vector<GraphObject> objects{{.name = "mesh", .triangles = std::move(mesh)}};
    for (std::uint32_t level = 1; level < 3; ++level)
        objects.push_back({.name = "group " + std::to_string(level),
                           .instances = copies(level - 1, 3, somewhere)});
    objects.push_back({.name = "root", .instances = copies(2, 3, [&](int i) {
                                           return moved(away, somewhere(i));
                                       })});
    objects.back().instances.push_back({moved(away), 0});  // the mesh itself, too
    return {std::move(objects), 3};
}

/// A group's object is moved by 10^10 and the group back again: what doubles round on the way there
/// is more than what floats round where it ends.
inline SceneGraph there_and_back(std::vector<Triangle> mesh, Pcg32& random) {
    std::vector<GraphObject> objects{{.name = "mesh", .triangles = std::move(mesh)}};
    std::vector<Instance> back;
    for (std::uint32_t i = 1; i <= 4; ++i) {
        const Double3 direction = random_direction(random);
        const Affine there = moved(1e10 * direction, rotated(random));
        const Affine turn = rotated(random);
        const Double3 way = turn.point(there.translation());
        objects.push_back({.name = "moved", .instances = {{there, 0}}});
        back.push_back({moved(Double3(random_vector(random)) - way, turn), i});
    }
    objects.push_back({.name = "root", .instances = std::move(back)});
    return {std::move(objects), 5};
}

/// Rotated, mirrored, stretched, sheared, far, tiny, huge, nested: each a small scene.
inline std::vector<TestGraph> test_graphs() {
    const std::vector<Triangle> ball = scenes::ball(2), soup = scenes::soup(60, 0.3f, 5);
    Pcg32 random(9);
    const auto turned = [&](int) {
        const Affine turn = rotated(random);
        return moved(2.0 * Double3(random_vector(random)), turn);
    };
    std::vector<TestGraph> graphs;
    const auto add = [&](std::string name, SceneGraph graph) {
        graphs.push_back({std::move(name), std::move(graph)});
    };
    add("as it is", two_levels(ball, {{{}, 0}}));
    add("rotated", two_levels(ball, copies(0, 8, turned)));
    add("mirrored", two_levels(soup, copies(0, 8, [&](int i) {
                                   return composed(
                                       turned(i),
                                       scaled({i % 2 ? -1.0 : 1.0, i % 4 < 2 ? 1.0 : -1.0, 1.0}));
                               })));
    add("sheared by scale", two_levels(ball, copies(0, 8, [&](int i) {
                                           return composed(scaled({1.0, 0.1, 3.0}), turned(i));
                                       })));
    add("stretched a million times",
        two_levels(soup, copies(0, 4, [&](int i) {
                       return composed(turned(i), scaled({1e-3, 1.0, 1e3}));
                   })));
    for (const double away : {1e3, 1e6})
        add("far from the origin",
            two_levels(ball, copies(0, 8, [&](int i) {
                           return moved({away, -0.3 * away, 0.7 * away}, turned(i));
                       })));
    for (const double size : {1e-6, 1e-3, 1e3, 1e6})
        add("of size " + std::to_string(size), two_levels(ball, copies(0, 4, [&](int i) {
                                                              return composed(scaled(Double3(size)),
                                                                              turned(i));
                                                          })));
    add("of sizes from 1e-6 to 1e6",
        two_levels(soup, copies(0, 12, [&](int i) {
                       return composed(turned(i), scaled(Double3(std::pow(10.0, i - 6))));
                   })));
    add("nested three deep", nested(ball, random, Double3(0.0)));
    add("nested three deep, far", nested(soup, random, {1e6, 2e5, -3e6}));
    add("moved far and back", there_and_back(ball, random));
    add("ten times in one place", two_levels(soup, copies(0, 10, [](int) { return Affine{}; })));
    add("a mesh that is the root", {{{.name = "mesh", .triangles = ball}}, 0});
    return graphs;
}

inline bool is_same(const std::optional<Hit>& flat, const std::optional<PlacedHit>& placed) {
    if (!flat || !placed) return !flat && !placed;
    return PlacedHit{flat->t, flat->u, flat->v, flat->triangle} == *placed;
}

}  // namespace space
