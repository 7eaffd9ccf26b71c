// An interior by a cache of few records, with and without gradients, and by paths; errors below.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"

namespace space::ch11 {

Image fig_11_16(const Options& options) {
    const LitPicture interior("interior", 280, 210, options.threads);
    const auto by_cache = [&](bool gradients) {
        return interior.cached(
            32, interior.cache({.accuracy = 0.5, .gradients = gradients, .coarsest = 16}));
    };
    const Film constant = by_cache(false), linear = by_cache(true),
               reference = interior.paths(1024);
    const auto errors = [&](const Film& film) { return error_picture(film, reference, 0.25); };
    return one_below_the_other(
        {side_by_side({constant.image(), linear.image(), reference.image()}),
         side_by_side({errors(constant), errors(linear), errors(reference)})});
}

}  // namespace space::ch11
