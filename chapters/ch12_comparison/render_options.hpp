/// @file
/// The command line of ./book render.
#pragma once

#include "common/camera.hpp"
#include "common/program/options.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>

namespace space {

/// How the light is found: chapter 11's three ways.
enum class RenderMethod { path, photons, cache };
const char* render_method_name(RenderMethod method);

/// What to render, how, how long, and what to write; a path that is empty was not given.
struct RenderOptions {
    Options common;
    std::filesystem::path mesh;
    std::optional<Camera> camera;  ///< none: the scene's own
    RenderMethod method = RenderMethod::path;
    std::size_t samples = 64;  ///< a pixel
    double seconds = std::numeric_limits<double>::infinity();
    std::string structure = "fast";  ///< a name, or "list"
    unsigned build_threads = 0;      ///< parse_render_options turns 0 into --threads
    std::size_t photons = 1'000'000;
    double accuracy = 0.3;  ///< the cache's a: records reach farther where it is larger
    double exposure = 1.0;
    std::filesystem::path out, hdr;
    bool resume = false;

    /// What a picture is gone on from.
    std::filesystem::path state() const { return out.string() + ".state"; }
};

/// --help prints and exits 0. @throws Error (usage) with one line that says what is wrong
RenderOptions parse_render_options(int argc, char** argv);

/// To be asked before long work. @throws Error (usage) for an output that is also an input or
/// another output, (bad_output) for one that cannot be written
void check_outputs(const RenderOptions& options);

}  // namespace space
