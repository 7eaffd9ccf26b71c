#include "chapters/ch12_comparison/render.hpp"

#include "chapters/ch11_sampling_and_caching/film.hpp"
#include "chapters/ch11_sampling_and_caching/irradiance_cache.hpp"
#include "chapters/ch11_sampling_and_caching/light_sampling.hpp"
#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch11_sampling_and_caching/path_tracer.hpp"
#include "chapters/ch11_sampling_and_caching/photon_radiance.hpp"
#include "chapters/ch11_sampling_and_caching/progressive.hpp"
#include "chapters/ch11_sampling_and_caching/radiance_cache.hpp"
#include "chapters/ch11_sampling_and_caching/sampler.hpp"
#include "chapters/ch12_comparison/erased_accelerator.hpp"
#include "chapters/ch12_comparison/lab.hpp"
#include "chapters/ch12_comparison/render_options.hpp"
#include "common/camera.hpp"
#include "common/measure.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/image.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space {
namespace {

constexpr double seconds_between_saves = 60.0;

volatile std::sig_atomic_t end_signal = 0;

/// Asks for an end after the pass; the next signal, also the other one, ends the program at once.
void on_signal(int signal) {
    end_signal = signal;
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

const Structure& find_structure(std::span<const Structure> structures, const std::string& name) {
    const auto found = std::ranges::find(structures, name, &Structure::name);
    if (found == structures.end())
        throw usage_error(
            fmt::format("--structure {}: no such structure (see --structure list)", name));
    return *found;
}

LitScene load(const RenderOptions& options) {
    // A mesh as a path, whatever scene has that name.
    const std::string spec = options.mesh.empty()         ? options.common.scene
                             : options.mesh.is_absolute() ? options.mesh.string()
                                                          : ("." / options.mesh).string();
    return make_lit_scene(spec, options.common.seed, false, options.camera);
}

/// A number that other triangles, colours, lights or another camera would change.
std::uint64_t hash_of(const LitScene& lit) {
    std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a (Fowler, Noll & Vo)
    const auto add = [&]<class T>(std::span<const T> values) {
        for (const std::byte byte : std::as_bytes(values))
            hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3u;
    };
    const Camera& camera = lit.scene.camera;
    add(std::span<const Triangle>(lit.triangles));
    add(std::span<const Color>(lit.scene.colors));
    add(std::span<const Color>(lit.emission));
    add(std::span<const std::uint8_t>(lit.mirror));
    const std::array points{camera.eye, camera.target, camera.up, lit.scene.background};
    add(std::span<const Point3>(points));
    add(std::span<const float>(&camera.field_of_view, 1));
    return hash;
}

/// What decides about the bytes of a picture, but for the number of samples.
std::string key_of(const RenderOptions& options, const LitScene& lit) {
    const Options& common = options.common;
    std::string key =
        fmt::format("scene={}#{:016x} size={}x{} method={} seed={}", lit.scene.name, hash_of(lit),
                    common.width, common.height, render_method_name(options.method), common.seed);
    if (options.method == RenderMethod::photons) key += fmt::format(" photons={}", options.photons);
    if (options.method == RenderMethod::cache) key += fmt::format(" accuracy={}", options.accuracy);
    return key;
}

/// @throws Error (bad_input) as load_film_state, and where there is none
Film kept_film(const RenderOptions& options, const std::string& key) {
    if (!std::filesystem::exists(options.state()))
        throw input_error(options.state().string() + ": not there: begin without --resume");
    return load_film_state(options.state(), key, options.common.width, options.common.height);
}

/// What add_pass asks for each row.
using Estimator = std::function<Double3(const Ray&, Sampler&)>;
using RowEstimator = std::function<Estimator()>;

RowEstimator path_estimator(const ErasedAccelerator& accelerator, const LitScene& lit,
                            const LightTable& lights) {
    return [&] {
        return [&](const Ray& ray, Sampler& sampler) {
            return path_radiance(accelerator, lit, lights, ray, sampler);
        };
    };
}

/// A caustic has edges: fewer photons blur them less. Other light has none. The largest discs are
/// for maps that hold few photons: without a bound they would tell of no light at all.
PhotonLookupConfig photon_lookup(const LitScene& lit) {
    const auto diagonal = static_cast<float>(diagonal_of(lit));
    return {.caustic = {.k = 30, .largest_radius = 0.02f * diagonal},
            .indirect = {.k = 100, .largest_radius = 0.25f * diagonal}};
}

/// Both maps from as many photons; each row has the memory of its searches.
RowEstimator photon_estimator(const RenderOptions& options, const ErasedAccelerator& accelerator,
                              const LitScene& lit, const LightTable& lights) {
    const auto count = static_cast<std::uint32_t>(options.photons);
    const auto maps = std::make_shared<const PhotonMaps>(PhotonMaps::build(
        accelerator, lit, lights,
        {.count = count, .seed = options.common.seed, .threads = options.common.threads}, count));
    return [&, maps, asked = photon_lookup(lit)] {
        return [&, lookup = std::make_shared<PhotonLookup>(*maps, asked)](const Ray& ray,
                                                                          Sampler& sampler) {
            return photon_radiance(accelerator, lit, lights, *lookup, ray, sampler);
        };
    };
}

/// Tells how far the filling of a cache is.
struct FillProgress {
    Progress progress;
    void observe(const CacheRound&) { progress.step(); }
};

RowEstimator cache_estimator(const RenderOptions& options, const ErasedAccelerator& accelerator,
                             const LitScene& lit, const LightTable& lights) {
    const RadianceCacheConfig config{.accuracy = options.accuracy, .seed = options.common.seed};
    FillProgress told{{"fill", coarse_to_fine(config.coarsest).size()}};
    const auto cache = std::make_shared<const IrradianceCache>(
        fill_cache(accelerator, lit, lights,
                   PixelGrid(lit.scene.camera, options.common.width, options.common.height), config,
                   options.common.threads, told));
    return [&, cache] {
        return [&, cache](const Ray& ray, Sampler& sampler) {
            return cache_radiance(accelerator, lit, lights, *cache, ray, sampler);
        };
    };
}

/// The method, made ready.
RowEstimator estimator(const RenderOptions& options, const ErasedAccelerator& accelerator,
                       const LitScene& lit, const LightTable& lights) {
    switch (options.method) {
        case RenderMethod::path:
            return path_estimator(accelerator, lit, lights);
        case RenderMethod::photons:
            return photon_estimator(options, accelerator, lit, lights);
        case RenderMethod::cache:
            return cache_estimator(options, accelerator, lit, lights);
    }
    return {};
}

void write_all(const RenderOptions& options, const Film& film, const std::string& key) {
    write_file(options.state(), film_state(film, key));
    if (!options.hdr.empty()) write_hdr(options.hdr, film.image());
    write_png(options.out, film.image(options.exposure));
}

/// Passes until the film has its samples, time is up or a signal came; writes after the last one
/// and now and then before.
void render(Film& film, const RenderOptions& options, const LitScene& lit,
            const RowEstimator& row_estimator, const std::string& key, double seconds_used) {
    const Sampler numbers(SamplePattern::sobol, static_cast<std::uint32_t>(options.samples),
                          options.common.seed);
    Progress progress("render",
                      (options.samples - film.samples) * static_cast<std::size_t>(film.height),
                      std::max(options.seconds - seconds_used, 0.0));
    Stopwatch watch;
    double unsaved = 0.0;
    while (film.samples < options.samples && !end_signal) {
        add_pass(film, lit.scene.camera, numbers, options.common.threads, row_estimator, &progress);
        const double pass = watch.lap().count() * 1e-3;
        seconds_used += pass;
        unsaved += pass;
        if (seconds_used + pass > options.seconds) break;  // the next would end too late
        if (unsaved < seconds_between_saves) continue;
        write_all(options, film, key);
        unsaved = 0.0;
    }
}

int report(const RenderOptions& options, const Film& film) {
    if (film.samples == 0) {
        fmt::print(stderr, "render: ended before the first pass: nothing is written\n");
        return 128 + end_signal;
    }
    fmt::print("picture {}: {}\n", options.out.string(),
               counted(film.samples, "sample") + " a pixel");
    if (end_signal == 0 || film.samples >= options.samples) return 0;
    fmt::print(stderr, "render: ended after {} of {} samples: --resume goes on\n", film.samples,
               options.samples);
    return 128 + end_signal;
}

}  // namespace

int run_render(std::span<const Structure> structures, int argc, char** argv) {
    const RenderOptions options = parse_render_options(argc, argv);
    if (options.structure == "list") return list_structures(structures);
    const Structure& structure = find_structure(structures, options.structure);
    check_outputs(options);
    std::signal(SIGINT, on_signal);
    std::signal(SIGTERM, on_signal);
    Stopwatch watch;

    const LitScene lit = load(options);
    print_remarks("render", lit.scene.mesh.remarks);
    const std::string key = key_of(options, lit);
    Film film(options.common.width, options.common.height);
    if (options.resume) film = kept_film(options, key);
    const LightTable lights(lit);
    if (lights.lights().empty())
        throw input_error(lit.scene.name + ": nothing shines: its light has no area in floats");
    fmt::print("scene   {}: {}, {} of them shine\n", lit.scene.name,
               counted(lit.triangles.size(), "triangle"), with_commas(lights.lights().size()));
    const ErasedAccelerator accelerator(
        structure.variants.front().build({lit.triangles}, {.threads = options.build_threads}));
    fmt::print("method  {} over {}\n", render_method_name(options.method), structure.name);
    std::fflush(stdout);
    if (film.samples < options.samples && !end_signal) {
        const RowEstimator row_estimator = estimator(options, accelerator, lit, lights);
        render(film, options, lit, row_estimator, key, watch.lap().count() * 1e-3);
    }
    if (film.samples > 0) write_all(options, film, key);
    return report(options, film);
}

}  // namespace space
