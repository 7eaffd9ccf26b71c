/// @file
/// The lab's command line.
#pragma once

#include "chapters/ch12_comparison/structures.hpp"
#include "common/camera.hpp"
#include "common/program/options.hpp"

#include <cstddef>
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
    std::filesystem::path rays;
    std::optional<Camera> camera;
    std::size_t diffuse = 0;
    std::vector<std::string> structures;  ///< names, "all" or "list"; at least one
    std::string triangle_test;            ///< a name, "list", or empty: each structure's default
    Query query = Query::closest;
    unsigned build_threads = 0;
    int repeat = 3;
    bool check = false;
    std::filesystem::path hits, json;
};

/// As on the command line.
constexpr std::string_view query_name(Query query) {
    return query == Query::any ? "any" : "closest";
}

/// --help prints and exits 0. @throws Error (usage) with one line that says what is wrong
LabOptions parse_lab_options(int argc, char** argv);

}  // namespace space
