// What every main() and every list of figures relies on: errors, figures, progress.
#include "common/parallel.hpp"
#include "common/program/error.hpp"
#include "common/program/figure.hpp"
#include "common/program/progress.hpp"
#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

#include <new>

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
    CHECK(run([](int, char**) -> int { throw std::logic_error("x"); }) ==
          std::pair(70, std::string("prog: internal error: x\n")));
}

namespace {
std::string made;
const std::vector<Figure> figures{
    {"fig_00_01", FigureKind::drawing, [](const Options&) { made += "1"; }},
    {"fig_00_02", FigureKind::chart, [](const Options&) { made += "2"; }}};
int make(const std::string& id) {
    made.clear();
    Options options;
    options.figure = id;
    return make_figures(figures, options);
}
}  // namespace

TEST_CASE("a figure is made by its id, or all of them; an unknown id is refused with the list") {
    CHECK(make("fig_00_02") == 0);
    CHECK(made == "2");
    CHECK(make("all") == 0);
    CHECK(made == "12");
    try {
        make("fig_00_03");
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::usage);
        CHECK(std::string(error.what()) ==
              "--figure fig_00_03: no such figure; there are: fig_00_01 fig_00_02 all");
    }
    CHECK(made.empty());
}

TEST_CASE("progress of a short job writes nothing, and steps may come from many threads") {
    const std::string text = written_to(2, [] {
        Progress progress("job", 1000);
        parallel_for(1000, 8, 1, [&](std::size_t) { progress.step(); });
    });
    CHECK(text.empty());
}

}  // namespace space
