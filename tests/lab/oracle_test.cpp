// The lab's answers, through its files, against exact arithmetic: every structure, random rays.
#include "chapters/ch12_comparison/lab.hpp"
#include "common/mesh.hpp"
#include "common/program/progress.hpp"
#include "common/program/report.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/lab/files.hpp"
#include "tests/lab/process.hpp"
#include "tests/oracle/compare.hpp"
#include "tests/suite/test_rays.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <span>

using namespace space;

namespace {

const std::filesystem::path bunny = "/usr/share/glmark2/models/bunny.obj";  // Debian's glmark2-data

std::optional<Hit> answer(const HitRecord& record) {
    if (!record.is_hit()) return std::nullopt;
    return Hit{.t = record.t,
               .triangle = static_cast<std::uint32_t>(record.triangle),
               .u = record.u,
               .v = record.v};
}

/// Runs the lab with every structure on `count` random rays. No answer of the first, naive tracing,
/// may be wrong; the others must answer as it does, bit for bit. Without `variants` one structure
/// stands for those that are called NAME-VARIANT.
void require_agreement(const std::string& mesh_option, std::span<const Triangle> triangles,
                       std::size_t count, bool variants = true) {
    const Workbench bench;
    RayMaker maker(triangles, 2024);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) ray = maker.random().ray;
    write_rays(bench / "rays", rays);
    std::vector<HitRecord> trusted;
    for (const Structure& structure : structures()) {
        if (!variants && structure.name.find('-') != structure.name.npos) continue;
        const Ended ended = run(Command{.words = {LAB_PROGRAM, "lab"}}
                                    .with(mesh_option)
                                    .with("--rays", bench / "rays")
                                    .with("--hits", bench / "hits")
                                    .with("--repeat 1 --structure")
                                    .with_word(std::string(structure.name)));
        INFO(ended.err);
        REQUIRE(ended.code == 0);
        const std::vector<HitRecord> hits = read_hits(bench / "hits");
        REQUIRE(hits.size() == rays.size());
        const std::string heading =
            fmt::format("{}, {}: {} triangles, {} rays", mesh_option, structure.name,
                        with_commas(triangles.size()), with_commas(count));
        if (!trusted.empty()) {
            std::size_t differ = 0;
            for (std::size_t i = 0; i < count; ++i) differ += hits[i] != trusted[i];
            fmt::print("{}: {} other answers than {}\n", heading, differ,
                       structures().front().name);
            INFO(heading);
            CHECK(differ == 0);
            continue;
        }
        trusted = hits;
        const ExactOracle oracle = ExactOracle::build(triangles);
        Tally tally;
        std::size_t hit_count = 0;
        Progress progress(mesh_option + ": exact oracle", count);
        for (std::size_t i = 0; i < count; ++i) {
            const Comparison comparison = compare(oracle, rays[i], answer(hits[i]));
            tally.add(comparison);
            if (comparison.agreement == Agreement::tie)  // the contract: the smallest index
                CHECK(hits[i].triangle == oracle.closest(rays[i]).front().triangle);
            hit_count += hits[i].is_hit();
            progress.step();
        }
        fmt::print("{}, {} hits: {}\n", heading, with_commas(hit_count), tally.text());
        INFO(heading << ": " << tally.text());
        CHECK(tally.wrong() == 0);
        CHECK(tally.examined() == count);
        CHECK(tally.skipped == 0);
        CHECK(tally.rounded_t == 0);     // the reference test gives the float nearest to t
        CHECK(hit_count > count / 100);  // the rays are worth asking
    }
}

void require_agreement_on(std::span<const char* const> scenes, std::size_t rays_per_scene) {
    for (const char* scene : scenes)
        require_agreement(fmt::format("--scene {}", scene), make_scene(scene).mesh.triangles(),
                          rays_per_scene);
}

void require_agreement_on_bunny(std::size_t rays, bool variants) {
    if (!std::filesystem::exists(bunny)) {
        WARN("skipped: " << bunny << " is not there (package glmark2-data)");
        return;
    }
    require_agreement("--mesh " + bunny.string(), load_mesh(bunny).triangles(), rays, variants);
}

}  // namespace

TEST_CASE("every structure of the lab gives the exact answers on five scenes") {
    require_agreement_on(
        std::array{"room:2", "sphereflake:1", "lattice:1", "soup_uneven:500", "stadium:4"}, 400);
}
TEST_CASE("every structure of the lab gives the exact answers on the bunny") {
    require_agreement_on_bunny(200, false);
}

// By hand, in minutes: the target lab_oracle_big.
TEST_CASE("100,000 rays over five scenes, every structure", "[.big]") {
    require_agreement_on(std::array{"room", "sphereflake", "lattice", "soup_uneven", "stadium"},
                         20'000);
}
TEST_CASE("100,000 rays on the bunny, every structure", "[.big]") {
    require_agreement_on_bunny(100'000, true);
}
