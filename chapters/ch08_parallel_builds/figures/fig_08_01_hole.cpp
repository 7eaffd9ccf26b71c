// The same scene by a sound tree, and by one whose two threads shared a scratch.

#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch08_parallel_builds/figures.hpp"
#include "chapters/ch08_parallel_builds/played_turns.hpp"
#include "chapters/ch08_parallel_builds/shared_scratch_builder.hpp"
#include "common/scene.hpp"

#include <vector>

namespace space::ch08 {

Image fig_08_01(const Options& options) {
    const Scene scene = make_scene("room:3", 1);
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const auto picture = [&](bool is_shared) {
        const auto bvh = Bvh<SharedScratchBuilder<>>::build(triangles, {.is_shared = is_shared},
                                                            PlayedTurns(15, 200));
        return render(scene, bvh,
                      {.width = 440, .height = 330, .samples = 2, .threads = options.threads})
            .image;
    };
    return side_by_side({picture(false), picture(true)});
}

}  // namespace space::ch08
