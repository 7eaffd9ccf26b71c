#include "chapters/ch12_comparison/render_options.hpp"

#include "chapters/ch11_sampling_and_caching/lit_scene.hpp"
#include "chapters/ch12_comparison/camera_option.hpp"
#include "chapters/ch12_comparison/output_check.hpp"
#include "chapters/ch12_comparison/rays.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>
#include <thread>
#include <vector>

namespace space {
namespace {

constexpr std::size_t max_samples = 1'000'000, max_photons = 100'000'000;

constexpr const char* notes = R"(
Methods (chapter 11)
  path     path tracing: no error but noise, which falls as one over the root of the samples.
  photons  light that has met a mirror or another surface is looked up among --photons N: a caustic
           without noise, and a bias that falls as N grows.
  cache    light from other surfaces is computed at few points and interpolated between them; less
           --accuracy, more points. For interiors without mirrors' caustics.
Scenes: see --scene list. A mesh, and the book's other scenes, stand in a closed studio under a
square light; it holds the eye of --camera, too. Every structure with an exact test gives the same
picture, byte for byte.
Files
  --out    the picture, sRGB of --exposure E times the light. Beside it FILE.state holds all that
           has been summed up.
  --hdr    the light itself, without --exposure, in Radiance's format.
A picture is made in passes of one sample a pixel. After --time S, or after Ctrl-C (SIGINT) or
SIGTERM, it ends with the pass in hand and writes whole files; a second Ctrl-C ends it at once.
--resume goes on from FILE.state, to --samples N in all, as if there had been no break: the same
bytes. It refuses the state of another scene, camera, size, method or seed.
Exit codes: 0, 2 usage, 3 bad input, 4 cannot write, 130 or 143 ended by SIGINT or SIGTERM.)";

/// A decimal number in [low, high] into `value`, whose default --help shows.
void add_number(CLI::App& app, const std::string& name, double low, double high, double& value,
                const std::string& unit, const std::string& about) {
    const auto parse = [=, &value](const std::string& text) {
        double number = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc() || end != text.data() + text.size() ||
            !(low <= number && number <= high))
            throw usage_error(
                fmt::format("{} {}: give a number from {} to {}", name, text, low, high));
        value = number;
    };
    auto* option = app.add_option_function<std::string>(name, parse, about)->type_name(unit);
    if (value <= high) option->default_str(fmt::format("{}", value));
}

void add_file_options(CLI::App& app, RenderOptions& options) {
    const auto named = [](std::string_view ending) {
        return [ending](const std::string& text) { return name_fault(text, ending); };
    };
    auto* mesh = app.add_option("--mesh", options.mesh, "a mesh file: OBJ, PLY, STL or OFF")
                     ->type_name("FILE")
                     ->check(named(""));
    app.add_option("--scene", options.common.scene, "a scene by name, or 'list'")
        ->type_name("NAME[:SIZE]")
        ->excludes(mesh);
    add_camera_option(app, options.camera);
    app.add_option("--out", options.out, "the picture")
        ->type_name("FILE.png")
        ->check(named(".png"));
    app.add_option("--hdr", options.hdr, "the light, unclipped")
        ->type_name("FILE.hdr")
        ->check(named(".hdr"));
    app.add_flag("--resume", options.resume, "go on where --out FILE.png was left");
}

/// @throws Error (usage) where something is missing, or absurd together
void check_together(const RenderOptions& options) {
    if (options.mesh.empty() && options.common.scene.empty())
        throw usage_error("give --scene NAME or --mesh FILE");
    if (options.out.empty()) throw usage_error("give --out FILE.png");
    const Options& common = options.common;
    if (static_cast<std::size_t>(common.width) * static_cast<std::size_t>(common.height) > max_rays)
        throw usage_error(fmt::format("--size {}x{}: more than {} pixels", common.width,
                                      common.height, max_rays));
}

/// --scene list prints the scenes and exits 0.
void list_lit_scenes_if_asked(const Options& options) {
    if (options.scene != "list") return;
    Table table({"lit scene", "what it is"});
    for (const LitSceneRecipe& recipe : lit_scene_recipes())
        table.row({std::string(recipe.name), std::string(recipe.about)});
    table.print();
    fmt::print("\nIn a studio:\n");
    list_scenes_if_asked(options);
}

}  // namespace

const char* render_method_name(RenderMethod method) {
    constexpr const char* names[] = {"path", "photons", "cache"};
    return names[static_cast<int>(method)];
}

RenderOptions parse_render_options(int argc, char** argv) {
    RenderOptions options;
    std::string method = "path";
    CLI::App app("Pictures by chapter 11's methods over any structure of the book.", "render");
    app.footer(notes);
    add_file_options(app, options);
    add_choice(app, "--method", {"path", "photons", "cache"}, method, "how light is found");
    add_whole_number(app, "--samples", 1, max_samples, options.samples, "a pixel");
    add_number(app, "--time", 0.0, 1e9, options.seconds, "SECONDS",
               "end earlier, with fewer samples; at least one");
    add_whole_number(app, "--photons", 1, max_photons, options.photons, "for --method photons");
    add_number(app, "--accuracy", 0.01, 1.0, options.accuracy, "A", "for --method cache");
    add_number(app, "--exposure", 1e-6, 1e6, options.exposure, "E", "of the picture");
    app.add_option("--structure", options.structure, "NAME or 'list'")->capture_default_str();
    add_common_options(app, options.common);
    add_whole_number(
        app, "--build-threads", 1, max_threads,
        [&](std::uint64_t n) { options.build_threads = static_cast<unsigned>(n); },
        "for builders that use several; default: as --threads");
    parse_command_line(app, argc, argv);
    list_lit_scenes_if_asked(options.common);
    if (options.structure == "list") return options;
    check_together(options);
    options.method = method == "path"      ? RenderMethod::path
                     : method == "photons" ? RenderMethod::photons
                                           : RenderMethod::cache;
    if (options.common.threads == 0)
        options.common.threads = std::max(1u, std::thread::hardware_concurrency());
    if (options.build_threads == 0) options.build_threads = options.common.threads;
    return options;
}

void check_outputs(const RenderOptions& options) {
    const std::vector<std::filesystem::path> inputs{options.mesh, scene_file(options.common.scene)};
    check_inputs_unprinted(inputs);
    check_output("--out", options.out, inputs);
    check_output("--out", options.state(), inputs);
    if (options.hdr.empty()) return;
    check_output("--hdr", options.hdr, inputs);
    if (is_same_file(options.hdr, options.out))
        throw usage_error(
            fmt::format("--out and --hdr are the same file, {}", options.out.string()));
}

}  // namespace space
