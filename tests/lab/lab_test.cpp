// The lab from outside, as a program that reads and writes files, and its parts from inside.
#include "chapters/ch12_comparison/lab.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "chapters/ch12_comparison/check.hpp"
#include "common/mesh.hpp"
#include "common/program/file.hpp"
#include "common/random.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"
#include "tests/lab/files.hpp"
#include "tests/lab/process.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>

using namespace space;

namespace {

const Command lab{.words = {LAB_PROGRAM, "lab"}};
const Command broken_lab{.words = {BROKEN_LAB_PROGRAM}};

/// Another triangle test than the exact one, which under sanitizers is alone in the lab.
using OtherTest = std::conditional_t<is_sanitized, FilteredExact, MollerTrumboreFloat>;
const std::string other_test = is_sanitized ? "" : " --triangle-test moller-trumbore-float";

/// Options of every run that measures: nobody looks at the times.
Command files(const Workbench& bench, const char* mesh) {
    return Command{}.with("--mesh", bench / mesh).with("--rays", bench / "rays").with("--repeat 1");
}

/// `count` right triangles in the plane z = 0, of legs 1, at (2 i, 0, 0).
TriangleMesh row_of_triangles(std::uint32_t count) {
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point3 corner(2.0f * static_cast<float>(i), 0.0f, 0.0f);
        mesh.vertices.insert(mesh.vertices.end(),
                             {corner, corner + Vector3(1, 0, 0), corner + Vector3(0, 1, 0)});
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

/// Straight down on triangle i of the row, from height 1, hit at u = v = 0.25.
Ray ray_down(std::uint32_t i) {
    return {.origin = {2.0f * static_cast<float>(i) + 0.25f, 0.25f, 1.0f},
            .direction = {0.0f, 0.0f, -1.0f}};
}

/// Triangles of very different sizes, in and about the unit cube.
TriangleMesh soup(std::uint32_t count) {
    Pcg32 random(11);
    TriangleMesh mesh;
    const auto point = [&] { return random_point(random, 0.0f, 1.0f); };
    for (std::uint32_t i = 0; i < count; ++i) {
        const float size = std::ldexp(1.0f, -static_cast<int>(random.below(6)));
        const Point3 corner = point();
        mesh.vertices.insert(mesh.vertices.end(),
                             {corner, corner + size * point(), corner + size * point()});
        mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

std::vector<Ray> random_rays(std::size_t count) {
    Pcg32 random(12);
    const auto point = [&] { return random_point(random, 0.0f, 1.0f); };
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = 3.0f * point() - 1.0f;
        const float scale = std::ldexp(1.0f, static_cast<int>(random.below(9)) - 4);
        ray.direction = scale * (point() - ray.origin);
        if (random.below(4) == 0) ray.tmin = random.uniform();
        if (random.below(4) == 0) ray.tmax = ray.tmin + random.uniform();
    }
    return rays;
}

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("each record of a hits file is the naive answer to its ray") {
    const Workbench bench;
    const TriangleMesh mesh = soup(200);
    write_ply(bench / "soup.ply", mesh);
    const std::vector<Ray> rays = random_rays(2000);
    write_rays(bench / "rays", rays);
    const auto naive = Naive<FilteredExact>::build(mesh.triangles());
    const auto by_other = Naive<OtherTest>::build(mesh.triangles());

    const Command naive_lab =
        lab.with(files(bench, "soup.ply")).with("--hits", bench / "hits").with("--structure naive");
    REQUIRE(run(naive_lab.with(other_test)).code == 0);
    const std::vector<HitRecord> other_hits = read_hits(bench / "hits");
    REQUIRE(other_hits.size() == rays.size());
    REQUIRE(run(naive_lab.with("--query closest")).code == 0);
    const std::vector<HitRecord> closest = read_hits(bench / "hits");
    REQUIRE(run(naive_lab.with("--query any")).code == 0);
    const std::vector<HitRecord> any = read_hits(bench / "hits");
    REQUIRE(closest.size() == rays.size());
    REQUIRE(any.size() == rays.size());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::optional<Hit> hit = closest_hit(naive, rays[i]);
        hits += hit.has_value();
        const HitRecord expected = hit ? HitRecord{hit->t, hit->u, hit->v, hit->triangle}
                                       : HitRecord{infinity, 0.0f, 0.0f, HitRecord::no_triangle};
        CHECK(closest[i] == expected);
        CHECK(other_hits[i] == HitRecord::closest(closest_hit(by_other, rays[i])));
        CHECK(any[i] == (hit ? HitRecord{0.0f, 0.0f, 0.0f, HitRecord::some_triangle} : expected));
    }
    CHECK((other_hits == closest) == is_sanitized);
    CHECK(hits > 200);  // the rays are worth asking
    CHECK(hits < 1800);
}

TEST_CASE("t is in units of the direction, and the interval is closed") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(1));
    Ray twice = ray_down(0), short_of = ray_down(0), just_so = ray_down(0),
        from_there = ray_down(0);
    twice.direction *= 2.0f;
    short_of.tmax = std::nextafter(1.0f, 0.0f);
    just_so.tmax = 1.0f;
    from_there.tmin = 1.0f;
    write_rays(bench / "rays", std::array{twice, short_of, just_so, from_there});
    REQUIRE(run(lab.with(files(bench, "row.ply"))
                    .with("--hits", bench / "hits")
                    .with("--structure naive"))
                .code == 0);
    const std::vector<HitRecord> hits = read_hits(bench / "hits");
    REQUIRE(hits.size() == 4);
    CHECK(hits[0] == HitRecord{0.5f, 0.25f, 0.25f, 0});
    CHECK(!hits[1].is_hit());
    CHECK(hits[2] == HitRecord{1.0f, 0.25f, 0.25f, 0});
    CHECK(hits[3] == HitRecord{1.0f, 0.25f, 0.25f, 0});
}

