/// @file
/// What is counted and timed of placements, as plain values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch09 {

/// Local points found again from world points, in float: the largest errors, in units of 2^-24 of
/// the object's half size.
struct InverseError {
    std::string placements;
    double parts = 0.0;    ///< by S^-1 (R^T (q - t))
    double product = 0.0;  ///< by the matrix S^-1 R^T T^-1
    double general = 0.0;  ///< by the general inverse of the matrix T R S
};

/// The time of one operation.
struct TransformTime {
    std::string what;
    double float_ns = 0.0, double_ns = 0.0;  ///< 0 where there is none
};

/// A product of rotations: the largest entry of |R R^T - 1|.
struct Drift {
    std::uint64_t turns = 0;
    double in_float = 0.0, made_orthonormal = 0.0, in_double = 0.0;
};

/// Normals of a sphere that is stretched along one axis.
struct StretchedNormals {
    double stretch = 0.0;
    double derived = 0.0;        ///< the largest angle by M n, in degrees
    double by_matrix = 0.0;      ///< the same as measured
    double by_transposed = 0.0;  ///< by the inverse's transpose
    double turned_away = 0.0;    ///< share of visible points whose M n is turned away
};

/// Triangles of spheres, placed with so many negative scales.
struct Winding {
    unsigned negative = 0;
    std::uint64_t triangles = 0;
    std::uint64_t inwards = 0;          ///< whose (b - a) x (c - a) points inwards
    std::uint64_t seen_wrong = 0;       ///< sides taken for the other one by n . d < 0
    std::uint64_t corrected_wrong = 0;  ///< by (n . d < 0) xor (det < 0)
};

/// All of it; no times where nothing is timed.
struct TransformMeasurements {
    std::vector<InverseError> inverses;
    std::vector<TransformTime> times;
    std::vector<Drift> drifts;
    std::vector<StretchedNormals> normals;
    std::vector<Winding> windings;
};

}  // namespace space::ch09
