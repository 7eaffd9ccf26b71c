// What every main() and every list of figures relies on: errors, figures, progress.
#include "common/parallel.hpp"
#include "common/program/error.hpp"
#include "common/program/figure.hpp"
#include "common/program/file.hpp"
#include "common/program/progress.hpp"
#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

#include <cerrno>
#include <filesystem>
#include <new>
#include <set>
#include <system_error>
#include <utility>

namespace space {

TEST_CASE("an error that a user can cause becomes one line on stderr and its exit code") {
    const auto run = [](int (*body)(int, char**)) {
        int code = 0;
        const std::string line =
            written_to(2, [&] { code = run_program("prog", body, 0, nullptr); });
        return std::pair(code, line);
    };
    CHECK(run([](int, char**) { return 0; }) == std::pair(0, std::string()));
    CHECK(run([](int, char**) { return 1; }) == std::pair(1, std::string()));
    CHECK(run([](int, char**) -> int { throw usage_error("no such option"); }) ==
          std::pair(2, std::string("prog: no such option\n")));
    CHECK(run([](int, char**) -> int { throw input_error("a.obj:3: no"); }) ==
          std::pair(3, std::string("prog: a.obj:3: no\n")));
    CHECK(run([](int, char**) -> int { throw output_error("full"); }) ==
          std::pair(4, std::string("prog: full\n")));
    CHECK(run([](int, char**) -> int { throw std::bad_alloc(); }) ==
          std::pair(70, std::string("prog: out of memory\n")));
    CHECK(
        run([](int, char**) -> int { throw std::system_error(EAGAIN, std::generic_category()); }) ==
        std::pair(70, std::string("prog: no more threads can be had (see --threads): Resource "
                                  "temporarily unavailable\n")));
    CHECK(run([](int, char**) -> int { throw std::logic_error("x"); }) ==
          std::pair(70, std::string("prog: internal error: x\n")));
    CHECK(run([](int, char**) -> int { throw input_error("mesh \"a\nb\033[31m\"\r"); }) ==
          std::pair(3, std::string("prog: mesh \"a\\x0ab\\x1b[31m\"\\x0d\n")));
    CHECK(run([](int, char**) -> int {
              throw usage_error(std::string(1'000'000, 'x') + std::string(490, 'y') + ": too long");
          }) == std::pair(2, "prog: " + std::string(1500, 'x') + "..." + std::string(490, 'y') +
                                 ": too long\n"));
}

namespace {

constexpr Figure figures[] = {
    {"fig_00_01",
     [](const Options&) {
         Svg svg("A line", 10, 10);
         svg.line({0, 0}, {1, 1}, {}, "line");
         return svg;
     }},
    {"fig_00_02", [](const Options& options) { return Image(options.width, 1); }},
    {"fig_00_03",
     [](const Options&) {
         return Chart{.title = "A point",
                      .x_label = "x",
                      .y_label = "y",
                      .series = {{.name = "one", .x = {1}, .y = {2}}}};
     }},
};

/// The files that are there when the figure has been made.
std::set<std::string> made(const std::string& id, const TemporaryDirectory& directory) {
    Options options;
    options.figure = id;
    options.out = directory.path();
    CHECK(write_figures(figures, options) == 0);
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(directory.path()))
        files.insert(entry.path().filename().string());
    return files;
}

}  // namespace

TEST_CASE("a figure is made by its id, and its file is called by it") {
    const TemporaryDirectory directory;
    CHECK(made("fig_00_01", directory) == std::set<std::string>{"fig_00_01.svg"});
    CHECK(read_file(directory / "fig_00_01.svg").find("id=\"fig_00_01-line\"") !=
          std::string::npos);
    CHECK(made("fig_00_02", directory) == std::set<std::string>{"fig_00_01.svg", "fig_00_02.png"});
    made("fig_00_03", directory);
    CHECK(read_file(directory / "fig_00_03.csv").starts_with("# fig_00_03: A point\n"));
}

TEST_CASE("all figures are made for \"all\"; an unknown id is refused with the list") {
    const TemporaryDirectory directory;
    const std::set<std::string> all = made("all", directory);
    for (const char* file : {"fig_00_01.svg", "fig_00_02.png", "fig_00_03.csv"})
        CHECK(all.contains(file));
    Options options;
    options.figure = "fig_00_04";
    options.out = directory.path() / "none";
    try {
        write_figures(figures, options);
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::usage);
        CHECK(std::string(error.what()) ==
              "--figure fig_00_04: no such figure; there are: fig_00_01 fig_00_02 fig_00_03 all");
    }
    CHECK_FALSE(exists(options.out));
}

TEST_CASE("progress of a short job writes nothing, and steps may come from many threads") {
    const std::string text = written_to(2, [] {
        Progress progress("job", 1000);
        parallel_for(1000, 8, 1, [&](std::size_t) { progress.step(); });
    });
    CHECK(text.empty());
}

TEST_CASE("times left are said in the two largest units, rounded up") {
    CHECK(duration_text(0.0) == "0 s");
    CHECK(duration_text(0.2) == "1 s");
    CHECK(duration_text(59.5) == "1 min 0 s");
    CHECK(duration_text(130.0) == "2 min 10 s");
    CHECK(duration_text(3600.0) == "1 h 0 min");
    CHECK(duration_text(11'100.0) == "3 h 5 min");
    CHECK(duration_text(-1.0) == "0 s");
    CHECK(duration_text(std::numeric_limits<double>::infinity()).ends_with(" h 20 min"));
}

}  // namespace space
