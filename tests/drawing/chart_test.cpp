#include "common/program/chart.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/svg.hpp"
#include "common/program/temporary.hpp"
#include "tests/catch.hpp"

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <regex>
#include <string>
#include <vector>

using namespace space;
namespace fs = std::filesystem;

namespace {

bool contains(const std::string& text, std::string_view part) {
    return text.find(part) != text.npos;
}

/// $PATH for as long as the test runs.
struct Path {
    std::string before = std::getenv("PATH");
    explicit Path(const fs::path& path) { ::setenv("PATH", path.c_str(), 1); }
    ~Path() { ::setenv("PATH", before.c_str(), 1); }
};

bool gnuplot_is_here() {
    return std::system("command -v gnuplot > /dev/null 2>&1") == 0;
}

void make_program(const fs::path& file, const std::string& script) {
    write_file(file, "#!/bin/sh\n" + script);
    fs::permissions(file, fs::perms::owner_all);
}

Chart growth() {
    return {.id = "fig_99_01",
            .title = "Time against triangles",
            .x_label = "triangles",
            .y_label = "time, ms",
            .log_x = true,
            .log_y = true,
            .series = {{.name = "naive", .x = {1000, 10000}, .y = {1.5, 15}, .note = "slope 1.00"},
                       {.name = "other, faster", .x = {1000, 10000}, .y = {0.5, 0.75}}}};
}

}  // namespace

TEST_CASE("the data file names the machine and the date, and holds every point") {
    ::setenv("SOURCE_DATE_EPOCH", "0", 1);
    const std::string csv = chart_csv(growth());
    ::unsetenv("SOURCE_DATE_EPOCH");
    CHECK(contains(csv, "# fig_99_01: Time against triangles\n# machine: "));
    CHECK(contains(csv, "\n# date: 1970-01-01\nseries,triangles,\"time, ms\"\n"));
    CHECK(contains(csv,
                   "\nnaive,1000,1.5\nnaive,10000,15\n\"other, faster\",1000,0.5\n\"other, "
                   "faster\",10000,0.75\n"));
}

TEST_CASE("bars are told by category in the data file") {
    const Chart chart{.id = "c",
                      .title = "",
                      .x_label = "",
                      .y_label = "%",
                      .kind = ChartKind::bars,
                      .series = {{.name = "share", .x = {}, .y = {60, 99.5}}},
                      .categories = {"1 K", "2 K"}};
    CHECK(contains(chart_csv(chart), "\nseries,category,%\nshare,1 K,60\nshare,2 K,99.5\n"));
}

TEST_CASE("the labels of points stand in the data file") {
    const Chart chart{
        .id = "c",
        .title = "",
        .x_label = "x",
        .y_label = "y",
        .kind = ChartKind::points,
        .series = {{.name = "tests", .x = {1, 2}, .y = {3, 4}, .labels = {"plain", "a, b"}}}};
    CHECK(contains(chart_csv(chart), "\nseries,x,y,label\ntests,1,3,plain\ntests,2,4,\"a, b\"\n"));
}

TEST_CASE("a chart has the drawings' palette, style and ids") {
    if (!gnuplot_is_here()) {
        WARN("skipped: gnuplot is not installed");
        return;
    }
    const TemporaryDirectory folder;
    write_chart(folder.path(), growth());
    const std::string svg = read_file(folder.path() / "fig_99_01.svg");
    CHECK(svg.starts_with(svg_opening("fig_99_01", "Time against triangles", 640, 420)));
    CHECK(svg.ends_with("</svg>\n"));
    for (const char* text :
         {">naive</text>", ">slope 1.00</text>", ">other, faster</text>", ">triangles</text>",
          ">time, ms</text>", ">1 K</text>", ">10 K</text>"})
        CHECK(contains(svg, text));
    CHECK(contains(svg, "stroke='" + std::string(svg_color(Ink::blue)) + "'"));
    CHECK(contains(svg, "stroke='" + std::string(svg_color(Ink::vermillion)) + "'"));
    for (const char* foreign :
         {"rgb(", "\"black\"", "\"white\"", "id='gp", "'#gp", "gnuplot", "<filter"})
        CHECK_FALSE(contains(svg, foreign));
}