TEST_CASE("rays that are not valid are counted misses") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(1));
    const float nan = std::nanf("");
    std::vector<Ray> rays(7, ray_down(0));
    rays[1].origin.x = nan;
    rays[2].direction.z = nan;
    rays[3].tmin = nan;
    rays[4].tmax = -1.0f;
    rays[5].direction = Vector3(0.0f);
    rays[6].direction.x = infinity;
    write_rays(bench / "rays", rays);
    for (const char* query : {"closest", "any"}) {
        const Ended ended = run(lab.with(files(bench, "row.ply"))
                                    .with("--hits", bench / "hits")
                                    .with("--structure naive --check --query")
                                    .with(query));
        CHECK(ended.code == 0);
        CHECK(ended.out.find("7 rays, 6 of them not valid") != std::string::npos);
        const std::vector<HitRecord> hits = read_hits(bench / "hits");
        CHECK(hits[0].is_hit());
        for (std::size_t i = 1; i < hits.size(); ++i)
            CHECK(hits[i] == HitRecord{infinity, 0.0f, 0.0f, HitRecord::no_triangle});
    }
}

TEST_CASE("hits have the same bytes for any number of threads") {
    const Workbench bench;
    write_ply(bench / "soup.ply", soup(300));
    write_rays(bench / "rays", random_rays(1000));
    for (const Command& source :
         {Command{}.with("--rays", bench / "rays"), Command{}.with("--size 40x30"),
          Command{}.with("--size 40x30 --diffuse 1000 --seed 3")})
        for (const char* query : {"closest", "any"}) {
            std::map<int, std::string> bytes;
            for (const int threads : {1, 2, 7}) {
                REQUIRE(run(lab.with("--mesh", bench / "soup.ply")
                                .with(source)
                                .with("--hits", bench / "hits")
                                .with(fmt::format("--structure naive --query {} --repeat 1 "
                                                  "--threads {}",
                                                  query, threads)))
                            .code == 0);
                bytes[threads] = read_file(bench / "hits");
            }
            CHECK(bytes[1].size() >= 1000 * 16);
            CHECK(bytes[1] == bytes[2]);
            CHECK(bytes[1] == bytes[7]);
        }
}

TEST_CASE("diffuse rays leave the hit surfaces on the camera's side with the cosine's mean") {
    const TriangleMesh mesh = soup(100);
    const std::vector<Triangle> triangles = mesh.triangles();
    const Naive<> naive = Naive<>::build(triangles);
    const std::vector<Ray> camera =
        camera_rays({Camera{.eye = {0.5f, 0.5f, 4.0f}, .target = Point3(0.5f)}, 64, 64});
    std::vector<HitRecord> hits(camera.size());
    trace<NoCounts>(naive, {camera, hits});
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].is_hit()) starts.push_back(i);
    REQUIRE(starts.size() > 500);

    constexpr std::size_t count = 20'000;
    const auto triangle_at = [&](std::uint64_t i) { return triangles[i]; };
    const std::vector<Ray> rays = diffuse_rays(triangle_at, camera, hits, count, 5);
    REQUIRE(rays.size() == count);
    CHECK(diffuse_rays(triangle_at, camera, hits, count, 6).front().direction !=
          rays.front().direction);
    double sum_of_cosines = 0.0;
    std::size_t self_hits = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t start = starts[i * starts.size() / count];
        const Triangle& triangle = triangles[hits[start].triangle];
        Double3 n = glm::normalize(normal(triangle));
        if (glm::dot(n, Double3(camera[start].direction)) > 0.0) n = -n;
        const double cosine = glm::dot(n, Double3(rays[i].direction));
        CHECK(cosine >=
              -1e-6);  // a direction of length 1, its three coordinates rounded to float: 3 * 2^-24
        CHECK(glm::length(Double3(rays[i].direction)) == Approx(1.0).margin(1e-6));
        sum_of_cosines += cosine;
        self_hits += MollerTrumbore::intersect(rays[i], triangle).has_value();
    }
    CHECK(self_hits == 0);
    // The cosine has mean 2/3 and variance 1/2 - 4/9 = 1/18; four standard deviations of the mean
    // of 20,000.
    CHECK(std::abs(sum_of_cosines / count - 2.0 / 3.0) < 4.0 * std::sqrt(1.0 / 18.0 / count));
    CHECK(diffuse_rays(triangle_at, camera,
                       std::vector<HitRecord>(camera.size(), HitRecord::any(false)), 10, 1)
              .empty());
}

