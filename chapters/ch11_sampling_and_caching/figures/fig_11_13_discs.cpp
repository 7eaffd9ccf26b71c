// The discs of photons that a floor is asked with, at a border, in a corner, and behind a wall.

#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"
#include "chapters/ch11_sampling_and_caching/photon_map.hpp"
#include "chapters/ch11_sampling_and_caching/photon_tracing.hpp"
#include "common/program/svg.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace space::ch11 {
namespace {

constexpr double floor_scale = 308;
/// A point of the floor on the paper, seen from above.
Point2 on_floor(const Double3& p) {
    return at(66 + floor_scale * (p.x + 1.5), 56 + floor_scale * (p.z + 1.0));
}

void draw_disc(Svg& svg, DensityEstimator& estimator, const PhotonMap& map, const Double3& query) {
    const PhotonDisc disc = estimator.disc_around(Point3(query));
    const double radius = std::sqrt(disc.squared_radius);
    svg.circle(on_floor(query), floor_scale * radius,
               {.stroke = Ink::vermillion, .fill = Ink::orange, .opacity = 0.25});
    for (const Neighbour& near : disc.photons) {
        const Photon& photon = map.photons[near.index];
        const bool counts =
            DensityEstimator::is_on_surface(photon, query, {0.0, 1.0, 0.0}, disc.squared_radius);
        svg.circle(on_floor(Double3(photon.position)), 3,
                   {.stroke = {}, .fill = counts ? Ink::vermillion : Ink::purple});
    }
    svg.circle(on_floor(query), 4, {.stroke = {}, .fill = Ink::ink});
}

}  // namespace

Svg fig_11_13(const Options& options) {
    const LitPicture wall("wall", 1, 1, options.threads);
    const PhotonTrace trace = trace_photons(wall.tree, wall.lit, wall.lights,
                                            {.count = 4'000, .threads = options.threads});
    const PhotonMap map = PhotonMap::build(trace.photons);
    Svg svg("Photons on a floor, and the discs in which a point asks for them", 676, 684);
    svg.rect(on_floor({-1.5, 0, -1}), at(floor_scale * 1.5, floor_scale * 1.75),
             {.stroke = Ink::quiet});
    svg.line(on_floor({0, 0, -1}), on_floor({0.42, 0, -1}), {.stroke = Ink::quiet});
    svg.line(on_floor({0, 0, 0.75}), on_floor({0.42, 0, 0.75}), {.stroke = Ink::quiet});
    for (const Photon& photon : map.photons)
        if (photon.position.y < 0.01f && photon.normal.y > 0.5f)
            svg.circle(on_floor(Double3(photon.position)), 2.5,
                       {.stroke = {}, .fill = Ink::blue, .opacity = 0.6});
    svg.rect(on_floor({-0.0078125, 0, -1}), at(floor_scale * 0.015625, floor_scale * 1.75),
             {.stroke = {}, .fill = Ink::ink});
    DensityEstimator estimator(map, {.k = 40});
    for (const Double3& query : {Double3{-0.85, 0, -0.2}, Double3{-0.75, 0, 0.72},
                                 Double3{-1.46, 0, -0.95}, Double3{0.1, 0, -0.15}})
        draw_disc(svg, estimator, map, query);
    svg.text(moved(on_floor({0.24, 0, 0.3}), 0, 0), "dark", {.ink = Ink::quiet, .size = 18});
    svg.text(moved(on_floor({-0.3, 0, 0.62}), 0, 0), "lit",
             {.ink = Ink::quiet, .size = 18, .halo = true});
    return svg;
}

}  // namespace space::ch11
