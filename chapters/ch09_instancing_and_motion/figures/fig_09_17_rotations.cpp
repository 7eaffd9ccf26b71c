// A refit with rotations: seven segments have moved.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/drawn_rotations.hpp"
#include "common/scene.hpp"

namespace space::ch09 {

Svg fig_09_17(const Options&) {
    const std::vector<Segment> rest = heinonen_segments();
    return drawn_rotations(rest, drifted(rest, first_drift));
}

}  // namespace space::ch09