TEST_CASE("the JSON file has exactly the documented members, in order, and true counts") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(40));
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < 500; ++i)
        rays.push_back(ray_down(i));  // those after the first forty miss
    write_rays(bench / "rays", rays);
    REQUIRE(run(lab.with(files(bench, "row.ply"))
                    .with("--json", bench / "json")
                    .with("--structure naive,naive --query closest --threads 2 --build-threads 2 "
                          "--check --against naive --max-references 77"))
                .code == 0);
    const auto json = nlohmann::ordered_json::parse(read_file(bench / "json"));
    const auto keys = [](const nlohmann::ordered_json& object) {
        std::string names;
        for (const auto& [key, value] : object.items()) names += key + " ";
        return names;
    };
    CHECK(keys(json) == "version machine mesh query against limits structures ");
    CHECK(json["version"] == 3);
    CHECK(json["machine"].is_string());
    CHECK(json["query"] == "closest");
    CHECK(json["mesh"] == nlohmann::ordered_json{{"name", "row"},
                                                 {"file", (bench / "row.ply").string()},
                                                 {"vertices", 120},
                                                 {"triangles", 40},
                                                 {"degenerate", 0},
                                                 {"objects", nullptr},
                                                 {"instances", nullptr}});
    CHECK(json["against"] == "naive");
    CHECK(json["limits"] ==
          nlohmann::ordered_json{{"references", 77}, {"placements", 100'000'000}});
    REQUIRE(json["structures"].size() == 2);
    CHECK(json["structures"][0]["build_ratio"] == 1.0);
    CHECK(json["structures"][0]["trace_ratio"] == 1.0);
    for (const auto& structure : json["structures"]) {
        CHECK(keys(structure) ==
              "structure home triangle_test configuration gave_up build_ms trace_ms rays_per_s "
              "build_ratio trace_ratio rays hits nodes leaves depth references bytes sah_cost "
              "node_visits triangle_tests threads build_threads check ");
        CHECK(structure["home"] == "chapter 1");
        CHECK(structure["triangle_test"] == "filtered-exact");
        CHECK(structure["build_ratio"].is_number());
        CHECK(structure["trace_ratio"].is_number());
        CHECK(keys(structure["check"]) ==
              "rays disagreements naive_wrong right equal_t t_off other_triangle missed "
              "false_hits ");
        CHECK(structure["check"]["rays"] == 500);
        CHECK(structure["check"]["disagreements"] == 0);
        CHECK(structure["check"]["right"] == 500);
        CHECK(structure["structure"] == "naive");
        for (const char* time : {"build_ms", "trace_ms", "rays_per_s"})
            CHECK(structure[time].is_number());
        for (const char* none :
             {"configuration", "gave_up", "nodes", "leaves", "depth", "sah_cost", "node_visits"})
            CHECK(structure[none].is_null());
        CHECK(structure["rays"] == 500);
        CHECK(structure["hits"] == 40);
        CHECK(structure["references"] == 40);
        CHECK(structure["bytes"] >= 40 * sizeof(Triangle));
        CHECK(structure["triangle_tests"] == 500 * 40);
        CHECK(structure["threads"] == 2);
        CHECK(structure["build_threads"] == 1);  // naive tracing builds nothing
    }
}

TEST_CASE("--check finds a broken structure, names each ray and exits with 1") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(40));
    std::vector<Ray> rays;
    for (std::uint32_t i = 0; i < 40; ++i) rays.push_back(ray_down(i));
    rays.push_back(ray_down(7));
    write_rays(bench / "rays", rays);
    const Command broken = broken_lab.with(files(bench, "row.ply"));

    const Ended closest = run(broken.with("--structure naive,broken --check"));
    CHECK(closest.code == 1);
    CHECK(
        closest.out.find("ray 7: naive triangle 7 at t = 1 (u = 0.25, v = 0.25), broken none\n") !=
        std::string::npos);
    CHECK(
        closest.out.find("ray 40: naive triangle 7 at t = 1 (u = 0.25, v = 0.25), broken none\n") !=
        std::string::npos);
    CHECK(closest.out.find("2 disagreements") != std::string::npos);
    CHECK(closest.out.find("ray 8:") == std::string::npos);

    const Ended any = run(broken.with("--structure broken --check --query any"));
    CHECK(any.code == 1);
    CHECK(any.out.find("ray 7: naive hit, broken none\n") != std::string::npos);

    CHECK(run(broken.with("--structure naive --check")).code == 0);
    CHECK(run(broken.with("--structure broken")).code == 0);  // nobody asked
}

