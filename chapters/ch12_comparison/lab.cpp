#include "chapters/ch12_comparison/lab.hpp"

#include "chapters/ch12_comparison/lab_options.hpp"
#include "common/measure.hpp"
#include "common/pcg32.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/report.hpp"
#include "common/program/results.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

namespace space {
namespace {

constexpr int json_version = 1;  // of the layout of --json

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

/// A structure with the triangle test to build it with.
struct Choice {
    std::string_view name;
    const StructureVariant* variant;
};

Choice choose(const Structure& structure, const std::string& triangle_test) {
    for (const StructureVariant& variant : structure.variants)
        if (triangle_test.empty() || triangle_test == variant.triangle_test)
            return {structure.name, &variant};
    throw usage_error(
        fmt::format("--triangle-test {}: {} has no such test (see --triangle-test list)",
                    triangle_test, structure.name));
}

std::vector<Choice> choose(std::span<const Structure> structures, const LabOptions& options) {
    std::vector<Choice> chosen;
    for (const std::string& name : options.structures) {
        const std::size_t before = chosen.size();
        for (const Structure& structure : structures)
            if (name == "all" || name == structure.name)
                chosen.push_back(choose(structure, options.triangle_test));
        if (chosen.size() == before)
            throw usage_error(
                fmt::format("--structure {}: no such structure (see --structure list)", name));
    }
    return chosen;
}

int list_structures(std::span<const Structure> structures) {
    Table table({"structure", "what it is"});
    for (const Structure& structure : structures)
        table.row({std::string(structure.name), std::string(structure.about)});
    table.print();
    return static_cast<int>(ExitCode::ok);
}

int list_triangle_tests(std::span<const Structure> structures) {
    Table table({"triangle test", "what it is"});
    for (const StructureVariant& variant : structures.front().variants)
        table.row({std::string(variant.triangle_test), std::string(variant.about_test)});
    table.print();
    return static_cast<int>(ExitCode::ok);
}

struct RaySet {
    std::vector<Ray> rays;
    std::string source;  ///< the options that give them again
};

RaySet make_rays(const LabOptions& options, const Scene& scene, std::span<const Triangle> triangles,
                 const Choice& tracer) {
    if (!options.rays.empty()) return {read_rays(options.rays), "--rays " + options.rays.string()};
    const Camera camera = options.camera.value_or(scene.camera);
    const int width = options.common.width, height = options.common.height;
    if (static_cast<std::size_t>(width) * static_cast<std::size_t>(height) > max_rays)
        throw usage_error(fmt::format("--size {}x{}: more than {} rays", width, height, max_rays));
    RaySet set{camera_rays(camera, width, height),
               fmt::format("--camera {} --size {}x{}", camera_text(camera), width, height)};
    if (options.diffuse == 0) return set;

    std::vector<HitRecord> hits(set.rays.size());
    Progress progress("camera rays", set.rays.size());
    tracer.variant->build(triangles, {options.build_threads})
        .trace({.rays = set.rays,
                .hits = hits,
                .threads = options.common.threads,
                .progress = &progress});
    set.rays = diffuse_rays(triangles, set.rays, hits, options.diffuse, options.common.seed);
    if (set.rays.empty())
        throw usage_error("--diffuse: no camera ray hits the mesh, so there is nowhere to start");
    set.source += fmt::format(" --diffuse {} --seed {}", options.diffuse, options.common.seed);
    return set;
}

struct Measurement {
    std::string_view structure;
    double build_ms = 0.0, trace_ms = 0.0;
    unsigned build_threads = 1;
    TreeShape shape;
    TraversalCounts counts;
    std::vector<HitRecord> hits;

