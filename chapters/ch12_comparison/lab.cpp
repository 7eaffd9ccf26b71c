#include "chapters/ch12_comparison/lab.hpp"

#include "chapters/ch12_comparison/lab_options.hpp"
#include "chapters/ch12_comparison/lab_report.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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
        throw usage_error("give --mesh FILE or --scene NAME");
    if (options.mesh.empty()) return make_scene(options.common.scene, options.common.seed);
    Scene scene;
    scene.name = options.mesh.stem().string();
    scene.mesh = load_mesh(options.mesh);
    frame_mesh(scene);
    return scene;
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
        for (const Structure& structure : structures)
            if (name == "all" || (name == "default" && structure.by_default) ||
                name == structure.name)
                chosen.push_back(choose(structure, options.triangle_test));
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

int list_structures(std::span<const Structure> structures) {
    Table table({"structure", "from", "default", "what it is"});
    for (const Structure& structure : structures)
        table.row({std::string(structure.name), std::string(structure.home),
                   structure.by_default ? "yes" : "", std::string(structure.about)});
    table.print();
    if (!has_peers(structures)) fmt::print("\npeers   left out: {}\n", no_peers);
    return static_cast<int>(ExitCode::ok);
}

int list_triangle_tests(std::span<const Structure> structures) {
    Table table({"triangle test", "what it is"});
    for (const StructureVariant& variant : structures.front().variants)
        table.row({std::string(variant.triangle_test), std::string(variant.about_test)});
    table.print();
    return static_cast<int>(ExitCode::ok);
}

/// Exact answers to the rays, by the last structure of the latest chapter that stands.
std::vector<HitRecord> exact_hits(std::span<const Structure> structures,
                                  std::span<const Triangle> triangles, std::span<const Ray> rays,
                                  const LabOptions& options) {
    std::vector<HitRecord> hits(rays.size());
    std::string_view tried;
    for (auto structure = structures.rbegin(); structure != structures.rend(); ++structure) {
        if (structure->is_peer || structure->home == tried) continue;
        tried = structure->home;
        try {
            Progress progress("camera rays", rays.size());
            structure->variants.front()
                .build(triangles, options.build)
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

RaySet make_rays(const LabOptions& options, const Scene& scene, std::span<const Triangle> triangles,
                 std::span<const Structure> structures) {
    if (!options.rays.empty()) return {read_rays(options.rays), "--rays " + options.rays.string()};
    const Camera camera = options.camera.value_or(scene.camera);
    const int width = options.common.width, height = options.common.height;
    if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > max_rays)
        throw usage_error(fmt::format("--size {}x{}: more than {} rays", width, height, max_rays));
    RaySet set{camera_rays({camera, width, height}),
               fmt::format("--camera {} --size {}x{}", camera_text(camera), width, height)};
    if (options.diffuse == 0) return set;

    const std::vector<HitRecord> hits = exact_hits(structures, triangles, set.rays, options);
    set.rays = diffuse_rays(triangles, set.rays, hits, options.diffuse, options.common.seed);
    if (set.rays.empty())
        throw usage_error("--diffuse: no camera ray hits the mesh, so there is nowhere to start");
    set.source += fmt::format(" --diffuse {} --seed {}", options.diffuse, options.common.seed);
    return set;
}

void print_head(const Scene& scene, std::size_t degenerate, const RaySet& set, bool with_peers,
                std::FILE* out) {
    fmt::print(out, "mesh    {}: {}, {}, {} degenerate\n", scene.name,
               scene.mesh.vertices.size() == 1
                   ? "1 vertex"
                   : with_commas(scene.mesh.vertices.size()) + " vertices",
               counted(scene.mesh.faces.size(), "triangle"), with_commas(degenerate));
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

int run_lab(std::span<const Structure> structures, int argc, char** argv) {
    const LabOptions options = parse_lab_options(argc, argv);
    if (options.structures.front() == "list") return list_structures(structures);
    if (options.triangle_test == "list") return list_triangle_tests(structures);
    const std::vector<Choice> chosen = choose(structures, options);
    check_outputs(options);
    std::FILE* const out = options.json_to_stdout() ? stderr : stdout;

    const Scene scene = load(options);
    print_remarks("lab", scene.mesh.remarks);
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const std::size_t degenerate = count_degenerate(triangles);
    const RaySet set = make_rays(options, scene, triangles, structures);
    print_head(scene, degenerate, set, has_peers(structures), out);

    const std::vector<Measurement> measurements = measure(chosen, triangles, set.rays, options);
    const auto against = std::find_if(measurements.begin(), measurements.end(),
                                      [&](auto& m) { return m.name() == options.against; });
    const Measurement* const reference = against == measurements.end() ? nullptr : &*against;
    print_measurements(measurements, reference, options, out);
    print_hint(options, scene, measurements, out);
    std::vector<Checked> checked;
    if (options.check) {
        checked = check(structures.front(), triangles, set.rays, measurements, options, out);
        print_checked(measurements, checked, out);
    }

    if (!options.hits.empty() && measurements.front().stands())
        write_file(options.hits, hits_bytes(measurements.front().hits));
    const std::string json =
        json_text(options, scene, degenerate, measurements, reference, checked);
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
