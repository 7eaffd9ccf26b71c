#include "chapters/ch12_comparison/lab_options.hpp"

#include "chapters/ch09_instancing_and_motion/instance_file.hpp"
#include "chapters/ch12_comparison/camera_option.hpp"
#include "chapters/ch12_comparison/comma_parts.hpp"
#include "chapters/ch12_comparison/lab_report.hpp"
#include "chapters/ch12_comparison/output_check.hpp"
#include "common/program/error.hpp"
#include "common/scene.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace space {
namespace {

constexpr int max_repeat = 10'000;

constexpr const char* formats = R"(
Files
  --mesh   OBJ, OFF, PLY or STL. What its reader passes over is said on standard error: lab: note:
  --instances  JSON: {"meshes": {NAME: MESH, ...}, "groups": {NAME: [INSTANCE, ...], ...},
           "scene": NAME}. A MESH is a file, seen from this one's folder, or a scene of the book
           such as "tree:5"; an INSTANCE is {"object": NAME, "matrix": [[4 numbers], [4], [4]]}, the
           matrix from the object's points to the group's; without it the object stays where it is.
           A group may hold groups, but not itself. Or no file, but one of sphereflake, tetra,
           jacks (each with :LEVELS) and forest (:TREES along a side).
  --rays   records of eight little-endian float32: ox oy oz tmin dx dy dz tmax. A ray is
           origin + t direction with t in [tmin, tmax]; the direction need not have length 1. A ray
           with a NaN, an infinite origin or direction, a direction of zero or tmin > tmax is a
           miss, and the number of such rays is printed. A file that does not hold whole records,
           or none, is an error.
  --hits   one record a ray, little-endian: float32 t u v, uint32 triangle (from 0, in the order of
           the mesh file). t is in units of the direction; the point is (1 - u - v) a + u b + v c.
           A miss is t = infinity, u = v = 0, triangle 0xFFFFFFFF. With --query any a hit has no
           triangle and no place: t = u = v = 0, triangle 0xFFFFFFFE. Needs exactly one structure.
           With --instances the triangle is a uint64, counted depth first, a group's instances in
           their order; a miss has 0xFFFFFFFFFFFFFFFF, and a hit of --query any one less.
  --json   the tables as JSON: version, machine, mesh, query, against, limits, structures; null
           where a figure has no meaning. With '-' or /dev/stdout what is printed otherwise goes to
           standard error.
  --csv    the same figures as a table: a line of names, those of --json, then one line for each
           structure; an empty field where a figure has no meaning. Before them in each line mesh,
           triangles and query, so that tables can be joined. '-' as for --json.
  --heatmap, --picture  a PNG picture: a pixel for each camera ray. They need exactly one structure.
Ratios are times divided by the other structure's times: 2 takes twice as long.
--check compares with naive tracing by the same test, bit for bit; by another test than
filtered-exact a difference counts only where the naive answer is the exact one. Peers (Embree,
CGAL) have tests of their own: their wrong answers are counted, and are no fault.
Exit codes: 0, 1 where --check found a disagreement or a structure gave up, 2 usage, 3 bad input,
4 cannot write.
Nothing is written before all is measured, and a file that cannot be written whole is not there.)";

void add_file_options(CLI::App& app, LabOptions& options) {
    const auto named = [](const std::string& text) { return name_fault(text); };
    auto* mesh = app.add_option("--mesh", options.mesh, "a mesh file: OBJ, PLY, STL or OFF");
    app.add_option("--scene", options.common.scene, "a scene by name, or 'list'")
        ->type_name("NAME[:SIZE]")
        ->excludes(mesh);
    auto* rays = app.add_option("--rays", options.rays,
                                "trace these rays; default: through the camera's pixels");
    auto* hits = app.add_option("--hits", options.hits, "write the answers to this file");
    auto* json = app.add_option("--json", options.json,
                                "write the measurements to this file; '-' is standard output");
    auto* csv = app.add_option("--csv", options.csv,
                               "write the table to this file; '-' is standard output");
    for (CLI::Option* option : {mesh, rays, hits, json, csv})
        option->type_name("FILE")->check(named);
    auto* instances =
        app.add_option("--instances", options.instances,
                       "a scene of instances, for structures that know them: see below")
            ->type_name("FILE|NAME[:SIZE]")
            ->check(named)
            ->excludes(mesh)
            ->excludes(app.get_option("--scene"));
    app.add_flag("--flatten", options.flatten,
                 "and its triangles in one mesh, for all other structures and for --check")
        ->needs(instances);
}

