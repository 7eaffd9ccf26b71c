/// @file
/// Charts of measured series: data as CSV with the machine and the date in it, drawn by gnuplot as
/// SVG in the drawings' palette (common/program/svg.hpp), so that charts follow light and dark
/// pages too.
#pragma once

#include "common/program/svg.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace space {

/// Points (x[i], y[i]), or for bars the values y[i] of the chart's categories.
struct Series {
    std::string name;  ///< stands beside the last point of a line
    std::vector<double> x, y;
    std::vector<std::string> labels = {};  ///< of single points; may be empty
    std::string note = {};                 ///< a second line under the name, such as "slope 1.02"
};

/// A point for each item, at x(item) and y(item).
template <class Items, class X, class Y>
Series series_along(std::string name, Items&& items, const X& x, const Y& y) {
    Series series{.name = std::move(name), .x = {}, .y = {}};
    for (const auto& item : items) {
        series.x.push_back(static_cast<double>(std::invoke(x, item)));
        series.y.push_back(static_cast<double>(std::invoke(y, item)));
    }
    return series;
}
/// The series with a note of the least-squares slope of log y over log x, if it has two points.
Series with_slope(Series series);

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
    /// Of the same data, where one frame of points or bars does not show them: it is written in
    /// gnuplot's place.
    std::optional<Svg> drawing = {};

    /// A bar for each category, of the height that `value` gives for its name.
    template <class Value>
    void add_bars(std::string_view name, const Value& value) {
        Series bars{.name = std::string(name), .x = {}, .y = {}};
        for (const std::string& category : categories) bars.y.push_back(value(category));
        series.push_back(std::move(bars));
    }
};

/// Writes ID.csv and ID.svg into `out`. Without gnuplot the CSV alone, and says so on stderr.
/// @throws Error (bad_output) where a file cannot be written or gnuplot fails
void write_chart(const std::filesystem::path& out, const Chart& chart);

/// The data of a chart: comment lines with title, machine and date, then one line for each point.
std::string chart_csv(const Chart& chart);

}  // namespace space
