#include "chapters/ch03_bsp_trees/bsp_builder.hpp"
#include "chapters/ch03_bsp_trees/figures.hpp"
#include "chapters/ch03_bsp_trees/painter.hpp"
#include "common/pcg32.hpp"
#include "common/program/image.hpp"

#include <algorithm>
#include <vector>

namespace space::ch03 {
namespace {

/// Tells neighbouring fragments apart: a little lighter or darker.
float tint(std::size_t fragment) {
    return 0.82f + 0.18f * Pcg32(fragment).uniform();
}

}  // namespace

Image fig_03_01(const Options& options) {
    constexpr int width = 400, height = 400,
                  samples = 3;  // of each stage; rays for a pixel, both ways
    Scene scene = make_scene("room:3", options.seed);
    scene.background = Color(1.0f);  // what is not yet painted
    const BspTree<3> tree = BspBuilder<3>::build(scene.mesh.triangles());
    const FragmentRays covers(tree, Grade::exact);

    Image fine(samples * width, samples * height);
    std::fill_n(&fine.at(0, 0), fine.width() * fine.height(), scene.background);
    const PixelGrid grid(scene.camera, fine.width(), fine.height());
    std::vector<Image> stages;
    std::size_t painted = 0;
    tree.back_to_front(scene.camera.eye, [&](const Fragment<3>& fragment) {
        const auto number = static_cast<std::size_t>(&fragment - tree.fragments.data());
        for_pixels_of(
            fragment, tree, covers, grid, [&](int x, int y, const Ray& ray, const Hit& hit) {
                fine.at(x, y) =
                    tint(number) * shade(scene, ray, hit, [](const Ray&) { return true; });
            });
        ++painted;
        if (painted * 3 / tree.fragments.size() == stages.size()) return;
        Image& stage = stages.emplace_back(width, height);
        for (int y = 0; y < fine.height(); ++y)
            for (int x = 0; x < fine.width(); ++x)
                stage.at(x / samples, y / samples) +=
                    fine.at(x, y) / static_cast<float>(samples * samples);
    });
    return side_by_side(stages);
}

}  // namespace space::ch03
