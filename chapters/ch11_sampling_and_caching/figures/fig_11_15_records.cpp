// The records of a radiance cache, over the picture that they make.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"
#include "common/scenes/shapes.hpp"

namespace space::ch11 {

Image fig_11_15(const Options& options) {
    const LitPicture interior("interior", 360, 276, options.threads);
    const IrradianceCache cache = interior.cache({.accuracy = 0.4});
    const Film film = interior.cached(4, cache);
    Image dotted = film.image(0.4);
    for (const IrradianceRecord& record : cache.records())
        if (const auto at = interior.seen_at(record.position + 1e-3 * record.normal))
            dot(dotted, *at, 1, srgb(0xE69F00u));
    return side_by_side({film.image(), dotted});
}

}  // namespace space::ch11
