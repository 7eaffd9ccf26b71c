/// Puts two large scenes together from furniture that Debian packages: a conference room and a
/// forest. ./book scenes calls it. Run   assemble_scenes FURNITURE OUT     FURNITURE: the unpacked
/// BlendSwap-CC-0.sh3f and Scopia.sh3f
#include "common/mesh.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"
#include "common/scenes/shapes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace {

using namespace space;
namespace fs = std::filesystem;

/// A model of the catalogue, `size` metres in x, y (up) and z, standing on y = 0 with its middle at
/// x = z = 0. The files are in any unit.
TriangleMesh model(const fs::path& file, const Double3& size) {
    const TriangleMesh mesh = load_mesh(file);
    print_remarks("assemble_scenes", mesh.remarks);
    const Aabb box = bounds(mesh);
    const Double3 extent(box.extent()), scale = size / extent;
    const Double3 foot{0.5 * (double(box.min.x) + box.max.x), box.min.y,
                       0.5 * (double(box.min.z) + box.max.z)};
    return transformed(mesh, {{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}}, -foot * scale);
}

TriangleMesh placed(const TriangleMesh& mesh, double x, double z, double degrees) {
    return transformed(mesh, rotation({0, 1, 0}, degrees), {x, 0, z});
}

/// Twenty-six chairs about a table of slats, under a grid of beams: long thin triangles beside many
/// tiny ones.
TriangleMesh conference_room(const fs::path& furniture) {
    TriangleMesh room = turned_inside_out(box({-8, 0, -5}, {8, 3.2, 5}));
    for (int slat = 0; slat < 40; ++slat) {
        const double x = -5.0 + 0.25 * slat;
        room.append(box({x, 0.70, -1.2}, {x + 0.23, 0.74, 1.2}));
    }
    for (const double x : {-4.5, 0.0, 4.5})
        for (const double z : {-0.9, 0.9})
            room.append(box({x - 0.05, 0, z - 0.05}, {x + 0.05, 0.70, z + 0.05}));
    for (int beam = 0; beam <= 64; ++beam)
        room.append(box({-8 + 0.25 * beam, 3.05, -5}, {-7.98 + 0.25 * beam, 3.1, 5}));
    for (int beam = 0; beam <= 40; ++beam)
        room.append(box({-8, 3.1, -5 + 0.25 * beam}, {8, 3.15, -4.98 + 0.25 * beam}));
    // The ceiling's tiles lie in the grid, each a little lower than the beams' upper edge.
    for (int row = 0; row < 40; ++row)
        for (int column = 0; column < 64; ++column) {
            const double x = -8 + 0.25 * column, z = -5 + 0.25 * row;
            room.append(box({x + 0.03, 3.12, z + 0.03}, {x + 0.24, 3.14, z + 0.24}));
        }

    const TriangleMesh chair =
        model(furniture / "blendswap-cc-0/chair/chair.obj", {0.513, 0.80, 0.531});
    for (int i = 0; i < 12; ++i) {
        room.append(placed(chair, -4.7 + 0.85 * i, 1.55, 180));
        room.append(placed(chair, -4.7 + 0.85 * i, -1.55, 0));
    }
    room.append(placed(chair, -5.5, 0, 90));
    room.append(placed(chair, 5.5, 0, -90));
    return room;
}

/// A few plants in one corner of wavy, wide ground: small things in a big empty hull.
TriangleMesh forest(const fs::path& furniture) {
    constexpr int cells = 125;
    constexpr double side = 30;  // metres
    const auto height = [](double x, double z) {
        return 0.4 * std::sin(0.5 * x) * std::cos(0.37 * z);
    };
    TriangleMesh ground;
    for (int row = 0; row <= cells; ++row)
        for (int column = 0; column <= cells; ++column) {
            const double x = side * column / cells - side / 2, z = side * row / cells - side / 2;
            ground.vertices.emplace_back(Double3{x, height(x, z), z});
        }
    for (std::uint32_t row = 0; row < cells; ++row)
        for (std::uint32_t column = 0; column < cells; ++column) {
            const std::uint32_t corner = row * (cells + 1) + column;
            ground.faces.push_back({corner, corner + cells + 1, corner + 1});
            ground.faces.push_back({corner + 1, corner + cells + 1, corner + cells + 2});
        }

    TriangleMesh scene = ground;
    const fs::path plants = furniture / "scopia";
    const auto plant = [&](const TriangleMesh& mesh, double x, double z, double degrees) {
        scene.append(moved(placed(mesh, x, z, degrees), {0, height(x, z), 0}));
    };
    const TriangleMesh palm = model(plants / "sabalPalmeto/sabalPalmeto.obj", {3.47, 11.5, 3.10});
    plant(palm, -6, -5, 0);
    plant(palm, -2, -8, 80);
    plant(palm, 4, -7, 200);
    plant(model(plants / "bamboo/bamboo.obj", {3.0, 5.0, 2.78}), -3, -2, 0);
    plant(model(plants / "bush/bush.obj", {1.52, 1.31, 1.44}), 1.5, 1.0, 0);
    plant(model(plants / "cypress/cypress.obj", {1.32, 5.6, 1.34}), 2.5, -3.5, 0);
    return scene;
}

int assemble(int argc, char** argv) {
    if (argc != 3) throw usage_error("give two folders: the furniture, and where the scenes go");
    const fs::path furniture = argv[1], out = argv[2];
    const auto write = [&](const char* name, const TriangleMesh& mesh) {
        write_ply(out / name, mesh);
        fmt::print("{}: {} triangles\n", (out / name).string(), mesh.faces.size());
    };
    write("conference.ply", conference_room(furniture));
    write("forest.ply", forest(furniture));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    return space::run_program("assemble_scenes", assemble, argc, argv);
}
