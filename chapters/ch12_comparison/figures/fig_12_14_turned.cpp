// What stands beside the picture that can be turned: its first state.

#include "chapters/ch07_bounding_volume_hierarchies/binned_builder.hpp"
#include "chapters/ch07_bounding_volume_hierarchies/bvh.hpp"
#include "chapters/ch12_comparison/figures.hpp"
#include "chapters/ch12_comparison/figures/turned_mesh.hpp"

namespace space::ch12 {

Svg fig_12_14(const Options&) {
    Scene scene = turned_mesh(TurnedMesh::teapot);
    turn(scene, first_turn, first_tilt);
    const auto bvh = Bvh<BinnedBuilder>::build(scene.mesh.triangles());
    Svg svg = turned_drawing(Shown::nodes);
    TracedPicture picture{.image = {320, 240}};
    for (int y = 0; y < 240; ++y) trace_row(scene, bvh, Shown::nodes, y, picture);
    svg.picture(turned_corner, turned_size, picture.image, "picture");
    return svg;
}

}  // namespace space::ch12
