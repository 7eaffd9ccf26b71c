#include "common/mesh.hpp"

#include "common/program/file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <string>

namespace space {
namespace {

/// Does the exact sum of the six terms vanish? Rounded addition decides where its error bound
/// allows; else the sum is kept without error as an expansion (Shewchuk 1997, "Adaptive Precision
/// Floating-Point Arithmetic", Grow-Expansion).
bool sum_is_zero(const std::array<double, 6>& terms) {
    double sum = 0.0, magnitude = 0.0;
    for (const double term : terms) {
        sum += term;
        magnitude += std::abs(term);
    }
    // Five additions, each wrong by at most 2^-53 of a partial sum that is no larger than the
    // magnitude.
    constexpr double error_bound = 8 * 0x1p-53;
    if (std::abs(sum) > error_bound * magnitude) return false;

    std::array<double, 6> expansion{};
    for (std::size_t count = 0; count < terms.size(); ++count) {
        double carry = terms[count];
        for (std::size_t i = 0; i < count; ++i) {  // two-sum: carry + part = total + error, exactly
            const double part = expansion[i], total = carry + part, virtual_part = total - carry;
            expansion[i] = (carry - (total - virtual_part)) + (part - virtual_part);
            carry = total;
        }
        expansion[count] = carry;
    }
    for (const double part : expansion)
        if (part != 0.0) return false;
    return true;
}

/// Multiplied out, each component of (b - a) x (c - a) is a sum of six products of two floats, and
/// such a product is exact in double: 24 + 24 bits fit into 53, and the exponents are far from the
/// ends.
bool is_degenerate(const Triangle& triangle) {
    const Double3 a{triangle.a}, b{triangle.b}, c{triangle.c};
    for (int axis = 0; axis < 3; ++axis) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        if (!sum_is_zero(
                {a[i] * b[j], -a[j] * b[i], b[i] * c[j], -b[j] * c[i], c[i] * a[j], -c[j] * a[i]}))
            return false;
    }
    return true;
}

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
    std::size_t count = 0;
    for (const Triangle& triangle : triangles) count += is_degenerate(triangle);
    return count;
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
