/// @file
/// How good the advice is, as plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace space::ch12 {

/// One question: so many rays through one scene of one size.
struct AdviceCase {
    std::string scene, spec;
    std::uint64_t triangles = 0;
    double rays = 0.0;
    std::string advised, best;  ///< structures; the best in hindsight, by what was measured
    double advised_ns = 0.0, best_ns = 0.0;

    double ratio() const { return advised_ns / best_ns; }
    bool is_good() const { return ratio() <= 1.15; }
};

/// How a way of foretelling costs does on scenes of kinds that it has not seen.
struct AdviceMethod {
    std::string name, about;
    std::size_t cases = 0, good = 0;
    double mean_ratio = 0.0;  ///< geometric
    double worst_ratio = 0.0;

    double share() const { return static_cast<double>(good) / static_cast<double>(cases); }
};

/// What is seen of a scene, as in a table's row.
struct SeenScene {
    std::string scene, spec;
    std::uint64_t triangles = 0;
    std::vector<double> features;  ///< in the order of feature_names
    bool is_fetched = false, is_fitted = false;
};

/// The model, how it was chosen, and what became of its advice.
struct JudgedAdvice {
    std::vector<SeenScene> scenes;
    std::vector<AdviceMethod> methods;  ///< tried within the fitting half, simple ones first
    std::size_t chosen = 0;             ///< of these
    /// Questions to the chosen one, once it was fitted on its whole half.
    std::vector<AdviceCase> fitted, other_half, fetched;
    double look_ms = 0.0;  ///< that a look at a million triangles took at most
    std::string
        model_csv;  ///< for figures/measured/ch12_advice.csv; empty where too little is known
};

}  // namespace space::ch12
