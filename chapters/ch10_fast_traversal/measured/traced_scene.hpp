/// @file
/// A scene and three kinds of rays through it: what every tracer of this chapter is given.
#pragma once

#include "chapters/ch10_fast_traversal/measured/data.hpp"
#include "common/accelerator.hpp"
#include "common/program/options.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace space::ch10 {

using Answers = std::vector<std::optional<Hit>>;

/// A scene, its rays, and what chapter 7's binary tree answers to them: all others are held against
/// that, bit for bit.
struct TracedScene {
    std::string name;
    bool is_long = false;  ///< whether triangles are as long as the scene
    std::vector<Triangle> triangles;
    /// A camera ray for each pixel, in tiles of 8 x 8 pixels; for each hit one to a lamp that the
    /// surface faces, and one away from the surface in a direction by chance.
    std::array<std::vector<Ray>, ray_kinds.size()> rays;
    std::array<Answers, ray_kinds.size()> answers;  ///< of shadow rays, any hit that says no more

    std::size_t ray_count(RayKind kind) const { return rays[kind].size(); }
};

/// Makes it, for a picture of so many pixels; none for a file that this machine does not have.
std::optional<TracedScene> traced_scene(const std::string& name, bool is_long, int width,
                                        int height, const Options& options);

}  // namespace space::ch10