TEST_CASE("a disagreement is any difference of the records' bits") {
    const std::vector<HitRecord> trusted{{1.0f, 0.0f, 0.0f, 3},
                                         {1.0f, 0.5f, 0.5f, 3},
                                         HitRecord::closest({}),
                                         {std::nanf(""), 0, 0, 1}};
    std::vector<HitRecord> other = trusted;
    const std::vector<std::size_t> indices{4, 5, 9, 10};
    CHECK(differences(trusted, {"naive", trusted}, {"tree", other}, indices).lines.empty());
    other[0].triangle = 2;
    other[1].t = std::nextafter(1.0f, 2.0f);
    other[2] = {2.5f, 0.0f, 0.0f, 1};
    const Differences found = differences(trusted, {"naive", trusted}, {"tree", other}, indices);
    CHECK(found.lines ==
          std::vector<std::string>{"ray 4: naive triangle 3 at t = 1 (u = 0, v = 0), tree triangle "
                                   "2 at t = 1 (u = 0, v = 0)",
                                   "ray 5: naive triangle 3 at t = 1 (u = 0.5, v = 0.5), tree "
                                   "triangle 3 at t = 1.0000001 (u = 0.5, v = 0.5)",
                                   "ray 9: naive none, tree triangle 1 at t = 2.5 (u = 0, v = 0)"});
    CHECK(found.naive_wrong == 0);
}

TEST_CASE("a difference is excused only where the naive answer is another than the exact one") {
    const HitRecord miss = HitRecord::closest({}), hit{1.0f, 0.5f, 0.25f, 3},
                    farther{2.0f, 0.5f, 0.25f, 4}, twin{1.0f, 0.0f, 0.25f, 4};
    HitRecord rounded = hit;
    rounded.t = 1.00001f;
    struct Case {
        HitRecord exact, naive, other;
        bool excused;
    };
    const Case cases[] = {
        {hit, miss, hit, true},       // naive missed
        {miss, hit, miss, true},      // naive hit beside the triangle
        {hit, farther, hit, true},    // naive took the triangle behind
        {hit, farther, miss, true},   // both are wrong
        {hit, rounded, miss, false},  // naive's t is rounded: no reason to miss
        {hit, twin, miss, false},     // naive took the twin at the same place
        {hit, hit, miss, false},     {miss, miss, hit, false},
    };
    for (const Case& c : cases) {
        const std::vector<HitRecord> naive{c.naive}, other{c.other}, exact{c.exact};
        const Differences found =
            differences(exact, {"naive", naive}, {"tree", other}, std::vector<std::size_t>{0});
        CHECK(found.naive_wrong == (c.excused ? 1 : 0));
        CHECK(found.lines.size() == (c.excused ? 0 : 1));
    }
}

TEST_CASE("an answer relates to the exact one in one of six ways") {
    const HitRecord miss = HitRecord::closest({}), hit{1.0f, 0.5f, 0.25f, 3};
    const auto at = [](float t, std::uint32_t triangle) { return HitRecord{t, 0, 0, triangle}; };
    const float next = std::nextafter(1.0f, 2.0f), second = std::nextafter(next, 2.0f);
    CHECK(relation(miss, miss) == Relation::right);
    CHECK(relation(hit, hit) == Relation::right);
    CHECK(relation(hit, at(next, 3)) == Relation::right);
    CHECK(relation(hit, at(second, 3)) == Relation::t_off);
    CHECK(relation(hit, at(std::nanf(""), 3)) == Relation::t_off);
    CHECK(relation(hit, at(next, 4)) == Relation::equal_t);
    CHECK(relation(hit, at(second, 4)) == Relation::other_triangle);
    CHECK(relation(hit, miss) == Relation::missed);
    CHECK(relation(miss, hit) == Relation::false_hit);
    CHECK(relation(HitRecord::any(true), HitRecord::any(true)) == Relation::right);
    CHECK(relations(std::vector{hit, miss, miss}, std::vector{miss, hit, hit}) ==
          std::array<std::size_t, relation_count>{0, 0, 0, 0, 1, 2});
}

TEST_CASE("a sample to check has one ray of each equal part, and all rays below the limit") {
    CHECK(check_sample(100, 10, 1, 1000).size() == 100);
    CHECK(check_sample(100, 10, 1, 1000).back() == 99);
    const std::vector<std::size_t> sample = check_sample(1000, 10, 1, 700);
    REQUIRE(sample.size() == 70);
    for (std::size_t i = 0; i < 70; ++i) {
        CHECK(sample[i] >= i * 1000 / 70);
        CHECK(sample[i] < (i + 1) * 1000 / 70);
    }
    CHECK(check_sample(1000, 10, 1, 700) == sample);
    CHECK(check_sample(1000, 10, 2, 700) != sample);
    CHECK(check_sample(1000, 5000, 1, 700).size() == 1);  // never none
}

