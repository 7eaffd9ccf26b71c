/// @file
/// The figures of chapter 1: the chapter's own code draws them.
#pragma once

#include "common/program/figure.hpp"

#include <span>

namespace space::ch01 {

std::span<const Figure> chapter01_figures();

}  // namespace space::ch01
