/// @file
/// Speed against accuracy as one chart.
#pragma once

#include "chapters/ch12_comparison/measured/accuracy_data.hpp"
#include "common/program/chart.hpp"

#include <span>

namespace space::ch12 {

/// Wrong answers per million rays against the time of one: a point for each structure and test.
Chart accuracy_chart(std::span<const AccuracyRow> rows);

}  // namespace space::ch12
