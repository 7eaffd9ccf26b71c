/// @file
/// A tracer of a nested scene, whatever it is.
#pragma once

#include "chapters/ch09_instancing_and_motion/instanced_walk.hpp"
#include "chapters/ch09_instancing_and_motion/measured/nesting_data.hpp"
#include "chapters/ch09_instancing_and_motion/scene_graph.hpp"
#include "common/geometry.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace space::ch09 {

using PlacedAnswers = std::vector<std::optional<PlacedHit>>;

/// One that stands, what is known of it, and what answers all rays.
struct NestingRun {
    NestingTrace trace;
    std::function<void(std::span<const Ray> rays, PlacedAnswers& answers)> run;
};

/// Of the tracer that `build` makes; `closest(tracer, ray)` is a ray's answer. A Guard stands
/// while rays are traced.
template <class Guard = std::nullptr_t, class Build, class Closest>
NestingRun nesting_run(std::string_view way, const Build& build, const Closest& closest) {
    auto tracer = std::make_shared<const decltype(build())>(build());
    return {{.way = way}, [tracer, closest](std::span<const Ray> rays, PlacedAnswers& answers) {
                [[maybe_unused]] const Guard guard{};
                for (std::size_t i = 0; i < rays.size(); ++i)
                    answers[i] = closest(*tracer, rays[i]);
            }};
}

/// Embree with the meshes in their places, and with the flattened triangles, if there are any;
/// nothing where it is not installed.
std::vector<NestingRun> embree_nesting_runs(const SceneGraph& graph,
                                            std::span<const Triangle> flattened,
                                            std::uint64_t most_places);

}  // namespace space::ch09
