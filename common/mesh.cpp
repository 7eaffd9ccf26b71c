#include "common/mesh.hpp"

#include "common/program/file.hpp"
#include "common/zero_area.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace space {
namespace {

template <class Number>
void append_bytes(std::string& text, Number number) {
    static_assert(std::endian::native == std::endian::little,
                  "PLY is written in the machine's byte order");
    const std::size_t size = text.size();
    text.resize(size + sizeof number);
    std::memcpy(text.data() + size, &number, sizeof number);
}

}  // namespace

std::vector<Triangle> TriangleMesh::triangles() const {
    std::vector<Triangle> result;
    result.reserve(faces.size());
    for (std::size_t face = 0; face < faces.size(); ++face) result.push_back(triangle(face));
    return result;
}

void TriangleMesh::append(const TriangleMesh& other) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.faces) faces.push_back({first + a, first + b, first + c});
    remarks.insert(remarks.end(), other.remarks.begin(), other.remarks.end());
}

Aabb bounds(const TriangleMesh& mesh) {
    Aabb box;
    for (const Point3& vertex : mesh.vertices) box.extend(vertex);
    return box;
}

std::size_t count_degenerate(std::span<const Triangle> triangles) {
    return static_cast<std::size_t>(
        std::count_if(triangles.begin(), triangles.end(), has_zero_area));
}

void write_ply(const std::filesystem::path& file, const TriangleMesh& mesh) {
    std::string content = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float "
        "y\nproperty float "
        "z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices.size(), mesh.faces.size());
    content.reserve(content.size() + 12 * mesh.vertices.size() + 13 * mesh.faces.size());
    for (const Point3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) append_bytes(content, vertex[axis]);
    for (const auto& face : mesh.faces) {
        append_bytes(content, std::uint8_t{3});
        for (const std::uint32_t corner : face) append_bytes(content, corner);
    }
    write_file(file, content);
}

}  // namespace space
