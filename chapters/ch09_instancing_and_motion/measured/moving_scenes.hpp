/// @file
/// Scenes and how they move: what measurements and pictures have in common.
#pragma once

#include "chapters/ch09_instancing_and_motion/deforming.hpp"
#include "common/program/options.hpp"
#include "common/random_rays.hpp"
#include "common/scene.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch09 {

/// A scene in motion; frame 0 is at rest.
struct MovingScene {
    std::string scene;
    std::string_view motion;
    std::vector<Triangle> rest;
    /// All triangles at a time from 0 to 1.
    std::function<void(double time, std::span<Triangle> moved)> move;

    std::vector<Triangle> at(double time) const {
        std::vector<Triangle> moved(rest.size());
        move(time, moved);
        return moved;
    }
};

template <Motion M>
MovingScene moving_scene(std::string scene, std::string_view name, std::vector<Triangle> rest,
                         const M& motion) {
    return {std::move(scene), name, rest, [rest, motion](double time, std::span<Triangle> moved) {
                move_to(time, motion, rest, moved);
            }};
}

inline MovingScene wave_scene(const std::string& scene) {
    const auto rest = make_scene(scene).mesh.triangles();
    const double length = bounds(rest).extent().x;
    return moving_scene(scene, "wave", rest, Wave{0.1 * length, 0.4 * length});
}
inline MovingScene twist_scene(const std::string& scene) {
    const auto rest = make_scene(scene).mesh.triangles();
    return moving_scene(scene, "twist", rest, Twist{bounds(rest), 1.0});
}
inline MovingScene explosion_scene(const std::string& scene) {
    const auto rest = make_scene(scene).mesh.triangles();
    return moving_scene(scene, "explosion", rest, Explosion{Double3(bounds(rest).centroid()), 1.0});
}

/// One of each, about 20,000 triangles each.
inline std::vector<MovingScene> moving_scenes(const Options& options) {
    const bool small = options.small;
    return {wave_scene(small ? "mount:4" : "mount"), twist_scene(small ? "lattice:2" : "lattice"),
            explosion_scene(small ? "icosphere:6" : "icosphere:32")};
}

}  // namespace space::ch09
