#include "common/program/chart.hpp"

#include "common/measure.hpp"
#include "common/program/axis.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/plot.hpp"
#include "common/program/report.hpp"
#include "common/program/results.hpp"
#include "common/program/svg_colors.hpp"
#include "common/program/temporary.hpp"
#include "common/program/xml.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <optional>
#include <regex>
#include <utility>

extern char** environ;

namespace space {
namespace {

// In drawing units, as everything below.
constexpr double chart_width = 640, chart_height = 420;
constexpr double text_size = 17, line_height = 21, text_gap = 12;
constexpr double symbol_width = 22;  // with the gaps before and behind it
/// Mean width of a character, for margins. DejaVu Sans, the widest of the style block's fonts, has
/// about 0.6.
constexpr double character_width = 0.6 * text_size;

constexpr std::array series_inks{Ink::blue, Ink::vermillion, Ink::green,
                                 Ink::ink,  Ink::purple,     Ink::orange};
/// gnuplot's filled circle, square, triangle, diamond, pentagon, inverted triangle: colours are not
/// the only difference.
constexpr std::array point_types{7, 5, 9, 13, 15, 11};

/// One line: what a script, a CSV comment or a label can hold.
std::string one_line(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    return text;
}

/// A gnuplot string. In single quotes nothing is special but the quote: no backquotes, macros or
/// escapes. gnuplot 5.4 misreads a doubled quote at the beginning, so quotes become apostrophes,
/// which also look better.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : one_line(text))
        result += c == '\'' ? std::string("\u2019") : std::string(1, c);
    return result + "'";
}

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == text.npos) return text;
    std::string result = "\"";
    for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
    return result + '"';
}

/// What can be drawn of a series, and of its labels.
struct Points {
    std::vector<double> x, y;
    std::vector<std::string> labels;
};

Points drawable(const Chart& chart, const Series& series) {
    Points points;
    const bool bars = chart.kind == ChartKind::bars;
    for (std::size_t i = 0; i < series.y.size(); ++i) {
        const double x = bars ? static_cast<double>(i) : series.x.at(i), y = series.y[i];
        if (!std::isfinite(x) || !std::isfinite(y) || (chart.log_x && !bars && x <= 0) ||
            (chart.log_y && y <= 0))
            continue;
        points.x.push_back(x);
        points.y.push_back(y);
        points.labels.push_back(i < series.labels.size() ? series.labels[i] : "");
    }
    return points;
}

/// The gnuplot script that writes the chart to its stdout.
class Script {
  public:
    explicit Script(const Chart& chart) : chart_(chart) {
        double x_least = infinity, x_most = -infinity, y_least = infinity, y_most = -infinity;
        for (const Series& series : chart.series) {
            points_.push_back(drawable(chart, series));
            for (const double x : points_.back().x)
                x_least = std::min(x_least, x), x_most = std::max(x_most, x);
            for (const double y : points_.back().y)
                y_least = std::min(y_least, y), y_most = std::max(y_most, y);
        }
        if (!(x_least <= x_most))
            throw output_error(fmt::format("{}.svg: there is no point to draw", chart.id));
        const bool points = chart.kind == ChartKind::points;
        // A point on the frame looks cut off, and its name stands beside it.
        const double room = points ? 0.13 : 0.05, headroom = points ? 0.3 : 0.0;
        x_ = chart.log_x ? log_axis(x_least, x_most, 8, room) : linear_axis(x_least, x_most);
        if (bars()) x_ = {false, -0.5, static_cast<double>(chart.categories.size()) - 0.5, {}};
        y_ = chart.log_y ? log_axis(y_least, y_most, 8, room)
                         : linear_axis(y_least, y_most, headroom);

        std::size_t tick_length = 0, name_length = 0;
        for (const Tick& tick : y_.ticks) tick_length = std::max(tick_length, tick.text.size());
        if (chart.kind == ChartKind::lines)
            for (const Series& series : chart.series)
                name_length = std::max({name_length, series.name.size(), series.note.size()});
        left_ = 20 + character_width * static_cast<double>(tick_length);
        right_ =
            chart_width - std::max(24.0, text_gap + symbol_width +
                                             character_width * static_cast<double>(name_length));
        top_ = keyed() ? 80 + (key_in_two_rows() ? line_height : 0) : 44;
    }