TEST_CASE("without --structure one of each chapter is measured; all and list name them all") {
    const auto names = [](const std::string& options) {
        const Ended ended =
            run(lab.with("--scene soup:50 --size 4x3 --repeat 1 --json -").with(options));
        CHECK(ended.code == 0);
        std::string all;
        const auto json = nlohmann::json::parse(ended.out);
        for (const auto& structure : json["structures"])
            all += structure["structure"].get<std::string>() + " ";
        return all;
    };
    std::string first_of_each;
    std::string_view home;
    for (const Structure& structure : structures()) {
        if (structure.home != home) first_of_each += std::string(structure.name) + " ";
        home = structure.home;
    }
    CHECK(first_of_each.starts_with("naive bsp "));
    CHECK(names("") == first_of_each);
    CHECK(names("--structure bsp-free,default" + other_test) == "bsp-free " + first_of_each);
    std::string every;
    for (const Structure& structure : structures()) every += std::string(structure.name) + " ";
    CHECK(names("--structure all" + other_test) == every);

    CHECK(structures().front().name == "naive");
    const Ended list = run(lab.with("--structure list"));
    CHECK(list.code == 0);
    const std::string listed = with_single_blanks(list.out);
    for (const char* line : {"naive chapter 1 yes ", "bsp chapter 3 yes ", "bsp-free chapter 3 as ",
                             "peers left out: "})
        CHECK(listed.find(line) != std::string::npos);
    const Ended tests = run(lab.with("--triangle-test list"));
    CHECK(tests.code == 0);
    for (const StructureVariant& variant : structures().back().variants)
        CHECK(tests.out.find(variant.triangle_test) != std::string::npos);
    CHECK(structures().back().variants.front().triangle_test == "filtered-exact");
    const Ended scenes = run(lab.with("--scene list"));
    CHECK(scenes.code == 0);
    for (const SceneRecipe& recipe : scene_recipes())
        CHECK(scenes.out.find(fmt::format("\n{} ", recipe.name)) != std::string::npos);
}

TEST_CASE("what ./book lab --help shows before the lab is built is the lab's own help") {
    const std::string kept = read_file(book_root() / "chapters/ch12_comparison/lab_help.txt");
    const Ended help = run(lab.with("--help"));
    REQUIRE(help.code == 0);
    // Versions of CLI11 set lines differently: the options' names and all that is below them count.
    const auto options = [](const std::string& text) {
        std::istringstream stream(text);
        std::set<std::string> names;
        for (std::string word; stream >> word;)
            if (word.starts_with("--")) names.insert(word);
        return names;
    };
    INFO("build/release/bin/ch12_comparison lab --help > chapters/ch12_comparison/lab_help.txt");
    CHECK(options(kept) == options(help.out));
    CHECK(kept.substr(kept.find("\nFiles\n")) == help.out.substr(help.out.find("\nFiles\n")));
}

TEST_CASE(
    "a structure that gives up leaves the others' results, says why, and the exit code is 1") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(40));
    write_rays(bench / "rays", std::array{ray_down(3), ray_down(4)});
    const auto gave_up = [&](const Command& command, const std::string& name) {
        const Ended ended = run(command.with("--json", bench / "json"));
        INFO(ended.out << ended.err);
        CHECK(ended.code == 1);
        const auto json = nlohmann::json::parse(read_file(bench / "json"));
        std::string why;
        for (const auto& structure : json["structures"]) {
            if (structure["structure"] == name) {
                why = structure["gave_up"];
                for (const char* none : {"build_ms", "trace_ms", "rays_per_s", "build_ratio",
                                         "trace_ratio", "hits", "references", "bytes", "check"})
                    CHECK(structure[none].is_null());
            } else {
                CHECK(structure["gave_up"].is_null());
                CHECK(structure["hits"] == 2);
            }
        }
        CHECK(!why.empty());
        CHECK(ended.out.find(why) != std::string::npos);
        CHECK(ended.out.find("--max-references ") != std::string::npos);
        return why;
    };
    const Command all = broken_lab.with(files(bench, "row.ply")).with("--check");
    CHECK(gave_up(all.with("--structure naive,no-memory,naive --against naive"), "no-memory") ==
          "out of memory");
    CHECK(gave_up(all.with("--structure naive,no-trace,naive"), "no-trace") == "no way through");
    CHECK(run(all.with("--structure no-memory --against no-memory")).code == 1);
    CHECK(run(all.with("--structure no-memory --hits").with(bench / "hits")).code == 1);
    CHECK(!std::filesystem::exists(bench / "hits"));

    const Command limited = lab.with(files(bench, "row.ply")).with("--structure naive,bsp --check");
    CHECK(run(limited).code == 0);
    CHECK(gave_up(limited.with("--max-references 39"), "bsp").find("39") != std::string::npos);
    CHECK(run(limited.with("--max-references 40")).code == 0);
    CHECK(gave_up(limited.with("--max-placements 39"), "bsp").find("39") != std::string::npos);
    // Diffuse rays start where an earlier chapter's structure says, if the latest gives up.
    const Command diffuse =
        lab.with("--mesh", bench / "row.ply")
            .with("--structure naive --repeat 1 --size 40x30 --diffuse 50 --hits")
            .with(bench / "hits");
    REQUIRE(run(diffuse).code == 0);
    const std::string hits = read_file(bench / "hits");
    REQUIRE(run(diffuse.with("--max-references 39")).code == 0);
    CHECK(read_file(bench / "hits") == hits);
}

