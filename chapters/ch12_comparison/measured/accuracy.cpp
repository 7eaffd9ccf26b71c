#include "chapters/ch12_comparison/measured/accuracy_data.hpp"
#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "common/aimed_rays.hpp"
#include "common/measure.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/progress.hpp"
#include "common/program/provenance.hpp"
#include "common/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <sstream>
#include <string_view>
#include <utility>

namespace space::ch12 {
namespace {

constexpr std::array<std::string_view, 3> accuracy_scenes{"icosphere:10", "boxes:160", "soup:2000"};
/// Of each scene.
std::size_t accuracy_ray_count(const Options& options) {
    return options.small ? 500 : 10'000;
}
constexpr int accuracy_turns = 3;

/// A scene, its rays and the right answers.
struct AccuracyScene {
    std::string name;
    std::vector<Triangle> triangles;
    std::vector<Ray> rays;
    std::vector<HitRecord> right;

    /// `exact` answers as naive tracing does, bit for bit, and sooner.
    AccuracyScene(std::string_view spec, const Structure& exact, const Options& options)
        : name(spec),
          triangles(make_scene(spec, options.seed).mesh.triangles()),
          rays(rays_at_edges(triangles, accuracy_ray_count(options), options.seed)),
          right(rays.size()) {
        exact.variants.front()
            .build_from_triangles(triangles, {})
            .trace({.rays = rays, .hits = right, .threads = std::max(1u, options.threads)});
    }
};

AccuracyRow asked(const AccuracyScene& scene, const Structure& structure,
                  const StructureVariant& variant) {
    AccuracyRow row{.scene = scene.name,
                    .structure = std::string(structure.name),
                    .test = structure.is_peer ? "its own" : std::string(variant.triangle_test),
                    .home = std::string(structure.home),
                    .is_peer = structure.is_peer,
                    .rays = scene.rays.size()};
    const BuiltStructure built = variant.build_from_triangles(scene.triangles, {});
    std::vector<HitRecord> hits(scene.rays.size());
    std::vector<double> times;
    const int turns = structure.name == "naive" ? 1 : accuracy_turns;
    for (int turn = 0; turn < turns; ++turn) {
        Stopwatch stopwatch;
        built.trace({.rays = scene.rays, .hits = hits});
        times.push_back(stopwatch.lap().count());
    }
    row.ns_per_ray = 1e6 * median(times) / static_cast<double>(scene.rays.size());
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const HitRecord &got = hits[i], &right = scene.right[i];
        if (!got.is_hit())
            row.missed += right.is_hit();
        else if (!right.is_hit())
            ++row.false_hit;
        else
            row.behind += got.t > right.t * (1.0f + 0x1p-10f);
    }
    return row;
}

std::string accuracy_head(std::span<const Structure> structures, const Options& options) {
    const Provenance run = provenance("ch12_comparison", options);
    std::string sources;
    for (const auto& [folder, print] : run.sources) sources += " " + print;
    return fmt::format(
        "# Chapter 12: wrong answers of {} aimed rays a scene. Times are of one thread\n"
        "# machine: {}\n# sources:{}\n# structures: {}, seed {}\n",
        accuracy_ray_count(options), run.machine, sources, structures.size(), options.seed);
}

constexpr std::string_view accuracy_columns =
    "scene,structure,test,home,is_peer,rays,missed,false_hit,behind,ns_per_ray\n";

bool takes_part(const Structure& structure, std::size_t triangles) {
    return std::ranges::any_of(compared_structures(), [&](const ComparedStructure& compared) {
        return compared.name == structure.name && triangles <= compared.most_triangles;
    });
}

}  // namespace

std::vector<AccuracyRow> measure_accuracy_of(std::span<const Structure> structures,
                                             const Options& options) {
    std::vector<AccuracyRow> rows;
    Progress progress("accuracy", accuracy_scenes.size() * structures.size());
    for (const std::string_view spec : accuracy_scenes) {
        const auto binned = std::ranges::find(structures, "bvh-binned", &Structure::name);
        const bool is_there = binned != structures.end();
        const AccuracyScene scene(spec, is_there ? *binned : structures.front(), options);
        for (const Structure& structure : structures) {
            progress.step();
            if (!takes_part(structure, scene.triangles.size())) continue;
            for (const StructureVariant& variant : structure.variants) try {
                    rows.push_back(asked(scene, structure, variant));
                } catch (const std::exception&) {
                    // It gave up; what it cannot build has no answers.
                }
        }
    }
    return rows;
}

void accuracy_into(const std::filesystem::path& csv, std::span<const Structure> structures,
                   const Options& options) {
    const std::string head = accuracy_head(structures, options);
    std::error_code error;
    if (std::filesystem::exists(csv, error) && read_file(csv).starts_with(head)) return;
    check_writable(csv);
    std::string text = head + std::string(accuracy_columns);
    for (const AccuracyRow& row : measure_accuracy_of(structures, options))
        text += fmt::format("{},{},{},{},{},{},{},{},{},{:.4g}\n", row.scene, row.structure,
                            row.test, row.home, row.is_peer ? 1 : 0, row.rays, row.missed,
                            row.false_hit, row.behind, row.ns_per_ray);
    write_file(csv, text);
}

std::vector<AccuracyRow> read_accuracy(const std::filesystem::path& csv) {
    std::vector<AccuracyRow> rows;
    std::istringstream lines(read_file(csv));
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (line.starts_with('#') || line + '\n' == accuracy_columns) continue;
        std::vector<std::string> fields;
        std::istringstream parts(line);
        for (std::string field; std::getline(parts, field, ',');) fields.push_back(field);
        try {
            if (fields.size() != 10) throw std::invalid_argument("fields");
            rows.push_back({fields[0], fields[1], fields[2], fields[3], fields[4] == "1",
                            std::stoull(fields[5]), std::stoull(fields[6]), std::stoull(fields[7]),
                            std::stoull(fields[8]), std::stod(fields[9])});
        } catch (const std::exception&) {
            throw input_error(fmt::format("{}: line {} is broken", csv.string(), number));
        }
    }
    if (rows.empty()) throw input_error(fmt::format("{}: no measurement in it", csv.string()));
    return rows;
}

std::vector<AccuracyRow> measure_accuracy(const Options& options) {
    const std::filesystem::path csv = options.out / accuracy_file;
    std::error_code error;
    if (!std::filesystem::exists(csv, error)) accuracy_into(csv, structures(), options);
    return read_accuracy(csv);
}

}  // namespace space::ch12
