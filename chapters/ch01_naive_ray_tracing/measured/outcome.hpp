/// @file
/// What is made of chapter 1's measurements: tables, charts, verdicts, and what the text quotes.
#pragma once

#include "chapters/ch01_naive_ray_tracing/measured/data.hpp"
#include "common/program/chart.hpp"
#include "common/program/numbers.hpp"
#include "common/program/results.hpp"

namespace space::ch01 {

/// Growth exponents of one scene: naive tracing over all sizes; rasterising over all, and between
/// the two largest, where the pixels' share has faded.
struct Slopes {
    double naive, rasteriser, rasteriser_last;
};
Slopes slopes(const std::vector<GrowthPoint>& growth, const std::string& scene);

/// Growth exponents over all sizes of one scene: of the time of the tests, and of the rest.
struct ShareSlopes {
    double tests, rest;
};
ShareSlopes share_slopes(const std::vector<SharePoint>& shares, const std::string& scene);

/// Time per pixel against triangles, both renderers, two of the scenes.
Chart growth_chart(const std::vector<GrowthPoint>& growth);
/// The part of the time that is not spent in intersection tests, against triangles.
Chart share_chart(const std::vector<SharePoint>& shares);
/// The time of the same test in float and in double, and how many rays slip through.
Chart accuracy_chart(const VertexLeaks& leaks);

/// The answers to H1, H2, H3, H14 and P1.
std::vector<ClaimAnswer> answer_claims(const Measurements& measured);

/// Tables on the terminal.
void print_counts(const std::vector<SceneCounts>& all);
void print_times(const std::vector<GrowthPoint>& growth, const std::vector<SharePoint>& shares);

/// What the text quotes; times where there are any.
Numbers quoted(const Measurements& measured);

}  // namespace space::ch01