TEST_CASE("wrong input gets one clear line and its exit code, and leaves no file") {
    const Workbench bench;
    const Command mesh = Command{}.with("--mesh", bench / "row.ply");
    write_ply(bench / "row.ply", row_of_triangles(3));
    write_file(bench / "33 bytes", std::string(33, 'x'));
    write_file(bench / "empty", "");
    write_file(bench / "a file", "");
    write_rays(bench / "rays", std::array{ray_down(0)});
    const Command rays = mesh.with("--rays", bench / "rays");
    const Command outputs = Command{}.with("--hits", bench / "hits").with("--json", bench / "json");
    struct Wrong {
        Command arguments;
        int code;
        std::string_view names;  ///< what the line must name
    };
    const std::vector<Wrong> wrongs{
        {mesh.with("--structure bvh,naive"), 2, "bvh"},
        {mesh.with("--structure").with_word(""), 2,
         "--structure: the name of a structure is missing"},
        {mesh.with("--structure naive,"), 2, "--structure: the name of a structure is missing"},
        {mesh.with("--triangle-test none"), 2, "none"},
        {mesh.with("--query nearest"), 2, "--query"},
        {{}, 2, "--mesh"},
        {mesh.with("--scene soup"), 2, "--scene"},
        {Command{}.with("--scene no_such_scene"), 2, "no_such_scene"},
        {Command{}.with("--mesh", bench / "missing.ply"), 3, "missing.ply"},
        {mesh.with("--rays", bench / "missing"), 3, "missing"},
        {mesh.with("--rays", bench / "33 bytes"), 3, "33 bytes"},
        {mesh.with("--rays", bench / "empty"), 3, "no ray"},
        {rays.with("--diffuse 10"), 2, "--diffuse"},
        {rays.with("--camera 0,0,1,0,0,0,45"), 2, "--camera"},
        {rays.with("--size 4x3"), 2, "--size"},
        {mesh.with("--diffuse 0"), 2, "--diffuse"},
        {mesh.with("--diffuse -5"), 2, "--diffuse -5"},
        {mesh.with("--diffuse 1e3"), 2, "--diffuse 1e3"},
        {mesh.with("--camera 0,0,9,0,0,8,45,0"), 2, "--camera"},
        {mesh.with("--camera 0,0,9,0,0,8"), 2, "--camera"},
        {mesh.with("--camera nan,0,9,0,0,8,45"), 2, "nan"},
        {mesh.with("--camera 1e99,0,9,0,0,8,45"), 2, "1e99"},
        {mesh.with("--camera 0,0,9x,0,0,8,45"), 2, "9x"},
        {mesh.with("--camera 1,2,3,1,2,3,45"), 2, "eye"},
        {mesh.with("--camera 0,0,9,0,0,8,0"), 2, "field of view"},
        {mesh.with("--camera 0,0,9,0,0,8,180"), 2, "field of view"},
        {mesh.with("--camera 0,0,9,0,0,10,45 --diffuse 10"), 2, "--diffuse"},
        {mesh.with("--size 0x0"), 2, "--size"},
        {mesh.with("--size 16384x16384"), 2, "--size"},
        {mesh.with("--size 12"), 2, "--size"},
        {mesh.with("--threads 0"), 2, "--threads"},
        {mesh.with("--threads -1"), 2, "--threads"},
        {mesh.with("--threads 100000"), 2, "--threads"},
        {mesh.with("--build-threads 0"), 2, "--build-threads"},
        {mesh.with("--build-threads 1.5"), 2, "--build-threads 1.5"},
        {mesh.with("--repeat 0"), 2, "--repeat"},
        {mesh.with("--repeat -1"), 2, "--repeat -1"},
        {mesh.with("--repeat 0x3"), 2, "--repeat 0x3"},
        {mesh.with("--seed x"), 2, "--seed"},
        {mesh.with("--seed -1"), 2, "--seed -1"},
        {mesh.with("--no-such-option 1"), 2, "--no-such-option 1: there is no such option"},
        {mesh.with("--seed 1 --seed 2"), 2, "--seed: give it once"},
        {mesh.with("--structure naive --seed"), 2, "--seed: its value is missing"},
        {mesh.with("--structure naive,embree"), 2, "embree"},
        {mesh.with("--against bsp"), 2, "bsp"},
        {mesh.with("--max-references 0"), 2, "--max-references"},
        {mesh.with("--max-placements -1"), 2, "--max-placements -1"},
        {mesh.with("--camera 0,0,+-9,0,0,8,45"), 2, "'+-9' is not a number"},
        {mesh.with("--camera 0,0,,0,0,8,45"), 2, "'' is not a number"},
        {mesh.with("--camera 1e99,0,9,0,0,8,45"), 2, "'1e99' is not finite"},
    };
    for (const Wrong& wrong : wrongs) {
        INFO(wrong.arguments.text());
        const bool names_one = wrong.arguments.text().find("--structure") != std::string::npos;
        const Ended ended =
            run(lab.with(outputs).with(wrong.arguments).with(names_one ? "" : "--structure naive"));
        INFO(ended.err);
        CHECK(ended.code == wrong.code);
        CHECK(ended.err.starts_with("lab: "));
        CHECK(lines(ended.err) == 1);
        CHECK(ended.err.find(wrong.names) != std::string::npos);
        CHECK(!std::filesystem::exists(bench / "hits"));
        CHECK(!std::filesystem::exists(bench / "json"));
    }
    const Ended two =
        run(lab.with(rays).with("--structure naive,naive --hits").with(bench / "hits"));
    CHECK(two.code == 2);
    CHECK(two.err.find("--hits") != std::string::npos);
    CHECK(!std::filesystem::exists(bench / "hits"));
}

