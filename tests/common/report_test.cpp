#include "common/program/report.hpp"

#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

#include <algorithm>

namespace space {

TEST_CASE("columns fit their entries; numbers stand to the right, words to the left") {
    Table table({"scene", "rays", "time"});
    table.row({"bunny", "1,234", "5.5 %"});
    table.row({"a long name", "7", "-"});
    CHECK(table.text() ==
          "scene         rays   time\n"
          "-----------  -----  -----\n"
          "bunny        1,234  5.5 %\n"
          "a long name      7      -\n");
}

TEST_CASE("a short row is filled up, letters of several bytes count once, no line ends in blanks") {
    Table table({"name", "note"});
    table.row({"Möller"});
    table.row({"x", "y"});
    CHECK(table.text() ==
          "name    note\n"
          "------  ----\n"
          "Möller\n"
          "x       y\n");
    CHECK(Table({"a", "b"}).text() == "a  b\n-  -\n");
}

TEST_CASE("tables and headings go to stdout") {
    Table table({"n"});
    table.row({"1"});
    CHECK(written_to(1, [&] { table.print(); }) == "n\n-\n1\n");
    CHECK(written_to(1, [] { print_heading("Möller"); }) == "\nMöller\n======\n");
}

TEST_CASE("a long text is wrapped at blanks to 100 columns, all lines but the first indented") {
    CHECK(wrapped("short, as it is", 5) == "short, as it is");
    std::string words;
    for (int i = 0; i < 60; ++i) words += "word ";  // 300 columns with the last blank
    words += "end";
    const std::string lines = wrapped(words, 5);
    CHECK(lines.find("\n     word") == 99);
    std::size_t longest = 0, length = 0;
    std::string again;
    for (const char c : lines) {
        length = c == '\n' ? 0 : length + 1;
        longest = std::max(longest, length);
        if (c != '\n' && !(c == ' ' && again.ends_with(' '))) again += c;
    }
    CHECK(longest <= 100);
    CHECK(again == words);
    CHECK(wrapped(std::string(300, 'x'), 5) == std::string(300, 'x'));
}

TEST_CASE("numbers get a comma after every three digits") {
    CHECK(with_commas(0) == "0");
    CHECK(with_commas(999) == "999");
    CHECK(with_commas(1000) == "1,000");
    CHECK(with_commas(1234567) == "1,234,567");
    CHECK(with_commas(18446744073709551615u) == "18,446,744,073,709,551,615");
}

}  // namespace space
