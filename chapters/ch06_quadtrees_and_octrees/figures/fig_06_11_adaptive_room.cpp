// Chapter 1's room by adaptive sampling: the picture, its cells, and what is wrong with it.

#include "chapters/ch06_quadtrees_and_octrees/figures.hpp"
#include "chapters/ch06_quadtrees_and_octrees/figures/sampling_panels.hpp"
#include "chapters/ch06_quadtrees_and_octrees/measured/sampled_scene.hpp"

namespace space::ch06 {

Image fig_06_11(const Options& options) {
    constexpr int width = 400, height = 300;
    const SampledScene scene(make_scene("room"), width, height);
    const auto sampled = [&](AdaptiveConfig::Evidence evidence) {
        return scene.by_objects({.evidence = evidence, .threads = options.threads});
    };
    const Image full = scene.full();
    const AdaptivePicture by_corners = sampled(AdaptiveConfig::Evidence::corners);
    const AdaptivePicture by_all = sampled(AdaptiveConfig::Evidence::all_samples);
    constexpr int threshold = AdaptiveConfig{}.threshold;
    return four(by_all.image, cells_of(by_all), errors_of(by_corners.image, full, threshold),
                errors_of(by_all.image, full, threshold));
}

}  // namespace space::ch06
