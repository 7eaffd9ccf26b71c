/// @file
/// What chapter 4 counts and times of searches among points, as plain values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace space::ch04 {

/// Queries for the k nearest of one set of points; counts are sums over all queries.
struct NearestQueries {
    std::uint64_t k = 0, queries = 0;
    std::uint64_t subtrees = 0, buckets = 0;  ///< gone into
    std::uint64_t compared = 0;               ///< points that floats did not leave out
    std::uint64_t checked = 0, wrong = 0;     ///< held against an exact loop, and not the same
    double microseconds = 0.0;                ///< a query, median
    /// nanoflann's, where it is installed.
    std::optional<double> peer_microseconds = {};
    /// Places among the neighbours where nanoflann names another point than ours: it depends on
    /// nanoflann's version.
    std::optional<std::uint64_t> peer_differs = {};

    double subtrees_per_query() const { return double(subtrees) / double(queries); }
    double buckets_per_query() const { return double(buckets) / double(queries); }
    double compared_per_query() const { return double(compared) / double(queries); }
    /// How many times as fast as nanoflann.
    std::optional<double> speedup() const {
        if (!peer_microseconds || microseconds == 0.0) return std::nullopt;
        return *peer_microseconds / microseconds;
    }
};

/// One set of points, uniform or clustered, in the plane or in space.
struct PointSet {
    std::string places;
    int dimensions = 0;
    std::uint64_t points = 0;
    std::vector<NearestQueries> nearest = {};
    double build_ms = 0.0;
    std::optional<double> peer_build_ms = {};
};

}  // namespace space::ch04