    std::string text() {
        frame();
        data();
        if (chart_.kind == ChartKind::lines)
            name_lines();
        else
            label_points();
        if (keyed()) key();
        plot();
        return text_;
    }

  private:
    bool bars() const { return chart_.kind == ChartKind::bars; }
    bool keyed() const { return chart_.kind != ChartKind::lines && chart_.series.size() > 1; }

    template <class... Args>
    void add(fmt::format_string<Args...> format, Args&&... args) {
        text_ += fmt::format(format, std::forward<Args>(args)...) + '\n';
    }
    /// Text with its base line at (x, y), from the top left.
    void label(const std::string& text, double x, double y, std::string_view place, Ink ink) {
        if (text.empty()) return;
        add("set label {} at screen {:.5f},{:.5f} {} font ',{}' textcolor rgb '{}'", quoted(text),
            x / chart_width,
            // gnuplot centres text at the given height: a third of its size above the base line
            1.0 - (y - text_size / 3) / chart_height, place, text_size, svg_text_color(ink));
    }
    /// What stands for the series in the chart, before its name at (x, y).
    void symbol(std::size_t series, double x, double y) {
        add("set label ' ' at screen {:.5f},{:.5f} point pointtype {} pointsize 0.8 linecolor rgb "
            "'{}'",
            (x + 10) / chart_width, 1 - (y - text_size / 3) / chart_height,
            bars() ? 5 : point_types[series % point_types.size()], svg_color(ink(series)));
    }
    double x_at(double value) const { return left_ + (right_ - left_) * x_.fraction(value); }
    double y_at(double value) const { return bottom_ - (bottom_ - top_) * y_.fraction(value); }

    void frame() {
        const auto tick_list = [](const Axis& axis) {
            std::vector<std::string> ticks;
            for (const Tick& tick : axis.ticks)
                ticks.push_back(fmt::format("{} {:.12g}", quoted(tick.text), tick.value));
            return fmt::format("{}", fmt::join(ticks, ", "));
        };
        add("set encoding utf8\nset terminal svg size {},{} noenhanced font 'sans-serif,{}' "
            "linewidth {}",
            chart_width, chart_height, text_size, line_weight);
        add("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset tmargin at screen "
            "{:.5f}\n"
            "set bmargin at screen {:.5f}",
            left_ / chart_width, right_ / chart_width, 1 - top_ / chart_height,
            1 - bottom_ / chart_height);
        add("unset key\nset border {} linecolor rgb '{}' linewidth 0.5", bars() ? 1 : 3,
            svg_color(Ink::quiet));
        add("set grid {} linetype 1 linecolor rgb '{}' linewidth 0.5",
            bars() ? "ytics" : "xtics ytics", svg_color(Ink::faint));
        if (x_.logarithmic) add("set logscale x");
        if (y_.logarithmic) add("set logscale y");
        add("set xrange [{:.12g}:{:.12g}]\nset yrange [{:.12g}:{:.12g}]", x_.low, x_.high, y_.low,
            y_.high);
        if (bars()) {
            for (std::size_t i = 0; i < chart_.categories.size(); ++i)
                label(chart_.categories[i], x_at(static_cast<double>(i)),
                      bottom_ + 22 + (i % 2 == 1 && categories_meet() ? 18 : 0), "center",
                      Ink::ink);
            add("unset xtics");
        } else {
            add("set xtics nomirror scale 0 offset 0,0.3 ({}) textcolor rgb '{}'", tick_list(x_),
                svg_color(Ink::ink));
        }
        add("set ytics nomirror scale 0 ({}) textcolor rgb '{}'", tick_list(y_),
            svg_color(Ink::ink));
        label(chart_.x_label, 0.5 * (left_ + right_), chart_height - 10, "center", Ink::ink);
        label(chart_.y_label, 8, 24, "left", Ink::ink);
    }

