// The lab from outside, as a program that reads and writes files, and its parts from inside.
#include "chapters/ch12_comparison/lab.hpp"

#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "chapters/ch02_intersection_tests/filtered_exact.hpp"
#include "chapters/ch02_intersection_tests/moller_trumbore_float.hpp"
#include "common/mesh.hpp"
#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/lab/files.hpp"
#include "tests/lab/process.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>

using namespace space;

namespace {

const std::string lab = LAB_PROGRAM " lab ";
const std::string broken_lab = BROKEN_LAB_PROGRAM " ";

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
    const std::string files =
        fmt::format("--mesh {} --rays {} --hits {} --repeat 1", (bench / "soup.ply").string(),
                    (bench / "rays").string(), (bench / "hits").string());
    const auto naive = Naive<FilteredExact>::build(mesh.triangles());
    const auto in_float = Naive<MollerTrumboreFloat>::build(mesh.triangles());

    REQUIRE(run(lab + "--structure naive --triangle-test moller-trumbore-float " + files).code ==
            0);
    const std::vector<HitRecord> float_hits = read_hits(bench / "hits");
    REQUIRE(float_hits.size() == rays.size());
    REQUIRE(run(lab + "--structure naive --query closest " + files).code == 0);
    const std::vector<HitRecord> closest = read_hits(bench / "hits");
    REQUIRE(run(lab + "--structure naive --query any " + files).code == 0);
    const std::vector<HitRecord> any = read_hits(bench / "hits");
    REQUIRE(closest.size() == rays.size());
    REQUIRE(any.size() == rays.size());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const std::optional<Hit> hit = closest_hit(naive, rays[i]);
        hits += hit.has_value();
        const HitRecord expected = hit ? HitRecord{hit->t, hit->u, hit->v, hit->triangle}
                                       : HitRecord{infinity, 0.0f, 0.0f, 0xFFFFFFFF};
        CHECK(closest[i] == expected);
        CHECK(float_hits[i] == HitRecord::closest(closest_hit(in_float, rays[i])));
        CHECK(any[i] == (hit ? HitRecord{0.0f, 0.0f, 0.0f, 0xFFFFFFFE} : expected));
    }
    CHECK(float_hits != closest);
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
    REQUIRE(run(fmt::format("{} --mesh {} --rays {} --hits {} --structure naive", lab,
                            (bench / "row.ply").string(), (bench / "rays").string(),
                            (bench / "hits").string()))
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
        const Ended ended =
            run(fmt::format("{} --mesh {} --rays {} --hits {} --structure naive --check --query {}",
                            lab, (bench / "row.ply").string(), (bench / "rays").string(),
                            (bench / "hits").string(), query));
        CHECK(ended.code == 0);
        CHECK(ended.out.find("7 rays, 6 of them not valid") != std::string::npos);
        const std::vector<HitRecord> hits = read_hits(bench / "hits");
        CHECK(hits[0].is_hit());
        for (std::size_t i = 1; i < hits.size(); ++i)
            CHECK(hits[i] == HitRecord{infinity, 0.0f, 0.0f, 0xFFFFFFFF});
    }
}

TEST_CASE("hits have the same bytes for any number of threads") {
    const Workbench bench;
    write_ply(bench / "soup.ply", soup(300));
    write_rays(bench / "rays", random_rays(1000));
    const std::string rays = "--rays " + (bench / "rays").string();
    for (const std::string& source :
         {rays, std::string("--size 40x30"), std::string("--size 40x30 --diffuse 1000 --seed 3")})
        for (const char* query : {"closest", "any"}) {
            std::map<int, std::string> bytes;
            for (const int threads : {1, 2, 7}) {
                const std::string hits = (bench / "hits").string();
                REQUIRE(run(fmt::format("{} --mesh {} {} --structure naive --query {} --repeat 1 "
                                        "--threads {} --hits {}",
                                        lab, (bench / "soup.ply").string(), source, query, threads,
                                        hits))
                            .code == 0);
                bytes[threads] = read_file(hits);
            }
            CHECK(bytes[1].size() >= 1000 * sizeof(HitRecord));
            CHECK(bytes[1] == bytes[2]);
            CHECK(bytes[1] == bytes[7]);
        }
}

