#include "common/program/report.hpp"

#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

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

TEST_CASE("numbers get a comma after every three digits") {
    CHECK(with_commas(0) == "0");
    CHECK(with_commas(999) == "999");
    CHECK(with_commas(1000) == "1,000");
    CHECK(with_commas(1234567) == "1,234,567");
    CHECK(with_commas(18446744073709551615u) == "18,446,744,073,709,551,615");
}

}  // namespace space
