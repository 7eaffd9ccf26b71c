/// @file
/// The results file of a program: the answers to the sources' claims, and the series behind its
/// charts.
#pragma once

#include "common/program/provenance.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace space {

/// confirmed, refuted, or depends (on what `measured` says). Always computed from a measurement.
enum class Verdict { confirmed, refuted, depends };
std::string_view name(Verdict verdict);
/// confirmed where all scenes (or series, or tests) agree with the claim, refuted where none does.
Verdict verdict_of(std::size_t agree, std::size_t all);
/// "soup, room, boxes": for what was measured and on what.
std::string joined(const std::vector<std::string>& words);

/// What a program measured about one claim of the sources.
struct ClaimAnswer {
    std::string claim;  ///< id in the ledger, such as "H1"
    Verdict verdict;
    std::string measured;  ///< one sentence with the numbers
    std::string scene;     ///< what it was measured on
    std::string
        rule;  ///< how the verdict follows from the number, such as "slope within 0.9 .. 1.1"
};

/// Collected by a chapter's program, written once at its end as JSON.
struct Results {
    Provenance run;
    std::vector<ClaimAnswer> answers;
};

/// @throws Error (bad_output)
void write_results(const std::filesystem::path& file, const Results& results);

}  // namespace space
