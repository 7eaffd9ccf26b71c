// Scenes by name: what they promise about their triangles, cameras and sizes.
#include "chapters/ch01_naive_ray_tracing/naive.hpp"
#include "common/program/error.hpp"
#include "common/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <utility>

namespace space {
namespace {

/// All recipes but those that need a file which may not be there.
std::vector<SceneRecipe> own_recipes() {
    std::vector<SceneRecipe> recipes;
    for (const SceneRecipe& recipe : scene_recipes())
        if (!recipe.from_file) recipes.push_back(recipe);
    return recipes;
}

std::string spec(const SceneRecipe& recipe, std::size_t size) {
    return fmt::format("{}:{}", recipe.name, size);
}

/// FNV-1a over the bits of the vertices and the indices.
std::uint64_t fingerprint(const TriangleMesh& mesh) {
    std::uint64_t hash = 14695981039346656037u;
    const auto mix = [&](std::uint32_t word) {
        for (int shift = 0; shift < 32; shift += 8)
            hash = (hash ^ ((word >> shift) & 0xFF)) * 1099511628211u;
    };
    for (const Point3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) mix(std::bit_cast<std::uint32_t>(vertex[axis]));
    for (const auto& face : mesh.faces)
        for (const std::uint32_t index : face) mix(index);
    return hash;
}

/// Does every edge belong to two triangles, which run along it in opposite directions?
bool is_closed(const TriangleMesh& mesh) {
    std::vector<std::array<std::uint32_t, 2>> forward, backward;
    for (const auto& [a, b, c] : mesh.faces)
        for (const auto& [from, to] : {std::pair{a, b}, {b, c}, {c, a}}) {
            forward.push_back({from, to});
            backward.push_back({to, from});
        }
    std::sort(forward.begin(), forward.end());
    std::sort(backward.begin(), backward.end());
    return forward == backward &&
           std::adjacent_find(forward.begin(), forward.end()) == forward.end();
}

/// Six times the volume inside; positive if the front of the faces is outside.
double six_volumes(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (const Triangle& t : mesh.triangles())
        sum += glm::dot(Double3(t.a), glm::cross(Double3(t.b), Double3(t.c)));
    return sum;
}

TEST_CASE(
    "every scene is sound: finite vertices, indices in range, a colour for each triangle, camera "
    "and lights",
    "[scenes]") {
    for (const SceneRecipe& recipe : own_recipes()) {
        INFO(recipe.name);
        const Scene scene = make_scene(recipe.name, 1, true);
        CHECK(scene.name == recipe.name);
        CHECK(test::is_sound(scene.mesh));
        CHECK((scene.colors.empty() || scene.colors.size() == scene.mesh.faces.size()));
        for (const Color& color : scene.colors)
            for (int channel = 0; channel < 3; ++channel)
                CHECK((color[channel] >= 0.0f && color[channel] <= 1.0f));
        CHECK(is_finite<3>(scene.camera.eye));
        CHECK(scene.camera.eye != scene.camera.target);
        CHECK_FALSE(scene.lights.empty());
        for (const PointLight& light : scene.lights) CHECK(is_finite<3>(light.position));
        CHECK(count_degenerate(scene.mesh.triangles()) == 0);
        CHECK(recipe.small_size >= 1);
        CHECK(recipe.small_size <= recipe.default_size);
        CHECK(recipe.default_size <= recipe.max_size);
    }
}

TEST_CASE("every camera sees its scene: at least a fifth of the rays hit", "[scenes]") {
    constexpr int width = sized(40, 20), height = sized(30, 15);
    for (const SceneRecipe& recipe : own_recipes()) {
        const Scene scene = make_scene(recipe.name, 1, true);
        const Naive naive = Naive<>::build(scene.mesh.triangles());
        const CameraFrame frame(scene.camera);
        int hits = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                hits += closest_hit(
                            naive, camera_ray(scene.camera, frame, x + 0.5, y + 0.5, width, height))
                            .has_value();
        INFO(recipe.name << ": " << hits << " of " << width * height);
        if (recipe.name != "dust") CHECK(5 * hits >= width * height);  // nearly all rays miss it
    }
}

TEST_CASE("the number of triangles follows from the size", "[scenes]") {
    const auto sphereflake = [](std::size_t depth) {
        constexpr std::size_t frequencies[] = {8, 4, 2, 2};
        std::size_t count = 2, spheres = 1;
        for (std::size_t level = 0; level <= depth; ++level, spheres *= 9)
            count += spheres * 20 * frequencies[level] * frequencies[level];
        return count;
    };
    const auto teapot = [](std::size_t n) { return 84 * n * n + 52 * n; };
    using Formula = std::function<std::size_t(std::size_t)>;
    const std::map<std::string_view, Formula> formulas{
        {"room",
         [&](std::size_t n) {
             return 4753 + teapot(n) +
                    60 * std::min<std::size_t>(n, 8) * std::min<std::size_t>(n, 8);
         }},
        {"sphereflake", sphereflake},
        {"tetra", [](std::size_t n) { return std::size_t{1} << 2 * n; }},
        {"tree", [](std::size_t n) { return 36 * ((std::size_t{2} << n) - 1) + 2; }},
        {"mount", [](std::size_t n) { return (std::size_t{2} << 2 * n) + 4 * 720; }},
        {"lattice",
         [](std::size_t n) {
             return 180 * (n + 1) * (n + 1) * (n + 1) + 16 * 3 * n * (n + 1) * (n + 1);
         }},
        {"shells", [](std::size_t n) { return 80 * ((std::size_t{180} << n) + 1); }},
        {"icosphere", [](std::size_t n) { return 20 * n * n; }},
        {"soup", [](std::size_t n) { return n; }},
        {"soup_uneven", [](std::size_t n) { return n; }},
        {"slivers", [](std::size_t n) { return n; }},
        {"dust", [](std::size_t n) { return n; }},
        {"blanket", [](std::size_t n) { return n + 1; }},
        {"scan", [](std::size_t n) { return 20 * n * n; }},
        {"boxes", [](std::size_t n) { return 12 * (n + 1); }},
        {"stadium", [&](std::size_t n) { return teapot(n) + 602; }},
        {"building", [](std::size_t n) { return 26024 * n + 14; }},
    };
    for (const SceneRecipe& recipe : own_recipes())
        for (std::size_t size = 1; size <= 3; ++size) {
            INFO(spec(recipe, size));
            REQUIRE(formulas.count(recipe.name) == 1);
            CHECK(make_scene(spec(recipe, size)).mesh.faces.size() ==
                  formulas.at(recipe.name)(size));
        }
}

TEST_CASE("an icosphere of over a million triangles has 20 f^2 of them and is closed", "[scenes]") {
    constexpr std::size_t f = sized(300, 40);
    const TriangleMesh mesh = make_scene(fmt::format("icosphere:{}", f)).mesh;
    CHECK(mesh.faces.size() == 20 * f * f);
    CHECK(mesh.vertices.size() == 10 * f * f + 2);
    CHECK(is_closed(mesh));
}

TEST_CASE("solids are closed and their front is outside", "[scenes]") {
    for (std::uint32_t frequency = 1; frequency <= 12; ++frequency) {
        const TriangleMesh sphere = icosphere(frequency);
        CHECK(sphere.vertices.size() == 10 * frequency * frequency + 2);
        CHECK(is_closed(sphere));
        CHECK(six_volumes(sphere) > 0.0);
        for (const Point3& vertex : sphere.vertices)
            CHECK(glm::length(Double3(vertex)) == Approx(1.0).epsilon(1e-7));
    }
    const TriangleMesh cube = box({1, 2, 3}, {2, 4, 6});
    CHECK(is_closed(cube));
    CHECK(six_volumes(cube) == 36.0);
    CHECK(six_volumes(turned_inside_out(cube)) == -36.0);
    const TriangleMesh rod = tube({{0, 0, 0}, 1.0}, {{1, 2, 3}, 0.5}, 7);
    CHECK(is_closed(rod));
    CHECK(six_volumes(rod) > 0.0);
    for (std::uint32_t detail = 1; detail <= 5; ++detail) {
        CHECK(is_closed(teapot(detail)));
        CHECK(six_volumes(teapot(detail)) > 0.0);
    }
    CHECK(is_closed(make_scene("shells:1").mesh));
    CHECK(is_closed(make_scene("tetra:4").mesh));
    CHECK(is_closed(make_scene("boxes:50").mesh));
    const TriangleMesh head = make_scene("scan:20").mesh;
    CHECK(is_closed(head));
    CHECK(six_volumes(head) > 0.0);
    CHECK_FALSE(is_closed(make_scene("sphereflake:1").mesh));  // its floor is open
}

TEST_CASE("a rotation turns by the right hand", "[scenes]") {
    const Double3 turned = rotation({0, 0, 1}, 90) * Double3{1, 0, 0};
    CHECK(glm::length(turned - Double3{0, 1, 0}) < 1e-15);
    const glm::dmat3 m = rotation(glm::normalize(Double3{1, 2, 3}), 33);
    CHECK(glm::length(m * Double3{1, 2, 3} - Double3{1, 2, 3}) < 1e-14);
    CHECK(glm::determinant(m) == Approx(1.0));
}

TEST_CASE("the same name, size and seed give the same scene, bit for bit; another seed another one",
          "[scenes]") {
    for (const SceneRecipe& recipe : own_recipes()) {
        INFO(recipe.name);
        const Scene scene = make_scene(recipe.name, 7, true),
                    again = make_scene(spec(recipe, recipe.small_size), 7);
        CHECK(fingerprint(scene.mesh) == fingerprint(again.mesh));
        CHECK(scene.colors == again.colors);
        const std::set<std::string_view> seeded{"soup",  "soup_uneven", "slivers", "boxes",
                                                "mount", "dust",        "blanket", "scan"};
        const bool random = seeded.contains(recipe.name);
        CHECK((fingerprint(make_scene(recipe.name, 8, true).mesh) != fingerprint(scene.mesh)) ==
              random);
    }
}

TEST_CASE("scenes have the published bytes, with every compiler and machine", "[scenes]") {
    // Those without sines and powers, whose last bits a library may round otherwise.
    CHECK(fingerprint(make_scene("icosphere:9").mesh) == 0xe93d843513b14be5u);
    CHECK(fingerprint(make_scene("soup:500").mesh) == 0xb9d60b4e9b5564a4u);
    CHECK(fingerprint(make_scene("slivers:500").mesh) == 0xf5c2e482a5d96693u);
    CHECK(fingerprint(make_scene("tetra:5").mesh) == 0x0946d4941295c6e5u);
    CHECK(fingerprint(make_scene("blanket:500").mesh) == 0x0c77d054264997dbu);
    CHECK(fingerprint(make_scene("scan:9").mesh) == 0xd4dbc84f606f6c3au);
}

TEST_CASE(
    "equal triangles of the soup are equal, those of the uneven soup differ by orders of magnitude",
    "[scenes]") {
    const auto areas = [](const char* name) {
        std::vector<double> result;
        for (const Triangle& triangle : make_scene(name).mesh.triangles())
            result.push_back(0.5 * glm::length(normal(triangle)));
        std::sort(result.begin(), result.end());
        return result;
    };
    const std::vector<double> even = areas("soup:1000"), uneven = areas("soup_uneven:1000");
    CHECK(even.back() / even.front() < 1.001);
    CHECK(uneven.back() / uneven.front() > 1e10);
}

TEST_CASE(
    "the blanket's box holds all the other triangles, and its area is far above all of theirs",
    "[scenes]") {
    for (const char* name : {"blanket:1", "blanket:5000"}) {
        const std::vector<Triangle> triangles = make_scene(name).mesh.triangles();
        const Aabb blanket = bounds(triangles.front());
        double others = 0.0;
        for (const Triangle& triangle : std::span(triangles).subspan(1)) {
            CHECK(blanket.contains(bounds(triangle)));
            others += glm::length(normal(triangle));
        }
        CHECK(glm::length(normal(triangles.front())) > 20.0 * others);
    }
}

TEST_CASE("a speck of dust is far smaller than the gap to the next one, at any number of them",
          "[scenes]") {
    for (const std::size_t specks : {200, 4000}) {
        const std::vector<Triangle> triangles =
            make_scene(fmt::format("dust:{}", specks)).mesh.triangles();
        std::vector<double> gaps;  // in sizes of a speck
        for (std::size_t i = 0; i < 100; ++i) {
            double nearest = infinity;
            for (std::size_t j = 0; j < specks; ++j)
                if (j != i)
                    nearest = std::min(
                        nearest, glm::length(Double3(triangles[j].a) - Double3(triangles[i].a)));
            gaps.push_back(nearest /
                           glm::length(Double3(triangles[i].b) - Double3(triangles[i].a)));
        }
        std::ranges::nth_element(gaps, gaps.begin() + 50);
        CHECK(gaps[50] > 2.0);
    }
}

TEST_CASE("the triangles of a scan are all of about a size", "[scenes]") {
    std::vector<double> areas;
    for (const Triangle& triangle : make_scene("scan:30").mesh.triangles())
        areas.push_back(glm::length(normal(triangle)));
    std::ranges::sort(areas);
    CHECK(areas[areas.size() / 100] * 12.0 > areas[areas.size() * 99 / 100]);
}

TEST_CASE("boxes are axis-aligned", "[scenes]") {
    for (const Triangle& triangle : make_scene("boxes:100").mesh.triangles()) {
        const Double3 n = normal(triangle);
        CHECK((n.x != 0) + (n.y != 0) + (n.z != 0) == 1);
    }
}

TEST_CASE(
    "the stadium is nearly empty: its teapot has nearly all triangles and a hundredth of the "
    "length",
    "[scenes]") {
    const TriangleMesh mesh = make_scene("stadium").mesh;
    const double hall = bounds(mesh).extent().x;
    std::size_t near = 0;
    for (const Triangle& triangle : mesh.triangles())
        near += glm::length(Double3(triangle.a)) < 0.02 * hall;
    CHECK(double(near) > 0.95 * double(mesh.faces.size()));
}

std::string complaint_about(const std::string& name, ExitCode expected) {
    try {
        (void)make_scene(name);
    } catch (const Error& error) {
        return error.code() == expected ? error.what() : "wrong exit code";
    }
    return "made";
}

TEST_CASE("absurd sizes are a usage error that names the range", "[scenes]") {
    for (const char* size :
         {"0", "1001", "-1", "", "x", "1e2", "3.5", " 3", "3 ", "0x10", "99999999999999999999"}) {
        INFO(size);
        CHECK(
            complaint_about(fmt::format("icosphere:{}", size), ExitCode::usage) ==
            fmt::format("scene icosphere: the size must be a whole number from 1 to 1000, not '{}'",
                        size));
    }
    CHECK(complaint_about("bunny:3", ExitCode::usage) == "scene bunny: it has no size, '3'");
    for (const SceneRecipe& recipe : own_recipes())
        CHECK(complaint_about(spec(recipe, std::size_t{recipe.max_size} + 1), ExitCode::usage)
                  .find("from 1 to") != std::string::npos);
}

TEST_CASE("a scene whose file is not there says how to get it", "[scenes]") {
    const test::Folder empty;
    const char* const before = std::getenv("BOOK_SCENES");
    const std::string kept = before ? before : "";
    ::setenv("BOOK_SCENES", empty.path().c_str(), 1);
    const std::string told = complaint_about("forest", ExitCode::bad_input);
    before ? ::setenv("BOOK_SCENES", kept.c_str(), 1) : ::unsetenv("BOOK_SCENES");
    CHECK(told == (empty.path() / "forest.ply").string() +
                      ": not there; ./book scenes fetches it (BOOK_SCENES names its folder)");
}

TEST_CASE("the optional scenes are seen by their cameras, where they are", "[scenes]") {
    for (const SceneRecipe& recipe : scene_recipes()) {
        if (!recipe.from_file) continue;
        try {
            const Scene scene = make_scene(recipe.name);
            CHECK(test::is_sound(scene.mesh));
            CHECK_FALSE(scene.lights.empty());
        } catch (const Error& error) {
            WARN("skipped: " << error.what());
        }
    }
}

TEST_CASE("an unknown name is a usage error that lists the names; a missing file an input error",
          "[scenes]") {
    for (const char* name : {"nonsense", "", ":", ":3", "Room", "roo"})
        CHECK(complaint_about(name, ExitCode::usage).find("room, sphereflake") !=
              std::string::npos);
    CHECK(complaint_about("missing.ply", ExitCode::bad_input) ==
          "missing.ply: No such file or directory");
    CHECK(complaint_about("room:missing.ply", ExitCode::bad_input) ==
          "missing.ply: No such file or directory");
}

/// Where a point lies in a picture as high as wide: inside if both are in -1 .. 1.
glm::dvec2 in_picture(const Camera& camera, const Point3& point) {
    const CameraFrame frame(camera);
    const Double3 p = Double3(point) - Double3(camera.eye);
    const double depth = -glm::dot(p, frame.back) * frame.tan_half_fov;
    return {glm::dot(p, frame.right) / depth, glm::dot(p, frame.up) / depth};
}

TEST_CASE("a mesh file of any size and place is framed whole", "[scenes]") {
    const test::Folder folder;
    for (const double size : {1e-12, 1.0, 1e12})
        for (const double shift : {0.0, 1.0, 30.0}) {
            const TriangleMesh mesh =
                transformed(teapot(2), glm::dmat3(size),
                            Double3{shift * size, -shift * size, 0.5 * shift * size});
            write_ply(folder.path() / "mesh.ply", mesh);
            const Scene scene = make_scene((folder.path() / "mesh.ply").string());
            double widest = 0.0;
            for (const Point3& vertex : scene.mesh.vertices) {
                const glm::dvec2 p = in_picture(scene.camera, vertex);
                widest = std::max({widest, std::abs(p.x), std::abs(p.y)});
            }
            CHECK(widest > 0.8);
            CHECK(widest < 0.95);
            CHECK(scene.lights.size() == 3);
        }
}

TEST_CASE("a mesh without extent and one at the end of the floats get a finite camera",
          "[scenes]") {
    for (const float far : {0.0f, 1.0f, 1e37f}) {
        Scene scene;
        scene.mesh.vertices = {Point3{1.0f}, Point3{1.0f}, Point3{1.0f + far, 1.0f, 1.0f}};
        scene.mesh.faces = {{0, 1, 2}};
        frame_mesh(scene);
        CHECK(is_finite<3>(scene.camera.eye));
        CHECK(scene.camera.eye != scene.camera.target);
    }
}

TEST_CASE("any mesh is put on the room's table, whatever its size", "[scenes]") {
    const test::Folder folder;
    for (const double size : {1e-6, 1e6}) {
        const TriangleMesh mesh = transformed(icosphere(3), glm::dmat3(size), Double3{5 * size});
        write_ply(folder.path() / "mesh.ply", mesh);
        const Scene scene = make_scene("room:" + (folder.path() / "mesh.ply").string());
        Aabb box;
        for (std::size_t i = scene.mesh.vertices.size() - mesh.vertices.size();
             i < scene.mesh.vertices.size(); ++i)
            box.extend(scene.mesh.vertices[i]);
        CHECK(box.min.y == Approx(0.74));
        CHECK(box.extent().y == Approx(0.55).epsilon(1e-3));
    }
}

}  // namespace
}  // namespace space
