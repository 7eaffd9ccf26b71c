/// @file
/// Speed against accuracy over the whole book, as plain values: each structure with each triangle
/// test, asked where tests fail.
#pragma once

#include "chapters/ch12_comparison/structures.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace space::ch12 {

/// A structure with a triangle test, on one scene.
struct AccuracyRow {
    std::string scene, structure, test, home;
    bool is_peer = false;
    std::uint64_t rays = 0;
    std::uint64_t missed = 0;     ///< there is a hit
    std::uint64_t false_hit = 0;  ///< there is none
    std::uint64_t behind = 0;     ///< another hit, farther by more than a thousandth of the way
    double ns_per_ray = 0.0;      ///< of one thread

    std::uint64_t wrong() const { return missed + false_hit + behind; }
};

/// Rays at edges, at vertices and along faces, judged by naive tracing with the exact test, which
/// the oracle has judged; every structure that can cope is asked, in every triangle test of its.
std::vector<AccuracyRow> measure_accuracy_of(std::span<const Structure> structures,
                                             const Options& options);

/// Writes what it measures, unless the file is there already, of the same machine, sources and
/// settings.
void accuracy_into(const std::filesystem::path& csv, std::span<const Structure> structures,
                   const Options& options);
/// @throws Error (bad_input)
std::vector<AccuracyRow> read_accuracy(const std::filesystem::path& csv);

/// What measure_comparison left in --out; measured with the book's structures where there is none.
std::vector<AccuracyRow> measure_accuracy(const Options& options);

/// All rows of a structure and test together.
struct AccuracyPoint {
    std::string structure, test, home;
    bool is_peer = false;
    double ns_per_ray = 0.0;  ///< geometric mean over the scenes
    double per_million = 0.0;
};
std::vector<AccuracyPoint> accuracy_points(std::span<const AccuracyRow> rows);

/// Those that a table shows: one of each kind, and the peers.
bool stands_for_its_kind(const AccuracyPoint& point);

/// The table `accuracy`, and the numbers accuracy_points, accuracy_exact_points, accuracy_rays,
/// accuracy_scenes, accuracy_most.
void quote_accuracy(std::span<const AccuracyRow> rows, Numbers& numbers);

inline constexpr const char* accuracy_file = "ch12_accuracy.csv";

}  // namespace space::ch12
