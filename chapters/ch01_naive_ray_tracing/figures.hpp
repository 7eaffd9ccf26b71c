/// @file
/// The figures of chapter 1: the chapter's own code draws them.
#pragma once

#include <span>

#include "common/figure.hpp"

namespace space {

std::span<const Figure> chapter01_figures();

}  // namespace space
