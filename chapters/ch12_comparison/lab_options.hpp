/// @file
/// The lab's command line.
#pragma once

#include "chapters/ch12_comparison/advice.hpp"
#include "chapters/ch12_comparison/lab_pictures.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/camera.hpp"
#include "common/program/options.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace space {

/// What to trace, with what, how often, and what to write; a path that is empty was not given.
struct LabOptions {
    Options common{.width = 160, .height = 120};  ///< small enough for naive tracing of a bunny
    std::filesystem::path mesh;
    std::string instances;  ///< a file, or a nested scene's name
    bool flatten = false;   ///< and all structures are asked, not those alone that know instances
    std::filesystem::path rays;
    std::optional<Camera> camera;
    std::size_t diffuse = 0;
    std::vector<std::string> structures;  ///< names, "default", "all" or "list"; at least one
    std::string triangle_test;            ///< a name, "list", or empty: each structure's first
    std::string against;                  ///< the structure that ratios refer to; empty for none
    Query query = Query::closest;
    BuildOptions build{.threads = 0};
    int repeat = 3;
    bool packets = false;  ///< of rays, where a structure knows them
    bool check = false;
    std::string sort;  ///< the column that orders the rows; empty: the order of --structure
    std::filesystem::path hits, json, csv, heatmap, picture;
    HeatOf heatmap_of = HeatOf::nodes;
    std::uint64_t heatmap_max = 0;        ///< where its colours end; 0: where 99 of 100 pixels do
    std::optional<AdviceRequest> advice;  ///< instead of all that is measured

    bool instances_are_in_file() const {
        return instances.find_first_of("./") != std::string::npos;
    }
    /// Standard output is for programs: what is printed otherwise goes to standard error.
    bool data_to_stdout() const { return is_stdout(json) || is_stdout(csv); }

    static bool is_stdout(const std::filesystem::path& file) {
        return file == "-" || file == "/dev/stdout" || file == "/dev/fd/1";
    }
};

/// As on the command line.
constexpr std::string_view query_name(Query query) {
    return query == Query::any ? "any" : "closest";
}

/// --help prints and exits 0. @throws Error (usage) with one line that says what is wrong
LabOptions parse_lab_options(int argc, char** argv);

/// To be asked before long work. @throws Error (usage) for an output that is also an input or
/// another output, (bad_output) for one that cannot be written
void check_outputs(const LabOptions& options);

}  // namespace space
