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
using namespace std::string_literals;

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
          "<p><div class=\"drawing\"><svg id=\"a\"><g id=\"a-x\"/></svg>\n</div>\n</p>");
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
        "</svg>\n</div>\n<ol class=\"steps\">\n<li>first &lt;</li>\n<li>then</li>\n</ol>\n"));
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

TEST_CASE("links in code that rest on a word's spelling alone go") {
    const auto link = [](const char* kind, const char* there, const char* word) {
        return "<a class=\"code hl_" + std::string(kind) + "\" href=\"" + there + "\">" + word +
               "</a>";
    };
    const auto kept = [](const std::string& code) { return without_guesses(code) == code; };
    CHECK(kept(link("struct", "structspace_1_1Ray.html", "Ray") + " ray;"));
    CHECK(kept(link("function", "namespacespace.html#a1", "slope") + "(x)"));
    CHECK(kept(link("function", "namespacespace.html#a1", "decode") + "&lt;float&gt;"));
    CHECK(kept(link("variable", "namespacespace.html#a1", "float_roundoff") + ";"));
    CHECK(kept("Splitter::" + link("enumvalue", "x.html", "first")));
    CHECK(kept(link("enumvalue", "x.html", "Splitter::first")));
    CHECK(without_guesses("double " + link("function", "n.html#a1", "slope") + " = " +
                          link("enumvalue", "x.html", "near") + ".t + node." +
                          link("variable", "structspace_1_1C.html#a1", "first") + ";") ==
          "double slope = near.t + node.first;");
    CHECK(kept("<a class=\"el\" href=\"n.html\">slope</a> and <a class=\"code hl_variable\""));
}

TEST_CASE(
    "no line ends inside an option or a folder's name, nor between a formula and its full stop") {
    const auto word = [](const std::string& text) {
        return "<span class=\"word\">" + text + "</span>";
    };
    CHECK(kept_together("<code>--query any x</code>") ==
          "<code>" + word("--query ") + "any x</code>");
    CHECK(kept_together("<code>a/b-c.hpp</code>") ==
          "<code>" + word("a/") + word("b-c.hpp") + "</code>");
    const std::string formula = "\\(a - b\\)", long_one = "\\(" + std::string(80, 'x') + "\\).";
    CHECK(kept_together("p " + formula + ", q (" + formula + ") and " + formula + " r") ==
          "p " + word(formula + ",") + " q " + word("(" + formula + ")") + " and " + formula +
              " r");
    for (const std::string& same : {long_one, "<code><b>a-b</b></code>"s, "a-b \\[x\\]."s, "\\(x"s})
        CHECK(kept_together(same) == same);
}

TEST_CASE("a picture's caption is its alternative text, and the menu stands without scripts, too") {
    const std::string image = "<div class=\"image\">\n<img src=\"fig_1.png\" alt=\"",
                      rest = "\"/>\n<div class=\"caption\">\nFigure 1: A room</div></div>";
    CHECK(with_alternatives(image + rest) == image + "Figure 1: A room" + rest);
    CHECK(
        menu_without_scripts("var NAVTREE =\n[\n  [ \"B\", \"index.html\", [\n"
                             "    [ \"1. A &amp; B\", \"a.html\", null ],\n"
                             "    [ \"Code\", null, [\n      [ \"Types\", \"t.html\", null ]\n") ==
        "<noscript><nav class=\"plain-menu\"><a href=\"index.html\">The book</a> <a "
        "href=\"a.html\">1. A &amp; B</a> <a href=\"files.html\">Code</a></nav></noscript>\n");
}

TEST_CASE("a table's first row is its head") {
    const std::string head = "<tr class=\"markdownTableHead\">\n<th>a</th></tr>",
                      rows = "\n<tr class=\"markdownTableRowOdd\">\n<td>1</td></tr>\n",
                      open = "<table class=\"markdownTable\">\n", close = "</table>";
    CHECK(with_table_heads("<p>" + open + head + rows + close + "</p>") ==
          "<p>" + open + "<thead>" + head + "</thead><tbody>" + rows + "</tbody>" + close + "</p>");
    CHECK(with_table_heads(open + rows + close) == open + rows + close);
}