    void data() {
        for (std::size_t s = 0; s < points_.size(); ++s) {
            add("$series{} << END", s);
            for (std::size_t i = 0; i < points_[s].x.size(); ++i)
                add("{:.12g} {:.12g}", points_[s].x[i], points_[s].y[i]);
            add("END");
        }
    }

    /// The names in a column beside the lines' ends, moved apart where they would meet.
    void name_lines() {
        struct Name {
            std::size_t series;
            double y, height;  ///< middle of the text
        };
        std::vector<Name> names;
        double column = left_;
        for (std::size_t s = 0; s < points_.size(); ++s) {
            if (points_[s].x.empty()) continue;
            names.push_back({s, y_at(points_[s].y.back()),
                             line_height * (chart_.series[s].note.empty() ? 1 : 2)});
            column = std::max(column, x_at(points_[s].x.back()) + text_gap);
        }
        std::sort(names.begin(), names.end(),
                  [](const Name& a, const Name& b) { return a.y < b.y; });
        for (std::size_t i = 1; i < names.size(); ++i)
            names[i].y = std::max(
                names[i].y, names[i - 1].y + 0.5 * (names[i].height + names[i - 1].height) + 6);
        double lowest = bottom_ - 4;
        for (std::size_t i = names.size(); i-- > 0;) {
            names[i].y = std::min(names[i].y, lowest - 0.5 * names[i].height);
            lowest = names[i].y - 0.5 * names[i].height;
        }
        for (const Name& name : names) {
            const Series& series = chart_.series[name.series];
            const double base =
                name.y + text_size / 3 - (series.note.empty() ? 0 : 0.5 * line_height);
            symbol(name.series, column, base);
            label(series.name, column + symbol_width, base, "left", ink(name.series));
            label(series.note, column + symbol_width, base + line_height, "left", ink(name.series));
        }
    }

    /// Above bars; beside points, where least is in the way.
    void label_points() {
        Labels labels({at(left_, 0), at(right_ + text_gap, bottom_)});
        if (!bars())
            for (const Points& series : points_)
                for (std::size_t i = 0; i < series.x.size(); ++i)
                    labels.keep_free(at(x_at(series.x[i]), y_at(series.y[i])), 7);
        for (std::size_t s = 0; s < points_.size(); ++s)
            for (std::size_t i = 0; i < points_[s].x.size(); ++i) {
                const std::string& text = points_[s].labels[i];
                const double x = x_at(points_[s].x[i]), y = y_at(points_[s].y[i]);
                if (bars())
                    label(text, x_at(points_[s].x[i] + offset(s)), y - 10, "center", Ink::ink);
                else if (!text.empty())
                    name_point(text, at(x, y), labels.place(at(x, y), text, text_size, text_gap));
            }
    }

    void name_point(const std::string& text, Point2 point, const PlacedName& placed) {
        if (placed.line)
            add("set arrow from screen {:.5f},{:.5f} to screen {:.5f},{:.5f} nohead back linecolor "
                "rgb '{}' linewidth 0.5",
                point.x / chart_width, 1.0 - point.y / chart_height, placed.line->x / chart_width,
                1.0 - placed.line->y / chart_height, svg_color(Ink::quiet));
        label(text, placed.start.x, placed.start.y, "left", Ink::ink);
    }

    /// Between the names of the key, if all stand in one row. Some fonts are wider than the one
    /// that the width of a character is from: what is tight moves together.
    double key_gap() const {
        double letters = 0;
        for (const Series& series : chart_.series)
            letters += character_width * static_cast<double>(series.name.size());
        return std::min(44.0, (chart_width - left_ - 24.0 - letters) /
                                  static_cast<double>(chart_.series.size()));
    }
    /// Where they would run into each other they stand in two rows.
    bool key_in_two_rows() const { return key_gap() < symbol_width; }

