/// @file
/// What a measurement must be read with: how much was measured, by which sources, where and when.
#pragma once

#include "common/program/options.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <map>
#include <string>

namespace space {

/// A fingerprint of each folder of sources, such as "chapters/ch03_bsp_trees" or "common".
using Fingerprints = std::map<std::string, std::string>;

/// One run of a chapter's program.
struct Provenance {
    std::string chapter;  ///< "ch01_naive_ray_tracing"
    std::string mode;     ///< "small", "quick" or "full"; "counts": as full, without any time
    std::string machine, date;
    Fingerprints sources = {};  ///< as they stood when the program ran; empty: not known
};

/// This run, now.
Provenance provenance(const std::string& chapter, const Options& options);

/// Processor name, cores, compiler.
std::string machine_description();
/// Today as YYYY-MM-DD; SOURCE_DATE_EPOCH is honoured.
std::string today();

/// Of all that a chapter's measurements are compiled from: its subject and measured/, those of the
/// chapters that it includes, and common/. Comments and white space do not count, nor does what
/// only draws or tells. Empty where `root` has no such chapter.
Fingerprints source_fingerprints(const std::filesystem::path& root, const std::string& chapter);

void to_json(nlohmann::ordered_json& json, const Provenance& run);
void from_json(const nlohmann::json& json, Provenance& run);

}  // namespace space
