/// @file
/// Charts of measured series: data as CSV with the machine and the date in it, drawn by gnuplot as SVG in the
/// drawings' palette, so that charts follow light and dark pages too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace space {

struct Series {
    std::string name;
    std::vector<double> x, y;
    std::vector<std::string> labels = {};  ///< of single points; may be empty
};

enum class ChartKind { lines, points, bars };

struct Chart {
    std::string id;     ///< "chart_01_06"
    std::string title;  ///< alternative text
    std::string x_label, y_label;
    bool log_x = false, log_y = false;
    ChartKind kind = ChartKind::lines;
    std::vector<Series> series;
    std::vector<std::string> categories = {};  ///< names along x for bars
};

/// Writes ID.csv and ID.svg into `out`. Without gnuplot the CSV alone, and says so.
/// @throws Error (bad_output)
void write_chart(const std::filesystem::path& out, const Chart& chart);

}  // namespace space
