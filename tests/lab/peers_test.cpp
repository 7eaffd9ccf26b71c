// Embree and CGAL in the lab: that our adapters ask them fairly, and that their wrong answers are
// counted and are no fault of the lab's.
#include "chapters/ch12_comparison/rays.hpp"
#include "common/mesh.hpp"
#include "common/pcg32.hpp"
#include "tests/catch.hpp"
#include "tests/lab/files.hpp"
#include "tests/lab/process.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>

using namespace space;

namespace {

const Command lab{.words = {PEERS_PROGRAM}};
constexpr const char* peers[] = {"embree", "embree-high", "embree-robust", "cgal"};

Point3 random_point(Pcg32& random) {
    Point3 point;
    for (int axis = 0; axis < 3; ++axis) point[axis] = random.uniform();
    return point;
}

TriangleMesh soup(std::uint32_t count) {
    Pcg32 random(21);
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back(random_point(random));
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

/// Many begin or end in the middle of the soup, and no direction has length 1.
std::vector<Ray> random_rays(std::size_t count) {
    Pcg32 random(22);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = 3.0f * random_point(random) - 1.0f;
        ray.direction = 0.7f * (random_point(random) - ray.origin);
        if (random.below(2) == 0) ray.tmin = random.uniform();
        if (random.below(2) == 0) ray.tmax = ray.tmin + random.uniform();
    }
    return rays;
}

nlohmann::json run_json(const Command& command) {
    const Ended ended = run(command.with("--repeat 1 --json -"));
    INFO(command.text() << ended.err);
    REQUIRE(ended.code == 0);
    return nlohmann::json::parse(ended.out);
}

}  // namespace

TEST_CASE("peers answer as exact arithmetic does, but for a few roundings") {
    const Workbench bench;
    write_ply(bench / "soup.ply", soup(100));
    write_rays(bench / "rays", random_rays(3000));
    for (const char* query : {"closest", "any"})
        for (const int threads : {1, 2}) {
            const auto json = run_json(
                lab.with("--mesh", bench / "soup.ply")
                    .with("--rays", bench / "rays")
                    .with(fmt::format("--structure naive,embree,embree-high,embree-robust,cgal "
                                      "--check --against embree --query {} --threads {}",
                                      query, threads)));
            CHECK(json["against"] == "embree");
            REQUIRE(json["structures"].size() == 5);
            CHECK(json["structures"][1]["build_ratio"] == 1.0);
            CHECK(json["structures"][1]["trace_ratio"] == 1.0);
            for (const auto& structure : json["structures"]) {
                INFO(structure.dump());
                const auto& check = structure["check"];
                const int wrong = check["other_triangle"].get<int>() + check["missed"].get<int>() +
                                  check["false_hits"].get<int>();
                CHECK(check["rays"] == 3000);
                CHECK(check["right"].get<int>() + check["equal_t"].get<int>() +
                          check["t_off"].get<int>() + wrong ==
                      3000);
                CHECK(wrong <= 3);
                CHECK(structure["hits"] > 500);
                CHECK(structure["hits"] < 2500);
                CHECK(structure["build_ratio"].is_number());
                CHECK(structure["trace_ratio"].is_number());
                const bool is_naive = structure["structure"] == "naive";
                CHECK(structure["triangle_tests"].is_null() != is_naive);
                CHECK(check["disagreements"].is_null() != is_naive);
                CHECK(structure["configuration"].is_null() == is_naive);
                CHECK(structure["bytes"] > 100 * 36);
            }
            CHECK(json["structures"][1]["configuration"].get<std::string>().find(
                      fmt::format("threads={}", threads)) != std::string::npos);
        }
}

TEST_CASE("peers' hits have the triangle, t, u and v of the mesh's own numbering") {
    const Workbench bench;
    const TriangleMesh mesh = soup(50);
    write_ply(bench / "soup.ply", mesh);
    write_rays(bench / "rays", random_rays(500));
    const std::vector<Ray> rays = random_rays(500);
    const std::vector<Triangle> triangles = mesh.triangles();
    for (const char* peer : peers) {
        REQUIRE(run(lab.with("--mesh", bench / "soup.ply")
                        .with("--rays", bench / "rays")
                        .with("--hits", bench / "hits")
                        .with("--repeat 1 --structure")
                        .with(peer))
                    .code == 0);
        const std::vector<HitRecord> hits = read_hits(bench / "hits");
        REQUIRE(hits.size() == rays.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (!hits[i].is_hit()) {
                CHECK(hits[i] == HitRecord::closest({}));
                continue;
            }
            ++count;
            const auto& [a, b, c] = triangles.at(hits[i].triangle);
            const double u = hits[i].u, v = hits[i].v;
            const Double3 in_triangle =
                (1.0 - u - v) * Double3(a) + u * Double3(b) + v * Double3(c);
            const Double3 on_ray =
                Double3(rays[i].origin) + double{hits[i].t} * Double3(rays[i].direction);
            CHECK(glm::length(in_triangle - on_ray) < 1e-4);
        }
        CHECK(count > 50);
    }
}

