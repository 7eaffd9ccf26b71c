// Where photons arrived, drawn over pictures without their light.

#include "chapters/ch11_sampling_and_caching/aimed_photons.hpp"
#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"

#include <algorithm>
#include <span>

namespace space::ch11 {
namespace {

/// The picture, darker, with a dot in its colour for each photon that is seen.
Image with_photons(const LitPicture& picture, const Film& film, std::span<const Photon> photons) {
    Image image = film.image(0.25);
    for (const Photon& photon : photons)
        if (const auto at =
                picture.seen_at(Double3(photon.position) + 1e-3 * Double3(photon.normal)))
            dot(image, *at, 0,
                Color(photon.power / std::max({photon.power.r, photon.power.g, photon.power.b})));
    return image;
}

}  // namespace

Image fig_11_11(const Options& options) {
    const LitPicture ring("ring", 360, 276, options.threads), box("box", 360, 276, options.threads);
    const PhotonConfig few{.count = 20'000, .threads = options.threads};
    const PhotonTrace caustic = trace_aimed_photons(ring.tree, ring.lit, ring.lights, few);
    const PhotonTrace all = trace_photons(box.tree, box.lit, box.lights, few);
    return side_by_side({with_photons(ring, ring.paths(8), caustic.photons),
                         with_photons(box, box.paths(8), all.photons)});
}

}  // namespace space::ch11
