// A thin wall between a lit and a dark room, by caches without and with neighbour clamping.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"

namespace space::ch11 {

Image fig_11_17(const Options& options) {
    const LitPicture wall("wall", 320, 246, options.threads);
    const auto picture = [&](bool clamping) {
        const IrradianceCache cache =
            wall.cache({.accuracy = 0.4, .neighbour_clamping = clamping, .coarsest = 32});
        return wall.cached(4, cache).image();
    };
    return side_by_side({picture(false), picture(true)});
}

}  // namespace space::ch11
