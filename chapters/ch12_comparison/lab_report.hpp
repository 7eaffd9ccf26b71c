/// @file
/// What the lab tells: tables for eyes, JSON for programs.
#pragma once

#include "chapters/ch12_comparison/check.hpp"
#include "chapters/ch12_comparison/measurement.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace space {

/// What rows can be ordered by: names of --json.
std::vector<std::string> sort_columns();
/// Orders the rows of all tables by one of them, the smallest first, but the most rays per second
/// and hits; what gave up or has no such figure stays behind. Equal rows keep their order.
void sort_rows(std::vector<Measurement>& measurements, std::string_view column);

/// Time as a multiple of another structure's; nothing where there is none to compare with.
struct Ratios {
    std::optional<double> build, trace;
};
Ratios ratios(const Measurement& measurement, const Measurement* against);

/// Cost and shape of each structure, and why those that gave up did.
void print_measurements(std::span<const Measurement> measurements, const Measurement* against,
                        const LabOptions& options, std::FILE* out);

/// How right each structure's answers are.
void print_checked(std::span<const Measurement> measurements, std::span<const Checked> checked,
                   std::FILE* out);

/// What the rays were traced through; a field without a meaning stays empty.
struct MeshFacts {
    std::string name;
    std::string file;
    std::uint64_t triangles = 0;
    std::optional<std::size_t> vertices = {};    ///< of a mesh
    std::optional<std::size_t> degenerate = {};  ///< where there is a list of triangles
    std::optional<std::size_t> objects = {}, instances = {};  ///< of a scene graph
};

/// Everything, in the layout that lab.dox describes; `checked` is empty without --check.
std::string json_text(const LabOptions& options, const MeshFacts& facts,
                      std::span<const Measurement> measurements, const Measurement* against,
                      std::span<const Checked> checked);

/// The structures of json_text as comma-separated values (RFC 4180), with the same names and
/// digits.
std::string csv_text(const LabOptions& options, const MeshFacts& facts,
                     std::span<const Measurement> measurements, const Measurement* against,
                     std::span<const Checked> checked);

}  // namespace space