TEST_CASE("no output is an input or another output") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(3));
    write_rays(bench / "rays", std::array{ray_down(0)});
    std::filesystem::create_symlink(bench / "row.ply", bench / "link");
    std::filesystem::create_hard_link(bench / "rays", bench / "twin");
    const std::string mesh = read_file(bench / "row.ply"), rays = read_file(bench / "rays");
    const Command naive = lab.with(files(bench, "row.ply")).with("--structure naive");
    const auto refused = [&](const Command& command, std::string_view names) {
        const Ended ended = run(command);
        INFO(command.text() << ": " << ended.err);
        CHECK(ended.code == 2);
        CHECK(lines(ended.err) == 1);
        CHECK(ended.err.find(names) != std::string::npos);
        CHECK(ended.out.empty());
    };
    for (const char* output : {"--hits", "--json"})
        for (const char* file : {"row.ply", "rays", "link", "twin", "./row.ply"})
            refused(naive.with(output, bench / file), "this is an input");
    refused(naive.with("--hits", bench / "new").with("--json", bench / "./new"), "the same file");
    const Command there = Command{.words = {"bash", "-c"}}
                              .with_word("cd \"$1\" && exec \"${@:2}\"")
                              .with_word("bash")
                              .with(bench / ".");
    refused(there.with(naive).with("--hits new --json ./new"), "the same file");
    const Command scene = lab.with("--structure naive --size 4x3 --repeat 1");
    refused(scene.with("--scene", bench / "row.ply").with("--json", bench / "row.ply"), "input");
    refused(scene.with_word("--scene")
                .with_word("room:" + (bench / "row.ply").string())
                .with("--json", bench / "row.ply"),
            "input");
    for (const char* option : {"--hits", "--json", "--mesh", "--rays"})
        refused(lab.with("--scene soup:50 --structure naive").with(option).with_word(""), option);
    const Command fetched = Command{.words = {"env"}}
                                .with_word("BOOK_SCENES=" + (bench / "").string())
                                .with(scene)
                                .with("--scene forest");
    write_ply(bench / "forest.ply", row_of_triangles(3));
    refused(fetched.with("--json", bench / "forest.ply"), "input");
    refused(naive.with("--hits -"), "--hits -");
    CHECK(read_file(bench / "row.ply") == mesh);
    CHECK(read_file(bench / "rays") == rays);
    CHECK(!std::filesystem::exists(bench / "new"));
}

TEST_CASE("what is printed goes into no input and into no file of results") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(3));
    write_rays(bench / "rays", std::array{ray_down(0)});
    std::filesystem::create_hard_link(bench / "row.ply", bench / "twin");
    const std::string mesh = read_file(bench / "row.ply");
    const auto refused = [&](const Command& options, const char* redirection, const char* file) {
        const Command shell = Command{.words = {"bash", "-c"}}
                                  .with_word(std::string("\"${@:2}\" ") + redirection + " \"$1\"")
                                  .with_word("bash")
                                  .with(bench / file);
        const Ended ended = run(
            shell.with(lab).with(files(bench, "row.ply")).with("--structure naive").with(options));
        INFO(options.text() << redirection << file);
        CHECK(ended.code == 2);
    };
    for (const char* redirection : {">>", "2>>"}) {
        refused({}, redirection, "row.ply");
        refused({}, redirection, "twin");
        refused(Command{}.with("--json -"), redirection, "rays");
        for (const char* output : {"--hits", "--json"})
            refused(Command{}.with(output, bench / "out"), redirection, "out");
    }
    refused(Command{}.with("--json - --hits", bench / "out"), ">", "out");
    refused(Command{}.with("--hits /dev/stdout"), ">", "out");
    CHECK(read_file(bench / "row.ply").starts_with(mesh));
}

TEST_CASE("what the reader of the mesh remarks goes to standard error, a line each") {
    const Workbench bench;
    write_file(bench / "row.obj",
               "mg 1 0.5\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3 2\nl 1 2\n");
    const std::string file = (bench / "row.obj").string();
    const std::string told =
        "lab: note: " + file +
        ": 2 statements skipped, the first 'mg' in line 1\nlab: note: " + file +
        ": 1 face encloses nothing: left out\n";
    const Command naive = lab.with("--structure naive --repeat 1 --size 4x3");
    for (const Command& mesh :
         {Command{}.with("--mesh", bench / "row.obj"), Command{}.with("--scene", bench / "row.obj"),
          Command{}.with_word("--scene").with_word("room:" + file)}) {
        INFO(mesh.text());
        const Ended ended = run(naive.with(mesh).with("--json -"));
        CHECK(ended.code == 0);
        CHECK(ended.err.starts_with(told));
        CHECK(nlohmann::json::parse(ended.out)["version"] == 3);
        const Ended tables = run(naive.with(mesh));
        CHECK(tables.err == told);
        CHECK(tables.out.starts_with("mesh    "));
    }
    write_ply(bench / "row.ply", row_of_triangles(3));
    CHECK(run(naive.with("--mesh", bench / "row.ply")).err.empty());
}

