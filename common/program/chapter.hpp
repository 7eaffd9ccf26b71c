/// @file
/// What the main programs of all chapters share: they make a figure or tell the chapter's story.
#pragma once

#include "common/program/figure.hpp"
#include "common/program/results.hpp"
#include "common/scene.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace space {

/// What CMake knows of a program's chapter: add_chapter and add_figure write it into the build
/// directory.
struct Chapter {
    std::string_view name;  ///< "ch01_naive_ray_tracing"
    std::span<const Figure> figures;
};
extern const Chapter this_chapter;

/// The scene that --scene asks for; what the reader of its mesh remarks goes to stderr.
Scene asked_scene(const Options& options);

/// Asked before long work: can the results be written into options.out?
/// @throws Error (bad_output)
void check_results_writable(const Options& options);

/// wrong_answer where there was any, ok where there was none.
int exit_code(std::uint64_t wrong_answers);

/// The end of a story: writes results.json and, unless the run was --small (times are no test's
/// business), the chapter's charts, and prints the verdicts on the sources' claims.
/// @return the exit code
int finish(const Options& options, const std::vector<ClaimAnswer>& answers,
           std::uint64_t wrong_answers);

}  // namespace space
