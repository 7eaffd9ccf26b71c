/// @file
/// Indexed triangle meshes, and reading them from files.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace space {

/// Triangles that share vertices, as files hold them.
struct TriangleMesh {
    std::vector<Point3> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;  ///< counter-clockwise seen from the front
    /// What a file held that is not in the mesh, or not as it stood there: a line each, which
    /// names the file.
    std::vector<std::string> remarks = {};

    Triangle triangle(std::size_t face) const {
        return {vertices[faces[face][0]], vertices[faces[face][1]], vertices[faces[face][2]]};
    }
    /// All triangles, in the order of the faces: what structures are built from.
    std::vector<Triangle> triangles() const;
    /// Appends the other mesh's vertices, faces and remarks.
    void append(const TriangleMesh& other);
};

Aabb bounds(const TriangleMesh& mesh);

/// Triangles of exactly zero area, decided exactly on the float coordinates. Kept in a mesh, never
/// hit.
std::size_t count_degenerate(std::span<const Triangle> triangles);

/// Reads OBJ, PLY, STL or OFF (by the file's extension); polygons are cut into triangles, by the
/// even-odd rule where they touch or cross themselves. Every vertex of the result is finite, every
/// index in range, and there is at least one triangle. Statements and columns that say nothing
/// about triangles may hold anything.
/// @throws Error (bad_input) with one line naming the file and the fault, and the place where it is
/// known
TriangleMesh load_mesh(const std::filesystem::path& file);

/// Writes binary little-endian PLY, atomically. @throws Error (bad_output)
void write_ply(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace space
