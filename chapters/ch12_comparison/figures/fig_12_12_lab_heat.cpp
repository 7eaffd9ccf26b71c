// What the lab's --heatmap writes.

#include "chapters/ch12_comparison/figures.hpp"
#include "chapters/ch12_comparison/lab_pictures.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace space::ch12 {

Image fig_12_12(const Options& options) {
    constexpr int width = 640, height = 480;
    const Scene scene = make_scene("building");
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const Structure& structure =
        *std::ranges::find(structures(), std::string_view("kd-sah"), &Structure::name);
    const BuiltStructure built = structure.variants.front().build_from_triangles(triangles, {});
    const std::vector<Ray> rays = camera_rays({scene.camera, width, height});
    std::vector<HitRecord> hits(rays.size());
    const std::vector<std::uint64_t> values = heat_values(
        counts_by_ray(built, {rays, hits, Query::closest, options.threads}), HeatOf::nodes);
    return heat_map(values, width, height, heat_scale_of(values), "building, kd-sah",
                    HeatOf::nodes);
}

}  // namespace space::ch12
