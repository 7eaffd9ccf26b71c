/// @file
/// The option --camera of the lab and of ./book render.
#pragma once

#include "common/camera.hpp"

#include <CLI/CLI.hpp>

#include <optional>

namespace space {

/// Adds --camera ex,ey,ez,tx,ty,tz,fov. Parsing throws Error (usage) with one line for anything
/// that is no camera.
CLI::Option* add_camera_option(CLI::App& app, std::optional<Camera>& camera);

}  // namespace space