TEST_CASE("a formula is found by what one would say or type for it") {
    const auto text = [](const std::string& body) {
        return search_entries("<div class=\"contents\">" + body + "</div><!-- contents -->",
                              "p.html")
            .front()
            .text;
    };
    CHECK(text("<p>Let \\(x \\cdot (y \\times z) \\le \\frac{1}{2} t_\\mathrm{max}\\).</p>") ==
          "Let x · (y × z) ≤ 1 / 2 t_max.");
    CHECK(text("<p>\\[\\left| \\varepsilon \\right| &lt; \\infty\\]</p>") == "| epsilon | < ∞");
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

TEST_CASE("in place of a figure without a file stands a sentence, and the others stand") {
    const Folder folder;
    const Places places{
        .root = folder.path, .configured = folder.path, .runs = folder.path / "runs", .pages = {}};
    write_file(folder.path / "figures.json",
               R"([{"id": "fig_04_06", "chapter": "ch04_a", "kind": "chart", "caption": "Times"},
                   {"id": "fig_04_07", "chapter": "ch04_a", "kind": "drawing", "caption": "A"}])");
    write_file(folder.path / "figures/fig_04_07.svg", "<svg/>");
    const std::string drawing =
        "ALIASES += \"fig_04_07=\\image html fig_04_07.svg \\\"Figure 4.7: A\\\"\"\n";
    CHECK(figure_aliases(places) ==
          "ALIASES += \"fig_04_06=<b>Figure 4.6 is not here</b>: `./book run 4` makes it.\"\n" +
              drawing);
    write_file(folder.path / "figures/measured/fig_04_06.svg", "<svg/>");
    CHECK(figure_aliases(places) ==
          "ALIASES += \"fig_04_06=\\image html fig_04_06.svg \\\"Figure 4.6: Times\\\"\"\n" +
              drawing);
}

TEST_CASE("figures are numbered in the order in which the text shows them") {
    CHECK(figure_order_fault(
              3, "\\fig_03_01\n\\fig_02_09 and \\fig_03_02 \\fig_03_01\n\\fig_03_03") == "");
    CHECK(figure_order_fault(3, "none, but Figure 3.2") == "");
    CHECK(figure_order_fault(3, "\\fig_03_01 \\fig_03_03 \\fig_03_02") ==
          "Figure 3.3 is shown where Figure 3.2 is due");
    CHECK(figure_order_fault(12, "\\fig_12_02") == "Figure 12.2 is shown where Figure 12.1 is due");

    const std::filesystem::path root = book_root();
    for (const Chapter& chapter : read_chapters(root)) {
        if (!exists(root / "chapters" / chapter.folder / "chapter.dox")) continue;
        std::string text;
        for (const auto& file : text_files(root, chapter)) text += read_file(file);
        CAPTURE(chapter.folder);
        CHECK(figure_order_fault(chapter.number, text) == "");
    }
}

TEST_CASE("a page's list of claims is the ledger's, by verdict or counted by source") {
    const auto claim = [](const char* id, const char* source, std::vector<int> chapters) {
        return Claim{.id = id,
                     .source = source,
                     .note = "",
                     .text = std::string("says ") + id,
                     .chapters = std::move(chapters),
                     .how = ""};
    };
    const Claim h1 = claim("H1", "Heinonen16", {1}), p6 = claim("P6", "BvhThesis13", {4, 7}),
                h2 = claim("H2", "Heinonen16", {7});
    const std::vector<ClaimVerdict> verdicts{
        {h1, 1, "confirmed"}, {p6, 4, "depends"}, {p6, 7, "confirmed"}, {h2, 7, ""}};
    const std::string right = claims_table(verdicts, "confirmed");
    CHECK(right.find("ledger.html#claim_H1\">H1</a>") != std::string::npos);
    CHECK(right.find("ledger.html#claim_P6_7\">P6</a>") != std::string::npos);
    CHECK(right.find("says H2") == std::string::npos);
    CHECK(right.find("claim_P6\">") == std::string::npos);  // chapter 4's, which depends
    CHECK(claims_table(verdicts, "depends").find("ledger.html#claim_P6\">") != std::string::npos);
    const std::string tally = claims_table(verdicts, "tally");
    CHECK(tally.find("Heinonen16</a></td><td>2</td><td>1</td><td>0</td><td>0</td>") !=
          std::string::npos);
    CHECK(tally.find("BvhThesis13</a></td><td>1</td><td>1</td><td>0</td><td>0</td>") !=
          std::string::npos);
    CHECK(tally.find("<b>all</b></td><td>3</td><td>2</td>") != std::string::npos);
    CHECK_THROWS_AS(claims_table(verdicts, "right"), Error);
}