    void key() {
        const std::size_t names = chart_.series.size();
        const bool two = key_in_two_rows();
        double x = left_, y = 50;
        for (std::size_t s = 0; s < names; ++s) {
            const std::string& name = chart_.series[s].name;
            if (two && s == (names + 1) / 2) x = left_, y += line_height;
            symbol(s, x - 4, y);
            label(name, x + symbol_width - 4, y, "left", Ink::ink);
            x += (two ? 44.0 : key_gap()) + character_width * static_cast<double>(name.size());
        }
    }

    /// Whether names below the bars need two rows.
    bool categories_meet() const {
        const double width = (right_ - left_) / static_cast<double>(chart_.categories.size());
        return std::ranges::any_of(chart_.categories, [&](const std::string& category) {
            return character_width * static_cast<double>(category.size()) > width;
        });
    }

    /// Where the bars of series s stand beside the middle of their category, and how wide they are.
    double bar_width() const { return 0.7 / static_cast<double>(chart_.series.size()); }
    double offset(std::size_t s) const {
        return bar_width() *
               (static_cast<double>(s) - 0.5 * static_cast<double>(chart_.series.size() - 1));
    }

    void plot() {
        std::vector<std::string> plots;
        for (std::size_t s = 0; s < points_.size(); ++s) {
            if (points_[s].x.empty()) continue;
            if (bars())
                plots.push_back(fmt::format(
                    "$series{} using ($1+{:.5f}):2:({:.5f}) with boxes fillstyle solid 1 noborder "
                    "linecolor rgb '{}' notitle",
                    s, offset(s), 0.92 * bar_width(), svg_color(ink(s))));
            else
                plots.push_back(fmt::format(
                    "$series{} with {} linecolor rgb '{}' pointtype {} pointsize 0.8 notitle", s,
                    chart_.kind == ChartKind::lines ? "linespoints" : "points", svg_color(ink(s)),
                    point_types[s % point_types.size()]));
        }
        add("plot {}", fmt::join(plots, ", "));
    }
    static Ink ink(std::size_t s) { return series_inks[s % series_inks.size()]; }

    const Chart& chart_;
    std::vector<Points> points_;
    Axis x_{}, y_{};
    double left_, right_, top_, bottom_ = chart_height - 66;
    std::string text_;
};

/// What gnuplot makes of the script; nothing where there is no gnuplot. No shell is between.
std::optional<std::string> run_gnuplot(const std::string& script, const std::string& id) {
    const TemporaryDirectory directory;
    const std::filesystem::path input = directory / "chart.gp", output = directory / "chart.svg",
                                errors = directory / "errors";
    write_file(input, script);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0600);
    std::string program = "gnuplot", defaults = "--default-settings", file = input.string();
    char* arguments[] = {program.data(), defaults.data(), file.data(), nullptr};
    pid_t child = 0;
    const int fault = ::posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (fault == ENOENT) return std::nullopt;
    if (fault != 0)
        throw output_error(
            fmt::format("{}.svg: cannot start gnuplot: {}", id, std::strerror(fault)));

    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        std::string reason = read_file(errors);
        while (!reason.empty() && std::isspace(static_cast<unsigned char>(reason.back())))
            reason.pop_back();
        reason.erase(
            0, reason.find_last_of('\n') + 1);  // the last line says what; those before show where
        throw output_error(fmt::format("{}.svg: gnuplot failed: {}", id,
                                       reason.empty() ? "no reason given" : reason));
    }
    return read_file(output);
}

