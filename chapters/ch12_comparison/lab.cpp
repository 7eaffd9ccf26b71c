#include "chapters/ch12_comparison/lab.hpp"

#include "chapters/ch12_comparison/lab_advice.hpp"
#include "chapters/ch12_comparison/lab_options.hpp"
#include "chapters/ch12_comparison/lab_pictures.hpp"
#include "chapters/ch12_comparison/lab_report.hpp"
#include "chapters/ch12_comparison/lab_subject.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/image.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace space {
namespace {

constexpr const char* no_peers =
    "this lab was built without Embree and CGAL (packages libembree-dev, libcgal-dev)";

bool has_peers(std::span<const Structure> structures) {
    return std::any_of(structures.begin(), structures.end(),
                       [](const Structure& structure) { return structure.is_peer; });
}

std::string camera_text(const Camera& camera) {
    const auto& [eye, target, up, fov] = camera;
    return fmt::format("{},{},{},{},{},{},{}", eye.x, eye.y, eye.z, target.x, target.y, target.z,
                       fov);
}

/// A peer has one test, its own.
Choice choose(const Structure& structure, const std::string& triangle_test) {
    for (const StructureVariant& variant : structure.variants)
        if (triangle_test.empty() || triangle_test == variant.triangle_test || structure.is_peer)
            return {&structure, &variant};
    throw usage_error(
        fmt::format("--triangle-test {}: {} has no such test (see --triangle-test list)",
                    triangle_test, structure.name));
}

/// Asked of the structure over no triangle, where it takes that; later it may give up, too.
void check_heat_is_told(const Choice& choice, const LabOptions& options) {
    BuiltStructure built;
    try {
        built = choice.variant->build_from_triangles({}, options.build);
    } catch (const std::exception&) {
        return;
    }
    const std::string_view name = choice.structure->name;
    if (!built.count)
        throw usage_error(fmt::format("--heatmap: {} does not tell what its rays do", name));
    if (options.heatmap_of == HeatOf::nodes && !built.shape().nodes)
        throw usage_error(fmt::format("--heatmap: {} has no nodes: add --heatmap-of tests", name));
}

std::vector<Choice> choose(std::span<const Structure> structures, const LabOptions& options) {
    std::vector<Choice> chosen;
    for (const std::string& name : options.structures) {
        const std::size_t before = chosen.size();
        for (const Structure& structure : structures) {
            const bool takes_it = options.instances.empty() || options.flatten ||
                                  structure.variants.front().build_from_graph;
            if (name == structure.name && !takes_it)
                throw usage_error(fmt::format(
                    "--structure {}: it takes triangles, not instances: add --flatten", name));
            if (name == structure.name ||
                (takes_it && (name == "all" || (name == "default" && structure.by_default))))
                chosen.push_back(choose(structure, options.triangle_test));
        }
        if (chosen.size() == before)
            throw usage_error(
                fmt::format("--structure {}: no such structure (see --structure list){}", name,
                            has_peers(structures) ? "" : std::string("; ") + no_peers));
    }
    const auto is_against = [&](const Choice& choice) {
        return choice.structure->name == options.against;
    };
    if (!options.against.empty() && std::none_of(chosen.begin(), chosen.end(), is_against))
        throw usage_error(fmt::format(
            "--against {}: it is none of the structures that are measured{}", options.against,
            has_peers(structures) ? "" : std::string("; ") + no_peers));
    const std::pair<const char*, bool> asked[] = {{"--hits", !options.hits.empty()},
                                                  {"--heatmap", !options.heatmap.empty()},
                                                  {"--picture", !options.picture.empty()}};
    for (const auto& [option, is_asked] : asked)
        if (is_asked && chosen.size() != 1)
            throw usage_error(fmt::format("{} needs exactly one structure", option));
    if (!options.heatmap.empty()) check_heat_is_told(chosen.front(), options);
    return chosen;
}

int list_triangle_tests(std::span<const Structure> structures) {
    Table table({"triangle test", "what it is"});
    for (const StructureVariant& variant : structures.front().variants)
        table.row({std::string(variant.triangle_test), std::string(variant.about_test)});
    table.print();
    return static_cast<int>(ExitCode::ok);
}

/// Exact answers to the rays, by the last structure of the latest chapter that stands; of a scene
/// graph, by the first structure that knows graphs.
std::vector<HitRecord> exact_hits(std::span<const Structure> structures, const Geometry& geometry,
                                  std::span<const Ray> rays, const LabOptions& options) {
    std::vector<HitRecord> hits(rays.size());
    std::string_view tried;
    if (geometry.graph)
        structures = structures.first(
            1 +
            static_cast<std::size_t>(
                std::ranges::find_if(structures,
                                     [](const Structure& structure) {
                                         return bool(structure.variants.front().build_from_graph);
                                     }) -
                structures.begin()));
    for (auto structure = structures.rbegin(); structure != structures.rend(); ++structure) {
        if (structure->is_peer || structure->home == tried) continue;
        tried = structure->home;
        try {
            Progress progress("camera rays", rays.size());
            structure->variants.front()
                .build(geometry, options.build)
                .trace({rays, hits, Query::closest, options.common.threads, &progress});
            break;
        } catch (const std::exception&) {
            if (std::next(structure) == structures.rend()) throw;  // naive tracing
        }
    }
    return hits;
}

struct RaySet {
    std::vector<Ray> rays;
    std::string source;  ///< the options that give them again
};

RaySet make_rays(const LabOptions& options, const Subject& subject,
                 std::span<const Structure> structures) {
    if (!options.rays.empty()) return {read_rays(options.rays), "--rays " + options.rays.string()};
    const Camera camera = options.camera.value_or(subject.scene.camera);
    const int width = options.common.width, height = options.common.height;
    if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > max_rays)
        throw usage_error(fmt::format("--size {}x{}: more than {} rays", width, height, max_rays));
    RaySet set{camera_rays({camera, width, height}),
               fmt::format("--camera {} --size {}x{}", camera_text(camera), width, height)};
    if (options.diffuse == 0) return set;

