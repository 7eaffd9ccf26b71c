/// @file
/// The figures of chapter 3: the chapter's own code draws them.
#pragma once

#include <span>

#include "common/figure.hpp"

namespace space {

std::span<const Figure> chapter03_figures();

}  // namespace space