/// gnuplot's SVG inside our own svg tag and style: colours as the style block knows them, ids that
/// are unique in a page.
std::string restyled(std::string svg, const Chart& chart) {
    const auto from = svg.find("<defs>"), to = svg.rfind("</g>");
    if (from == svg.npos || to == svg.npos || to < from)
        throw output_error(
            fmt::format("{}.svg: gnuplot wrote something that is not the SVG we know", chart.id));
    svg = svg.substr(from, to - from);

    std::string colored;
    const std::regex rgb(R"(rgb\( *(\d+), *(\d+), *(\d+)\))");
    auto last = svg.cbegin();
    for (std::sregex_iterator match(svg.cbegin(), svg.cend(), rgb), end; match != end; ++match) {
        colored.append(last, (*match)[0].first);
        colored += fmt::format("#{:02x}{:02x}{:02x}", std::stoi((*match)[1]),
                               std::stoi((*match)[2]), std::stoi((*match)[3]));
        last = (*match)[0].second;
    }
    colored.append(last, svg.cend());

    const std::string id = xml_escaped(chart.id), ink = std::string(svg_color(Ink::ink)),
                      paper = std::string(svg_color(Ink::paper));
    const std::array<std::pair<const char*, std::string>, 7> replacements{{
        {R"(<filter[\s\S]*?</filter>)", ""},
        {R"(<title>[^<]*</title>)", ""},
        {R"(id=(['"])gp)", "id=$1" + id + "-gp"},
        {R"(id=(['"])gnuplot_)", "id=$1" + id + "-"},
        {R"(xlink:href='#)", "href='#" + id + "-"},
        {R"((color|fill|stroke)="black")", "$1=\"" + ink + "\""},
        {R"((color|fill|stroke)="white")", "$1=\"" + paper + "\""},
    }};
    for (const auto& [pattern, replacement] : replacements)
        colored = std::regex_replace(colored, std::regex(pattern), replacement);
    colored = std::regex_replace(colored, std::regex(R"(<g [^>]*>\s*</g>\s*)"),
                                 "");  // gnuplot leaves many empty groups
    return svg_opening(chart.id, chart.title, chart_width, chart_height) + colored + "</svg>\n";
}

}  // namespace

Series with_slope(Series series) {
    if (series.x.size() > 1)
        series.note = fmt::format("slope {}", fixed(log_log_slope(series.x, series.y), 2));
    return series;
}

std::string chart_csv(const Chart& chart) {
    const bool bars = chart.kind == ChartKind::bars;
    const bool labelled = std::any_of(chart.series.begin(), chart.series.end(),
                                      [](const Series& series) { return !series.labels.empty(); });
    std::string csv = fmt::format("# {}: {}\n# machine: {}\n# date: {}\nseries,{},{}{}\n", chart.id,
                                  one_line(chart.title), one_line(machine_description()), today(),
                                  csv_field(bars ? "category" : chart.x_label),
                                  csv_field(chart.y_label), labelled ? ",label" : "");
    for (const Series& series : chart.series)
        for (std::size_t i = 0; i < series.y.size(); ++i) {
            csv += fmt::format(
                "{},{},{:.9g}", csv_field(series.name),
                bars ? csv_field(chart.categories.at(i)) : fmt::format("{:.9g}", series.x.at(i)),
                series.y[i]);
            if (labelled) csv += "," + csv_field(i < series.labels.size() ? series.labels[i] : "");
            csv += '\n';
        }
    return csv;
}

void write_chart(const std::filesystem::path& out, const Chart& chart) {
    write_file(out / (chart.id + ".csv"), chart_csv(chart));
    if (chart.drawing)
        return write_file(out / (chart.id + ".svg"), chart.drawing->document(chart.id));
    const std::optional<std::string> svg = run_gnuplot(Script(chart).text(), chart.id);
    if (!svg) {
        fmt::print(stderr, "{0}.csv is written, {0}.svg is not: gnuplot is not installed\n",
                   chart.id);
        return;
    }
    write_file(out / (chart.id + ".svg"), restyled(*svg, chart));
}

}  // namespace space
