/// @file
/// Fits the model of the advice on half of the compared scenes, and judges it by the other half and
/// by scenes from files.
#pragma once

#include "chapters/ch12_comparison/advice.hpp"
#include "chapters/ch12_comparison/measured/advice_data.hpp"
#include "chapters/ch12_comparison/measured/break_even.hpp"
#include "chapters/ch12_comparison/measured/comparison_data.hpp"
#include "common/program/numbers.hpp"
#include "common/program/options.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace space::ch12 {

/// A block of the comparison as the advice sees it.
struct KnownScene {
    SeenScene seen;
    SceneFeatures features;
    double look_ms = 0.0;                                      ///< that looking at it took
    std::vector<std::pair<std::string, StructureCost>> costs;  ///< of our structures that stand
    std::vector<CostLine> lines;                               ///< what counts in hindsight
};

/// Whether the scene of the comparison is one to fit with: of the k-th kind the i-th size where
/// i + k is even. Both halves have each kind. Those from files are for judging alone.
bool is_for_fitting(const std::string& scene, const std::string& spec);

/// Timed blocks of our structures, without bvh-instanced, which wants instances.
std::vector<KnownScene> known_scenes(const Comparison& comparison, std::uint64_t seed);

/// What a model may learn: the first so many features, 1 to all. Growth with the number of
/// triangles is free, the weight of each other one has the penalty.
struct FitRule {
    std::size_t features = feature_names.size();
    double penalty = 0.0;
};

/// The model of the structures that stand on all of these scenes of up to 100,000 triangles. It
/// foretells means, not the logarithms' (ridge.hpp: smeared).
AdviceModel fit_advice(std::span<const KnownScene* const> scenes, const FitRule& rule);

/// Advice for 1, 10, ... 10^10 rays through the scene. What was not measured there is passed over.
std::vector<AdviceCase> ask(const AdviceModel& model, const KnownScene& scene);

AdviceMethod summary_of_cases(std::string name, std::string about,
                              std::span<const AdviceCase> cases);

/// Empty where fewer than eight scenes are there to fit with.
JudgedAdvice judge_advice(const Comparison& comparison, std::uint64_t seed);

/// By what options ask for, measured once.
JudgedAdvice measure_advice(const Options& options);

/// What the page quotes.
void quote_advice(const JudgedAdvice& judged, Numbers& numbers);

}  // namespace space::ch12
