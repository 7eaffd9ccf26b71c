// Speed against accuracy: the rays find tests that fail, the exact one never does.
#include "chapters/ch12_comparison/measured/accuracy_data.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/temporary.hpp"
#include "tests/catch.hpp"

#include <string>
#include <vector>

namespace space::ch12 {
namespace {

/// Naive tracing, and the book's plain hierarchy: what is wrong is the test's fault alone.
std::vector<Structure> two_structures() {
    std::vector<Structure> two{structures().front()};
    for (const Structure& structure : structures())
        if (structure.name == "bvh-binned") two.push_back(structure);
    return two;
}

TEST_CASE("aimed rays find wrong answers of tests that round, and none of the exact one",
          "[accuracy]") {
    const std::vector<Structure> two = two_structures();
    const std::vector<AccuracyRow> rows = measure_accuracy_of(two, {.small = true, .threads = 2});
    std::size_t exact = 0;
    for (const AccuracyPoint& point : accuracy_points(rows)) {
        INFO(point.structure << ", " << point.test);
        if (point.test == "filtered-exact") {
            ++exact;
            CHECK(point.per_million == 0.0);
        } else {
            CHECK(point.per_million > 1000.0);
        }
    }
    CHECK(exact == 2);
}

TEST_CASE("what is written is read again, and not measured again", "[accuracy]") {
    const TemporaryDirectory folder;
    const std::filesystem::path csv = folder / accuracy_file;
    const std::vector<Structure> naive{structures().front()};
    accuracy_into(csv, naive, {.small = true});
    const std::vector<AccuracyRow> rows = read_accuracy(csv);
    CHECK(rows.size() == 3 * naive.front().variants.size());
    CHECK(rows.front().structure == "naive");
    CHECK(rows.front().wrong() == 0);
    const auto written = std::filesystem::last_write_time(csv);
    accuracy_into(csv, naive, {.small = true});
    CHECK(std::filesystem::last_write_time(csv) == written);
    accuracy_into(csv, naive, {.small = true, .seed = 2});  // other rays
    CHECK(std::filesystem::last_write_time(csv) != written);
}

TEST_CASE("a broken line is named", "[accuracy]") {
    const TemporaryDirectory folder;
    const std::filesystem::path csv = folder / accuracy_file;
    write_file(csv, "# a\nsoup:1,naive,exact,chapter 1,0,10,1,2,three,4\n");
    CHECK_THROWS_WITH(read_accuracy(csv), csv.string() + ": line 2 is broken");
    write_file(csv, "# a\n");
    CHECK_THROWS_WITH(read_accuracy(csv), csv.string() + ": no measurement in it");
}

}  // namespace
}  // namespace space::ch12
