/// @file
/// Every figure of the book is a function with an id.
#pragma once

#include "common/program/options.hpp"

#include <filesystem>
#include <span>
#include <string_view>

namespace space {

/// A drawing comes from an algorithm's own output and has the same bytes on every run and machine;
/// a rendering is a PNG, the same bytes too; a chart shows measured times and is never compared.
enum class FigureKind { drawing, rendering, chart };

/// A figure of the book, and the function that makes it.
struct Figure {
    std::string_view id;  ///< "fig_01_03"
    FigureKind kind;
    /// Writes ID.svg (a drawing; a chart, with ID.csv) or ID.png (a rendering) into options.out.
    void (*make)(const Options& options);
};

/// Makes the named figure, or all of them for "all"; returns an exit code.
/// @throws Error (usage) for an unknown id, with the list of those that there are
int make_figures(std::span<const Figure> figures, const Options& options);

}  // namespace space
