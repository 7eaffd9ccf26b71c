#include "docs/ledger.hpp"

#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/results.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <set>
#include <utility>

using namespace space;
using namespace space::docs;

namespace {

const std::vector<Claim> claims{
    {.id = "H1", .source = "S", .note = "", .text = "linear", .chapters = {1}, .how = ""},
    {.id = "P6", .source = "S", .note = "", .text = "6T", .chapters = {4, 7}, .how = ""},
    {.id = "H4", .source = "S", .note = "", .text = "log n", .chapters = {3}, .how = ""}};

Answers good() {
    return {.run = {.chapter = "ch01", .mode = "full", .machine = "m", .date = "d"},
            .answers = {{.claim = "H1",
                         .verdict = "confirmed",
                         .measured = "1.0",
                         .scene = "soup",
                         .rule = "0.9 .. 1.1"}}};
}

}  // namespace

TEST_CASE("a chapter that answers its claims has no fault") {
    CHECK(faults(claims, 1, good()).empty());
}

TEST_CASE("a claim without an answer is a fault that names it") {
    Answers answers = good();
    answers.answers.clear();
    const auto lines = faults(claims, 1, answers);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].find("H1") != std::string::npos);
}

TEST_CASE("a claim of two chapters is owed by both") {
    CHECK(faults(claims, 4, {}).size() == 1);
    CHECK(faults(claims, 7, {}).size() == 1);
}

TEST_CASE("a claim answered twice is a fault") {
    Answers answers = good();
    answers.answers.push_back(answers.answers[0]);
    CHECK(faults(claims, 1, answers).size() == 1);
}

TEST_CASE("an answer to a claim of another chapter, or to none, is a fault") {
    const std::string id = GENERATE("H4", "P6", "X9", "");
    Answers answers = good();
    answers.answers.push_back(answers.answers[0]);
    answers.answers[1].claim = id;
    CHECK(faults(claims, 1, answers).size() == 1);
}

TEST_CASE("a verdict is one of three words") {
    const std::string verdict = GENERATE("true", "Confirmed", "confirmed ", "");
    Answers answers = good();
    answers.answers[0].verdict = verdict;
    CHECK(faults(claims, 1, answers).size() == 1);
}

TEST_CASE("measured value, scene and rule are said") {
    const auto field = GENERATE(&Answer::measured, &Answer::scene, &Answer::rule);
    const std::string nothing = GENERATE("", " \n");
    Answers answers = good();
    answers.answers[0].*field = nothing;
    CHECK(faults(claims, 1, answers).size() == 1);
}

TEST_CASE("what a program writes is what the ledger reads") {
    const auto file = std::filesystem::temp_directory_path() / "splitting_space_ledger_test.json";
    Results results{.run = provenance("ch01_naive_ray_tracing", {.small = true}), .answers = {}};
    for (const Verdict verdict : {Verdict::confirmed, Verdict::refuted, Verdict::depends})
        results.answers.push_back({.claim = "H1",
                                   .verdict = verdict,
                                   .measured = "\"1\" < 2",
                                   .scene = "s",
                                   .rule = "r"});
    write_results(file, results);
    const Answers answers = read_answers(file);
    std::filesystem::remove(file);
    REQUIRE(answers.answers.size() == 3);
    CHECK(answers.run.mode == "small");
    CHECK(answers.answers[0].measured == "\"1\" < 2");
    CHECK(faults(claims, 1, answers).size() ==
          1);  // three answers to one claim; all three words are verdicts
}

TEST_CASE("a results file that is no JSON, or lacks a field, is one line that names it") {
    const std::string text = GENERATE("", "{", "[]", "{\"chapter\": 1}");
    const auto file =
        std::filesystem::temp_directory_path() / "splitting_space_broken_results.json";
    write_file(file, text);
    try {
        read_answers(file);
        FAIL("read");
    } catch (const Error& error) {
        CHECK(std::string(error.what()).starts_with(file.string()));
    }
    std::filesystem::remove(file);
}

TEST_CASE("the ledger holds every claim of the sources once, each with a chapter of the book") {
    const std::filesystem::path root = book_root();
    const auto chapters = read_chapters(root);
    CHECK(chapters.size() == 12);
    std::set<std::string> expected, found;
    for (const auto& [letter, last] :
         {std::pair{'H', 17}, {'P', 19}, {'L', 11}, {'J', 7}, {'O', 16}})
        for (int i = 1; i <= last; ++i) expected.insert(letter + std::to_string(i));
    for (const Claim& claim : read_claims(root / "docs/claims.json")) {
        CHECK(found.insert(claim.id).second);
        CHECK_FALSE(claim.chapters.empty());
        for (const int chapter : claim.chapters) CHECK((chapter >= 1 && chapter <= 12));
    }
    CHECK(found == expected);
}
