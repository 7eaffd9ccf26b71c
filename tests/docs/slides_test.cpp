#include "docs/slides.hpp"

#include "common/program/base64.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

using namespace space;
using namespace space::docs;
using namespace std::string_literals;

namespace {

/// A small book: chapter 1 with a drawing in two steps, a rendering and a chart; chapter 2 with a
/// drawing, and one that is not made yet.
struct SmallBook {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / "splitting_space_slides_test";
    Places places{.root = path, .configured = path, .runs = path / "runs", .pages = {}};

    SmallBook() {
        write_file(path / "docs/chapters.json",
                   R"([{"folder": "ch01_a", "title": "A & B", "teaches": "", "sources": []},
                       {"folder": "ch02_c", "title": "C", "teaches": "", "sources": []}])");
        write_file(path / "figures.json", "[" + figure("fig_01_10", "ch01_a", "chart", "Times") +
                                              figure("fig_01_02", "ch01_a", "rendering", "A room") +
                                              figure("fig_01_01", "ch01_a", "drawing", "x < 1") +
                                              figure("fig_02_02", "ch02_c", "drawing", "Later") +
                                              figure("fig_02_01", "ch02_c", "drawing", "One", "]"));
        const std::string steps =
            "<g data-first=\"0\">\n<desc>first</desc>\n</g>\n"
            "<g data-first=\"1\">\n<desc>then</desc>\n</g>\n";
        write_file(path / "figures/fig_01_01.svg", svg("fig_01_01", 640, 400, steps));
        write_file(path / "figures/fig_01_02.png",  // its first chunk: 512 by 256 pixels
                   "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\2\0\0\0\1\0"s);
        write_file(path / "figures/measured/fig_01_10.svg", svg("fig_01_10", 640, 400, ""));
        write_file(path / "figures/fig_02_01.svg", svg("fig_02_01", 800, 400, ""));
        for (const char* part : {"steps.css", "slides.css", "steps.js", "slides.js"})
            write_file(path / "docs" / part, "/* "s + part + " */\n");
    }
    ~SmallBook() { std::filesystem::remove_all(path); }

    static std::string figure(const std::string& id, const std::string& chapter,
                              const std::string& kind, const std::string& caption,
                              const std::string& then = ",") {
        return R"({"id": ")" + id + R"(", "chapter": ")" + chapter + R"(", "kind": ")" + kind +
               R"(", "caption": ")" + caption + "\"}" + then;
    }
    static std::string svg(const std::string& id, int width, int height, const std::string& body) {
        return "<?xml version=\"1.0\"?>\n<svg id=\"" + id + "\" width=\"" + std::to_string(width) +
               "\" height=\"" + std::to_string(height) + "\">\n<style>\n.ink{}\n</style>\n" + body +
               "</svg>\n";
    }
    std::string page(const std::string& name) const {
        const SlideShow show = slide_shows(places, {name}).front();
        return slides(show.title, show.figures, path);
    }
};

std::vector<std::string> all_of(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
        found.push_back(at->str(1));
    return found;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("bytes become letters as in the vectors of RFC 4648") {
    CHECK(base64("").empty());
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("slides show each figure of a chapter once, in their order, with number and caption") {
    const SmallBook book;
    const std::string page = book.page("ch01_a");
    CHECK(all_of(page, "<section [^>]*id=\"([^\"]*)\"") == Names{"outline", "1.1", "1.2", "1.10"});
    CHECK(all_of(page, "<p class=\"caption\">(.*?)</p>") == Names{"<b>Figure 1.1</b> x &lt; 1",
                                                                  "<b>Figure 1.2</b> A room",
                                                                  "<b>Figure 1.10</b> Times"});
    CHECK(all_of(page, "<li><a href=\"#([^\"]*)\">") == Names{"1.1", "1.2", "1.10"});
    CHECK(all_of(page, "<svg id=\"([^\"]*)\"") == Names{"fig_01_01", "fig_01_10"});
    CHECK(all_of(page, "<img alt=\"([^\"]*)\"") == Names{"A room"});
    CHECK(all_of(page, "<(title|h1)>Chapter 1: A &amp; B</") == Names{"title", "h1"});
    CHECK(page.find("<ol class=\"steps\">\n<li>first</li>\n<li>then</li>\n</ol>") != page.npos);
}

TEST_CASE("slides need no other file: what they link to and show is in them") {
    const SmallBook book;
    const std::string page = book.page("ch01_a");
    for (const std::string& there :
         all_of(page, "(?:href|src|data|url)\\s*[=(]\\s*\"?([^\"\\s)]*)"))
        CHECK((there.starts_with('#') || there.starts_with("data:")));
    CHECK(page.find("<link") == page.npos);
    CHECK(all_of(page, "/\\* (\\S*) \\*/") ==
          Names{"steps.css", "slides.css", "steps.js", "slides.js"});
    CHECK(page.find("base64," + base64("\x89PN")) != page.npos);
    CHECK(all_of(page, "(\\.ink)").size() == 1);  // the drawings' common style
}

TEST_CASE("a picture that is about as wide as a window has its caption below") {
    const SmallBook book;
    CHECK(all_of(book.page("ch01_a"), "class=\"slide([^\"]*)\"") ==
          Names{" outline", "", " wide", ""});
    CHECK(all_of(book.page("fig_02_01"), "class=\"slide([^\"]*)\"") == Names{" outline", " wide"});
}

TEST_CASE("chapters have a file each, figures that are named one in that order, each once") {
    const SmallBook book;
    const auto shows = slide_shows(book.places, {"fig_02_01", "ch01_a", "fig_01_10", "fig_02_01"});
    REQUIRE(shows.size() == 2);
    CHECK(shows[0].file == "slides_01.html");
    CHECK(shows[0].figures.size() == 3);
    CHECK(shows[1].file == "slides.html");
    REQUIRE(shows[1].figures.size() == 2);
    CHECK(shows[1].figures[0].id == "fig_02_01");
    CHECK(shows[1].figures[1].id == "fig_01_10");
    const auto all = slide_shows(book.places, {});
    REQUIRE(all.size() == 2);
    CHECK(all[1].title == "Chapter 2: C");
}

TEST_CASE("slides of what is not there are errors") {
    const SmallBook book;
    CHECK_THROWS_AS(slide_shows(book.places, {"ch03_d"}), Error);
    CHECK_THROWS_AS(slide_shows(book.places, {"fig_01_03"}), Error);
    CHECK_THROWS_WITH(book.page("ch02_c"), "figure 2.2 is not here: ./book run 2 makes it");
    write_file(book.path / "figures/fig_01_02.png", "\x89PNG");
    CHECK_THROWS_AS(book.page("ch01_a"), Error);
}

TEST_CASE("slides follow the reader's system, or are light or dark at first") {
    const SmallBook book;
    const auto show = slide_shows(book.places, {"fig_02_01"}).front();
    const auto with = [&](SlideMode mode) {
        return slides(show.title, show.figures, book.path, mode);
    };
    CHECK(with(SlideMode::system).find("<html lang=\"en\">") != std::string::npos);
    CHECK(with(SlideMode::light).find("<html lang=\"en\" class=\"light-mode\">") !=
          std::string::npos);
    CHECK(with(SlideMode::dark).find("<html lang=\"en\" class=\"dark-mode\">") !=
          std::string::npos);
}