/// Which rays are traced, but for --rays.
void add_ray_options(CLI::App& app, LabOptions& options) {
    auto* camera = add_camera_option(app, options.camera);
    auto* diffuse = add_whole_number(
        app, "--diffuse", 1, max_rays, [&](std::uint64_t n) { options.diffuse = n; },
        "trace N rays that leave the camera rays' hits, cosine-distributed (by --seed)");
    add_common_options(app, options.common);
    app.get_option("--rays")->excludes(camera)->excludes(diffuse)->excludes(
        app.get_option("--size"));
}

/// What shows a pixel for each camera ray.
void add_picture_options(CLI::App& app, LabOptions& options, std::string& heat_of) {
    const auto is_png = [](const std::string& text) { return name_fault(text, ".png"); };
    auto* heatmap = app.add_option("--heatmap", options.heatmap,
                                   "a picture of what each camera ray costs, with its scale");
    auto* picture = app.add_option("--picture", options.picture,
                                   "a shaded picture of the mesh, seen through the structure");
    for (CLI::Option* option : {heatmap, picture})
        option->type_name("FILE.png")
            ->check(is_png)
            ->excludes(app.get_option("--rays"))
            ->excludes(app.get_option("--diffuse"));
    add_choice(app, "--heatmap-of", {"nodes", "tests"}, heat_of,
               "nodes visited or triangles tested");
    app.get_option("--heatmap-of")->needs(heatmap);
    add_whole_number(
        app, "--heatmap-max", 1, 1'000'000'000, [&](std::uint64_t n) { options.heatmap_max = n; },
        "where its colours end, to compare pictures; default: where 99 of 100 pixels do")
        ->needs(heatmap);
}

/// Which structures, and the order of their rows.
void add_structure_options(CLI::App& app, LabOptions& options, std::string& structures) {
    app.add_option("--structure", structures,
                   "NAME[,NAME...]; 'default' (one of each chapter and peer), 'all' or 'list'")
        ->capture_default_str();
    const auto named = [](const std::string& text) {
        return text.empty() ? "give a name" : std::string();
    };
    app.add_option("--triangle-test", options.triangle_test,
                   "NAME or 'list'; default: filtered-exact")
        ->check(named);
    app.add_option("--against", options.against,
                   "NAME: ratios of all times to this structure's, such as embree")
        ->check(named);
    app.add_option("--sort", options.sort,
                   "order the rows by this figure of --json, the best first; default: as measured")
        ->type_name("NAME")
        ->check(CLI::IsMember(sort_columns()));
}

void add_build_options(CLI::App& app, BuildOptions& build) {
    constexpr auto any = std::numeric_limits<std::uint64_t>::max();
    add_whole_number(
        app, "--build-threads", 1, max_threads,
        [&](std::uint64_t n) { build.threads = static_cast<unsigned>(n); },
        "for builders that use several; default: as --threads");
    add_whole_number(
        app, "--max-references", 1, any, [&](std::uint64_t n) { build.limits.references = n; },
        "memory: structures that name triangles several times give up beyond so many names")
        ->default_str(fmt::format("{}", build.limits.references));
    add_whole_number(
        app, "--max-placements", 1, any, [&](std::uint64_t n) { build.limits.placements = n; },
        "time: a BSP builder gives up after it has put triangles or pieces somewhere so many times")
        ->default_str(fmt::format("{}", build.limits.placements));
}

/// @return nothing for what is no number
std::optional<double> double_in(const std::string& text) {
    double number = 0.0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, number);
    if (error != std::errc{} || end != last) return std::nullopt;
    return number;
}

/// A whole number, which may be written as 1e9.
std::string fault_in_rays(const std::string& text) {
    const std::optional<double> rays = double_in(text);
    if (rays && *rays >= 1.0 && *rays <= 1e18 && *rays == std::floor(*rays)) return "";
    return fmt::format("'{}' is no whole number from 1 to 1e18", text);
}

std::string fault_in_memory(const std::string& text) {
    const std::optional<double> megabytes = double_in(text);
    if (megabytes && *megabytes > 0.0 && *megabytes <= 1e12) return "";
    return fmt::format("'{}' is no number of megabytes above 0 and up to 1e12", text);
}

/// What --advise was given, when it has been parsed.
struct AdviceTexts {
    bool advise = false, moving = false;
    std::string rays, memory;
    std::vector<CLI::Option*> of_measuring;  ///< options that have no meaning beside it

    std::optional<AdviceRequest> request() const {
        if (!advise) return std::nullopt;
        for (const CLI::Option* option : of_measuring)
            if (option->count() > 0)
                throw usage_error(
                    fmt::format("--advise measures nothing: leave {} away", option->get_name()));
        if (rays.empty()) throw usage_error("--advise: for how many rays? add --rays-to-trace N");
        AdviceRequest request{.rays = *double_in(rays), .moving = moving};
        if (!memory.empty()) request.memory = 1e6 * *double_in(memory);
        return request;
    }
};

