#include "chapters/ch12_comparison/lab_subject.hpp"

#include "chapters/ch09_instancing_and_motion/instance_file.hpp"
#include "chapters/ch09_instancing_and_motion/nested_scenes.hpp"
#include "common/program/error.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <utility>

namespace space {
namespace {

Scene load(const LabOptions& options) {
    if (options.mesh.empty() && options.common.scene.empty())
        throw usage_error("give --mesh FILE, --scene NAME or --instances FILE");
    if (options.mesh.empty()) return make_scene(options.common.scene, options.common.seed);
    Scene scene;
    scene.name = options.mesh.stem().string();
    scene.mesh = load_mesh(options.mesh);
    frame_mesh(scene);
    return scene;
}

/// Those of the points that lie farthest out, in 26 directions.
std::vector<Double3> farthest(std::span<const Double3> points) {
    std::vector<Double3> kept;
    for (int i = 0; i < 27 && !points.empty(); ++i) {
        const Double3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        kept.push_back(*std::ranges::max_element(
            points, {}, [&](const Double3& p) { return glm::dot(p, direction); }));
    }
    return kept;
}

/// The box of what it holds, nearly: from below, each object's farthest points stand for it. (Boxes
/// of turned boxes would do for all but a picture: they grow with every level.)
Aabb box_around(const SceneGraph& graph) {
    std::vector<std::vector<Double3>> outline(graph.objects().size());
    for (const std::uint32_t i : graph.from_below()) {
        std::vector<Double3> points;
        for (const Triangle& triangle : graph.object(i).triangles)
            if (!box_if_finite<3>(triangle).is_empty())
                for (int corner = 0; corner < 3; ++corner) points.emplace_back(triangle[corner]);
        for (const Instance& instance : graph.object(i).instances)
            for (const Double3& point : outline[instance.object])
                points.push_back(instance.to_parent.point(point));
        outline[i] = farthest(points);
    }
    Aabb box;
    for (const Double3& point : outline[graph.root()])
        if (is_finite<3>(Point3(point))) box.extend(Point3(point));
    return box;
}

}  // namespace

Subject subject_of(const LabOptions& options) {
    if (options.instances.empty()) {
        Subject subject{load(options)};
        subject.triangles = subject.scene.mesh.triangles();
        subject.degenerate = count_degenerate(subject.triangles);
        return subject;
    }
    Subject subject;
    const bool from_file = options.instances_are_in_file();
    InstanceFile file = from_file ? load_instances(options.instances)
                                  : InstanceFile{make_nested_scene(options.instances), {}};
    subject.graph = std::move(file.graph);
    const std::uint64_t count = subject.graph->triangle_count();
    if (options.flatten) {
        if (count > options.build.limits.references)
            throw usage_error(fmt::format("--flatten: {} triangles, more than --max-references {}",
                                          count, options.build.limits.references));
        subject.triangles = flatten(*subject.graph);
        subject.degenerate = count_degenerate(subject.triangles);
    }
    const Aabb around = box_around(*subject.graph);
    Scene& scene = subject.scene;
    scene.name =
        from_file ? std::filesystem::path(options.instances).stem().string() : options.instances;
    if (!around.is_empty()) {
        scene.mesh = box(Double3(around.min), Double3(around.max));
        frame_mesh(scene);
    }
    scene.mesh.remarks = std::move(file.remarks);
    return subject;
}

}  // namespace space
