#include "chapters/ch12_comparison/measured/lab_counts.hpp"

#include "chapters/ch12_comparison/structures.hpp"
#include "common/program/progress.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space::ch12 {

void count_lab(Numbers& numbers) {
    const Scene scene = make_scene("sphereflake");
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const std::vector<Ray> rays = camera_rays({scene.camera, 64, 48});
    std::vector<HitRecord> hits(rays.size());
    const auto count = [](const std::optional<std::size_t>& value) {
        return value ? with_commas(*value) : "-";
    };
    const auto per_ray = [&](std::uint64_t total) {
        return fmt::format("{:.1f}", static_cast<double>(total) / static_cast<double>(rays.size()));
    };
    Table table({"structure", "nodes", "leaves", "depth", "references", "hits", "visits per ray",
                 "tests per ray"});
    Progress progress("the lab's structures", structures().size());
    for (const Structure& structure : structures()) {
        const BuiltStructure built = structure.variants.front().build_from_triangles(triangles, {});
        const TraversalCounts work = built.count({.rays = rays, .hits = hits});
        const TreeShape shape = built.shape();  // as the rays leave it
        table.row({std::string(structure.name), count(shape.nodes), count(shape.leaves),
                   count(shape.depth), with_commas(shape.references),
                   with_commas(static_cast<std::uint64_t>(std::ranges::count_if(
                       hits, [](const HitRecord& hit) { return hit.is_hit(); }))),
                   shape.nodes ? per_ray(work.nodes_visited) : "-",
                   per_ray(work.triangles_tested)});
        progress.step();
    }
    numbers.count("lab_triangles", triangles.size());
    numbers.count("lab_rays", rays.size());
    numbers.count_table("lab", table);
}

}  // namespace space::ch12
