/// @file
/// The charts that the comparison's rows are drawn as.
#pragma once

#include "chapters/ch12_comparison/measured/comparison_data.hpp"
#include "common/program/chart.hpp"

namespace space::ch12 {

/// Build against trace, one panel a scene: every structure a point, those that no other one beats
/// in both joined.
Chart pareto_chart(const Comparison& comparison);
/// Structures x scenes: the mean ray's cost over the least of ours.
Chart regret_chart(const Comparison& comparison);
/// Rays a second by kind of ray: a structure's least, middle and best scene.
Chart ray_kinds_chart(const Comparison& comparison);
/// Build and trace against size, in scenes of three kinds.
Chart growth_chart(const Comparison& comparison);
/// Bytes a triangle against the cost of a ray.
Chart memory_chart(const Comparison& comparison);
/// Which structure is the cheapest for how many rays: a strip a scene.
Chart break_even_chart(const Comparison& comparison);
/// What some structures cost in all, over the number of rays, in one scene.
Chart total_cost_chart(const Comparison& comparison);
/// Questions and answers on the way to a structure, with the numbers of rays as they were measured.
Chart decision_chart(const Comparison& comparison);

}  // namespace space::ch12
