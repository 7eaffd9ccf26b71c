/// @file
/// What chapter 12 measures of each structure on each scene, as plain values, and the CSV file that
/// holds them.
#pragma once

#include "common/program/options.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace space::ch12 {

/// The rays of a comparison: closest hit through a picture's pixels; any hit from there to the
/// lamps; closest hit of cosine-distributed rays that leave those surfaces; any hit of the same.
enum class RayKind { camera, shadow, diffuse, any };
inline constexpr std::array<RayKind, 4> ray_kinds{RayKind::camera, RayKind::shadow,
                                                  RayKind::diffuse, RayKind::any};
inline constexpr std::array<std::string_view, 4> ray_kind_names{"camera", "shadow", "diffuse",
                                                                "any"};

/// What is not known, such as a peer's nodes per ray, or was not timed.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// One kind of rays through one structure.
struct TracedKind {
    double ns_per_ray = unknown;  ///< by one thread; of a lazy tree, once its nodes stand
    double nodes_per_ray = unknown, tests_per_ray = unknown;
    std::uint64_t rays = 0, wrong = 0;  ///< wrong: another answer than exact arithmetic's

    bool operator==(const TracedKind&) const;
};

/// What the first `rays` rays, taken evenly from all kinds, spent on making nodes of a lazy tree.
struct NodesMade {
    double rays = 0.0, ms = 0.0;
    bool operator==(const NodesMade&) const = default;
};

/// One structure on one scene of one size.
struct ComparedRow {
    std::string scene = {};  ///< "soup"
    std::string spec = {};   ///< what makes it again: "soup:1000"; "graph/jacks:1", a nested scene
    std::uint64_t triangles = 0;
    std::string structure = {}, home = {};  ///< as the lab has them
    bool is_peer = false;
    unsigned build_threads = 1;
    double build_ms = unknown;
    std::vector<NodesMade> made_later = {};  ///< of a lazy tree, its last entry by all rays
    std::uint64_t bytes = 0;
    double nodes = unknown;  ///< unknown where a structure has none or does not tell
    std::uint64_t references = 0;
    double depth = unknown, sah_cost = unknown;
    std::array<TracedKind, ray_kinds.size()> traced = {};
    std::string gave_up = {};  ///< why; empty for a structure that stands

    bool stands() const { return gave_up.empty(); }
    const TracedKind& operator[](RayKind kind) const {
        return traced[static_cast<std::size_t>(kind)];
    }
    /// Until all nodes stand that the measured rays need: more rays never make fewer.
    double ready_ms() const {
        double made_ms = 0.0;
        for (const NodesMade& made : made_later) made_ms = std::max(made_ms, made.ms);
        return build_ms + made_ms;
    }
    /// The mean over the kinds of rays, each as important as another.
    double mean_ns() const;
    std::uint64_t rays() const;
    std::uint64_t wrong() const;
    bool operator==(const ComparedRow&) const;
};

/// All rows, block after block: a block is one scene of one size by all structures.
struct Comparison {
    std::vector<ComparedRow> rows = {};
    std::string machine = {}, date = {};
    std::string sources = {};   ///< a fingerprint of what was measured
    double minutes = 0.0;       ///< of measuring, in all runs together
    std::string settings = {};  ///< how much was measured, such as "full, seed 1, 2 threads"
};

/// The rows of each block, in their order.
std::vector<std::span<const ComparedRow>> blocks(const Comparison& comparison);
/// The structure's row; null where it has none or gave up.
const ComparedRow* find(std::span<const ComparedRow> block, std::string_view structure);

/// The file as text; a line after each block says that it is whole.
std::string csv_text(const Comparison& comparison);

/// @throws Error (bad_input) with one line for a file that is missing, or in which a line is broken
Comparison read_comparison(const std::filesystem::path& csv);
/// The same, of which only whole blocks are taken: `dropped` tells how many lines behind the last
/// one were left.
Comparison read_whole_blocks(const std::filesystem::path& csv, std::size_t& dropped);

/// That of the book, in figures/measured.
std::filesystem::path kept_comparison_file();

}  // namespace space::ch12
