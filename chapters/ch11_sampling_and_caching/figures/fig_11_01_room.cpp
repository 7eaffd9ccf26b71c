/// @file
/// The book's room by daylight and lamplight, over the fastest exact tree of the book.
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch11_sampling_and_caching/figures.hpp"
#include "chapters/ch11_sampling_and_caching/film.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/progressive.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "common/geometry.hpp"
#include "common/program/image.hpp"
#include "common/program/options.hpp"
#include "common/program/progress.hpp"

#include <cstddef>
#include <cstdint>

namespace space::ch11 {

/// The picture of ./book render --scene room:32 --samples 128 --exposure 1.15.
Image fig_11_01(const Options& options) {
    constexpr std::uint32_t samples = 128;
    const LitScene lit = make_lit_scene("room:32");
    const LightTable lights(lit);
    const FastBvh<> tree = FastBvh<>::build(lit.triangles);
    const Sampler numbers(SamplePattern::sobol, samples, options.seed);
    Film film(640, 480);
    Progress progress("fig_11_01", samples * std::size_t(film.height));
    const auto paths = [&] {
        return [&](const Ray& ray, Sampler& sampler) {
            return path_radiance(tree, lit, lights, ray, sampler);
        };
    };
    while (film.samples < samples)
        add_pass(film, lit.scene.camera, numbers, options.threads, paths, &progress);
    return film.image(1.15);
}

}  // namespace space::ch11
