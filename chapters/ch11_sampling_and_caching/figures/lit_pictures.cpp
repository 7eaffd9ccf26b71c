#include "chapters/ch11_sampling_and_caching/figures/lit_pictures.hpp"

#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/progressive.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/program/heat.hpp"

#include <algorithm>
#include <cmath>

namespace space::ch11 {
namespace {

template <class RowEstimator>
Film film_of(const LitPicture& picture, std::uint32_t samples, const RowEstimator& estimator) {
    Film film(picture.width, picture.height);
    const Sampler numbers(SamplePattern::sobol, samples, 1);
    while (film.samples < samples)
        add_pass(film, picture.lit.scene.camera, numbers, picture.threads, estimator);
    return film;
}

}  // namespace

LitPicture::LitPicture(std::string_view scene, int w, int h, unsigned with_threads)
    : lit(make_lit_scene(scene)),
      tree(FastBvh<>::build(lit.triangles)),
      lights(lit),
      width(w),
      height(h),
      threads(with_threads) {}

Film LitPicture::paths(std::uint32_t samples, Lighting lighting) const {
    return film_of(*this, samples, [&] {
        return [&](const Ray& ray, Sampler& sampler) {
            return path_radiance(tree, lit, lights, ray, sampler, {.lighting = lighting});
        };
    });
}

Film LitPicture::photons(std::uint32_t samples, const PhotonMaps& maps,
                         const PhotonLookupConfig& config) const {
    return film_of(*this, samples, [&] {
        return
            [this, lookup = PhotonLookup(maps, config)](const Ray& ray, Sampler& sampler) mutable {
                return photon_radiance(tree, lit, lights, lookup, ray, sampler);
            };
    });
}

IrradianceCache LitPicture::cache(const RadianceCacheConfig& config) const {
    return fill_cache(tree, lit, lights, pixels(), config, threads);
}

Film LitPicture::cached(std::uint32_t samples, const IrradianceCache& cache) const {
    return film_of(*this, samples, [&] {
        return [&](const Ray& ray, Sampler& sampler) {
            return cache_radiance(tree, lit, lights, cache, ray, sampler);
        };
    });
}

std::optional<Double2> LitPicture::seen_at(const Double3& point) const {
    const CameraFrame frame(lit.scene.camera);
    const Double3 way = point - Double3(lit.scene.camera.eye);
    const double depth = -glm::dot(way, frame.back);
    if (!(depth > 0.0)) return std::nullopt;
    const double scale = 0.5 * height / (frame.tan_half_fov * depth);
    const Double2 place(0.5 * width + scale * glm::dot(way, frame.right),
                        0.5 * height - scale * glm::dot(way, frame.up));
    const bool is_inside = place.x >= 0.0 && place.x < width && place.y >= 0.0 && place.y < height;
    const Ray ray{
        .origin = lit.scene.camera.eye, .direction = Vector3(way), .tmin = 0.0f, .tmax = 0.999f};
    if (!is_inside || any_hit(tree, ray)) return std::nullopt;
    return place;
}

Image error_picture(const Film& film, const Film& reference, double most) {
    double mean = 0.0;
    for (const Double3& sum : reference.sums) mean += luminance(sum);
    mean /= static_cast<double>(reference.sums.size()) * reference.samples;
    Image image(film.width, film.height);
    for (int y = 0; y < film.height; ++y)
        for (int x = 0; x < film.width; ++x)
            image.at(x, y) =
                heat(std::abs(luminance(film.radiance(x, y) - reference.radiance(x, y))) /
                     (mean * most));
    return image;
}

Image one_below_the_other(const std::vector<Image>& images, int gap) {
    int height = -gap;
    for (const Image& image : images) height += image.height() + gap;
    Image all(images.front().width(), height);
    int top = 0;
    for (const Image& image : images) {
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) all.at(x, top + y) = image.at(x, y);
        top += image.height();
        for (int y = 0; y < gap && top + y < height; ++y)
            for (int x = 0; x < all.width(); ++x) all.at(x, top + y) = glm::vec3(1.0f);
        top += gap;
    }
    return all;
}

void dot(Image& image, const Double2& at, int reach, const Color& color) {
    const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
    for (int j = std::max(0, y - reach); j <= std::min(image.height() - 1, y + reach); ++j)
        for (int i = std::max(0, x - reach); i <= std::min(image.width() - 1, x + reach); ++i)
            image.at(i, j) = color;
}

}  // namespace space::ch11
