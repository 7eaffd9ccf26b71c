/// @file
/// Colours for counts: maps of what each pixel costs.
#pragma once

#include "common/program/image.hpp"
#include "common/scene.hpp"

namespace space {

/// From few (0) to many (1): dark to light, so that it reads without colours too.
Color heat(double share);
/// All of them from left to right, in a row of pixels.
Image heat_bar();

}  // namespace space
