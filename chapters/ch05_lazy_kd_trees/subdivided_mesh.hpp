/// @file
/// A coarse mesh whose triangles are cut into many small ones with bumps, where it is asked for.
#pragma once

#include "common/geometry.hpp"
#include "common/limit_error.hpp"
#include "common/mesh.hpp"
#include "common/pcg32.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace space {

/// How finely a mesh is cut, and how high its bumps are.
struct SubdividedMeshConfig {
    std::uint32_t levels = 5;  ///< each cuts every edge in two: 4^levels triangles a face; to 15
    double height = 0.1;       ///< of the highest bump, outwards
    double wave = 0.5;         ///< length of the longest bumps; the others are halves of it
    std::uint32_t waves = 4;
    std::uint64_t seed = 1;
};

/// A source for LazyGeometry: a patch is a face of the coarse mesh. Faces that share an edge have
/// the same points there, bit for bit, so a closed mesh stays closed.
class SubdividedMesh {
  public:
    using Config = SubdividedMeshConfig;

    /// @throws LimitError where 32 bits can't number the triangles of one face
    explicit SubdividedMesh(TriangleMesh mesh, const Config& config = {})
        : mesh_(std::move(mesh)), config_(config), outwards_(mesh_.vertices.size()) {
        if (config.levels > 15) throw LimitError("subdivided mesh: more than 15 levels (levels)");
        std::vector<Double3> sums(mesh_.vertices.size(), Double3(0.0));
        for (std::size_t face = 0; face < mesh_.faces.size(); ++face)
            for (const std::uint32_t vertex : mesh_.faces[face])
                sums[vertex] += normal(mesh_.triangle(face));
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const double length = glm::length(sums[i]);
            if (length > 0.0) outwards_[i] = Vector3(sums[i] / length);
        }
    }

    std::uint32_t patches() const { return std::uint32_t(mesh_.faces.size()); }
    std::uint32_t first_triangle(std::uint32_t patch) const { return patch * patch_triangles(); }
    std::uint32_t patch_triangles() const { return 1u << 2 * config_.levels; }

    // [bounds]
    /// Holds the patch's triangles. Each of their points is a mean of the three corners, each moved
    /// outwards by one and the same height: it lies in the hull of the corners where they are and
    /// where the highest bump would bring them. In floats it may lie beside it: see `margin`.
    Aabb bounds(std::uint32_t patch) const {
        Double3 low(double{infinity}), high(-double{infinity}), size(0.0);
        for (const std::uint32_t vertex : mesh_.faces[patch]) {
            const Double3 from(mesh_.vertices[vertex]);
            const Double3 way = config_.height * Double3(outwards_[vertex]);
            low = glm::min(low, glm::min(from, from + way));
            high = glm::max(high, glm::max(from, from + way));
            size = glm::max(size, glm::abs(from) + glm::abs(way));
        }
        return {Point3(low - margin * size), Point3(high + margin * size)};
    }
    /// With u53 = 2^-53, and L the size of a corner and of its way outwards together, on one axis.
    /// A point is off from the exact one by two roundings of each mean (the products with whole
    /// numbers are exact), one of the product with the height and one of the sum: at most 4 u53 L.
    /// The hull is off by one in `way`, one in `from + way` and one where it is set outwards: 3 u53
    /// L. And the last rounding, to float, keeps the order.
    static constexpr double margin = 8.0 * 0x1p-53;
    // [bounds]

    /// Row by row from the face's first corner, oriented as the face.
    std::vector<Triangle> triangles(std::uint32_t patch) const {
        const std::uint32_t n = 1u << config_.levels;
        std::vector<Triangle> triangles;
        triangles.reserve(patch_triangles());
        std::vector<Point3> row{point(patch, 0, 0)};
        for (std::uint32_t i = 1; i <= n; ++i) {
            const std::vector<Point3> above = std::move(row);
            row.clear();
            for (std::uint32_t j = 0; j <= i; ++j) row.push_back(point(patch, i, j));
            for (std::uint32_t j = 0; j < i; ++j) {
                triangles.push_back({above[j], row[j], row[j + 1]});
                if (j + 1 < i) triangles.push_back({above[j], row[j + 1], above[j + 1]});
            }
        }
        return triangles;
    }

  private:
    /// In the i-th row from the first corner, the j-th point of 0 .. i.
    Point3 point(std::uint32_t patch, std::uint32_t i, std::uint32_t j) const {
        const std::uint32_t n = 1u << config_.levels;
        const std::array<std::uint32_t, 3> weights{n - i, i - j, j};
        Double3 from(0.0), way(0.0);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = mesh_.faces[patch][corner];
            from += double(weights[corner]) * Double3(mesh_.vertices[vertex]);
            way += double(weights[corner]) * Double3(outwards_[vertex]);
        }
        from /= n;
        way /= n;
        return Point3(from + height(from) * way);
    }

    /// From 0 to config.height: noise of several lengths, each half as high as the one before.
    double height(const Double3& at) const {
        double sum = 0.0, part = 0.5, wave = config_.wave;
        for (std::uint32_t i = 0; i < config_.waves; ++i, part /= 2, wave /= 2)
            sum += part * noise(at / wave, i);
        return config_.height * std::clamp(sum, 0.0, 1.0);
    }
    /// Random numbers at whole coordinates, smoothly between them.
    double noise(const Double3& at, std::uint32_t octave) const {
        const Double3 low = glm::floor(at), s = at - low;
        const Double3 share = s * s * (3.0 - 2.0 * s);
        double sum = 0.0;
        for (int corner = 0; corner < 8; ++corner) {
            std::uint64_t place = config_.seed;
            double weight = 1.0;
            for (int axis = 0; axis < 3; ++axis) {
                const bool upper = (corner >> axis & 1) != 0;
                weight *= upper ? share[axis] : 1.0 - share[axis];
                place = place * 0x1000003u + std::uint64_t(std::int64_t(low[axis]) + upper);
            }
            sum += weight * Pcg32(place, octave).uniform_double();
        }
        return sum;
    }

    TriangleMesh mesh_;
    Config config_;
    std::vector<Vector3>
        outwards_;  ///< of length 1 by vertex; 0 where faces around it have no area
};

}  // namespace space
