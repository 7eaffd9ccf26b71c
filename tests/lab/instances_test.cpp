// The lab with scene graphs, as a program that reads and writes files.
#include "chapters/ch09_instancing_and_motion/instance_file.hpp"
#include "chapters/ch09_instancing_and_motion/nested_scenes.hpp"
#include "common/mesh.hpp"
#include "common/program/file.hpp"
#include "tests/catch.hpp"
#include "tests/lab/files.hpp"
#include "tests/lab/process.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

using namespace space;

namespace {

const Command lab{.words = {LAB_PROGRAM, "lab"}};

/// Two flags and a pair of these, 3 above; the second of each pair is mirrored, larger, and turned
/// by an angle without a short name.
constexpr const char* flags = R"({
 "meshes": {"flag": "flag.ply"},
 "groups": {
  "pair": [{"object": "flag"},
           {"object": "flag", "matrix": [[-1.2, 0.9, 0, 4], [0.9, 1.2, 0, 0.5], [0, 0, 1.5, 1]]}],
  "four": [{"object": "pair"}, {"object": "pair", "matrix": [[1,0,0,0],[0,1,0,3],[0,0,1,0.1]]}]},
 "scene": "four"
})";

void write_flags(const Workbench& bench) {
    write_ply(bench / "flag.ply", {.vertices = {{0, 0, 0}, {2, 0, 0.25f}, {0, 1, 0}, {2, 1, 0}},
                                   .faces = {{0, 1, 2}, {3, 2, 1}}});
    write_file(bench / "flags.json", flags);
}

Command naming(const Workbench& bench) {
    return lab.with("--instances", bench / "flags.json").with("--repeat 1 --size 64x48");
}

}  // namespace

TEST_CASE("instances give the flattened mesh's answers, and every structure agrees") {
    const Workbench bench;
    write_flags(bench);
    for (const char* rays : {"", "--diffuse 500"})
        for (const char* query : {"closest", "any"}) {
            const Ended ended = run(naming(bench).with(rays).with("--query").with(query).with(
                "--flatten --check --structure default,naive --json -"));
            INFO(ended.err);
            REQUIRE(ended.code == 0);
            const auto json = nlohmann::json::parse(ended.out);
            CHECK(json["mesh"]["triangles"] == 8);
            CHECK(json["mesh"]["objects"] == 3);
            CHECK(json["mesh"]["instances"] == 4);
            CHECK(json["mesh"]["degenerate"] == 0);
            CHECK(json["mesh"]["vertices"].is_null());
            CHECK(json["mesh"]["file"] == (bench / "flags.json").string());
            for (const auto& structure : json["structures"]) {
                CHECK(structure["check"]["disagreements"] == 0);
                CHECK(structure["hits"] == json["structures"][0]["hits"]);
            }
            CHECK(json["structures"][0]["hits"] > (*rays ? 0 : 300));
        }
}

TEST_CASE("a hits file of instances counts triangles in 64 bits, in the graph's order") {
    const Workbench bench;
    write_flags(bench);
    const Command hits = naming(bench).with("--hits", bench / "hits").with("--structure");
    REQUIRE(run(hits.with("bvh-instanced")).code == 0);
    const std::vector<HitRecord> answers = read_hits<std::uint64_t>(bench / "hits");
    REQUIRE(answers.size() == 64 * 48);
    CHECK(read_file(bench / "hits").size() == 64 * 48 * 20);
    REQUIRE(run(hits.with("naive --flatten")).code == 0);
    CHECK(read_hits<std::uint64_t>(bench / "hits") == answers);
    std::array<int, 8> seen{};
    for (const HitRecord& hit : answers)
        if (hit.is_hit()) ++seen.at(hit.triangle);
    CHECK(std::ranges::count(seen, 0) == 0);
    REQUIRE(run(hits.with("bvh-instanced --query any")).code == 0);
    const std::vector<HitRecord> any = read_hits<std::uint64_t>(bench / "hits");
    for (std::size_t i = 0; i < any.size(); ++i)
        CHECK(any[i] == HitRecord::any(answers[i].is_hit()));

    const SceneGraph graph = nested_sphereflake(9);
    REQUIRE(run(lab.with("--instances sphereflake:9 --size 20x15 --repeat 1 --hits")
                    .with(bench / "hits")
                    .with("--structure bvh-instanced"))
                .code == 0);
    std::uint64_t largest = 0;
    for (const HitRecord& hit : read_hits<std::uint64_t>(bench / "hits"))
        if (hit.is_hit()) largest = std::max(largest, hit.triangle);
    CHECK(largest > 0xFFFFFFFF);
    CHECK(largest < graph.triangle_count());
}

