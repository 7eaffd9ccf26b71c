// One room by each way of looking for light, with the same number of samples.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"

namespace space::ch11 {

Image fig_11_10(const Options& options) {
    const LitPicture box("box", 212, 160, options.threads);
    const auto picture = [&](Lighting lighting) { return box.paths(8, lighting).image(); };
    return one_below_the_other(
        {side_by_side(
             {picture(Lighting::uniform), picture(Lighting::cosine), picture(Lighting::area)}),
         side_by_side({picture(Lighting::solid_angle), picture(Lighting::mis_area),
                       picture(Lighting::mis_solid_angle)})});
}

}  // namespace space::ch11
