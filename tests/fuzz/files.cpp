// Files: each is read whole, or refused in one line that names it.
#include "chapters/ch09_instancing_and_motion/instance_file.hpp"
#include "chapters/ch12_comparison/rays.hpp"
#include "common/geometry.hpp"
#include "common/mesh.hpp"
#include "common/program/error.hpp"
#include "common/program/temporary.hpp"
#include "common/scene.hpp"
#include "tests/fuzz/answers.hpp"
#include "tests/fuzz/kinds.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space::fuzz {
namespace {

bool is_one_line(std::string_view text) {
    return std::ranges::none_of(
        text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7F'; });
}

void check_line(const std::string& line, const std::filesystem::path& file) {
    if (!line.starts_with(file.string() + ":")) fail("file not named: " + line);
    if (!is_one_line(line)) fail("not one line: " + line);
}

/// What `read` gives, or nothing where it refuses the file as it should.
template <class Read>
auto read_or_refused(const std::filesystem::path& file, const Read& read) {
    std::optional<decltype(read(file))> content;
    try {
        content = read(file);
    } catch (const Error& error) {
        if (error.code() != ExitCode::bad_input) fail(std::string("exit code: ") + error.what());
        check_line(error.what(), file);
    }
    return content;
}

void feed_mesh(const std::string& name, std::string_view bytes) {
    const std::filesystem::path file = written(name, bytes);
    const auto mesh = read_or_refused(file, load_mesh);
    if (!mesh) return;
    if (mesh->faces.empty()) fail("a mesh without a face");
    for (const Point3& vertex : mesh->vertices)
        if (!is_finite<3>(vertex)) fail("a vertex that is not finite");
    for (const auto& face : mesh->faces)
        for (const std::uint32_t index : face)
            if (index >= mesh->vertices.size()) fail("an index out of range");
    for (const std::string& remark : mesh->remarks) check_line(remark, file);
    (void)count_degenerate(mesh->triangles());
}

/// Triangles for rays from a file: a fan of 20 around the origin, one of them huge, some flat.
std::vector<Triangle> fan() {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 20; ++i) {
        const auto at = [](int n) {
            return Point3(float(n % 5) - 2.0f, float(n % 3) - 1.0f, float(n % 7) - 3.0f);
        };
        triangles.push_back({at(i), at(2 * i + 1), at(3 * i + 2)});
    }
    triangles.push_back({{-1e30f, -1e30f, 0.5f}, {1e30f, -1e30f, 0.5f}, {0.0f, 1e30f, 0.5f}});
    return triangles;
}

}  // namespace

void fail(const std::string& broken) {
    std::fprintf(stderr, "BROKEN PROMISE: %s\n", broken.c_str());
    std::abort();
}

std::filesystem::path written(const std::string& name, std::string_view bytes) {
    static const TemporaryDirectory folder;
    const std::filesystem::path file = folder / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
}

void feed_obj(std::string_view bytes) {
    feed_mesh("m.obj", bytes);
}
void feed_off(std::string_view bytes) {
    feed_mesh("m.off", bytes);
}
void feed_ply(std::string_view bytes) {
    feed_mesh("m.ply", bytes);
}
void feed_stl(std::string_view bytes) {
    feed_mesh("m.stl", bytes);
}

void feed_rays(std::string_view bytes) {
    const auto rays = read_or_refused(written("r.rays", bytes), read_rays);
    static const Answers answers(fan(), 1);
    if (rays) answers.compare(*rays);
}

void feed_instances(std::string_view bytes) {
    // Scenes of the book may be large: meshes come from files.
    for (const SceneRecipe& recipe : scene_recipes())
        if (bytes.find(recipe.name) != bytes.npos) return;
    written("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n");
    written("b.obj", "v -1e30 0 0\nv 1e30 0 1\nv 0 1e-30 0\nf 1 2 3\nf 1 1 2\n");
    const std::filesystem::path file = written("i.json", bytes);
    (void)meshes_of_instances(file);
    const auto instances = read_or_refused(file, load_instances);
    if (instances && instances->graph.triangle_count() <= 200) compare_instances(instances->graph);
}

}  // namespace space::fuzz