TEST_CASE("a chart with a drawing of its own is written as that, beside the same data") {
    const TemporaryDirectory folder;
    Chart chart = growth();
    chart.drawing.emplace("its own", 640, 100);
    chart.drawing->text({10, 20}, "by hand", {.turn = -60});
    write_chart(folder.path(), chart);
    const std::string svg = read_file(folder.path() / "fig_99_01.svg");
    CHECK(contains(svg, ">by hand</text>"));
    CHECK(contains(svg, "transform=\"rotate(-60 10 20)\""));
    CHECK_FALSE(contains(svg, "gnuplot"));
    CHECK(read_file(folder.path() / "fig_99_01.csv") == chart_csv(growth()));
}

TEST_CASE("the names of a chart's series have room: in one row, or in two") {
    if (!gnuplot_is_here()) {
        WARN("skipped: gnuplot is not installed");
        return;
    }
    const TemporaryDirectory folder;
    for (const std::size_t names : {2u, 4u, 5u}) {
        Chart chart = growth();
        chart.kind = ChartKind::points;
        chart.series.assign(names, {.name = "SAH, boxes", .x = {1000}, .y = {1}});
        write_chart(folder.path(), chart);
        const std::string svg = read_file(folder.path() / "fig_99_01.svg");
        static const std::regex place(R"(translate\(([0-9.]+),([0-9.]+)\)[^<]*<text>SAH)");
        std::map<std::string, std::vector<double>> rows;  // by height
        for (std::sregex_iterator at(svg.begin(), svg.end(), place), end; at != end; ++at)
            rows[at->str(2)].push_back(std::stod(at->str(1)));
        CAPTURE(names);
        CHECK(rows.size() == (names < 5 ? 1 : 2));
        for (const auto& [height, x] : rows)
            for (std::size_t i = 1; i < x.size(); ++i)
                CHECK(x[i] - x[i - 1] > 0.6 * 17 * 10 + 20);  // ten letters and a symbol
    }
}

TEST_CASE("text in a chart is text: not a script, not markup") {
    if (!gnuplot_is_here()) {
        WARN("skipped: gnuplot is not installed");
        return;
    }
    const TemporaryDirectory folder;
    const fs::path trace = folder.path() / "trace";
    Chart chart = growth();
    chart.x_label = "'; system('touch " + trace.string() + "') #";
    chart.y_label = "`touch " + trace.string() + "` @GPVAL $HOME";
    chart.series[0].name = "a\nsystem('touch " + trace.string() + "')";
    chart.series[1].name = "<b> & {/=30 big} x_1 \\n";
    write_chart(folder.path(), chart);
    CHECK_FALSE(fs::exists(trace));
    const std::string svg = read_file(folder.path() / "fig_99_01.svg");
    CHECK(contains(svg, ">&lt;b> &amp; {/=30 big} x_1 \\n</text>"));
    CHECK(contains(svg, "` @GPVAL $HOME</text>"));
}

TEST_CASE("points that an axis cannot show are left out; no point at all is an error") {
    if (!gnuplot_is_here()) {
        WARN("skipped: gnuplot is not installed");
        return;
    }
    const TemporaryDirectory folder;
    Chart chart = growth();
    chart.series[0].y = {0.0, std::numeric_limits<double>::quiet_NaN()};
    CHECK_NOTHROW(write_chart(folder.path(), chart));
    chart.series.pop_back();
    CHECK_THROWS_WITH(write_chart(folder.path(), chart),
                      "fig_99_01.svg: there is no point to draw");
}

TEST_CASE("without gnuplot there is the data file alone") {
    const TemporaryDirectory folder;
    {
        const Path nowhere(folder.path() / "nothing");
        CHECK_NOTHROW(write_chart(folder.path(), growth()));
    }
    CHECK(fs::exists(folder.path() / "fig_99_01.csv"));
    CHECK_FALSE(fs::exists(folder.path() / "fig_99_01.svg"));
}

TEST_CASE("a gnuplot that fails is an error with its reason, and leaves no picture") {
    const TemporaryDirectory folder;
    const Path path(folder.path());
    make_program(folder.path() / "gnuplot",
                 "echo '\"chart.gp\" line 3: undefined moon' >&2; exit 1");
    CHECK_THROWS_WITH(write_chart(folder.path(), growth()),
                      "fig_99_01.svg: gnuplot failed: \"chart.gp\" line 3: undefined moon");
    make_program(folder.path() / "gnuplot", "echo not a picture");
    CHECK_THROWS_AS(write_chart(folder.path(), growth()), Error);
    CHECK_FALSE(fs::exists(folder.path() / "fig_99_01.svg"));
}
