// An interior by a cache of few records, with and without gradients, and by one of many; what the
// first two are off from the third, and paths.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"

namespace space::ch11 {

Image fig_11_16(const Options& options) {
    const LitPicture interior("interior", 212, 160, options.threads);
    const auto by_cache = [&](double accuracy, bool gradients) {
        return interior.cached(32, interior.cache({.accuracy = accuracy, .gradients = gradients}));
    };
    const Film constant = by_cache(0.5, false), linear = by_cache(0.5, true),
               many = by_cache(0.15, true);
    const auto errors = [&](const Film& film) { return error_picture(film, many, 0.25); };
    return one_below_the_other(
        {side_by_side({constant.image(), linear.image(), many.image()}),
         side_by_side({errors(constant), errors(linear), interior.paths(32).image()})});
}

}  // namespace space::ch11
