/// @file
/// Scenes that grow by nesting, from a thousand triangles to a million millions: memory, time, and
/// answers beside those of the flattened mesh and of Embree.
#pragma once

#include "chapters/ch09_instancing_and_motion/measured/nesting_data.hpp"
#include "common/camera.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"

#include <cstdint>
#include <string_view>

namespace space::ch09 {

NestingMeasurements measure_nesting(const Options& options);

/// What looks at a nested scene.
Camera nested_camera(std::string_view scene);

void print_nesting(const NestingMeasurements& measured, bool times);
void quote_nesting(const NestingMeasurements& measured, bool times, Numbers& numbers);
/// Answers of the exact way that are not the flattened mesh's.
std::uint64_t wrong_nesting(const NestingMeasurements& measured);

Chart nesting_memory_chart(const NestingMeasurements& measured);
Chart nesting_speed_chart(const NestingMeasurements& measured);

}  // namespace space::ch09
