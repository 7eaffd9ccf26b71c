#include "docs/pages.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "docs/finish.hpp"
#include "docs/ledger.hpp"
#include "docs/search_text.hpp"
#include "tests/catch.hpp"

#include <filesystem>

using namespace space;
using namespace space::docs;

namespace {

/// A folder of its own, gone at the end.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / "splitting_space_pages_test";
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
};

std::string picture(const std::string& name) {
    return "<object type=\"image/svg+xml\" data=\"" + name + "\" style=\"pointer-events: none;\">" +
           name + "</object>";
}

}  // namespace

TEST_CASE("a drawing becomes part of its page, without the XML declaration") {
    const Folder folder;
    write_file(folder.path / "a.svg",
               "<?xml version=\"1.0\"?>\n<svg id=\"a\"><g id=\"a-x\"/></svg>\n");
    CHECK(inline_drawings("<p>" + picture("a.svg") + "</p>", folder.path) ==
          "<p><svg id=\"a\"><g id=\"a-x\"/></svg>\n</p>");
}

TEST_CASE("a drawing with steps is followed by the list of what they tell, in their order") {
    const Folder folder;
    write_file(
        folder.path / "a.svg",
        "<svg id=\"a\"><g data-first=\"1\">\n<desc>then</desc>\n</g>\n<g data-first=\"0\" "
        "data-last=\"0\" "
        "display=\"none\">\n<desc>first &lt;</desc>\n</g>\n<g data-first=\"1\">\n</g>\n</svg>\n");
    const std::string page = inline_drawings(picture("a.svg"), folder.path);
    CHECK(page.ends_with(
        "</svg>\n<ol class=\"steps\">\n<li>first &lt;</li>\n<li>then</li>\n</ol>\n"));
}

TEST_CASE("a missing drawing, and two drawings with an id in common, are errors") {
    const Folder folder;
    write_file(folder.path / "a.svg", "<svg id=\"a\"/>");
    write_file(folder.path / "b.svg", "<svg id=\"b\"><g id=\"a\"/></svg>");
    CHECK_THROWS_AS(inline_drawings(picture("none.svg"), folder.path), Error);
    CHECK_THROWS_AS(inline_drawings(picture("a.svg") + picture("b.svg"), folder.path), Error);
    CHECK_THROWS_AS(inline_drawings(picture("a.svg") + picture("a.svg"), folder.path), Error);
}

TEST_CASE("quoted code loses the indentation that its lines share, and only that") {
    const std::string open = "<div class=\"fragment\">", close = "</div><!-- fragment -->",
                      line = "<div class=\"line\">";
    CHECK(dedent_fragments(open + line + "    if (x)</div>\n" + line + "</div>\n" + line +
                           "        y();</div>\n" + close) ==
          open + line + "if (x)</div>\n" + line + "</div>\n" + line + "    y();</div>\n" + close);
    CHECK(dedent_fragments(open + line + "a</div>" + line + "  b</div>" + close) ==
          open + line + "a</div>" + line + "  b</div>" + close);
    const std::string comment = "<span class=\"comment\">", end = "</span></div>\n";
    CHECK(dedent_fragments(open + line + comment + "    // why" + end + line + comment +
                           "</span>    x();</div>\n" + close) ==
          open + line + comment + "// why" + end + line + "x();</div>\n" + close);
    CHECK(dedent_fragments("<p>  none</p>") == "<p>  none</p>");
}

TEST_CASE("a page is found by its sections, with the text that a reader sees") {
    const auto entries = search_entries(
        "<div class=\"title\">Naive &amp; slow</div></div>\n<div class=\"contents\">\n<p>A "
        "<b>r</b>ay.</p>"
        "<svg><text>hidden</text></svg><h1><a class=\"anchor\" "
        "id=\"idea\"></a>\nIdea</h1><p>M\u00f6ller</p>"
        "<h2 class=\"memtitle\"><span class=\"permalink\"><a "
        "href=\"#a1\">&#9670;&nbsp;</a></span>hit()</h2><p>x &lt; "
        "y</p>"
        "</div><!-- contents -->",
        "p.html");
    REQUIRE(entries.size() == 3);
    CHECK(entries[0].title == "Naive & slow");
    CHECK(entries[0].text.find("ray.") != std::string::npos);
    CHECK(entries[0].text.find("hidden") == std::string::npos);
    CHECK(entries[1].title == "Idea");
    CHECK(entries[1].url == "p.html#idea");
    CHECK(entries[2].title == "hit()");
    CHECK(entries[2].url == "p.html#a1");
    CHECK(entries[2].text.find("x < y") != std::string::npos);
}

TEST_CASE("a page's table of files is its README's, with names in place of links") {
    const Folder folder;
    const auto readme = folder.path / "README.md";
    for (const char* file : {"a.hpp", "b.hpp", "chapter.dox"}) write_file(folder.path / file, "");
    const std::string table =
        "| Read | for |\n|---|---|\n| [a.hpp](a.hpp), [b](b.hpp) | all |\n"
        "| [chapter.dox](chapter.dox) | the text |\n";
    write_file(readme, "# C\n\n" + table + "\n| x | y |\n");
    CHECK(files_table(readme) == "| Read | for |\n|---|---|\n| `a.hpp`, `b` | all |\n");
    write_file(readme, table + "| [c.hpp](c.hpp) | gone |\n");
    CHECK_THROWS_AS(files_table(readme), Error);
    write_file(readme, "# C\n| file | holds |\n");
    CHECK_THROWS_AS(files_table(readme), Error);
}

TEST_CASE("figures are numbered in the order in which the text shows them") {
    CHECK(figure_order_fault(
              3, "\\fig_03_01\n\\fig_02_09 and \\fig_03_02 \\fig_03_01\n\\fig_03_03") == "");
    CHECK(figure_order_fault(3, "none, but Figure 3.2") == "");
    CHECK(figure_order_fault(3, "\\fig_03_01 \\fig_03_03 \\fig_03_02") ==
          "Figure 3.3 is shown where Figure 3.2 is due");
    CHECK(figure_order_fault(12, "\\fig_12_02") == "Figure 12.2 is shown where Figure 12.1 is due");

    const std::filesystem::path root = BOOK_ROOT;
    for (const Chapter& chapter : read_chapters(root)) {
        if (!exists(root / "chapters" / chapter.folder / "chapter.dox")) continue;
        std::string text;
        for (const auto& file : text_files(root, chapter)) text += read_file(file);
        CAPTURE(chapter.folder);
        CHECK(figure_order_fault(chapter.number, text) == "");
    }
}
