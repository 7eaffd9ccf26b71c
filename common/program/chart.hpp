/// @file
/// Charts of measured series: data as CSV with the machine and the date in it, drawn by gnuplot as
/// SVG in the drawings' palette (common/program/svg.hpp), so that charts follow light and dark
/// pages too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace space {

/// Points (x[i], y[i]), or for bars the values y[i] of the chart's categories.
struct Series {
    std::string name;  ///< stands beside the last point of a line
    std::vector<double> x, y;
    std::vector<std::string> labels = {};  ///< of single points; may be empty
    std::string note = {};                 ///< a second line under the name, such as "slope 1.02"
};

/// What stands for a value: a corner of a line, a dot, or a bar.
enum class ChartKind { lines, points, bars };

/// Text is drawn as it stands, one line each. On a logarithmic axis, values that are not positive
/// are left out; those that are not finite are left out everywhere. The CSV has them all.
struct Chart {
    std::string id = {};  ///< "fig_01_07"; a figure's caller sets it
    std::string title;    ///< alternative text
    std::string x_label, y_label;
    bool log_x = false, log_y = false;
    ChartKind kind = ChartKind::lines;
    std::vector<Series> series;
    std::vector<std::string> categories = {};  ///< names along x for bars
};

/// Writes ID.csv and ID.svg into `out`. Without gnuplot the CSV alone, and says so on stderr.
/// @throws Error (bad_output) where a file cannot be written or gnuplot fails
void write_chart(const std::filesystem::path& out, const Chart& chart);

/// The data of a chart: comment lines with title, machine and date, then one line for each point.
std::string chart_csv(const Chart& chart);

}  // namespace space
