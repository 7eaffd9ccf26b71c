/// @file
/// How chapter 2 counts and times.
#pragma once

#include "chapters/ch02_intersection_tests/measured/accuracy.hpp"
#include "chapters/ch02_intersection_tests/measured/timing.hpp"
#include "common/program/options.hpp"

#include <initializer_list>
#include <vector>

namespace space::ch02 {

/// How many inputs are counted, and how many rounds are timed.
struct Sizes {
    std::uint64_t pairs;      ///< rays with a triangle each, per input class
    std::uint64_t leak_rays;  ///< per closed mesh
    std::uint64_t volumes;    ///< of whole numbers
    std::uint32_t root_stride, root_samples;
    std::uint64_t boxes, spheres;  ///< rays with a box or a sphere each, spheres per distance
    std::uint64_t bounces;         ///< per way and place
    int rounds;
};
Sizes sizes(Amount amount);

/// A part fills in its own members. Counts do not depend on the number of threads; times are taken
/// on one.
using Part = void (*)(const Options& options, Measurements& measured);
void count_triangles(const Options& options, Measurements& measured);
void count_signs(const Options& options, Measurements& measured);
void count_leaks(const Options& options, Measurements& measured);
void count_roots(const Options& options, Measurements& measured);
void count_boxes(const Options& options, Measurements& measured);
void count_spheres(const Options& options, Measurements& measured);
void count_bounces(const Options& options, Measurements& measured);
void time_triangles(const Options& options, Measurements& measured);
void time_patterns(const Options& options,
                   Measurements& measured);  ///< boxes, and orders of a triangle test
void time_others(const Options& options, Measurements& measured);  ///< roots, spheres, planes

/// What these parts count and time, each once in a program's run: tables, claims and charts show
/// the same.
const Measurements& measure(const Options& options, std::initializer_list<Part> parts);
const Measurements& measure_all(const Options& options);

/// What is promised never to happen: hits that the conservative box test misses, and certain signs
/// that are wrong.
std::uint64_t wrong_answers(const Measurements& measured);

}  // namespace space::ch02
