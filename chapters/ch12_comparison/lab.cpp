#include "chapters/ch12_comparison/lab.hpp"

#include "chapters/ch09_instancing_and_motion/instance_file.hpp"
#include "chapters/ch09_instancing_and_motion/nested_scenes.hpp"
#include "chapters/ch12_comparison/lab_options.hpp"
#include "chapters/ch12_comparison/lab_report.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
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

Scene load(const LabOptions& options) {
    if (options.mesh.empty() && options.common.scene.empty())
        throw usage_error("give --mesh FILE, --scene NAME or --instances FILE");
    if (options.mesh.empty()) return make_scene(options.common.scene, options.common.seed);
    Scene scene;
    scene.name = options.mesh.stem().string();
    scene.mesh = load_mesh(options.mesh);
    frame_mesh(scene);
    return scene;
}

/// Those of the points that lie farthest out, in 26 directions.
std::vector<Double3> farthest(std::span<const Double3> points) {
    std::vector<Double3> kept;
    for (int i = 0; i < 27 && !points.empty(); ++i) {
        const Double3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        kept.push_back(*std::ranges::max_element(
            points, {}, [&](const Double3& p) { return glm::dot(p, direction); }));
    }
    return kept;
}

/// The box of what it holds, nearly: from below, each object's farthest points stand for it. (Boxes
/// of turned boxes would do for all but a picture: they grow with every level.)
Aabb box_around(const SceneGraph& graph) {
    std::vector<std::vector<Double3>> outline(graph.objects().size());
    for (const std::uint32_t i : graph.from_below()) {
        std::vector<Double3> points;
        for (const Triangle& triangle : graph.object(i).triangles)
            if (!box_if_finite<3>(triangle).is_empty())
                for (int corner = 0; corner < 3; ++corner) points.emplace_back(triangle[corner]);
        for (const Instance& instance : graph.object(i).instances)
            for (const Double3& point : outline[instance.object])
                points.push_back(instance.to_parent.point(point));
        outline[i] = farthest(points);
    }
    Aabb box;
    for (const Double3& point : outline[graph.root()])
        if (is_finite<3>(Point3(point))) box.extend(Point3(point));
    return box;
}

/// What is asked, as the options have it.
struct Subject {
    Scene scene;  ///< of a graph: name and camera, and a box that it fills
    std::optional<SceneGraph> graph = {};
    std::vector<Triangle> triangles = {};
    std::size_t degenerate = 0;

    Geometry geometry() const { return {triangles, graph ? &*graph : nullptr}; }
    Triangle triangle(std::uint64_t i) const { return graph ? graph->triangle(i) : triangles[i]; }
};

Subject subject_of(const LabOptions& options) {
    if (options.instances.empty()) {
        Subject subject{load(options)};
        subject.triangles = subject.scene.mesh.triangles();
        subject.degenerate = count_degenerate(subject.triangles);
        return subject;
    }
    Subject subject;
    const bool from_file = options.instances_are_in_file();
    InstanceFile file = from_file ? load_instances(options.instances)
                                  : InstanceFile{make_nested_scene(options.instances), {}};
    subject.graph = std::move(file.graph);
    const std::uint64_t count = subject.graph->triangle_count();
    if (options.flatten) {
        if (count > options.build.limits.references)
            throw usage_error(fmt::format("--flatten: {} triangles, more than --max-references {}",
                                          count, options.build.limits.references));
        subject.triangles = flatten(*subject.graph);
        subject.degenerate = count_degenerate(subject.triangles);
    }
    const Aabb around = box_around(*subject.graph);
    Scene& scene = subject.scene;
    scene.name =
        from_file ? std::filesystem::path(options.instances).stem().string() : options.instances;
    if (!around.is_empty()) {
        scene.mesh = box(Double3(around.min), Double3(around.max));
        frame_mesh(scene);
    }
    scene.mesh.remarks = std::move(file.remarks);
    return subject;
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
    if (!options.hits.empty() && chosen.size() != 1)
        throw usage_error("--hits needs exactly one structure");
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

void write_to(std::FILE* out, const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), out);  // run_program sees whether it could be written
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
    std::FILE* const out = options.json_to_stdout() ? stderr : stdout;

    const Subject subject = subject_of(options);
    print_remarks("lab", subject.scene.mesh.remarks);
    const RaySet set = make_rays(options, subject, structures);
    print_head(subject, options.flatten, set, has_peers(structures), out);

    const std::vector<Measurement> measurements =
        measure(chosen, subject.geometry(), set.rays, options);
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

    if (!options.hits.empty() && measurements.front().stands())
        write_file(options.hits, subject.graph
                                     ? hits_bytes<std::uint64_t>(measurements.front().hits)
                                     : hits_bytes<std::uint32_t>(measurements.front().hits));
    const std::string json =
        json_text(options, mesh_facts(options, subject), measurements, reference, checked);
    if (options.json_to_stdout())
        write_to(stdout, json);
    else if (!options.json.empty())
        write_file(options.json, json);
    const bool all_stand = std::all_of(measurements.begin(), measurements.end(),
                                       [](const Measurement& m) { return m.stands(); });
    const bool all_agree = std::all_of(checked.begin(), checked.end(),
                                       [](const Checked& c) { return c.disagreements == 0; });
    return static_cast<int>(all_stand && all_agree ? ExitCode::ok : ExitCode::wrong_answer);
}

}  // namespace space
