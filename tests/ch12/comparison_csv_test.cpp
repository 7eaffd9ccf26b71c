#include "chapters/ch12_comparison/measured/comparison_data.hpp"
#include "common/pcg32.hpp"
#include "common/program/error.hpp"
#include "common/program/file.hpp"
#include "common/program/temporary.hpp"
#include "tests/catch.hpp"

#include <string>
#include <utility>
#include <vector>

using namespace space;
using namespace space::ch12;

namespace {

ComparedRow random_row(const std::string& spec, int number, Pcg32& random) {
    const auto real = [&] {
        return random.below(5) == 0 ? unknown : random.uniform_double() * 1e6;
    };
    ComparedRow row{.scene = spec.substr(0, spec.find(':')),
                    .spec = spec,
                    .triangles = random.below(1'000'000),
                    .structure = "structure-" + std::to_string(number),
                    .home = "chapter 7",
                    .is_peer = random.below(2) == 0,
                    .build_threads = 1 + random.below(8)};
    row.build_ms = real();
    for (std::uint32_t i = random.below(4); i > 0; --i)
        row.made_later.push_back({double(random.below(1000)), random.uniform_double()});
    row.bytes = random.below(1'000'000'000);
    row.nodes = real();
    row.references = random.below(1'000'000);
    row.depth = real();
    row.sah_cost = real();
    for (TracedKind& kind : row.traced) {
        kind.ns_per_ray = real();
        kind.nodes_per_ray = real();
        kind.tests_per_ray = real();
        kind.rays = random.below(5000);
        kind.wrong = random.below(10);
    }
    if (random.below(4) == 0) row.gave_up = "BSP tree: more than 5 polygons, \"or so\"";
    return row;
}

Comparison random_comparison(std::uint64_t seed) {
    Pcg32 random(seed);
    Comparison comparison{.rows = {},
                          .machine = "Some Processor, 2 cores, g++ 12.2",
                          .date = "2026-11-28",
                          .sources = "0123",
                          .minutes = 1.25,
                          .settings = "full, seed 1"};
    for (const char* spec : {"soup:10", "soup:20", "boxes:3"})
        for (int i = 0; i < 5; ++i) comparison.rows.push_back(random_row(spec, i, random));
    return comparison;
}

/// Reads a text as a file, and gives the line that refuses it; empty where it is taken.
std::string refusal(const std::string& text) {
    const TemporaryDirectory directory;
    write_file(directory / "c.csv", text);
    try {
        read_comparison(directory / "c.csv");
        return "";
    } catch (const Error& error) {
        CHECK(error.code() == ExitCode::bad_input);
        const std::string line = error.what();
        CHECK(line.find('\n') == std::string::npos);
        return line.substr(line.find("c.csv"));
    }
}

std::pair<Comparison, std::size_t> whole_blocks_of(const std::string& text) {
    const TemporaryDirectory directory;
    write_file(directory / "c.csv", text);
    std::size_t dropped = 0;
    Comparison comparison = read_whole_blocks(directory / "c.csv", dropped);
    return {std::move(comparison), dropped};
}

}  // namespace

TEST_CASE("what is written is read back, each bit of it") {
    for (std::uint64_t seed = 1; seed < 50; ++seed) {
        const Comparison comparison = random_comparison(seed);
        const auto [read, dropped] = whole_blocks_of(csv_text(comparison));
        REQUIRE(read.rows == comparison.rows);
        REQUIRE(csv_text(read) == csv_text(comparison));
        CHECK(read.machine == comparison.machine);
        CHECK(read.settings == comparison.settings);
        CHECK(read.minutes == comparison.minutes);
        CHECK(dropped == 0);
        CHECK(refusal(csv_text(comparison)).empty());
    }
}

TEST_CASE("cut anywhere, a file is refused, or cut back to blocks that are whole") {
    const Comparison comparison = random_comparison(7);
    const std::string text = csv_text(comparison);
    for (std::size_t size = 0; size < text.size(); size += sized(7, 97)) {
        const auto [read, dropped] = whole_blocks_of(text.substr(0, size));
        REQUIRE(read.rows.size() % 5 == 0);
        REQUIRE(read.rows.size() < comparison.rows.size());
        for (std::size_t i = 0; i < read.rows.size(); ++i)
            REQUIRE(read.rows[i] == comparison.rows[i]);
    }
    const std::size_t second = text.find("# whole: soup:20");
    CHECK(refusal(text.substr(0, second)) == "c.csv: its last block is not whole");
    CHECK(refusal(text.substr(0, second + 5)) == "c.csv:19: the line has no end");
    CHECK(whole_blocks_of(text.substr(0, second + 5)).second == 6);
}

TEST_CASE("a broken line is refused with its place and its fault") {
    const std::string text = csv_text(random_comparison(3));
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string changed = text;
        const std::size_t at = changed.find(from);
        REQUIRE(at != std::string::npos);
        return changed.replace(at, from.size(), to);
    };
    CHECK(refusal("") == "c.csv: holds no comparison");
    CHECK(refusal("a,b\n1,2\n") == "c.csv:1: these are not a comparison's columns");
    CHECK(refusal(with("chapter 7,", "chapter 7,-")) ==
          "c.csv:8: '-" + std::string(text[text.find("chapter 7,") + 10] == '1' ? "1" : "0") +
              "' is no number that can be here");
    CHECK(refusal(with("soup,soup:10,", "soup;soup:10;")).starts_with("c.csv:8: "));
    CHECK(refusal(with("# whole: soup:10", "# whole: soup:11")) ==
          "c.csv:13: the rows before it are of another scene");
    CHECK(refusal(with("# minutes: 1.25", "# minutes: nan")) ==
          "c.csv:6: 'nan' is no number that can be here");
}

TEST_CASE("a missing file is refused") {
    CHECK_THROWS_AS(read_comparison("no/such/file.csv"), Error);
}

TEST_CASE("the book's own comparison can be read, and nothing of the book answered wrong") {
    const Comparison kept = read_comparison(kept_comparison_file());
    CHECK(kept.rows.size() > 300);
    for (const ComparedRow& row : kept.rows)
        if (!row.is_peer) CHECK(row.wrong() == 0);
}

TEST_CASE("a row's mean is over the kinds that have rays; a structure that gave up is not found") {
    ComparedRow row{.spec = "soup:10", .structure = "a"};
    row.traced[0] = {.ns_per_ray = 10, .rays = 1};
    row.traced[2] = {.ns_per_ray = 20, .rays = 3, .wrong = 2};
    CHECK(row.mean_ns() == 15);
    CHECK(row.rays() == 4);
    CHECK(row.wrong() == 2);
    row.build_ms = 1;
    row.made_later = {{1, 2}, {5, 3}};
    CHECK(row.ready_ms() == 4);
    std::vector<ComparedRow> block{row, row};
    block[1].structure = "b";
    block[1].gave_up = "out of memory";
    CHECK(find(block, "a") == &block[0]);
    CHECK(find(block, "b") == nullptr);
    CHECK(find(block, "c") == nullptr);
}
