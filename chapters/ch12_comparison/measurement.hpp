/// @file
/// Measuring structures side by side: they take turns, and one that gives up leaves the others'
/// results alone.
#pragma once

#include "chapters/ch12_comparison/lab_options.hpp"
#include "chapters/ch12_comparison/structures.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace space {

/// A structure with the triangle test to build it with.
struct Choice {
    const Structure* structure;
    const StructureVariant* variant;
};

/// What a structure cost and answered. Where it gave up there is no more than the reason.
struct Measurement {
    Choice choice;
    std::string gave_up = {};  ///< why; empty for a structure that stands
    double build_ms = 0.0, trace_ms = 0.0;
    unsigned build_threads = 1;
    std::string configuration = {};
    TreeShape shape = {};
    std::optional<TraversalCounts> counts = {};
    std::vector<HitRecord> hits = {};

    std::string_view name() const { return choice.structure->name; }
    bool stands() const { return gave_up.empty(); }
    std::size_t hit_count() const;
    double rays_per_second() const { return static_cast<double>(hits.size()) / trace_ms * 1e3; }
};

/// Builds each structure and traces the rays through it, options.repeat times after a turn to warm
/// up; times are medians. Whatever a structure throws is its reason to give up. At last calls
/// `look` with each that stands, which is gone after that.
std::vector<Measurement> measure(
    std::span<const Choice> chosen, const Geometry& geometry, std::span<const Ray> rays,
    const LabOptions& options,
    const std::function<void(const BuiltStructure&)>& look = [](const BuiltStructure&) {});

}  // namespace space
