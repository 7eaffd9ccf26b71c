#include "chapters/ch12_comparison/measured/break_even.hpp"

#include "common/pcg32.hpp"
#include "tests/catch.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace space;
using namespace space::ch12;

namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();

std::vector<std::string> names(std::span<const CostLine> lines,
                               std::span<const CheapestSpan> spans) {
    std::vector<std::string> all;
    for (const CheapestSpan& span : spans) all.push_back(lines[span.line].name);
    return all;
}

double least_cost(std::span<const CostLine> lines, double rays) {
    double least = no_end;
    for (const CostLine& line : lines) least = std::min(least, line.cost(rays));
    return least;
}

/// Small whole numbers, so that lines meet in one point and run side by side; some of them end.
std::vector<CostLine> random_lines(Pcg32& random) {
    std::vector<CostLine> lines(1 + random.below(12));
    for (CostLine& line : lines) {
        line.fixed_ns = random.below(40);
        line.ns_per_ray = random.below(8);
        if (random.below(3) == 0) line.most_rays = 1.0 + random.below(30);
    }
    lines[random.below(static_cast<std::uint32_t>(lines.size()))].most_rays = no_end;
    return lines;
}

ComparedRow timed(const std::string& name, double build_ms, double ns) {
    ComparedRow row{.structure = name, .build_ms = build_ms};
    for (TracedKind& kind : row.traced) kind.ns_per_ray = ns, kind.rays = 10;
    return row;
}

}  // namespace

TEST_CASE("three lines change where pen and paper say") {
    // 10 n, 90 + n and 1000 + n/10 meet at 10 and at 9100/9.
    const std::vector<CostLine> lines{{"slow", 0, 10}, {"middling", 90, 1}, {"fast", 1000, 0.1}};
    const auto spans = lower_envelope(lines, 1, 1e6);
    CHECK(names(lines, spans) == std::vector<std::string>{"slow", "middling", "fast"});
    CHECK(spans[0].from == 1);
    CHECK(spans[0].to == 10);
    CHECK(spans[1].to == Approx(9100.0 / 9.0));
    CHECK(spans[2].to == 1e6);
    CHECK(cheapest(lines, 9) == 0);
    CHECK(cheapest(lines, 10) == 1);  // of equal ones the one that grows least
    CHECK(cheapest(lines, 1011) == 1);
    CHECK(cheapest(lines, 1012) == 2);
}

TEST_CASE("a line that is never the lowest is in no span, whatever the order") {
    const std::vector<CostLine> lines{{"fast", 100, 1}, {"hopeless", 95, 9}, {"slow", 0, 10}};
    CHECK(names(lines, lower_envelope(lines, 1, 1e10)) == std::vector<std::string>{"slow", "fast"});
}

TEST_CASE("where a line ends the lowest of the others takes over") {
    const std::vector<CostLine> lines{
        {"lazy, few", 1, 2, 10}, {"lazy", 50, 2, no_end}, {"whole", 100, 1, no_end}};
    const auto spans = lower_envelope(lines, 1, 1e3);
    CHECK(names(lines, spans) == std::vector<std::string>{"lazy, few", "lazy", "whole"});
    CHECK(spans[0].to == 10);
    CHECK(spans[1].to == 50);
}

TEST_CASE("no line, no span") {
    CHECK(lower_envelope({}, 1, 10).empty());
}

TEST_CASE("spans follow each other without gaps, and their line is the lowest everywhere") {
    Pcg32 random(12);
    for (int round = 0; round < sized(20'000, 500); ++round) {
        const std::vector<CostLine> lines = random_lines(random);
        const auto spans = lower_envelope(lines, 1, 1e3);
        REQUIRE(!spans.empty());
        REQUIRE(spans.front().from == 1);
        REQUIRE(spans.back().to == 1e3);
        for (std::size_t i = 0; i < spans.size(); ++i) {
            const auto [line, from, to] = spans[i];
            REQUIRE(from <= to);
            if (i > 0) {
                REQUIRE(from >= spans[i - 1].to);
                REQUIRE(from <= std::nextafter(spans[i - 1].to, 1e3));
            }
            for (const double rays : {from, 0.5 * (from + to), to})
                REQUIRE(lines[line].cost(rays) <= least_cost(lines, rays) * (1 + 1e-12));
        }
    }
}

TEST_CASE("a lazy tree costs what few and all rays make of it, and one ray says nothing") {
    std::vector<ComparedRow> block{timed("whole", 5, 100), timed("kd-lazy", 1, 200)};
    block[1].made_later = {{1, 0.5}, {100, 2}, {1000, 6}};
    const auto lines = cost_lines(block, false);
    REQUIRE(lines.size() == 3);
    CHECK(lines[1].cost(1) == Approx(3e6 + 200));
    CHECK(lines[1].cost(100) == Approx(3e6 + 2e4));
    CHECK(lines[1].cost(101) == no_end);
    CHECK(lines[2].cost(1e9) == Approx(7e6 + 2e11));  // the last one has no end
    CHECK(lines[cheapest(lines, 50)].name == "kd-lazy");
    CHECK(lines[cheapest(lines, 500)].name == "whole");
}

TEST_CASE("more rays never make fewer nodes: what falls is noise") {
    std::vector<ComparedRow> block{timed("kd-lazy", 1, 200)};
    block[0].made_later = {{1, 0.5}, {100, 6}, {1000, 2}};
    const auto lines = cost_lines(block, false);
    CHECK(lines[1].cost(1e9) == Approx(7e6 + 2e11));
    CHECK(block[0].ready_ms() == 7);
}

TEST_CASE("what gave up, was not timed, or is a peer where none is wanted has no line") {
    std::vector<ComparedRow> block{timed("a", 1, 1), timed("b", 1, 1), timed("c", unknown, 1),
                                   timed("d", 1, 1)};
    block[1].gave_up = "out of memory";
    block[3].is_peer = true;
    CHECK(cost_lines(block, false).size() == 1);
    CHECK(cost_lines(block, true).size() == 2);
    block[0].traced[2].ns_per_ray = 7;
    CHECK(cost_lines(block, false).front().ns_per_ray == Approx(2.5));
    CHECK(cost_lines(block, false, RayKind::diffuse).front().ns_per_ray == 7);
}
