/// @file
/// What the figures' pictures have in common: a lit scene with its tree, rendered by each of the
/// chapter's methods.
#pragma once

#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch11_sampling_and_caching/film.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance_cache.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/photon_radiance.hpp"
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"
#include "common/program/image.hpp"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace space::ch11 {

/// A scene that is ready for its pictures, all of one size.
struct LitPicture {
    LitScene lit;
    FastBvh<> tree;
    LightTable lights;
    int width, height;
    unsigned threads;

    LitPicture(std::string_view scene, int w, int h, unsigned with_threads);

    PixelGrid pixels() const { return PixelGrid(lit.scene.camera, width, height); }
    Film paths(std::uint32_t samples, Lighting lighting = Lighting::mis_solid_angle) const;
    Film photons(std::uint32_t samples, const PhotonMaps& maps,
                 const PhotonLookupConfig& config) const;
    IrradianceCache cache(const RadianceCacheConfig& config) const;
    Film cached(std::uint32_t samples, const IrradianceCache& cache) const;

    /// Where a point stands in the picture, in pixels; nothing where it is hidden, or outside.
    std::optional<Double2> seen_at(const Double3& point) const;
};

/// The difference of a pixel's light from the reference's, as a part of the reference's mean, with
/// colours from 0 to `most`.
Image error_picture(const Film& film, const Film& reference, double most);

/// Pictures of the same width, one below the other.
Image one_below_the_other(const std::vector<Image>& images, int gap = 8);

/// A square of 2 `reach` + 1 pixels in this colour; what lies outside is left out.
void dot(Image& image, const Double2& at, int reach, const Color& color);

}  // namespace space::ch11
