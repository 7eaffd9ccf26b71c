#include "chapters/ch12_comparison/machine_probe.hpp"

#include "chapters/ch09_instancing_and_motion/refitted_bvh.hpp"
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/measure.hpp"
#include "common/scene.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace space {

MachineProbe probe_machine(unsigned threads) {
    constexpr int turns = 4;
    const Scene scene = make_scene("lattice:6");
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const std::vector<Ray> rays = camera_rays({scene.camera, 192, 144});
    std::vector<HitRecord> hits(rays.size());
    auto refitted = RefittedBvh<>::build(triangles);
    double build = std::numeric_limits<double>::infinity(), trace_all = build, refit = build;
    for (int turn = 0; turn < turns; ++turn) {
        Stopwatch stopwatch;
        const auto tree = FastBvh<>::build(triangles);
        build = std::min(build, stopwatch.lap().count());
        trace<NoCounts>(tree, {.rays = rays, .hits = hits, .threads = threads});
        trace_all = std::min(trace_all, stopwatch.lap().count());
        refitted.refit(triangles);
        refit = std::min(refit, stopwatch.lap().count());
    }
    const auto ns_each = [](double milliseconds, std::size_t count) {
        return 1e6 * milliseconds / static_cast<double>(count);
    };
    return {{ns_each(build, triangles.size()), ns_each(trace_all, rays.size())},
            ns_each(refit, triangles.size())};
}

}  // namespace space