    const std::vector<HitRecord> hits =
        exact_hits(structures, subject.geometry(), set.rays, options);
    set.rays = diffuse_rays([&](std::uint64_t i) { return subject.triangle(i); }, set.rays, hits,
                            options.diffuse, options.common.seed);
    if (set.rays.empty())
        throw usage_error("--diffuse: no camera ray hits the mesh, so there is nowhere to start");
    set.source += fmt::format(" --diffuse {} --seed {}", options.diffuse, options.common.seed);
    return set;
}

std::size_t instance_count(const SceneGraph& graph) {
    std::size_t count = 0;
    for (const GraphObject& object : graph.objects()) count += object.instances.size();
    return count;
}

MeshFacts mesh_facts(const LabOptions& options, const Subject& subject) {
    if (!subject.graph)
        return {.name = subject.scene.name,
                .file = options.mesh.string(),
                .triangles = subject.triangles.size(),
                .vertices = subject.scene.mesh.vertices.size(),
                .degenerate = subject.degenerate};
    MeshFacts facts{.name = subject.scene.name,
                    .file = options.instances_are_in_file() ? options.instances : "",
                    .triangles = subject.graph->triangle_count(),
                    .objects = subject.graph->objects().size(),
                    .instances = instance_count(*subject.graph)};
    if (options.flatten) facts.degenerate = subject.degenerate;
    return facts;
}

void print_head(const Subject& subject, bool flattened, const RaySet& set, bool with_peers,
                std::FILE* out) {
    const Scene& scene = subject.scene;
    if (subject.graph)
        fmt::print(out, "scene   {}: {} by {} of {}{}\n", scene.name,
                   counted(subject.graph->triangle_count(), "triangle"),
                   counted(instance_count(*subject.graph), "instance"),
                   counted(subject.graph->objects().size(), "object"),
                   flattened
                       ? fmt::format("; flattened, {} degenerate", with_commas(subject.degenerate))
                       : "");
    else
        fmt::print(out, "mesh    {}: {}, {}, {} degenerate\n", scene.name,
                   scene.mesh.vertices.size() == 1
                       ? "1 vertex"
                       : with_commas(scene.mesh.vertices.size()) + " vertices",
                   counted(scene.mesh.faces.size(), "triangle"), with_commas(subject.degenerate));
    const auto invalid = static_cast<std::uint64_t>(std::count_if(
        set.rays.begin(), set.rays.end(), [](const Ray& ray) { return !is_valid(ray); }));
    fmt::print(out, "rays    {}: {}", set.source, counted(set.rays.size(), "ray"));
    if (invalid) fmt::print(out, ", {} of them not valid: misses", with_commas(invalid));
    fmt::print(out, "\n");
    if (!with_peers) fmt::print(out, "peers   left out: {}\n", no_peers);
}