    std::size_t hit_count() const {
        return static_cast<std::size_t>(
            std::count_if(hits.begin(), hits.end(), [](auto& hit) { return hit.is_hit(); }));
    }
    double rays_per_second() const { return static_cast<double>(hits.size()) / trace_ms * 1e3; }
};

std::vector<Measurement> measure(std::span<const Choice> chosen,
                                 std::span<const Triangle> triangles, std::span<const Ray> rays,
                                 const LabOptions& options) {
    const std::size_t runs_each = static_cast<std::size_t>(options.repeat) + 1;  // one to warm up
    std::vector<Measurement> measurements(chosen.size());
    std::vector<BuiltStructure> built(chosen.size());
    {
        // The old structure is freed in a run of its own, so that no build is timed with it.
        Progress progress("building", runs_each * chosen.size());
        std::vector<std::function<void()>> runs;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            runs.push_back([&, i] { built[i] = {}; });
            runs.push_back([&, i] {
                built[i] = chosen[i].variant->build(triangles, {options.build_threads});
                progress.step();
            });
        }
        const std::vector<double> medians = interleaved_medians(runs, options.repeat);
        for (std::size_t i = 0; i < chosen.size(); ++i)
            measurements[i].build_ms = medians[2 * i + 1];
    }
    {
        Progress progress("tracing", runs_each * chosen.size() * rays.size());
        std::vector<std::function<void()>> runs;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            Measurement& measurement = measurements[i];
            measurement.structure = chosen[i].name;
            measurement.build_threads = built[i].build_threads;
            measurement.shape = built[i].shape();
            measurement.hits.resize(rays.size());
            const Batch batch{rays, measurement.hits, options.query, options.common.threads,
                              &progress};
            // The first run, which warms up and is not timed, is the one that counts.
            runs.push_back([&measurement, &structure = built[i], batch, counting = true]() mutable {
                if (std::exchange(counting, false) && structure.count)
                    measurement.counts = structure.count(batch);
                else
                    structure.trace(batch);
            });
        }
        const std::vector<double> medians = interleaved_medians(runs, options.repeat);
        for (std::size_t i = 0; i < chosen.size(); ++i) measurements[i].trace_ms = medians[i];
    }
    return measurements;
}

void print_measurements(std::span<const Measurement> measurements, const LabOptions& options) {
    const auto count = [](const std::optional<std::size_t>& value) {
        return value ? with_commas(*value) : "-";
    };
    Table work({"structure", "build ms", "trace ms", "Mrays/s", "hits", "visits/ray", "tests/ray"});
    Table shape({"structure", "nodes", "leaves", "depth", "references", "bytes", "SAH cost"});
    for (const Measurement& m : measurements) {
        const std::string name(m.structure);
        const auto per_ray = [&](std::uint64_t total) {
            return fmt::format("{:.2f}",
                               static_cast<double>(total) / static_cast<double>(m.hits.size()));
        };
        work.row({name, fmt::format("{:.3f}", m.build_ms), fmt::format("{:.3f}", m.trace_ms),
                  fmt::format("{:.4f}", m.rays_per_second() * 1e-6), with_commas(m.hit_count()),
                  m.shape.nodes ? per_ray(m.counts.nodes_visited) : "-",
                  per_ray(m.counts.triangles_tested)});
        shape.row({name, count(m.shape.nodes), count(m.shape.leaves), count(m.shape.depth),
                   with_commas(m.shape.references), with_commas(m.shape.bytes),
                   m.shape.sah_cost ? fmt::format("{:.2f}", *m.shape.sah_cost) : "-"});
    }
    fmt::print("query   {}{}; times: medians of {}, threads: {}\n\n", query_name(options.query),
               options.triangle_test.empty() ? "" : " by " + options.triangle_test, options.repeat,
               options.common.threads);
    work.print();
    fmt::print("\n");
    shape.print();
    fmt::print("\n");
}

std::string json_text(const LabOptions& options, const Scene& scene, std::size_t degenerate,
                      std::span<const Measurement> measurements) {
    using Json = nlohmann::ordered_json;
    const auto or_null = [](const auto& value) { return value ? Json(*value) : Json(nullptr); };
    Json list = Json::array();
    for (const Measurement& m : measurements)
        list.push_back(
            {{"structure", m.structure},
             {"build_ms", m.build_ms},
             {"trace_ms", m.trace_ms},
             {"rays_per_s", m.rays_per_second()},
             {"rays", m.hits.size()},
             {"hits", m.hit_count()},
             {"nodes", or_null(m.shape.nodes)},
             {"leaves", or_null(m.shape.leaves)},
             {"depth", or_null(m.shape.depth)},
             {"references", m.shape.references},
             {"bytes", m.shape.bytes},
             {"sah_cost", or_null(m.shape.sah_cost)},
             {"node_visits", m.shape.nodes ? Json(m.counts.nodes_visited) : Json(nullptr)},
             {"triangle_tests", m.counts.triangles_tested},
             {"threads", options.common.threads},
             {"build_threads", m.build_threads}});
    const Json mesh{{"name", scene.name},
                    {"file", options.mesh.empty() ? Json(nullptr) : Json(options.mesh.string())},
                    {"vertices", scene.mesh.vertices.size()},
                    {"triangles", scene.mesh.faces.size()},
                    {"degenerate", degenerate}};
    const Json document{{"version", json_version},
                        {"machine", machine_description()},
                        {"mesh", mesh},
                        {"query", query_name(options.query)},
                        {"structures", list}};
    return document.dump(2, ' ', false, Json::error_handler_t::replace) +
           '\n';  // a file's name may not be UTF-8
}