TEST_CASE(
    "peers miss with rays that are not valid, and stand without a triangle that has an area") {
    const Workbench bench;
    TriangleMesh mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}};
    write_ply(bench / "one.ply", mesh);
    mesh.faces = {{0, 1, 1}};
    write_ply(bench / "none.ply", mesh);
    const Ray down{.origin = {0.25f, 0.25f, 1.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    std::vector<Ray> rays(7, down);
    rays[1].origin.x = std::nanf("");
    rays[2].direction.z = std::nanf("");
    rays[3].tmin = std::nanf("");
    rays[4].tmax = -1.0f;
    rays[5].direction = Vector3(0.0f);
    rays[6].direction.x = infinity;
    write_rays(bench / "rays", rays);
    for (const char* query : {"closest", "any"})
        for (const char* file : {"one.ply", "none.ply"}) {
            const auto json =
                run_json(lab.with("--mesh", bench / file)
                             .with("--rays", bench / "rays")
                             .with("--structure embree,embree-high,embree-robust,cgal --query")
                             .with(query));
            for (const auto& structure : json["structures"])
                CHECK(structure["hits"] == (file == std::string("one.ply") ? 1 : 0));
        }
}

TEST_CASE("Embree gives up, and nothing else does, where it would assert: beyond 1.844e18") {
    const Workbench bench;
    write_ply(bench / "one.ply",
              {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}});
    const Ray down{.origin = {0.25f, 0.25f, 1.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    const auto gives_up = [&](const Command& command, const Ray& ray) {
        write_rays(bench / "rays", {{down, ray}});
        const Ended ended = run(command.with("--rays", bench / "rays").with("--repeat 1"));
        INFO(command.text() << ended.out << ended.err);
        const bool told = ended.out.find("beyond 1.844e18") != std::string::npos;
        CHECK(ended.code == (told ? 1 : 0));
        return told;
    };
    const Command mesh = lab.with("--mesh", bench / "one.ply").with("--structure naive,embree");
    CHECK_FALSE(gives_up(mesh, down));
    CHECK_FALSE(gives_up(mesh, {.origin = {0.0f, 0.0f, 1e18f}, .direction = {0.0f, 0.0f, -1.0f}}));
    CHECK(gives_up(mesh, {.origin = {0.0f, 0.0f, 1e19f}, .direction = {0.0f, 0.0f, -1.0f}}));
    CHECK(gives_up(mesh, {.origin = {0.0f, 0.0f, 1.0f}, .direction = {0.0f, 0.0f, -1e19f}}));
    // In the instance's space the ray is that much larger; or the matrix has no inverse in floats.
    for (const char* scale : {"1e-10", "1e-12", "1e-20", "1e-40"}) {
        write_file(bench / "small.json",
                   fmt::format(R"({{"meshes": {{"one": "one.ply"}}, "scene": "small", "groups": )"
                               R"({{"small": [{{"object": "one", "matrix": )"
                               R"([[{0}, 0, 0, 0], [0, {0}, 0, 0], [0, 0, {0}, 0]]}}]}}}})",
                               scale));
        const Command small =
            lab.with("--instances", bench / "small.json").with("--structure bvh-instanced,embree");
        const Ray far{.origin = {0.0f, 0.0f, 1e7f}, .direction = {0.0f, 0.0f, -1.0f}};
        CAPTURE(scale);
        CHECK(gives_up(small, far) == (scale != std::string("1e-10")));
    }
}

TEST_CASE("embree's instances are the scene graph's, with its numbers, but for a few roundings") {
    for (const char* query : {"closest", "any"}) {
        const auto json =
            run_json(lab.with("--instances sphereflake:2 --size 64x48 --flatten --check")
                         .with("--structure bvh-instanced,embree,embree-high,embree-robust --query")
                         .with(query));
        REQUIRE(json["structures"].size() == 4);
        for (const auto& structure : json["structures"]) {
            INFO(structure.dump());
            const auto& check = structure["check"];
            CHECK(structure["hits"] > 300);
            CHECK(check["other_triangle"].get<int>() + check["missed"].get<int>() +
                      check["false_hits"].get<int>() <=
                  3);
            CHECK(structure["bytes"] < 29'120 * 36);  // each sphere is there once
        }
        CHECK(json["structures"][0]["check"]["disagreements"] == 0);
    }
    const Ended ended = run(lab.with("--instances sphereflake:8 --structure embree --size 4x3"));
    CHECK(ended.code == 1);
    CHECK(ended.out.find("48427561 places of meshes, more than") != std::string::npos);
}

TEST_CASE("a peer's wrong answers are counted by kind, and the exit code stays 0") {
    const Workbench bench;
    write_ply(bench / "one.ply",
              {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}});
    // In the triangle's plane: none of the book's hits, but one of CGAL's.
    write_rays(bench / "rays",
               std::array{Ray{.origin = {-1.0f, 0.25f, 0.0f}, .direction = {1.0f, 0.0f, 0.0f}}});
    const Command command = lab.with("--mesh", bench / "one.ply").with("--rays", bench / "rays");
    const auto json = run_json(command.with("--structure naive,cgal --check"));
    CHECK(json["structures"][0]["check"]["false_hits"] == 0);
    CHECK(json["structures"][1]["check"]["false_hits"] == 1);
    const Ended ended = run(command.with("--structure naive,cgal --check --repeat 1"));
    CHECK(ended.code == 0);
    CHECK(ended.out.find("0 disagreements") != std::string::npos);
}

TEST_CASE("embree and cgal are measured by default, and list says which versions") {
    const Ended list = run(lab.with("--structure list"));
    CHECK(list.code == 0);
    const std::string listed = with_single_blanks(list.out);
    for (const char* text : {"embree Embree ", "cgal CGAL "})
        CHECK(listed.find(text) != std::string::npos);
    CHECK(list.out.find("left out") == std::string::npos);
    std::string names;
    const auto json = run_json(lab.with("--scene soup:50 --size 4x3 --triangle-test watertight"));
    for (const auto& structure : json["structures"])
        names += structure["structure"].get<std::string>() + " ";
    CHECK(names.starts_with("naive bsp "));
    CHECK(names.ends_with(" embree cgal "));
    CHECK(json["structures"].back()["triangle_test"] == "its own");
}