/// What to tell those whose camera looks past the mesh.
void print_hint(const LabOptions& options, const Scene& scene,
                std::span<const Measurement> measurements, std::FILE* out) {
    if (!options.rays.empty() || options.diffuse > 0) return;
    if (std::any_of(measurements.begin(), measurements.end(),
                    [](const Measurement& m) { return !m.stands() || m.hit_count() > 0; }))
        return;
    const Aabb box = bounds(scene.mesh);
    fmt::print(out,
               "hint    no camera ray hits the mesh, which lies between ({}, {}, {}) and "
               "({}, {}, {}): --camera ex,ey,ez,tx,ty,tz,fov\n\n",
               box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
}

/// The bytes of --heatmap and --picture; empty for what is not asked for.
struct Pictures {
    std::string heat, shaded;
};

Pictures make_pictures(const BuiltStructure& built, const LabOptions& options,
                       const Subject& subject, std::span<const Ray> rays,
                       std::string_view structure, std::FILE* out) {
    Pictures pictures;
    const auto& [width, height] = std::pair(options.common.width, options.common.height);
    if (!options.heatmap.empty()) {
        std::vector<HitRecord> hits(rays.size());
        Progress progress("heat map", rays.size());
        const std::vector<std::uint64_t> values = heat_values(
            counts_by_ray(built, {rays, hits, options.query, options.common.threads, &progress}),
            options.heatmap_of);
        const HeatScale scale =
            options.heatmap_max ? heat_scale_to(options.heatmap_max) : heat_scale_of(values);
        pictures.heat = png_bytes(heat_map(values, width, height, scale,
                                           fmt::format("{}, {}", subject.scene.name, structure),
                                           options.heatmap_of));
        fmt::print(out, "heatmap {}: {}, {} in all; colours from 0 to {}\n",
                   options.heatmap.string(), heat_name(options.heatmap_of),
                   with_commas(std::accumulate(values.begin(), values.end(), std::uint64_t{0})),
                   with_commas(scale.end));
    }
    if (!options.picture.empty()) {
        const Surfaces surfaces{[&](std::uint64_t i) { return subject.triangle(i); },
                                [&](std::uint64_t i) {
                                    return subject.graph
                                               ? Scene::default_color
                                               : subject.scene.color(static_cast<std::uint32_t>(i));
                                }};
        const PixelGrid pixels(options.camera.value_or(subject.scene.camera), width, height);
        pictures.shaded = png_bytes(
            shaded_picture(built, pixels, subject.scene, surfaces, options.common.threads));
    }
    return pictures;
}

/// To the file, or to standard output where it is asked for; nowhere without a name.
void write_data(const std::filesystem::path& file, const std::string& text) {
    if (LabOptions::is_stdout(file))
        std::fwrite(text.data(), 1, text.size(), stdout);  // run_program sees whether it could be
    else if (!file.empty())
        write_file(file, text);
}

}  // namespace

int list_structures(std::span<const Structure> structures) {
    Table table({"structure", "from", "default", "what it is"});
    for (const Structure& structure : structures)
        table.row({std::string(structure.name), std::string(structure.home),
                   structure.by_default ? "yes" : "", std::string(structure.about)});
    table.print();
    if (!has_peers(structures)) fmt::print("\npeers   left out: {}\n", no_peers);
    return static_cast<int>(ExitCode::ok);
}

int run_lab(std::span<const Structure> structures, int argc, char** argv) {
    const LabOptions options = parse_lab_options(argc, argv);
    if (options.structures.front() == "list") return list_structures(structures);
    if (options.triangle_test == "list") return list_triangle_tests(structures);
    const std::vector<Choice> chosen = choose(structures, options);
    check_outputs(options);
    std::FILE* const out = options.data_to_stdout() ? stderr : stdout;

    const Subject subject = subject_of(options);
    print_remarks("lab", subject.scene.mesh.remarks);
    if (options.advice) {
        print_advice(subject.scene.name, subject.triangles, *options.advice, options.common.threads,
                     out);
        return static_cast<int>(ExitCode::ok);
    }
    const RaySet set = make_rays(options, subject, structures);
    print_head(subject, options.flatten, set, has_peers(structures), out);

    Pictures pictures;
    std::vector<Measurement> measurements =
        measure(chosen, subject.geometry(), set.rays, options, [&](const BuiltStructure& built) {
            pictures = make_pictures(built, options, subject, set.rays,
                                     chosen.front().structure->name, out);
        });
    if (!options.sort.empty()) sort_rows(measurements, options.sort);
    const auto against = std::find_if(measurements.begin(), measurements.end(),
                                      [&](auto& m) { return m.name() == options.against; });
    const Measurement* const reference = against == measurements.end() ? nullptr : &*against;
    print_measurements(measurements, reference, options, out);
    print_hint(options, subject.scene, measurements, out);
    std::vector<Checked> checked;
    if (options.check) {
        checked =
            check(structures.front(), subject.triangles, set.rays, measurements, options, out);
        print_checked(measurements, checked, out);
    }

    const MeshFacts facts = mesh_facts(options, subject);
    if (!options.hits.empty() && measurements.front().stands())
        write_file(options.hits, subject.graph
                                     ? hits_bytes<std::uint64_t>(measurements.front().hits)
                                     : hits_bytes<std::uint32_t>(measurements.front().hits));
    if (!pictures.heat.empty()) write_file(options.heatmap, pictures.heat);
    if (!pictures.shaded.empty()) write_file(options.picture, pictures.shaded);
    write_data(options.json, json_text(options, facts, measurements, reference, checked));
    write_data(options.csv, csv_text(options, facts, measurements, reference, checked));
    const bool all_stand = std::all_of(measurements.begin(), measurements.end(),
                                       [](const Measurement& m) { return m.stands(); });
    const bool all_agree = std::all_of(checked.begin(), checked.end(),
                                       [](const Checked& c) { return c.disagreements == 0; });
    return static_cast<int>(all_stand && all_agree ? ExitCode::ok : ExitCode::wrong_answer);
}

}  // namespace space
