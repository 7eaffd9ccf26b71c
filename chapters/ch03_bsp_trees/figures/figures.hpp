/// @file
/// The figures of chapter 3: the chapter's own code draws them.
#pragma once

#include "common/program/figure.hpp"

#include <span>

namespace space::ch03 {

std::span<const Figure> chapter03_figures();

}  // namespace space::ch03
