/// @file
/// The figures of chapter 2: the chapter's own code draws them.
#pragma once

#include "common/program/figure.hpp"

#include <span>

namespace space::ch02 {

std::span<const Figure> chapter02_figures();

}  // namespace space::ch02
