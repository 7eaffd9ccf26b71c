#include "chapters/ch09_instancing_and_motion/mesh_places.hpp"
#include "chapters/ch12_comparison/peers/peers.hpp"
#include "common/embree_instances.hpp"
#include "common/embree_tree.hpp"
#include "common/limit_error.hpp"

#include <fmt/format.h>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace space::ch12 {
namespace {

/// Embree asserts, and so ends the program, where a ray has a coordinate larger than this (its
/// FLT_LARGE), in the world or in an instance's space.
constexpr float embree_largest = 1.844e18f;

/// How large coordinates in instances' spaces may be: at most scale |p| + shift.
struct LocalReach {
    float scale = 1.0f, shift = 0.0f;

    /// By the inverse in floats, as Embree computes it.
    void cover(const Affine& to_world) {
        glm::mat3 linear;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) linear[j][i] = static_cast<float>(to_world.at(i, j));
        const glm::mat3 inverse = glm::inverse(linear);
        const auto size = [](const Vector3& v) { return glm::dot(glm::abs(v), Vector3(1.0f)); };
        const float most = size({size(inverse[0]), size(inverse[1]), size(inverse[2])});
        scale = std::isfinite(most) ? std::max(scale, most) : infinity;
        shift = std::max(shift, most * size(Vector3(to_world.translation())));
    }
    void check(std::span<const Ray> rays) const {
        const auto fits = [&](const Vector3& v, float by) {
            for (int axis = 0; axis < 3; ++axis)
                if (!(std::abs(v[axis]) * scale + by <= embree_largest)) return false;
            return true;
        };
        for (const Ray& ray : rays)
            if (is_valid(ray) && !(fits(ray.origin, shift) && fits(ray.direction, 0.0f)))
                throw LimitError("Embree takes no ray with coordinates beyond 1.844e18");
    }
};

template <class Tree>
BuiltStructure stands(const std::shared_ptr<const Tree>& tree, const EmbreeFlavour& flavour,
                      unsigned threads, const LocalReach& reach = {}) {
    return {.shape = [tree] { return tree->shape(); },
            .trace =
                [tree, reach, checked = static_cast<const Ray*>(nullptr)](
                    const Batch& batch) mutable {  // the first run is not timed
                    if (std::exchange(checked, batch.rays.data()) != batch.rays.data())
                        reach.check(batch.rays);
                    [[maybe_unused]] const DenormalsAreZero guard;
                    trace<NoCounts>(*tree, batch);
                },
            .build_threads = threads,
            .configuration = fmt::format("Embree {}, {}, threads={}, instruction set by default, "
                                         "rtcIntersect1 and rtcOccluded1, denormals are zero",
                                         RTC_VERSION_STRING, flavour.names, threads)};
}

/// Every mesh of the graph in every place: Embree is compiled for one level of instances.
BuiltStructure placed(const SceneGraph& graph, const EmbreeFlavour& flavour,
                      const BuildOptions& options) {
    std::vector<std::span<const Triangle>> meshes;
    for (const GraphObject& object : graph.objects()) meshes.emplace_back(object.triangles);
    std::vector<EmbreePlaced> places;
    LocalReach reach;
    for (const auto& [mesh, to_world] : mesh_places(graph, options.limits.references)) {
        places.push_back({mesh, to_world.rows});
        reach.cover(to_world);
    }
    return stands(std::make_shared<const EmbreeInstances>(meshes, places, options.threads, flavour),
                  flavour, options.threads, reach);
}

Structure offer(std::string_view name, std::string_view about, EmbreeFlavour flavour) {
    const auto build = [flavour](std::span<const Triangle> triangles, const BuildOptions& options) {
        const auto tree = std::make_shared<const EmbreeTree>(triangles, options.threads, flavour);
        return stands(tree, flavour, options.threads);
    };
    const auto build_instances = [flavour](const SceneGraph& graph, const BuildOptions& options) {
        return placed(graph, flavour, options);
    };
    return {.name = name, .about = about, .variants = {{"its own", "", build, build_instances}}};
}

}  // namespace

Home embree() {
    return {"Embree " RTC_VERSION_STRING,
            {offer("embree", "Intel's bounding volume hierarchy, eight children a node", {}),
             offer("embree-high", "the same, built with spatial splits",
                   {RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE,
                    "RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE"}),
             offer("embree-robust", "as embree, watertight along edges",
                   {RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST,
                    "RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST"})},
            true};
}

}  // namespace space::ch12