/// Prints every disagreement with naive tracing, and returns how many there are.
std::size_t check(const Choice& naive, std::span<const Triangle> triangles,
                  std::span<const Ray> rays, std::span<const Measurement> measurements,
                  const LabOptions& options) {
    const std::vector<std::size_t> sample =
        check_sample(rays.size(), triangles.size(), options.common.seed);
    std::vector<Ray> sample_rays;
    for (const std::size_t i : sample) sample_rays.push_back(rays[i]);
    std::vector<HitRecord> trusted(sample.size()), other(sample.size());
    {
        Progress progress("checking", sample.size());
        naive.variant->build(triangles, {options.build_threads})
            .trace({sample_rays, trusted, options.query, options.common.threads, &progress});
    }
    std::size_t wrong = 0;
    for (const Measurement& m : measurements) {
        std::transform(sample.begin(), sample.end(), other.begin(),
                       [&](std::size_t i) { return m.hits[i]; });
        const auto lines = disagreements({naive.name, trusted}, {m.structure, other}, sample);
        for (const std::string& line : lines) fmt::print("{}\n", line);
        wrong += lines.size();
    }
    if (sample.size() < rays.size())
        fmt::print(
            "check   a sample of {} of {} rays (naive tracing of all would be over {} tests): ",
            with_commas(sample.size()), with_commas(rays.size()), with_commas(check_limit));
    else
        fmt::print("check   all {} rays: ", with_commas(rays.size()));
    fmt::print("{} disagreement{}\n", with_commas(wrong), wrong == 1 ? "" : "s");
    return wrong;
}

std::string answer_text(const HitRecord& hit) {
    if (!hit.is_hit()) return "none";
    if (hit.triangle == HitRecord::some_triangle) return "hit";
    return fmt::format("triangle {} at t = {} (u = {}, v = {})", hit.triangle, hit.t, hit.u, hit.v);
}

}  // namespace

std::vector<std::size_t> check_sample(std::size_t rays, std::size_t triangles, std::uint64_t seed,
                                      std::size_t limit) {
    const std::size_t count =
        std::min(rays, std::max<std::size_t>(1, limit / std::max<std::size_t>(1, triangles)));
    std::vector<std::size_t> sample(count);
    std::iota(sample.begin(), sample.end(), std::size_t{0});
    if (count == rays) return sample;
    Pcg32 random(seed);
    for (std::size_t& i : sample) {
        const std::size_t first = i * rays / count, last = (i + 1) * rays / count;
        i = first + random.below(static_cast<std::uint32_t>(last - first));
    }
    return sample;
}

std::vector<std::string> disagreements(const Answers& trusted, const Answers& other,
                                       std::span<const std::size_t> rays) {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (trusted.hits[i] != other.hits[i])
            lines.push_back(fmt::format("ray {}: {} {}, {} {}", rays[i], trusted.structure,
                                        answer_text(trusted.hits[i]), other.structure,
                                        answer_text(other.hits[i])));
    return lines;
}

int run_lab(std::span<const Structure> structures, int argc, char** argv) {
    const LabOptions options = parse_lab_options(argc, argv);
    if (options.structures.front() == "list") return list_structures(structures);
    if (options.triangle_test == "list") return list_triangle_tests(structures);
    const std::vector<Choice> chosen = choose(structures, options);
    if (!options.hits.empty() && chosen.size() != 1)
        throw usage_error("--hits needs exactly one structure");
    for (const auto& output : {options.hits, options.json})
        if (!output.empty()) check_writable(output);

    const Scene scene = load(options);
    const std::vector<Triangle> triangles = scene.mesh.triangles();
    const std::size_t degenerate = count_degenerate(triangles);
    fmt::print("mesh    {}: {} vertices, {} triangles, {} degenerate\n", scene.name,
               with_commas(scene.mesh.vertices.size()), with_commas(triangles.size()),
               with_commas(degenerate));

    const auto [rays, source] =
        make_rays(options, scene, triangles, choose(structures.back(), options.triangle_test));
    const auto invalid =
        std::count_if(rays.begin(), rays.end(), [](const Ray& ray) { return !is_valid(ray); });
    fmt::print("rays    {}: {} rays", source, with_commas(rays.size()));
    if (invalid)
        fmt::print(", {} of them not valid: misses",
                   with_commas(static_cast<std::uint64_t>(invalid)));
    fmt::print("\n");

    const std::vector<Measurement> measurements = measure(chosen, triangles, rays, options);
    print_measurements(measurements, options);
    std::size_t wrong = 0;
    if (options.check)
        wrong = check(choose(structures.front(), options.triangle_test), triangles, rays,
                      measurements, options);

    if (!options.hits.empty()) write_file(options.hits, hits_bytes(measurements.front().hits));
    if (!options.json.empty())
        write_file(options.json, json_text(options, scene, degenerate, measurements));
    return static_cast<int>(wrong ? ExitCode::wrong_answer : ExitCode::ok);
}

}  // namespace space
