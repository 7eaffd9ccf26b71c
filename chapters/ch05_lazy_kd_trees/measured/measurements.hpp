/// @file
/// What chapter 5's program counts and times.
#pragma once

#include "chapters/ch05_lazy_kd_trees/measured/data.hpp"
#include "common/program/options.hpp"

#include <cstddef>

namespace space::ch05 {

/// How far measurements go.
struct Limits {
    std::uint32_t teapot;          ///< the stand-in's detail
    std::uint32_t plants;          ///< along each side of the field
    int width, height;             ///< of pictures
    std::size_t rays;              ///< of the parts of a scene
    std::uint32_t field_cells;     ///< along each side
    std::uint32_t ball_levels;     ///< of subdivision
    std::uint32_t picture_levels;  ///< of the ball to whose first picture times are taken
    std::size_t list_sizes;        ///< decades from 1,000 triangles
    int rounds;                    ///< of timed runs
};
Limits limits(const Options& options);

/// Johnston06's table: three views of one mesh, and of a larger one where this machine has it, and
/// two of many plants.
std::vector<ViewPoint> measure_views(const Options& options);
/// Rays to growing parts of the plants.
std::vector<ReachPoint> measure_reach(const Options& options);
/// What is held while the first of the views is drawn.
std::vector<MemoryPoint> measure_memory(const Options& options);
std::vector<ListPoint> measure_lists(const Options& options);
std::vector<GeometryPoint> measure_geometry(const Options& options);
std::vector<FirstPicture> measure_first_pictures(const Options& options);

}  // namespace space::ch05
