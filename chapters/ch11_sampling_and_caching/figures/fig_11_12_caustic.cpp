// A caustic by paths and by photons, in about the same time.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"

namespace space::ch11 {

Image fig_11_12(const Options& options) {
    const LitPicture ring("ring", 360, 276, options.threads);
    const PhotonMaps maps = PhotonMaps::build(
        ring.tree, ring.lit, ring.lights, {.count = 50'000, .threads = options.threads}, 400'000);
    const PhotonLookupConfig lookup{.caustic = {.k = 100, .largest_radius = 0.05f},
                                    .indirect = {.k = 100}};
    return side_by_side({ring.paths(32).image(), ring.photons(2, maps, lookup).image()});
}

}  // namespace space::ch11
