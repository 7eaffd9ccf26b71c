/// @file
/// Affine maps: how an object's local space lies in the space that holds it.
#pragma once

#include "common/geometry.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace space {

// [affine]
/// p goes to M p, a linear map and a translation: the first three rows of a 4 x 4 matrix whose last
/// row is 0 0 0 1. In double, and every sum from left to right: flattening and tracing have to come
/// to the same bits.
struct Affine {
    std::array<std::array<double, 4>, 3> rows = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    double at(int row, int column) const {
        return rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
    /// Where a point goes.
    Double3 point(const Double3& p) const {
        return row_by_row(
            [&](const auto& r) { return r[0] * p.x + r[1] * p.y + r[2] * p.z + r[3]; });
    }
    /// Where a difference of points goes: nothing moves it.
    Double3 vector(const Double3& v) const {
        return row_by_row([&](const auto& r) { return r[0] * v.x + r[1] * v.y + r[2] * v.z; });
    }
    /// The same for coordinates that are known by their sizes alone: how large the sums may be.
    Double3 size_of_vector(const Double3& v) const {
        return row_by_row([&](const auto& r) {
            return std::abs(r[0]) * v.x + std::abs(r[1]) * v.y + std::abs(r[2]) * v.z;
        });
    }
    Double3 size_of_point(const Double3& p) const {
        return size_of_vector(p) +
               Double3(std::abs(at(0, 3)), std::abs(at(1, 3)), std::abs(at(2, 3)));
    }
    Double3 translation() const { return {at(0, 3), at(1, 3), at(2, 3)}; }

    bool operator==(const Affine&) const = default;

  private:
    template <class OfRow>
    Double3 row_by_row(const OfRow& of_row) const {
        return {of_row(rows[0]), of_row(rows[1]), of_row(rows[2])};
    }
};
// [affine]

/// Whether all entries are.
inline bool is_finite(const Affine& map) {
    for (const auto& row : map.rows)
        for (const double entry : row)
            if (!std::isfinite(entry)) return false;
    return true;
}

// [composed]
/// First `inner`, then `outer`: the product outer inner.
inline Affine composed(const Affine& outer, const Affine& inner) {
    Affine product;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& row = outer.rows[i];
        for (std::size_t j = 0; j < 4; ++j)
            product.rows[i][j] =
                row[0] * inner.rows[0][j] + row[1] * inner.rows[1][j] + row[2] * inner.rows[2][j];
        product.rows[i][3] += row[3];
    }
    return product;
}
// [composed]

// [flattened]
/// A mesh's triangle in the world: each coordinate computed in double, then rounded to float, once.
/// This is what flattening *means*; all that claims to be exact here is measured against it.
inline Triangle flattened(const Affine& to_world, const Triangle& triangle) {
    const auto corner = [&](const Point3& p) { return Point3(to_world.point(Double3(p))); };
    return {corner(triangle.a), corner(triangle.b), corner(triangle.c)};
}
// [flattened]

/// Negative where the map mirrors.
inline double determinant(const Affine& m) {
    return m.at(0, 0) * (m.at(1, 1) * m.at(2, 2) - m.at(1, 2) * m.at(2, 1)) +
           m.at(0, 1) * (m.at(1, 2) * m.at(2, 0) - m.at(1, 0) * m.at(2, 2)) +
           m.at(0, 2) * (m.at(1, 0) * m.at(2, 1) - m.at(1, 1) * m.at(2, 0));
}

// [residual]
/// How far inverse map is from an identity, entry by entry: above |inverse map - 1|, the computed
/// difference and all that its roundings may hide. With u53 = 2^-53 each of four products of a row
/// and a column has at most four roundings, the difference one more.
inline Affine residual(const Affine& inverse, const Affine& map) {
    const Affine product = composed(inverse, map), identity;
    Affine off;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 4; ++j) {
            double size = j == 3 ? std::abs(inverse.rows[i][3]) : 0.0;
            for (std::size_t k = 0; k < 3; ++k)
                size += std::abs(inverse.rows[i][k] * map.rows[k][j]);
            off.rows[i][j] =
                std::abs(product.rows[i][j] - identity.rows[i][j]) + 6.0 * 0x1p-53 * size;
        }
    return off;
}
// [residual]

// [inverse]
/// The inverse by cofactors, as near as doubles come. Nothing where the map is singular, or so near
/// to it that doubles cannot tell: where |inverse map - 1| is below 1 in some norm both matrices
/// have an inverse (its series converges). The norm that is asked here is the largest entry of a
/// vector, each divided by the size of its row of the inverse: scales that differ by 10^12 are no
/// reason to refuse.
inline std::optional<Affine> inverse(const Affine& m) {
    const double det = determinant(m);
    Affine inverse;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            inverse.rows[std::size_t(i)][std::size_t(j)] =
                (m.at(j1, i1) * m.at(j2, i2) - m.at(j1, i2) * m.at(j2, i1)) / det;
        }
    const Double3 back = inverse.vector(m.translation());
    for (int i = 0; i < 3; ++i) inverse.rows[std::size_t(i)][3] = -back[i];
    if (!is_finite(inverse)) return std::nullopt;
    const Double3 weight = inverse.size_of_vector(Double3(1.0)),
                  off = residual(inverse, m).size_of_vector(weight);
    for (int i = 0; i < 3; ++i)
        if (!(off[i] < 0.5 * weight[i])) return std::nullopt;
    return inverse;
}
// [inverse]

}  // namespace space
