#include "docs/measured.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/numbers.hpp"
#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

#include <chrono>

using namespace space;
using namespace space::docs;

namespace {

namespace fs = std::filesystem;

/// A project with the numbers of one chapter, and a folder for the reader's own run of it.
struct Project {
    TemporaryDirectory directory;
    fs::path root = directory.path() / "book", runs = directory.path() / "runs";

    Project() {
        Numbers numbers;
        numbers.count("deepest", 31'622);
        numbers.time("ratio", 1.78, "1.8");
        Table table({"splitter", "depth"});
        table.row({"free", "84"});
        numbers.count_table("splitters", table);
        const fs::path run = directory.path() / "run", measured = root / "figures/measured";
        numbers.write(run, {.chapter = "ch03_x", .mode = "full", .machine = "M & N", .date = "D"});
        fs::create_directories(measured);
        fs::rename(run / "numbers.json", measured / "ch03_numbers.json");
        fs::rename(run / "ch03_splitters.md", measured / "ch03_splitters.md");
    }
    /// What the reader's own run, newer than the committed one, measured.
    void run_again(const std::string& mode, std::uint64_t deepest) const {
        Numbers numbers;
        numbers.count("deepest", deepest);
        numbers.write(runs / "ch03",
                      {.chapter = "ch03_x", .mode = mode, .machine = "", .date = ""});
        fs::last_write_time(runs / "ch03/numbers.json",
                            fs::file_time_type::clock::now() + std::chrono::hours(1));
    }
    std::string resolved(const std::string& text) const {
        return Measured(root, runs).resolved(text, "chapter.dox");
    }
    std::string refused(const std::string& text) const {
        try {
            return "not refused: " + resolved(text);
        } catch (const Error& error) {
            return error.what();
        }
    }
};

}  // namespace

TEST_CASE("a text's numbers and tables are those of the chapter's run") {
    const Project project;
    CHECK(project.resolved("depth \\num{ch03.deepest},\n@num{ch03.ratio} times.") ==
          "depth 31,622,\n1.8 times.");
    CHECK(project.resolved("\\table{ch03.splitters}") ==
          "| splitter | depth |\n| --- | --: |\n| free | 84 |\n");
    CHECK(project.resolved("\\measured{ch03}") == "Measured in a full run on M &amp; N, on D.");
    CHECK(project.resolved("\\image x \\number{3}") == "\\image x \\number{3}");
}

TEST_CASE("what no run has measured is an error that names the page, the line and the name") {
    const Project project;
    CHECK(project.refused("a\nb \\num{ch03.depest}") ==
          "chapter.dox:2: \\num{ch03.depest}: figures/measured/ch03_numbers.json has no such "
          "number");
    CHECK(project.refused("\\table{ch03.deepest}") ==
          "chapter.dox:1: \\table{ch03.deepest}: figures/measured/ch03_numbers.json has no such "
          "table");
    CHECK(project.refused("\n\n\\measured{ch04}") ==
          "chapter.dox:3: \\measured{ch04}: there is no figures/measured/ch04_numbers.json");
    CHECK(project.refused("\\num{deepest}").starts_with("chapter.dox:1: \\num{deepest}: expected"));
    for (const std::string text : {"See \\table{ch03.splitters}", "\\table{ch03.splitters}.",
                                   "See\n\\table{ch03.splitters}"})
        CHECK(project.refused(text).find("a paragraph of its own") != std::string::npos);
    CHECK(project.resolved("a\n\n\\table{ch03.splitters}\n\nb").starts_with("a\n\n| splitter"));
    CHECK(project.refused("\\num{ch04.deepest}").starts_with("chapter.dox:1: "));
}

TEST_CASE("the reader's own newer run comes first; what it has not measured is the book's") {
    const Project project;
    const std::string text = "\\num{ch03.deepest} \\num{ch03.ratio}";
    const std::string mode = GENERATE("quick", "full");
    project.run_again(mode, 99);
    CHECK(project.resolved(text) == "99 1.8");
    CHECK(project.resolved("\\measured{ch03}").find(mode) != std::string::npos);

    SECTION("but not if it is older") {
        fs::last_write_time(project.runs / "ch03/numbers.json",
                            fs::file_time_type::clock::now() - std::chrono::hours(1));
        CHECK(project.resolved(text) == "31,622 1.8");
    }
}

TEST_CASE("a run that measures no times does not stand for one that does") {
    const Project project;
    project.run_again(GENERATE("small", "counts"), 99);
    CHECK(project.resolved("\\num{ch03.deepest}") == "31,622");
}

TEST_CASE("a run says that it was quick, and which code has changed since") {
    const Provenance run{.chapter = "ch03_x",
                         .mode = "quick",
                         .machine = "M",
                         .date = "D",
                         .sources = {{"chapters/ch03_x", "1"}, {"common", "2"}}};
    CHECK(told(run, run.sources) ==
          "Measured in a quick run on M, on D. It takes fewer sizes and rounds than the book's.");
    CHECK(told(run, {{"chapters/ch03_x", "1"}, {"common", "3"}})
              .ends_with(" Since then the code in <code>common</code> has changed."));
    CHECK(told(run, {}).ends_with(
        "code in <code>chapters/ch03_x</code>, <code>common</code> has changed."));
}

TEST_CASE("fingerprints tell code from comments, and follow what a chapter includes") {
    const TemporaryDirectory directory;
    const fs::path& root = directory.path();
    const auto write = [&](const char* file, const char* text) { write_file(root / file, text); };
    write("chapters/ch01_a/a.hpp", "int a;");
    write("chapters/ch02_b/b.hpp", "#include \"chapters/ch01_a/a.hpp\"\nint b;");
    write("chapters/ch03_c/c.hpp", "int c;");
    write("common/d.hpp", "int d;");
    const auto prints = [&] { return source_fingerprints(root, "ch02_b"); };
    const Fingerprints before = prints();
    REQUIRE(before.size() == 3);
    CHECK(before.contains("chapters/ch01_a"));
    CHECK(before.contains("chapters/ch02_b"));
    CHECK(before.contains("common"));

    write("chapters/ch01_a/a.hpp", "// what it is for\nint /* of course */   a;\n");
    write("chapters/ch02_b/figures/f.cpp", "int f;");
    write("chapters/ch02_b/exercises/e.hpp", "int e;");
    write("chapters/ch02_b/chapter.dox", "int f;");
    CHECK(prints() == before);

    write("chapters/ch01_a/a.hpp", "int b;");
    CHECK(prints().at("chapters/ch01_a") != before.at("chapters/ch01_a"));
    CHECK(prints().at("chapters/ch02_b") == before.at("chapters/ch02_b"));
    write("chapters/ch02_b/measured/m.cpp", "int m;");
    CHECK(prints().at("chapters/ch02_b") != before.at("chapters/ch02_b"));
    CHECK(source_fingerprints(root, "ch09_none").empty());
}

TEST_CASE("a name is given once, and numbers are written as texts write them") {
    Numbers numbers;
    numbers.count("n", 1);
    CHECK_THROWS(numbers.time("n", 1.0, "1"));
    CHECK(one_in(0.0154833) == "65");
    CHECK(percent(0.171) == "17 %");
    CHECK(percent(0.0154) == "1.5 %");
    CHECK(percent(-0.0001) == "0.0 %");
    CHECK(power_of_ten(4.1e-4) == "4·10<sup>−4</sup>");
    CHECK(power_of_ten(1e-12) == "10<sup>−12</sup>");
    CHECK(power_of_ten(0.0) == "0");
}
