/// @file
/// Every structure on every scene: what is measured, one scene of one size after another, into a
/// file that an interrupted run goes on with.
#pragma once

#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "chapters/ch12_comparison/measured/comparison_data.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/program/options.hpp"
#include "common/program/progress.hpp"

#include <cstdio>
#include <span>
#include <string>
#include <vector>

namespace space::ch12 {

/// All structures on one scene. Answers are compared with naive tracing's up to 10,000 triangles,
/// and with those of bvh-binned beyond, which is proved to give the same.
std::vector<ComparedRow> compare_on(const ComparedSubject& subject,
                                    std::span<const Structure> structures,
                                    const CompareEffort& effort, const Options& options,
                                    Progress* progress = nullptr);

/// Measures what is not in the file yet, and writes it after each block as a whole. What a file of
/// another machine, of other sources or settings holds is not taken; both are told on stderr.
/// @throws Error
Comparison compare_into(const std::filesystem::path& csv, std::span<const Structure> structures,
                        const CompareEffort& effort, const Options& options);

/// The sub-command `compare`: the whole comparison of these structures into --out. @return exit
/// code
int run_compare(std::span<const Structure> structures, int argc, char** argv);

/// What options ask for, through the lab with peers where that program stands beside this one.
Comparison measure_comparison(const Options& options);

/// In --out, and in figures/measured where it is kept.
inline constexpr const char* comparison_file = "ch12_comparison.csv";

}  // namespace space::ch12
