/// @file
/// Which structure does a scene need? The one with the least total time, build + rays times the
/// time of a ray, by a model that foretells both from the scene's features.
#pragma once

#include "chapters/ch12_comparison/ridge.hpp"
#include "chapters/ch12_comparison/scene_features.hpp"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace space {

// [cost]
/// What a structure costs over one scene: measured or foretold.
struct StructureCost {
    double build_ns = 0.0;
    double ns_per_ray = 0.0;  ///< with all threads; the mean of four kinds of rays
    double bytes = 0.0;

    double total_ns(double rays) const { return build_ns + rays * ns_per_ray; }
};
// [cost]

/// Foretells the cost of one structure, from the features: log2 of each figure is linear in them.
struct StructureModel {
    std::string structure;
    LinearModel build;  ///< log2 of nanoseconds a triangle
    LinearModel ray;    ///< log2 of nanoseconds a ray
    LinearModel bytes;  ///< log2 of bytes a triangle

    StructureCost cost(const SceneFeatures& features) const;
};

/// How fast a machine is: nanoseconds of a small piece of work that is always the same.
struct ProbeTimes {
    double build_per_triangle = 1.0, per_ray = 1.0;
};

/// A feature over the scenes that a model was fitted on: its mean, least and largest value.
struct FeatureRange {
    double usual = 0.0, least = 0.0, most = 0.0;
    bool operator==(const FeatureRange&) const = default;
};

/// All that is kept of the measurements.
struct AdviceModel {
    std::vector<StructureModel> structures = {};
    std::array<FeatureRange, feature_names.size()> seen{};
    ProbeTimes probe = {};  ///< of the machine that it was fitted on
    std::string machine = {}, date = {};
};

/// What a reader asks for.
struct AdviceRequest {
    double rays = 1.0;  ///< to be traced; of a moving scene: in each frame
    bool moving = false;
    std::optional<double> memory = {};  ///< bytes that the structure may hold
};

/// The reader's machine.
struct Calibration {
    double build = 1.0, ray = 1.0;  ///< times here / times of the model's machine
    double refit_ns_per_triangle = 0.0;
};

/// A structure that was considered, with its cost on the reader's machine.
struct Candidate {
    std::string structure;
    StructureCost cost;  ///< of a moving scene: each frame's; refitting counts as building
    bool is_refitted = false;
    double total_ns = 0.0;
};

/// Those that fit in the memory, from the least total time to the most: the first is the advice,
/// the second the runner-up.
std::vector<Candidate> advise(const AdviceModel& model, const SceneFeatures& features,
                              const AdviceRequest& request, const Calibration& here = {});

/// The rays from which the one that is dearer to build is the cheaper one in all; infinite where
/// it never is.
double break_even_rays(const StructureCost& a, const StructureCost& b);

/// Whether chapter 9's RefittedBvh can hold it: chapter 7's trees that name each triangle once.
bool can_be_refitted(std::string_view structure);

/// Why the first and not the second: the terms that decided, and the feature that did most for it.
std::string reason(const AdviceModel& model, const SceneFeatures& features,
                   std::span<const Candidate> candidates);

/// As kept in a file; names and numbers, one line each. @throws Error (bad_input)
AdviceModel read_advice(std::string_view csv);
std::string advice_csv(const AdviceModel& model);

/// The model that this program was compiled with: figures/measured/ch12_advice.csv as it stood.
/// @throws Error (bad_input) where there was none
AdviceModel kept_advice();

}  // namespace space