TEST_CASE("without --flatten those are measured that know instances, and others are refused") {
    const Workbench bench;
    write_flags(bench);
    const auto names = [&](const char* structures) {
        const Ended ended = run(naming(bench).with("--json - --structure").with(structures));
        INFO(ended.err);
        CHECK(ended.code == 0);
        std::string all;
        const auto json = nlohmann::json::parse(ended.out);
        for (const auto& structure : json["structures"])
            all += structure["structure"].get<std::string>() + " ";
        return all;
    };
    CHECK(names("default") == "bvh-instanced ");
    CHECK(names("all") == "bvh-instanced bvh-instanced-local ");
    CHECK(names("default --flatten").starts_with("naive bsp "));
    const auto refused = [&](const Command& command, int code, const std::string& told) {
        const Ended ended = run(command);
        INFO(command.text() << ": " << ended.err);
        CHECK(ended.code == code);
        CHECK(ended.err.starts_with("lab: "));
        CHECK(std::ranges::count(ended.err, '\n') == 1);
        CHECK(ended.err.find(told) != std::string::npos);
        CHECK(ended.out.empty());
    };
    const Command some = naming(bench);
    refused(some.with("--structure bsp"), 2, "--structure bsp: it takes triangles");
    refused(some.with("--structure bvh-instanced,bvh-binned"), 2, "bvh-binned: it takes triangles");
    refused(some.with("--check"), 2, "--check: naive tracing needs triangles: add --flatten");
    refused(some.with("--flatten --max-references 7"), 2, "8 triangles, more than");
    refused(some.with("--scene soup"), 2, "--scene");
    refused(some.with("--mesh", bench / "flag.ply"), 2, "--mesh");
    refused(lab.with("--scene soup --flatten"), 2, "--flatten");
    refused(lab.with("--instances").with_word(""), 2, "--instances");
    refused(lab.with("--instances flakes"), 2, "flakes");
    refused(lab.with("--instances tetra:x"), 2, "tetra");
    refused(lab.with("--instances sphereflake:7 --flatten"), 2, "1721868800 triangles, more than");
    refused(lab.with("--instances", bench / "none.json"), 3, "none.json");
    write_file(bench / "broken.json", "{\n \"scene\": garden}");
    refused(lab.with("--instances", bench / "broken.json"), 3, "broken.json:2: ");
    write_file(bench / "circle.json",
               R"({"groups": {"a": [{"object": "b"}], "b": [{"object": "a"}]}, "scene": "a"})");
    refused(lab.with("--instances", bench / "circle.json"), 3, "a group holds itself");
    refused(some.with("--json", bench / "flags.json"), 2, "this is an input");
    refused(some.with("--hits", bench / "flag.ply").with("--structure bvh-instanced"), 2,
            "this is an input");
}

#ifndef BOOK_SANITIZED  // whose shadow memory is larger
TEST_CASE("more than 10^9 triangles are traced where no more than 1 GB can be had") {
    const Command limited = Command{.words = {"bash", "-c"}}
                                .with_word("ulimit -v 1000000; exec \"$@\"")
                                .with_word("bash");
    for (const char* scene : {"forest:320", "sphereflake:10", "tetra:14", "jacks:8"}) {
        const Ended ended = run(
            limited.with(lab)
                .with("--instances")
                .with(scene)
                .with("--size 32x24 --repeat 1 --threads 2 --structure bvh-instanced --json -"));
        INFO(scene << ended.err);
        REQUIRE(ended.code == 0);
        const auto json = nlohmann::json::parse(ended.out);
        CHECK(json["mesh"]["triangles"] > 1'000'000'000);
        CHECK(json["structures"][0]["hits"] > 10);
    }
    // The limit holds: 36 bytes a triangle are too many.
    CHECK(run(limited.with(lab).with("--instances sphereflake:6 --flatten --structure naive "
                                     "--repeat 1 --size 4x3 --max-references 1000000000"))
              .code != 0);
}
#endif

TEST_CASE("a scene graph of nothing is traced, and its rays miss") {
    const Workbench bench;
    write_file(bench / "nothing.json", R"({"groups": {"a": []}, "scene": "a"})");
    const Ended ended = run(lab.with("--instances", bench / "nothing.json")
                                .with("--repeat 1 --size 4x3 --flatten --check"));
    INFO(ended.err);
    CHECK(ended.code == 0);
    CHECK(ended.out.find("0 triangles by 0 instances of 1 object") != std::string::npos);
}

TEST_CASE("what the reader of an instance's mesh remarks goes to standard error") {
    const Workbench bench;
    write_file(bench / "flag.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n");
    write_file(bench / "one.json", R"({"meshes": {"m": "flag.obj"}, "scene": "m"})");
    const Ended ended =
        run(lab.with("--instances", bench / "one.json").with("--repeat 1 --size 4x3"));
    CHECK(ended.code == 0);
    CHECK(ended.err.starts_with("lab: note: "));
    CHECK(ended.err.find("flag.obj: 1 statement skipped") != std::string::npos);
}
