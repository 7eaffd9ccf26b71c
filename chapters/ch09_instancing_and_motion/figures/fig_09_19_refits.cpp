// Three trees around walkers who have crossed a square.

#include "chapters/ch09_instancing_and_motion/figures.hpp"
#include "chapters/ch09_instancing_and_motion/figures/drawn_refits.hpp"
#include "chapters/ch09_instancing_and_motion/figures/drawn_rotations.hpp"

namespace space::ch09 {

Svg fig_09_19(const Options&) {
    const std::vector<Segment> rest = walkers_at_rest(), moved = drifted(rest, walkers_ways);
    const Ray2 ray{.origin = Point2(refits_from),
                   .direction = Point2(refits_through) - Point2(refits_from)};
    return drawn_refits(rest, moved, ray, followed_trees(rest, moved, ray));
}

}  // namespace space::ch09
