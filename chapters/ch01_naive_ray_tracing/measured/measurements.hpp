/// @file
/// How chapter 1 counts and measures.
#pragma once

#include "chapters/ch01_naive_ray_tracing/measured/data.hpp"
#include "common/program/options.hpp"
#include "common/scene.hpp"

namespace space::ch01 {

/// The scene with its triangles listed from the last to the first.
Scene in_reverse(Scene scene);

/// For five scenes. --small takes their small sizes.
std::vector<SceneCounts> count_scenes(const Options& options);
/// With the test in float and in double; --counts does not time them.
VertexLeaks measure_leaks(const Options& options);
/// Five scenes, from 1 K to 1 M triangles (slivers to 100 K).
std::vector<GrowthPoint> measure_growth(const Options& options);
std::vector<SharePoint> measure_shares(const Options& options);

Measurements measure(const Options& options);

}  // namespace space::ch01
