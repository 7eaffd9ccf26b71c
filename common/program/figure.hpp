/// @file
/// Every figure of the book is a function with an id. It returns what it shows; who called it
/// writes the file.
#pragma once

#include "common/program/chart.hpp"
#include "common/program/image.hpp"
#include "common/program/options.hpp"
#include "common/program/svg.hpp"

#include <span>
#include <string_view>
#include <variant>

namespace space {

/// A figure of the book, as its add_figure line names it.
struct Figure {
    std::string_view id;  ///< "fig_01_03"
    /// A drawing or a rendering has the same bytes on every run and machine; a chart shows measured
    /// times and is never compared.
    std::variant<Svg (*)(const Options&), Image (*)(const Options&), Chart (*)(const Options&)>
        make;

    bool is_chart() const { return std::holds_alternative<Chart (*)(const Options&)>(make); }
};

/// Makes the figure and writes ID.svg (a drawing; a chart, with ID.csv) or ID.png (a rendering)
/// into options.out.
void write_figure(const Figure& figure, const Options& options);

/// Writes the figure that options.figure names, or all of them for "all"; returns an exit code.
/// @throws Error (usage) for an unknown id, with the list of those that there are
int write_figures(std::span<const Figure> figures, const Options& options);

}  // namespace space
