#include "chapters/ch01_naive_ray_tracing/coverage.hpp"
#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/figures/parallel_view.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

namespace space::ch01 {

Svg fig_01_06(const Options& options) {
    Svg svg(
        "The room by the ray tracer and by the rasteriser; circles mark the pixels that see "
        "another triangle",
        640, 330);
    constexpr int width = 300, height = 225;
    const Scene scene = make_scene("room:1");
    const auto naive = Naive<>::build(scene.mesh.triangles());
    const RenderSettings settings{.width = width, .height = height, .threads = options.threads};
    Progress progress("the room", height);
    const Image traced = render<NoCounts>(scene, naive, settings, &progress).image;
    const PixelGrid grid(scene.camera, width, height);
    const DepthBuffer traced_depth = trace_depth(grid, naive, options.threads);
    const DepthBuffer rasterised_depth = rasterise(scene, width, height);
    const Coverage coverage = compare_coverage(scene, traced_depth, rasterised_depth);

    svg.text({160, 24}, "ray tracer", {.size = 18, .bold = true});
    svg.picture({10, 38}, {width, height}, traced, "ray-tracer");
    svg.text({480, 24}, "rasteriser", {.size = 18, .bold = true});
    svg.picture({330, 38}, {width, height}, render_rasterised(scene, width, height), "rasteriser");
    svg.begin_group("differences");
    grid.for_each([&](int x, int y) {
        const Hit &one = traced_depth.at(x, y), &other = rasterised_depth.at(x, y);
        if (one.t == infinity && other.t == infinity) return;
        if (one.t < infinity && other.t < infinity && one.triangle == other.triangle) return;
        for (const float left : {10.0f, 330.0f})
            svg.circle({left + static_cast<float>(x) + 0.5f, 38.5f + static_cast<float>(y)}, 6,
                       {.stroke = Ink::yellow});
    });
    svg.end_group();
    svg.text({320, 292},
             fmt::format("{} of {} pixels see another triangle:", coverage.disagree,
                         with_commas(coverage.pixels)),
             {});
    svg.text({320, 316},
             fmt::format("all within {} pixels of an edge", shown(coverage_distance(grid), 4)), {});
    return svg;
}

}  // namespace space::ch01
