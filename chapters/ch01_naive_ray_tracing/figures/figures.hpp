/// @file
/// The figures of chapter 1: the chapter's own code draws them.
#pragma once

#include "common/program/chart.hpp"
#include "common/program/figure.hpp"

#include <span>

namespace space::ch01 {

std::span<const Figure> chapter01_figures();

/// fig_01_08: the time of the same test in float and in double, and how many rays slip through a
/// closed surface.
Chart accuracy_chart(const Options& options);

}  // namespace space::ch01
