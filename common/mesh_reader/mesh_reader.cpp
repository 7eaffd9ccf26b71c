// load_mesh: a reader a format, then one way from polygons to triangles.
//
// Each format has a reader of our own, since a reader must say what is wrong and where, and no
// library's does. Tried on Debian 12 with the files of tests/scenes: assimp 5.2 turns an index out
// of range into 0, accepts a truncated PLY, copies an OBJ's vertices and regroups its faces;
// tinyobjloader 2.0rc10 rounds 0.3 to 0.30000000000000004, takes 'nan' and 'zero' for 0, knows no
// continued lines, only warns of indices out of range, and takes five times as long; CGAL 5.5
// believes any count, refuses PLY with NaN normals, indices of one byte or integer coordinates, OFF
// with wrapped lines and OBJ with most of the format's statements.
#include "common/mesh.hpp"
#include "common/mesh_reader/polygons.hpp"
#include "common/mesh_reader/triangulate.hpp"
#include "common/program/file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace space {
namespace {

using namespace mesh_reader;

struct Format {
    std::string_view extension;
    Polygons (*read)(Source&);
};
constexpr Format formats[] = {
    {".obj", read_obj}, {".off", read_off}, {".ply", read_ply}, {".stl", read_stl}};

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& file) {
    Source source{file.string(), read_file(file)};
    const std::string extension = lower_case(file.extension().string());
    const auto format =
        std::find_if(std::begin(formats), std::end(formats),
                     [&](const Format& each) { return each.extension == extension; });
    if (format == std::end(formats))
        source.fail("not a mesh file: its name must end in .obj, .off, .ply or .stl");
    if (source.content.empty()) source.fail("the file is empty");

    Polygons polygons = format->read(source);
    source.content = {};
    std::vector<std::string> remarks;
    if (!polygons.remark.empty()) remarks.push_back(polygons.remark);
    if (polygons.skipped > 0)
        remarks.push_back(fmt::format(
            "{} skipped, the first {}",
            polygons.skipped == 1 ? "1 statement" : fmt::format("{} statements", polygons.skipped),
            polygons.first_skipped));
    if (polygons.size() == 0)
        source.fail(remarks.empty() ? "the file has no faces"
                                    : fmt::format("the file has no faces ({})", remarks.back()));
    TriangleMesh mesh = triangulate(source, std::move(polygons));
    if (mesh.faces.empty()) source.fail("no face of the file encloses anything");
    mesh.remarks.insert(mesh.remarks.begin(), remarks.begin(), remarks.end());
    for (std::string& remark : mesh.remarks) remark = fmt::format("{}: {}", source.name, remark);
    return mesh;
}

}  // namespace space
