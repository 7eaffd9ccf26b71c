/// @file
/// A scene, and the rays that are traced through its trees.
#pragma once

#include "chapters/ch07_bounding_volume_hierarchies/measured/data.hpp"
#include "common/accelerator.hpp"
#include "common/measure.hpp"
#include "common/scene.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace space::ch07 {

using Answers = std::vector<std::optional<Hit>>;

/// A scene with its rays, and what they must hit.
struct RayTask {
    std::string scene;
    std::vector<Triangle> triangles;
    std::array<std::vector<Ray>, ray_kinds.size()> rays;
    /// A tree's answers to the camera rays and to the diffuse ones, which all others are held
    /// against; it is held against the naive loop's, as far as their number allows.
    Answers camera_hits, diffuse_hits;
    std::uint64_t checked = 0, wrong = 0;

    /// A camera ray for each pixel, one shadow ray for each hit that faces its lamp (they take
    /// turns), a diffuse ray for each hit.
    RayTask(std::string name, const Scene& made, int width, int height, std::uint64_t naive_tests,
            unsigned threads, std::uint64_t seed);
};

/// Traces all rays of a kind.
template <Accelerator A, class Counts>
void trace(const A& tree, const RayTask& task, std::size_t kind, Counts& counts) {
    if (kind == shadow_kind)
        for (const Ray& ray : task.rays[kind]) do_not_optimize(tree.any_hit(ray, counts));
    else
        for (const Ray& ray : task.rays[kind]) do_not_optimize(tree.closest_hit(ray, counts));
}

/// The same for each kind, to be timed. `Around` lives while rays are traced.
struct Nothing {};
template <class Around = Nothing, Accelerator A>
std::array<std::function<void()>, ray_kinds.size()> runs(const RayTask& task,
                                                         const std::shared_ptr<const A>& tree) {
    std::array<std::function<void()>, ray_kinds.size()> all;
    for (std::size_t kind = 0; kind < all.size(); ++kind)
        all[kind] = [&task, tree, kind] {
            [[maybe_unused]] const Around around;
            NoCounts none;
            trace(*tree, task, kind, none);
        };
    return all;
}

}  // namespace space::ch07