/// To be called last.
std::shared_ptr<AdviceTexts> add_advice_options(CLI::App& app) {
    const auto texts = std::make_shared<AdviceTexts>();
    for (CLI::Option* option : app.get_options()) {
        constexpr std::string_view others[] = {"--help",    "--mesh",          "--scene",
                                               "--threads", "--build-threads", "--seed"};
        if (std::ranges::find(others, option->get_name()) == std::end(others))
            texts->of_measuring.push_back(option);
    }
    auto* advise = app.add_flag("--advise", texts->advise,
                                "which structure does this mesh need? by a look, in a second");
    app.add_option("--rays-to-trace", texts->rays,
                   "that the structure is built for; with --moving, in each frame")
        ->type_name("N")
        ->check(CLI::Validator(fault_in_rays, ""))
        ->needs(advise);
    app.add_flag("--moving", texts->moving, "the triangles move from frame to frame")
        ->needs(advise);
    app.add_option("--memory", texts->memory, "megabytes that the structure may hold")
        ->type_name("MB")
        ->check(CLI::Validator(fault_in_memory, ""))
        ->needs(advise);
    return texts;
}

}  // namespace

LabOptions parse_lab_options(int argc, char** argv) {
    LabOptions options;
    std::string structures = "default", query = "closest", heat_of = "nodes";
    CLI::App app("Any structure of the book on your own mesh and rays.", "lab");
    app.footer(formats);
    add_file_options(app, options);
    add_ray_options(app, options);
    add_picture_options(app, options, heat_of);
    add_structure_options(app, options, structures);
    app.add_option("--query", query, "the nearest hit, or whether there is any")
        ->check(CLI::IsMember({"closest", "any"}))
        ->capture_default_str();
    add_build_options(app, options.build);
    add_whole_number(
        app, "--repeat", 1, max_repeat,
        [&](std::uint64_t n) { options.repeat = static_cast<int>(n); },
        "timed runs of each build and trace, in turn; their medians count")
        ->default_str(fmt::format("{}", options.repeat));
    app.add_flag("--packets", options.packets,
                 "rays in packets of 64, by structures that know them (fast); others one by one");
    app.add_flag("--check", options.check, "compare the answers with naive tracing");
    const auto advice = add_advice_options(app);
    parse_command_line(app, argc, argv);
    list_scenes_if_asked(options.common);

    const std::vector<std::string_view> named = comma_parts(structures);
    options.structures.assign(named.begin(), named.end());
    if (std::ranges::count(options.structures, "") > 0)
        throw usage_error("--structure: the name of a structure is missing (see --structure list)");
    if (!options.instances.empty() && options.check && !options.flatten)
        throw usage_error("--check: naive tracing needs triangles: add --flatten");
    options.query = query == "any" ? Query::any : Query::closest;
    options.heatmap_of = heat_of == "tests" ? HeatOf::tests : HeatOf::nodes;
    if (LabOptions::is_stdout(options.json) && LabOptions::is_stdout(options.csv))
        throw usage_error("--json and --csv: only one can have standard output");
    options.advice = advice->request();
    if (options.common.threads == 0)
        options.common.threads = std::max(1u, std::thread::hardware_concurrency());
    if (options.build.threads == 0) options.build.threads = options.common.threads;
    return options;
}

void check_outputs(const LabOptions& options) {
    std::vector<std::filesystem::path> inputs{options.mesh, options.rays,
                                              scene_file(options.common.scene)};
    if (options.instances_are_in_file()) {
        inputs = meshes_of_instances(options.instances);
        inputs.insert(inputs.end(), {options.instances, options.rays});
    }
    check_inputs_unprinted(inputs);
    const std::pair<std::string_view, std::filesystem::path> outputs[] = {
        {"--hits", options.hits},
        {"--json", options.json},
        {"--csv", options.csv},
        {"--heatmap", options.heatmap},
        {"--picture", options.picture}};
    std::vector<std::pair<std::string_view, std::filesystem::path>> files;
    for (const auto& [option, file] : outputs) {
        if (option == "--hits" && file == "-") throw usage_error("--hits -: it needs a file");
        if (file.empty() || (option != "--hits" && LabOptions::is_stdout(file))) continue;
        for (const auto& [other_option, other] : files)
            if (is_same_file(file, other))
                throw usage_error(fmt::format("{} and {} are the same file, {}", other_option,
                                              option, file.string()));
        files.emplace_back(option, file);
    }
    for (const auto& [option, file] : files) check_output(option, file, inputs);
}

}  // namespace space
