/// Chapter 11: where rays should go, and what need not be traced twice.
///     ch11_sampling_and_caching --out pictures
///     ch11_sampling_and_caching --figure fig_11_01 --out figures
#include "chapters/ch10_fast_traversal/fast_bvh.hpp"
#include "chapters/ch11_sampling_and_caching/film.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/measured/convergence.hpp"
#include "chapters/ch11_sampling_and_caching/measured/density.hpp"
#include "chapters/ch11_sampling_and_caching/measured/sampling.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/photon_radiance.hpp"
#include "chapters/ch11_sampling_and_caching/progressive.hpp"
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"
#include "common/measure.hpp"
#include "common/program/chapter.hpp"
#include "common/program/error.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"
#include "common/program/provenance.hpp"
#include "common/program/report.hpp"
#include "common/program/results.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace space::ch11 {
namespace {

Options read_options(int argc, char** argv) {
    return parse_options(argc, argv,
                         {.name = this_chapter.name,
                          .about = "Chapter 11: sampling and caching",
                          .defaults = {.scene = "box"}});
}

/// The mean luminance of a picture of 16 samples a pixel by what `row_estimator` gives.
template <class RowEstimator>
double mean_light(const Camera& camera, const Options& options, const RowEstimator& row_estimator) {
    Film film = options.small ? Film(16, 12) : Film(96, 72);
    const Sampler numbers(SamplePattern::sobol, 16, options.seed);
    for (int pass = 0; pass < 16; ++pass)
        add_pass(film, camera, numbers, options.threads, row_estimator);
    Double3 sum{0.0};
    for (const Double3& pixel : film.sums) sum += pixel;
    return luminance(sum) / (16.0 * double(film.sums.size()));
}

/// The same picture by paths, by photons and by cached irradiance.
void light_one_scene(const Options& options) {
    const LitScene lit = make_lit_scene(options.scene, options.seed, options.small);
    const Camera& camera = lit.scene.camera;
    const LightTable lights(lit);
    const auto tree = FastBvh<>::build(lit.triangles);
    Table table({"method", "kept", "mean light"});

    table.row({"paths", "nothing",
               fixed(mean_light(camera, options,
                                [&] {
                                    return [&](const Ray& ray, Sampler& sampler) {
                                        return path_radiance(tree, lit, lights, ray, sampler);
                                    };
                                }),
                     3)});

    const std::uint32_t count = options.small ? 2'000 : 100'000;
    const auto maps = PhotonMaps::build(
        tree, lit, lights, {.count = count, .seed = options.seed, .threads = options.threads},
        count);
    const std::size_t kept = maps.caustic.photons.size() + maps.indirect.photons.size();
    table.row({"photons", counted(kept, "photon"),
               fixed(mean_light(camera, options,
                                [&] {
                                    return [&, lookup = PhotonLookup(maps)](
                                               const Ray& ray, Sampler& sampler) mutable {
                                        return photon_radiance(tree, lit, lights, lookup, ray,
                                                               sampler);
                                    };
                                }),
                     3)});

    RadianceCacheConfig config{.seed = options.seed};
    if (options.small) config.grid = {6, 18};
    const PixelGrid pixels(camera, options.small ? 16 : 96, options.small ? 12 : 72);
    const IrradianceCache cache = fill_cache(tree, lit, lights, pixels, config, options.threads);
    table.row({"radiance cache", counted(cache.records().size(), "record"),
               fixed(mean_light(camera, options,
                                [&] {
                                    return [&](const Ray& ray, Sampler& sampler) {
                                        return cache_radiance(tree, lit, lights, cache, ray,
                                                              sampler);
                                    };
                                }),
                     3)});
    print_heading(fmt::format("{}: {} triangles, {} of them lights", options.scene,
                              with_commas(lit.triangles.size()), lit.lights.size()));
    table.print();
}

int run(int argc, char** argv) {
    const Options options = read_options(argc, argv);
    if (options.figure) return write_figures(this_chapter.figures, options);
    check_results_writable(options);
    const bool times = !options.small && !options.counts;

    if (!options.counts) light_one_scene(options);
    const SamplingMeasurements& sampling = measured_once<measure_sampling>(options);
    print_sampling(sampling, times);
    const DensityMeasurements density = measure_density(options);
    print_density(density);
    const std::uint64_t wrong = wrong_sampling(sampling, times) + wrong_density(density);

    Numbers numbers;
    quote_sampling(sampling, times, numbers);
    quote_density(density, numbers);
    const std::vector<Convergence>& convergence = measured_once<measure_convergence>(options);
    if (times) {
        print_convergence(convergence);
        quote_convergence(convergence, numbers);
    }
    numbers.write(options.out, provenance(std::string(this_chapter.name), options));
    if (options.counts) return exit_code(wrong);
    fmt::print("\n{} wrong answers.\n", wrong);
    std::vector<ClaimAnswer> answers = answer_sampling(sampling);
    for (ClaimAnswer& answer : answer_convergence(convergence))
        answers.push_back(std::move(answer));
    return finish(options, answers, wrong);
}

}  // namespace
}  // namespace space::ch11

int main(int argc, char** argv) {
    return space::run_program(space::this_chapter.name, space::ch11::run, argc, argv);
}