TEST_CASE("diffuse rays leave the hit surfaces on the camera's side with the cosine's mean") {
    const TriangleMesh mesh = soup(100);
    const std::vector<Triangle> triangles = mesh.triangles();
    const Naive<> naive = Naive<>::build(triangles);
    const std::vector<Ray> camera =
        camera_rays({.eye = {0.5f, 0.5f, 4.0f}, .target = Point3(0.5f)}, 64, 64);
    std::vector<HitRecord> hits(camera.size());
    trace<NoCounts>(naive, {camera, hits});
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < hits.size(); ++i)
        if (hits[i].is_hit()) starts.push_back(i);
    REQUIRE(starts.size() > 500);

    constexpr std::size_t count = 20'000;
    const std::vector<Ray> rays = diffuse_rays(triangles, camera, hits, count, 5);
    REQUIRE(rays.size() == count);
    CHECK(diffuse_rays(triangles, camera, hits, count, 6).front().direction !=
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
    CHECK(diffuse_rays(triangles, camera,
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
    REQUIRE(run(fmt::format("{} --mesh {} --rays {} --json {} --structure naive,naive --query "
                            "closest --threads 2 "
                            "--build-threads 2",
                            lab, (bench / "row.ply").string(), (bench / "rays").string(),
                            (bench / "json").string()))
                .code == 0);
    const auto json = nlohmann::ordered_json::parse(read_file(bench / "json"));
    const auto keys = [](const nlohmann::ordered_json& object) {
        std::string names;
        for (const auto& [key, value] : object.items()) names += key + " ";
        return names;
    };
    CHECK(keys(json) == "version machine mesh query structures ");
    CHECK(json["version"] == 1);
    CHECK(json["machine"].is_string());
    CHECK(json["query"] == "closest");
    CHECK(json["mesh"] == nlohmann::ordered_json{{"name", "row"},
                                                 {"file", (bench / "row.ply").string()},
                                                 {"vertices", 120},
                                                 {"triangles", 40},
                                                 {"degenerate", 0}});
    REQUIRE(json["structures"].size() == 2);
    for (const auto& structure : json["structures"]) {
        CHECK(keys(structure) ==
              "structure build_ms trace_ms rays_per_s rays hits nodes leaves depth references "
              "bytes sah_cost node_visits "
              "triangle_tests threads build_threads ");
        CHECK(structure["structure"] == "naive");
        for (const char* time : {"build_ms", "trace_ms", "rays_per_s"})
            CHECK(structure[time].is_number());
        for (const char* none : {"nodes", "leaves", "depth", "sah_cost", "node_visits"})
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
    const std::string files = fmt::format("--mesh {} --rays {} ", (bench / "row.ply").string(),
                                          (bench / "rays").string());

    const Ended closest = run(broken_lab + files + "--structure all --check");
    CHECK(closest.code == 1);
    CHECK(
        closest.out.find("ray 7: naive triangle 7 at t = 1 (u = 0.25, v = 0.25), broken none\n") !=
        std::string::npos);
    CHECK(
        closest.out.find("ray 40: naive triangle 7 at t = 1 (u = 0.25, v = 0.25), broken none\n") !=
        std::string::npos);
    CHECK(closest.out.find("2 disagreements") != std::string::npos);
    CHECK(closest.out.find("ray 8:") == std::string::npos);

    const Ended any = run(broken_lab + files + "--structure broken --check --query any");
    CHECK(any.code == 1);
    CHECK(any.out.find("ray 7: naive hit, broken none\n") != std::string::npos);

    CHECK(run(broken_lab + files + "--structure naive --check").code == 0);
    CHECK(run(broken_lab + files + "--structure broken").code == 0);  // nobody asked
}

TEST_CASE("a disagreement is any difference of the records") {
    const std::vector<HitRecord> trusted{
        {1.0f, 0.0f, 0.0f, 3}, {1.0f, 0.5f, 0.5f, 3}, HitRecord::closest({})};
    std::vector<HitRecord> other = trusted;
    const std::vector<std::size_t> indices{4, 5, 9};
    CHECK(disagreements({"naive", trusted}, {"tree", other}, indices).empty());
    other[0].triangle = 2;
    other[1].t = std::nextafter(1.0f, 2.0f);
    other[2] = {2.5f, 0.0f, 0.0f, 1};
    CHECK(disagreements({"naive", trusted}, {"tree", other}, indices) ==
          std::vector<std::string>{"ray 4: naive triangle 3 at t = 1 (u = 0, v = 0), tree triangle "
                                   "2 at t = 1 (u = 0, v = 0)",
                                   "ray 5: naive triangle 3 at t = 1 (u = 0.5, v = 0.5), tree "
                                   "triangle 3 at t = 1.0000001 (u = 0.5, v = 0.5)",
                                   "ray 9: naive none, tree triangle 1 at t = 2.5 (u = 0, v = 0)"});
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

TEST_CASE("naive, all and list name the structures; an unknown triangle test is refused") {
    const Ended list = run(lab + "--structure list");
    CHECK(list.code == 0);
    CHECK(list.out.find("naive") != std::string::npos);
    CHECK(structures().front().name == "naive");
    const Ended tests = run(lab + "--triangle-test list");
    CHECK(tests.code == 0);
    CHECK(tests.out.find("filtered-exact") != std::string::npos);
    CHECK(run(lab + "--scene soup:50 --size 4x3 --triangle-test watertight --structure all").code ==
          0);
    CHECK(run(lab + "--help").code == 0);
}

TEST_CASE("wrong input gets one clear line and its exit code, and leaves no file") {
    const Workbench bench;
    const std::string mesh = "--mesh " + (bench / "row.ply").string() + " ";
    write_ply(bench / "row.ply", row_of_triangles(3));
    write_file(bench / "33 bytes", std::string(33, 'x'));
    write_file(bench / "empty", "");
    write_file(bench / "a file", "");
    write_rays(bench / "rays", std::array{ray_down(0)});
    const std::string rays = "--rays " + (bench / "rays").string() + " ";
    const std::string outputs = fmt::format("--hits {} --json {} ", (bench / "new/hits").string(),
                                            (bench / "new/json").string());
    struct Wrong {
        std::string arguments;
        int code;
        std::string_view names;  ///< what the line must name
    };
    const std::vector<Wrong> wrongs{
        {mesh + "--structure bvh,naive", 2, "bvh"},
        {mesh + "--structure ''", 2, "--structure"},
        {mesh + "--structure naive,", 2, "--structure"},
        {mesh + "--triangle-test none", 2, "none"},
        {mesh + "--query nearest", 2, "--query"},
        {"", 2, "--mesh"},
        {mesh + "--scene soup", 2, "--scene"},
        {"--scene no_such_scene", 2, "no_such_scene"},
        {"--mesh " + (bench / "missing.ply").string(), 3, "missing.ply"},
        {mesh + "--rays " + (bench / "missing").string(), 3, "missing"},
        {mesh + "--rays '" + (bench / "33 bytes").string() + "'", 3, "33 bytes"},
        {mesh + "--rays " + (bench / "empty").string(), 3, "no ray"},
        {mesh + rays + "--diffuse 10", 2, "--diffuse"},
        {mesh + rays + "--camera 0,0,1,0,0,0,45", 2, "--camera"},
        {mesh + rays + "--size 4x3", 2, "--size"},
        {mesh + "--diffuse 0", 2, "--diffuse"},
        {mesh + "--diffuse -5", 2, "--diffuse -5"},
        {mesh + "--diffuse 1e3", 2, "--diffuse 1e3"},
        {mesh + "--camera 0,0,9,0,0,8,45,0", 2, "--camera"},
        {mesh + "--camera 0,0,9,0,0,8", 2, "--camera"},
        {mesh + "--camera nan,0,9,0,0,8,45", 2, "nan"},
        {mesh + "--camera 1e99,0,9,0,0,8,45", 2, "1e99"},
        {mesh + "--camera 0,0,9x,0,0,8,45", 2, "9x"},
        {mesh + "--camera 1,2,3,1,2,3,45", 2, "eye"},
        {mesh + "--camera 0,0,9,0,0,8,0", 2, "field of view"},
        {mesh + "--camera 0,0,9,0,0,8,180", 2, "field of view"},
        {mesh + "--camera 0,0,9,0,0,10,45 --diffuse 10", 2, "--diffuse"},
        {mesh + "--size 0x0", 2, "--size"},
        {mesh + "--size 16384x16384", 2, "--size"},
        {mesh + "--size 12", 2, "--size"},
        {mesh + "--threads 0", 2, "--threads"},
        {mesh + "--threads -1", 2, "--threads"},
        {mesh + "--threads 100000", 2, "--threads"},
        {mesh + "--build-threads 0", 2, "--build-threads"},
        {mesh + "--build-threads 1.5", 2, "--build-threads 1.5"},
        {mesh + "--repeat 0", 2, "--repeat"},
        {mesh + "--repeat -1", 2, "--repeat -1"},
        {mesh + "--repeat 0x3", 2, "--repeat 0x3"},
        {mesh + "--seed x", 2, "--seed"},
        {mesh + "--seed -1", 2, "--seed -1"},
        {mesh + "--no-such-option", 2, "--no-such-option"},
    };
    for (const Wrong& wrong : wrongs) {
        INFO(wrong.arguments);
        const Ended ended = run(
            lab + outputs + wrong.arguments +
            (wrong.arguments.find("--structure") == std::string::npos ? " --structure naive" : ""));
        INFO(ended.err);
        CHECK(ended.code == wrong.code);
        CHECK(ended.err.starts_with("lab: "));
        CHECK(lines(ended.err) == 1);
        CHECK(ended.err.find(wrong.names) != std::string::npos);
        CHECK(!std::filesystem::exists(bench / "new"));
    }
    const Ended two =
        run(lab + mesh + rays + "--structure naive,naive --hits " + (bench / "hits").string());
    CHECK(two.code == 2);
    CHECK(two.err.find("--hits") != std::string::npos);
    CHECK(!std::filesystem::exists(bench / "hits"));
}

TEST_CASE(
    "a file that cannot be written is an error before anything is measured, or on a full disk "
    "after, and no part of it "
    "is left") {
    const Workbench bench;
    write_ply(bench / "row.ply", row_of_triangles(3));
    write_rays(bench / "rays", random_rays(100));
    write_file(bench / "a file", "");
    const std::string run_it = fmt::format("{} --mesh {} --rays {} --structure naive ", lab,
                                           (bench / "row.ply").string(), (bench / "rays").string());
    const auto files = [&] {
        const std::filesystem::directory_iterator all(bench / "");
        return std::distance(begin(all), end(all));
    };
    const auto before = files();
    const auto fails = [&](const std::string& line, bool at_once) {
        INFO(line);
        const Ended ended = run(line);
        CHECK(ended.out.empty() == at_once);
        INFO(ended.err);
        CHECK(ended.code == 4);
        CHECK(ended.err.starts_with("lab: cannot "));
        CHECK(lines(ended.err) == 1);
        CHECK(files() == before);
    };
    for (const char* option : {"--hits", "--json"}) {
        fails(fmt::format("{} {} '{}'", run_it, option, (bench / "a file/x").string()),
              true);  // in a file
        fails(fmt::format("{} {} '{}'", run_it, option, (bench / "").string()),
              true);                                                  // a directory
        fails(fmt::format("{} {} /dev/full", run_it, option), true);  // no regular file
        // A full disk: no file may grow beyond 512 bytes. (A full disk sends no signal; the limit's
        // is ignored.)
        fails(fmt::format("trap '' XFSZ; ulimit -f 1; {} {} {}", run_it, option,
                          (bench / "out").string()),
              false);
    }
    CHECK(std::filesystem::is_character_file("/dev/full"));
}
