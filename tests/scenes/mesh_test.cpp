// Meshes: what a file says is what is loaded, in its order.
#include "common/scenes/shapes.hpp"
#include "tests/catch.hpp"
#include "tests/scenes/files.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdlib>

namespace space {
namespace {

using Faces = std::vector<std::array<std::uint32_t, 3>>;

bool same_bits(const TriangleMesh& a, const TriangleMesh& b) {
    if (a.faces != b.faces || a.vertices.size() != b.vertices.size()) return false;
    for (std::size_t i = 0; i < a.vertices.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (std::bit_cast<std::uint32_t>(a.vertices[i][axis]) !=
                std::bit_cast<std::uint32_t>(b.vertices[i][axis]))
                return false;
    return true;
}

TriangleMesh awkward_numbers() {
    TriangleMesh mesh = teapot(2);
    mesh.vertices.push_back(
        {-0.0f, 1e-45f, 3.4028235e38f});  // a signed zero, the smallest and the largest float
    mesh.vertices.push_back({0.1f, -1.1754942e-38f, 16777217.0f});
    mesh.faces.push_back({0, static_cast<std::uint32_t>(mesh.vertices.size() - 1),
                          static_cast<std::uint32_t>(mesh.vertices.size() - 2)});
    mesh.faces.push_back({5, 5, 5});
    return mesh;
}

TEST_CASE("a mesh written as PLY is read back bit for bit, degenerate triangles too", "[mesh]") {
    const test::Folder folder;
    const TriangleMesh mesh = awkward_numbers();
    write_ply(folder.path() / "deep" / "mesh.ply", mesh);
    CHECK(same_bits(load_mesh(folder.path() / "deep" / "mesh.ply"), mesh));
}

TEST_CASE("PLY where it cannot be written is an output error that leaves nothing", "[mesh]") {
    const test::Folder folder;
    const std::filesystem::path file =
        folder.write("file", "") / "mesh.ply";  // a folder that is a file
    try {
        write_ply(file, awkward_numbers());
        FAIL("written");
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::bad_output);
    }
    CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("text formats keep the order of vertices and faces, and every float", "[mesh]") {
    const test::Folder folder;
    const TriangleMesh mesh = awkward_numbers();
    std::string obj = "# a comment\nmtllib none.mtl\no thing\n",
                off = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.faces.size());
    std::string ply = fmt::format(
        "ply\nformat ascii 1.0\ncomment a comment\nelement vertex {}\nproperty float x\nproperty "
        "float y\nproperty "
        "float z\nelement face {}\nproperty list uchar uint vertex_index\nend_header\n",
        mesh.vertices.size(), mesh.faces.size());
    for (const Point3& p : mesh.vertices) {
        obj += fmt::format("v {} {}\t{}\r\n", p.x, p.y, p.z);
        off += fmt::format("{} {} {}\n", p.x, p.y, p.z);
        ply += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    }
    for (const auto& [a, b, c] : mesh.faces) {
        obj += fmt::format("usemtl m{}\nf\t{}/7\t{}//8 {}/1/2\n", a % 3, a + 1, b + 1, c + 1);
        off += fmt::format("3 {} {} {}\n", a, b, c);
        ply += fmt::format("3 {} {} {}\n", a, b, c);
    }
    CHECK(same_bits(load_mesh(folder.write("mesh.OBJ", obj)), mesh));
    CHECK(same_bits(load_mesh(folder.write("mesh.off", off)), mesh));
    CHECK(same_bits(load_mesh(folder.write("mesh.ply", ply)), mesh));
}

TEST_CASE("STL gives the triangles in their order, equal corners as one vertex", "[mesh]") {
    const test::Folder folder;
    const std::vector<Triangle> triangles = icosphere(2).triangles();
    std::string text = "solid facet vertex\n";  // words of the name are not commands
    for (const auto& [a, b, c] : triangles) {
        text += "  facet normal nan 0 1\n    outer loop\n";
        for (const Point3& p : {a, b, c})
            text += fmt::format("      VERTEX {} {} {:+}\n", p.x, p.y, p.z);
        text += "    endloop\n  endfacet\n";
    }
    text += "endsolid facet vertex\n";
    std::string binary = test::binary_stl(triangles, static_cast<std::uint32_t>(triangles.size()));
    for (const std::string_view header : {"", "solid that is binary"}) {
        binary.replace(0, header.size(), header);
        const TriangleMesh mesh = load_mesh(folder.write("binary.stl", binary));
        CHECK(mesh.triangles() == triangles);
        CHECK(mesh.vertices.size() == 42);
    }
    CHECK(load_mesh(folder.write("text.stl", text)).triangles() == triangles);
}

TEST_CASE("OFF with normals, colours or texture coordinates, also where a line lacks them",
          "[mesh]") {
    const test::Folder folder;
    for (const char* kind : {"OFF", "COFF", "NOFF", "STOFF", "CNOFF", "STCNOFF"}) {
        const std::string off = std::string("# comment\n") + kind +
                                " # comment\n3 2 0\n\n0 0 0 1 0 0 1\n1 0 0\n0 1 0 255 0 0 # red\n3 "
                                "0 1 2 0.5 0.5 0.5\n3 2 1 0\n";
        CHECK(load_mesh(folder.write("mesh.off", off)).faces == Faces{{0, 1, 2}, {2, 1, 0}});
    }
}

TEST_CASE("polygons become triangles where they stand", "[mesh]") {
    const test::Folder folder;
    const std::string vertices = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n";
    CHECK(load_mesh(folder.write("quad.obj", vertices + "f 1 2 3\nf 1 2 3 4\nf 3 4 1\n")).faces ==
          Faces{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {2, 3, 0}});
    CHECK(load_mesh(folder.write("relative.obj", vertices + "f -4 -3 -2\nv 1 1 5\nf -1 -2 1\n"))
              .faces == Faces{{0, 1, 2}, {4, 3, 0}});
}

/// Do the triangles cover a polygon in the plane z = 0 once? Their areas are all positive and sum
/// up to its own.
void check_cover(const TriangleMesh& mesh, double twice_area) {
    double sum = 0.0;
    for (const Triangle& triangle : mesh.triangles()) {
        CHECK(normal(triangle).z > 0.0);
        sum += normal(triangle).z;
    }
    CHECK(sum == twice_area);
}

TEST_CASE("a polygon that is not convex is cut inside its outline, whichever corner comes first",
          "[mesh]") {
    const test::Folder folder;
    const int arrow[4][2] = {{0, 0}, {4, -4}, {1, 0}, {4, 4}};
    const int comb[8][2] = {{0, 0}, {7, 0}, {7, 5}, {5, 5}, {4, 1}, {3, 1}, {2, 5}, {0, 5}};  // a U
    const auto check = [&](const auto& corners, double twice_area) {
        const int n = static_cast<int>(std::size(corners));
        for (int first = 0; first < n; ++first) {
            std::string off = fmt::format("OFF\n{} 1 0\n", n);
            for (int i = 0; i < n; ++i)
                off += fmt::format("{} {} 0\n", corners[(first + i) % n][0],
                                   corners[(first + i) % n][1]);
            off += fmt::format("{}", n);
            for (int i = 0; i < n; ++i) off += fmt::format(" {}", i);
            const TriangleMesh mesh = load_mesh(folder.write("polygon.off", off + "\n"));
            CHECK(mesh.faces.size() == static_cast<std::size_t>(n) - 2);
            check_cover(mesh, twice_area);
        }
    };
    const auto twice_area = [](const auto& corners) {
        int sum = 0;
        const std::size_t n = std::size(corners);
        for (std::size_t i = 0; i < n; ++i)
            sum +=
                corners[i][0] * corners[(i + 1) % n][1] - corners[(i + 1) % n][0] * corners[i][1];
        return double(sum);
    };
    check(arrow, twice_area(arrow));
    check(comb, twice_area(comb));
}

TEST_CASE("a polygon without area keeps its triangles, none of which can be hit", "[mesh]") {
    const test::Folder folder;
    const std::string line = "OFF\n5 1 0\n0 0 0\n1 1 1\n2 2 2\n3 3 3\n4 4 4\n5 0 1 2 3 4\n";
    const TriangleMesh flat = load_mesh(folder.write("line.off", line));
    CHECK(flat.faces.size() == 3);
    CHECK(count_degenerate(flat.triangles()) == 3);
}

TEST_CASE("meshes append with their indices moved", "[mesh]") {
    TriangleMesh mesh = box({0, 0, 0}, {1, 1, 1});
    mesh.append(box({2, 0, 0}, {3, 1, 1}));
    CHECK(mesh.vertices.size() == 16);
    CHECK(mesh.faces.size() == 24);
    CHECK(test::is_sound(mesh));
    CHECK(bounds(mesh) == Aabb{{0, 0, 0}, {3, 1, 1}});
}

TEST_CASE("the optional meshes load, where they are", "[mesh]") {
    const char* given = std::getenv("BOOK_SCENES");
    const std::filesystem::path folder = given ? given : "build/scenes";
    struct Expected {
        const char* name;
        std::size_t vertices, faces, degenerate;
    };
    for (const auto& [name, vertices, faces, degenerate] :
         {Expected{"dragon_48k.ply", 22998, 47794, 0}, {"dragon_871k.ply", 437645, 871414, 108}}) {
        const std::filesystem::path file = folder / name;
        if (!std::filesystem::exists(file)) {
            WARN("skipped: " << file.string() << " is not there");
            continue;
        }
        const TriangleMesh mesh = load_mesh(file);
        CHECK(mesh.vertices.size() == vertices);
        CHECK(mesh.faces.size() == faces);
        CHECK(count_degenerate(mesh.triangles()) == degenerate);
    }
}

}  // namespace
}  // namespace space