TEST_CASE("--json - writes to standard output, and the tables go to standard error") {
    const Workbench bench;
    for (const char* where : {"-", "/dev/stdout", "/dev/fd/1"}) {
        const Ended ended =
            run(lab.with("--scene soup:50 --size 4x3 --structure naive --repeat 1 --check --json")
                    .with(where));
        CHECK(ended.code == 0);
        CHECK(nlohmann::json::parse(ended.out)["version"] == 3);
        CHECK(ended.err.find("mesh    soup: ") != std::string::npos);
        CHECK(ended.err.find("0 disagreements") != std::string::npos);
    }
    CHECK(!std::filesystem::exists("-"));
}

TEST_CASE(
    "a file that cannot be written is an error before anything is measured, or on a full "
    "disk after, and no part of it is left") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(3));
    write_rays(bench / "rays", random_rays(100));
    write_file(bench / "a file", "");
    const Command naive = lab.with(files(bench, "row.ply")).with("--structure naive");
    const auto count = [&] {
        const std::filesystem::directory_iterator all(bench / "");
        return std::distance(begin(all), end(all));
    };
    const auto before = count();
    const auto fails = [&](const Command& command, bool at_once) {
        INFO(command.text());
        const Ended ended = run(command);
        CHECK(ended.out.empty() == at_once);
        INFO(ended.err);
        CHECK(ended.code == 4);
        CHECK(ended.err.starts_with("lab: cannot "));
        CHECK(lines(ended.err) == 1);
        CHECK(count() == before);
    };
    // A full disk: no file may grow beyond a block of 512 bytes. (A full disk sends no signal; the
    // limit's is ignored.) What is printed needs another way out.
    const Command full_disk =
        Command{.words = {"bash", "-c"}}
            .with_word("trap '' XFSZ; set -o posix -o pipefail; (ulimit -f 1; exec \"$@\") | cat")
            .with_word("bash");
    for (const char* option : {"--hits", "--json"}) {
        fails(naive.with(option, bench / "a file/x"), true);  // in a file
        fails(naive.with(option, bench / ""), true);          // a directory
        fails(naive.with(option, bench / "new/x"), true);     // a mistyped directory is not made
        fails(naive.with(option).with("/dev/full"), true);    // no regular file
        fails(full_disk.with(naive.with(option, bench / "out")), false);
    }
    CHECK(std::filesystem::is_character_file("/dev/full"));
}

TEST_CASE("what cannot be printed is an error") {
    for (const char* options :
         {"--structure list", "--scene list", "--help", "--scene soup:50 --size 4x3 --repeat 1",
          "--scene soup:50 --size 4x3 --repeat 1 --json -"}) {
        const Ended ended = run(lab.with(options), "/dev/full");
        CHECK(ended.code == 4);
        CHECK(ended.err.find("lab: cannot write to standard output: No space left on device\n") !=
              std::string::npos);
    }
}

TEST_CASE("numbers of a camera may have a plus sign, and a camera that sees nothing gets a hint") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(1));
    const Command naive = lab.with("--mesh", bench / "row.ply")
                              .with("--structure naive --repeat 1 --size 4x3 --camera");
    const Ended sees = run(naive.with_word("+0.25, 0.25,+3,0.25,0.25,0,+20"));
    CHECK(sees.code == 0);
    CHECK(sees.out.find("3 vertices, 1 triangle, 0 degenerate") != std::string::npos);
    CHECK(sees.out.find("hint") == std::string::npos);
    const Ended blind = run(naive.with("0.25,0.25,3,0.25,0.25,4,20"));
    CHECK(blind.code == 0);
    CHECK(blind.out.find("hint    no camera ray hits the mesh, which lies between (0, 0, 0) and "
                         "(1, 1, 0)") != std::string::npos);
}

TEST_CASE("the default camera sees meshes at the ends of float and far from the origin") {
    const Workbench bench;
    struct Square {
        double half_side;
        Double3 centre;
    };
    for (const auto& [half, centre] :
         {Square{1.0, {0, 0, 0}}, Square{1e38, {0, 0, 0}}, Square{3.4e38, {0, 0, 0}},
          Square{1e37, {0, 0, 3.3e38}}, Square{0.005, {0, 0, 1e8}}, Square{0.005, {0, 0, -1e8}},
          Square{1e-5, {0, 0, 1}}, Square{1.0, {4e6, 5e5, 0}}}) {
        TriangleMesh square;
        square.faces = {{0, 1, 2}, {0, 2, 3}};
        for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            square.vertices.push_back(Point3(centre + half * Double3(x, y, 0)));
        write_ply(bench / "square.ply", square);
        const Ended ended = run(lab.with("--mesh", bench / "square.ply")
                                    .with("--structure naive --repeat 1 --size 16x12 --json -"));
        INFO(half << " at " << centre.z << ": " << ended.err);
        REQUIRE(ended.code == 0);
        CHECK(ended.err.find("not valid") == std::string::npos);
        const auto json = nlohmann::json::parse(ended.out);
        CHECK(json["structures"][0]["hits"] >= 16 * 12 / 5);
    }
}
