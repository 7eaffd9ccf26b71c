#include "chapters/ch01_naive_ray_tracing/figures.hpp"
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch01_naive_ray_tracing/ray_tracing.hpp"
#include "common/program/progress.hpp"

namespace space::ch01 {

Image fig_01_01(const Options& options) {
    const Scene scene = make_scene("room");
    const RenderSettings settings{
        .width = 640, .height = 480, .samples = 2, .threads = options.threads};
    Progress progress("the room", static_cast<std::size_t>(settings.height));
    return render<NoCounts>(scene, Naive<>::build(scene.mesh.triangles()), settings, &progress)
        .image;
}

}  // namespace space::ch01
