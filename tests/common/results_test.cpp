#include "common/program/results.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "tests/catch.hpp"
#include "tests/common/temporary.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>

namespace space {

TEST_CASE("the results file holds every answer, the machine and the date") {
    const TemporaryDirectory directory;
    const auto file = directory.path() / "out" / "results.json";
    ::setenv("SOURCE_DATE_EPOCH", "951782400", 1);  // 2000-02-29 00:00:00 UTC
    write_results(file,
                  {.run = provenance("ch00_test", {.small = true}),
                   .answers = {{"H1", Verdict::confirmed, "slope 1.0", "soup", "0.9 .. 1.1"},
                               {"H2", Verdict::refuted, "a \"quote\" and Möller", "bunny", "r"},
                               {"P1", Verdict::depends, "", "", ""}}});
    ::unsetenv("SOURCE_DATE_EPOCH");

    const auto json = nlohmann::json::parse(read_file(file));
    CHECK(json.size() == 6);
    CHECK(json["chapter"] == "ch00_test");
    CHECK(json["mode"] == "small");
    CHECK(json["machine"] == machine_description());
    CHECK(json["date"] == "2000-02-29");
    REQUIRE(json["answers"].size() == 3);
    CHECK(json["answers"][0] == nlohmann::json{{"claim", "H1"},
                                               {"verdict", "confirmed"},
                                               {"measured", "slope 1.0"},
                                               {"scene", "soup"},
                                               {"rule", "0.9 .. 1.1"}});
    CHECK(json["answers"][1]["verdict"] == "refuted");
    CHECK(json["answers"][1]["measured"] == "a \"quote\" and Möller");
    CHECK(json["answers"][2]["verdict"] == "depends");
}

TEST_CASE("the machine's description names processor, cores and compiler") {
    const std::string text = machine_description();
    CHECK(text.find(" cores, ") != std::string::npos);
    CHECK((text.find("g++ ") != std::string::npos || text.find("clang ") != std::string::npos));
}

TEST_CASE("today is a date") {
    const std::string date = today();
    REQUIRE(date.size() == 10);
    CHECK(date[4] == '-');
    CHECK(date[7] == '-');
    CHECK(date.substr(0, 2) == "20");
}

TEST_CASE("results that cannot be written are an error") {
    CHECK_THROWS_AS(write_results("/proc/none/results.json", {.run = {}, .answers = {}}), Error);
}

}  // namespace space
