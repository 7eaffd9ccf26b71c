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

namespace space {

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

/// Everything, in the layout that chapter.dox describes; `checked` is empty without --check.
std::string json_text(const LabOptions& options, const MeshFacts& facts,
                      std::span<const Measurement> measurements, const Measurement* against,
                      std::span<const Checked> checked);

}  // namespace space
