/// @file
/// What is made of chapter 5's measurements: tables, charts, verdicts, and what the text quotes.
#pragma once

#include "chapters/ch05_lazy_kd_trees/measured/data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/results.hpp"

#include <optional>
#include <vector>

namespace space::ch05 {

/// The row of Johnston06's table that a view is to be held against; none for the one left empty.
std::optional<PublishedRow> published(const ViewPoint& point);

Chart reach_chart(const std::vector<ReachPoint>& reach);     ///< time against share, both trees
Chart memory_chart(const std::vector<MemoryPoint>& memory);  ///< held during a picture
Chart first_picture_chart(const std::vector<FirstPicture>& pictures);  ///< time against error

/// J1 to J7.
std::vector<ClaimAnswer> answer_claims(const Measurements& measured);

/// Counts; times too, where they mean something.
void print_views(const std::vector<ViewPoint>& views, bool times);
void print_reach(const std::vector<ReachPoint>& reach, bool times);
void print_memory(const std::vector<MemoryPoint>& memory);
void print_lists(const std::vector<ListPoint>& lists, bool times);
void print_geometry(const std::vector<GeometryPoint>& geometry, bool times);
void print_first_pictures(const std::vector<FirstPicture>& pictures, bool times);

/// What the text quotes; times where there are any; if not `all` has been measured, no table that
/// grows with what has.
Numbers quoted(const Measurements& measured, bool all, bool times);

}  // namespace space::ch05
