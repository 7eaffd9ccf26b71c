// The lab's pictures and its table as comma-separated values: beside its counts, its JSON and each
// other.
#include "chapters/ch12_comparison/lab_pictures.hpp"
#include "chapters/ch12_comparison/lab_report.hpp"
#include "chapters/ch12_comparison/structures.hpp"
#include "common/mesh.hpp"
#include "common/program/file.hpp"
#include "common/program/heat.hpp"
#include "common/program/image_text.hpp"
#include "common/program/report.hpp"
#include "tests/catch.hpp"
#include "tests/lab/process.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace space;

namespace {

const Command lab{.words = {LAB_PROGRAM, "lab"}};
const Command broken_lab{.words = {BROKEN_LAB_PROGRAM}};

/// Under sanitizers, one structure of each chapter.
std::vector<const Structure*> tried_structures() {
    std::vector<const Structure*> tried;
    for (const Structure& structure : structures())
        if (!is_sanitized || structure.by_default) tried.push_back(&structure);
    return tried;
}

nlohmann::json json_of(const Ended& ended) {
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    return nlohmann::json::parse(ended.out);
}

/// The records of comma-separated values, by RFC 4180.
std::vector<std::vector<std::string>> csv_records(const std::string& text) {
    std::vector<std::vector<std::string>> records{{""}};
    bool is_quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        std::string& field = records.back().back();
        if (is_quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            field += text[i++];
        else if (c == '"')
            is_quoted = !is_quoted;
        else if (!is_quoted && c == ',')
            records.back().emplace_back();
        else if (!is_quoted && c == '\n')
            records.push_back({""});
        else
            field += c;
    }
    records.pop_back();  // after the last end of a line
    return records;
}

/// The rows as maps from names to fields.
std::vector<std::map<std::string, std::string>> csv_rows(const std::string& text) {
    const auto records = csv_records(text);
    std::vector<std::map<std::string, std::string>> rows;
    for (std::size_t i = 1; i < records.size(); ++i) {
        REQUIRE(records[i].size() == records[0].size());
        auto& row = rows.emplace_back();
        for (std::size_t k = 0; k < records[0].size(); ++k) row[records[0][k]] = records[i][k];
    }
    return rows;
}

std::string field_of(const nlohmann::json& value) {
    return value.is_null() ? "" : value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

TEST_CASE("a heat map's pixels sum to the counts that are reported, for every structure") {
    const Workbench bench;
    for (const Structure* structure : tried_structures())
        for (const HeatOf of : {HeatOf::nodes, HeatOf::tests}) {
            const Command command = lab.with("--scene soup:200 --size 24x18 --repeat 1 --structure")
                                        .with_word(std::string(structure->name))
                                        .with("--query any --json -");
            const nlohmann::json json = json_of(run(command));
            const auto& row = json["structures"][0];
            const auto& count = row[of == HeatOf::nodes ? "node_visits" : "triangle_tests"];
            const Ended heated =
                run(command.with("--heatmap", bench / "heat.png")
                        .with(of == HeatOf::nodes ? "--heatmap-of nodes" : "--heatmap-of tests"));
            INFO(structure->name << ": " << heated.err);
            if (count.is_null()) {
                CHECK(heated.code == 2);
                continue;
            }
            CHECK(nlohmann::json::parse(heated.out)["structures"][0]["triangle_tests"] ==
                  row["triangle_tests"]);
            CHECK(heated.err.find(fmt::format("heat.png: {}, {} in all", heat_name(of),
                                              with_commas(count.get<std::uint64_t>()))) !=
                  std::string::npos);
            CHECK(read_file(bench / "heat.png").starts_with("\x89PNG"));
        }
}

TEST_CASE("a heat map shows the same bytes for any number of threads, and its scale can be set") {
    const Workbench bench;
    const auto bytes = [&](const char* options) {
        const Ended ended = run(lab.with("--scene soup:200 --size 24x18 --repeat 1 --structure "
                                         "bvh-binned --heatmap")
                                    .with(bench / "heat.png")
                                    .with(options));
        INFO(ended.err);
        REQUIRE(ended.code == 0);
        return read_file(bench / "heat.png");
    };
    const std::string one = bytes("--threads 1");
    CHECK(bytes("--threads 7") == one);
    CHECK(bytes("--heatmap-of tests") != one);
    CHECK(bytes("--heatmap-max 3") != one);
    CHECK(bytes("--heatmap-max 1000 --threads 1") == bytes("--heatmap-max 1000 --threads 2"));
}

TEST_CASE("each pixel of a heat map has its value's colour, and below stand the scale's numbers") {
    const std::vector<std::uint64_t> values{0, 1, 2, 3, 4, 90};
    const Image map = heat_map(values, 3, 2, {4, 1}, "a title", HeatOf::nodes);
    constexpr int side = 160;  // of a pixel's square: the picture is small
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x) {
            const double share = std::min(1.0, static_cast<double>(values[3 * y + x]) / 4.0);
            for (const int inside : {0, side - 1})
                CHECK(map.at(side * x + inside, side * y + inside) == heat(share));
        }
    CHECK(map.width() == 3 * side);
    REQUIRE(map.height() > 2 * side + 50);
    // Below the map there is ink, and every colour of the bar.
    std::set<float> greens;
    std::size_t black = 0;
    for (int y = 2 * side; y < map.height(); ++y)
        for (int x = 0; x < map.width(); ++x) {
            black += map.at(x, y) == glm::vec3(0.0f);
            greens.insert(map.at(x, y).g);
        }
    CHECK(black > 500);
    CHECK(greens.size() > 200);
    // Another scale has other numbers.
    CHECK(other_pixels(map, heat_map(values, 3, 2, {5, 1}, "a title", HeatOf::nodes)) > 100);
    CHECK(other_pixels(map, heat_map(values, 3, 2, {4, 1}, "other", HeatOf::nodes)) > 20);
    // Whatever the shape of the picture, the legend is there.
    for (const auto& [width, height] : {std::pair(1, 1), {1, 900}, {900, 1}, {481, 3}}) {
        const std::vector<std::uint64_t> ones(static_cast<std::size_t>(width * height), 1);
        const Image shaped = heat_map(ones, width, height, heat_scale_of(ones), "t", HeatOf::tests);
        CHECK(shaped.width() >= 480);
        CHECK(shaped.height() >= height + 64);
    }
}

TEST_CASE("a scale ends at a round number that 99 of 100 values do not exceed") {
    CHECK(heat_scale_of(std::vector<std::uint64_t>(100, 0)) == HeatScale{1, 1});
    CHECK(heat_scale_of(std::vector<std::uint64_t>(100, 6)) == HeatScale{6, 1});
    CHECK(heat_scale_of(std::vector<std::uint64_t>(100, 7)) == HeatScale{8, 2});
    CHECK(heat_scale_of(std::vector<std::uint64_t>(100, 61)) == HeatScale{80, 20});
    std::vector<std::uint64_t> few_large(1000, 20);
    for (std::size_t i = 0; i < 9; ++i) few_large[100 * i] = 1'000'000;
    CHECK(heat_scale_of(few_large) == HeatScale{20, 5});
    for (std::uint64_t end = 1; end < 3'000'000'000'000'000'000; end = end * 3 + 1) {
        const auto [kept, step] = heat_scale_to(end);
        CHECK(kept == end);
        CHECK(end / step <= 6);
        CHECK(end / step >= (end < 2 ? 1 : 2));
    }
}

TEST_CASE("text in a picture is legible where it lies inside, and cut where it does not") {
    Image image(60, 24);
    const auto ink = [&] {
        std::size_t count = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) count += image.at(x, y) != glm::vec3(0.0f);
        return count;
    };
    const auto drawn = [&](int x, int y, std::string_view text, int scale) {
        image = Image(60, 24);
        draw_text(image, x, y, text, scale, glm::vec3(1.0f));
        return ink();
    };
    CHECK(drawn(0, 0, "", 1) == 0);
    CHECK(drawn(0, 0, " ", 1) == 0);
    const std::size_t once = drawn(1, 1, "1", 1);
    CHECK(once > 5);
    CHECK(drawn(1, 1, "1", 2) == 4 * once);
    CHECK(drawn(-1000, 5, "12", 1) == 0);
    CHECK(drawn(5, 1000, "12", 1) == 0);
    CHECK(drawn(55, 20, "W", 3) > 0);
    CHECK(drawn(0, 0, "\xff\n\x01\x7f", 1) == 4 * drawn(0, 0, "?", 1));
    CHECK(text_width("10", 3) == 3 * text_width("10", 1));
    std::set<std::size_t> digits;
    for (char c = '0'; c <= '9'; ++c) {
        image = Image(60, 24);
        draw_text(image, 0, 0, std::string(1, c), 1, glm::vec3(1.0f));
        std::size_t code = 0;
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 6; ++x) code = code * 2 + (image.at(x, y) != glm::vec3(0.0f));
        digits.insert(code);
    }
    CHECK(digits.size() == 10);
}

TEST_CASE(
    "the picture has the same bytes through every exact structure, for any threads and query") {
    const Workbench bench;
    const auto bytes = [&](const Command& command) {
        const Ended ended = run(command.with("--picture", bench / "a.png").with("--repeat 1"));
        INFO(command.text() << ended.err);
        REQUIRE(ended.code == 0);
        return read_file(bench / "a.png");
    };
    const Command scene = lab.with("--scene soup:200 --size 32x24");
    const std::string picture = bytes(scene.with("--structure naive"));
    for (const Structure* structure : tried_structures()) {
        if (structure->name == "bvh-instanced-local") continue;  // its hits are not the mesh's
        CAPTURE(structure->name);
        CHECK(bytes(scene.with("--structure").with_word(std::string(structure->name))) == picture);
    }
    for (const char* options : {"--threads 1", "--threads 7", "--query any", "--packets"})
        CHECK(bytes(scene.with("--structure fast").with(options)) == picture);
    CHECK(bytes(scene.with("--structure naive --camera 2,2,2,0,0,0,40")) != picture);

    const Command instances = lab.with("--instances sphereflake:2 --size 32x24 --structure");
    CHECK(bytes(instances.with("bvh-instanced")) == bytes(instances.with("naive --flatten")));
}

TEST_CASE("the picture is what the structure sees: a triangle that it loses is not there") {
    const Workbench bench;
    TriangleMesh wall;
    for (std::uint32_t i = 0; i < 10; ++i) {
        const float x = static_cast<float>(i);
        wall.vertices.insert(wall.vertices.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}});
        wall.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    write_ply(bench / "wall.ply", wall);
    const auto bytes = [&](const char* structure) {
        const Ended ended = run(broken_lab.with("--mesh", bench / "wall.ply")
                                    .with("--picture", bench / "a.png")
                                    .with("--repeat 1 --structure")
                                    .with(structure));
        INFO(ended.err);
        REQUIRE(ended.code == 0);
        return read_file(bench / "a.png");
    };
    CHECK(bytes("naive") == bytes("naive"));
    CHECK(bytes("broken") != bytes("naive"));
}

TEST_CASE("no picture is written where the structure gives up, and the exit code is 1") {
    const Workbench bench;
    write_ply(bench / "mesh.ply",
              {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}});
    for (const char* option : {"--heatmap", "--picture"}) {
        const Ended ended = run(broken_lab.with("--mesh", bench / "mesh.ply")
                                    .with("--repeat 1 --structure no-memory")
                                    .with(option, bench / "a.png"));
        CHECK(ended.code == 1);
        CHECK(!std::filesystem::exists(bench / "a.png"));
    }
}

TEST_CASE(
    "the numbers of the CSV file are those of the JSON file, and the table's are these rounded") {
    const Workbench bench;
    write_ply(bench / "a, \"b\".ply",
              {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}});
    for (const char* options :
         {"", "--check", "--against naive --sort trace_ms", "--max-references 1"})
        for (const Command& what :
             {lab.with("--scene soup:200"), lab.with("--mesh", bench / "a, \"b\".ply")}) {
            const Ended ended = run(what.with("--size 16x12 --repeat 1")
                                        .with(options)
                                        .with("--json", bench / "json")
                                        .with("--csv", bench / "csv"));
            INFO(what.text() << ' ' << options << ended.err);
            REQUIRE(ended.code <= 1);
            const auto json = nlohmann::ordered_json::parse(read_file(bench / "json"));
            const auto rows = csv_rows(read_file(bench / "csv"));
            REQUIRE(rows.size() == json["structures"].size());
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const auto& structure = json["structures"][i];
                std::size_t fields = 3;
                CHECK(rows[i].at("mesh") == json["mesh"]["name"].get<std::string>());
                CHECK(rows[i].at("triangles") == json["mesh"]["triangles"].dump());
                CHECK(rows[i].at("query") == "closest");
                for (const auto& [name, value] : structure.items()) {
                    if (name == "check") continue;
                    CHECK(rows[i].at(name) == field_of(value));
                    ++fields;
                }
                if (structure["check"].is_object())
                    for (const auto& [name, value] : structure["check"].items()) {
                        CHECK(rows[i].at("check_" + name) == field_of(value));
                        ++fields;
                    }
                CHECK((rows[i].size() == fields || structure["check"].is_null()));
                if (structure["gave_up"].is_null())
                    CHECK(with_single_blanks(ended.out).find(
                              fmt::format("{} {:.3f} {:.3f} {:.4f} {} ",
                                          structure["structure"].get<std::string>(),
                                          structure["build_ms"].get<double>(),
                                          structure["trace_ms"].get<double>(),
                                          structure["rays_per_s"].get<double>() * 1e-6,
                                          with_commas(structure["hits"].get<std::uint64_t>()))) !=
                          std::string::npos);
            }
        }
    const Ended printed = run(lab.with("--scene soup:50 --size 4x3 --repeat 1 --csv -"));
    CHECK(csv_rows(printed.out).size() > 5);
    CHECK(printed.err.find("mesh    soup: ") != std::string::npos);
}

TEST_CASE("--sort orders table, CSV and JSON alike, and keeps the order of equal rows") {
    const Workbench bench;
    const Ended ended = run(lab.with("--scene soup:200 --size 16x12 --repeat 1 --sort "
                                     "triangle_tests --csv")
                                .with(bench / "csv")
                                .with("--json", bench / "json"));
    INFO(ended.err);
    REQUIRE(ended.code == 0);
    const auto json = nlohmann::json::parse(read_file(bench / "json"));
    std::size_t at = 0;
    std::uint64_t tests = 0;
    for (const auto& structure : json["structures"]) {
        const std::size_t next =
            ended.out.find("\n" + structure["structure"].get<std::string>() + " ");
        CHECK(next > at);
        at = next;
        CHECK(structure["triangle_tests"].get<std::uint64_t>() >= tests);
        tests = structure["triangle_tests"].get<std::uint64_t>();
    }
    CHECK(tests == 200 * 16 * 12);  // naive tracing comes last

    const auto named = [](std::string_view name) {
        Structure structure;
        structure.name = name;
        return structure;
    };
    const Structure a = named("a"), b = named("b"), c = named("c"), d = named("d"), e = named("e");
    std::vector<Measurement> rows;
    for (const Structure* structure : {&a, &b, &c, &d, &e})
        rows.push_back({.choice = {structure, nullptr}, .build_ms = 1.0, .trace_ms = 2.0});
    rows[1].gave_up = "tired";
    rows[3].build_ms = 0.5;
    rows[3].hits.resize(5);
    rows[4].shape.nodes = 7;
    const auto order = [&](const char* column) {
        std::vector<Measurement> sorted = rows;
        sort_rows(sorted, column);
        std::string names;
        for (const Measurement& m : sorted) names += m.name();
        return names;
    };
    CHECK(order("build_ms") == "daceb");
    CHECK(order("trace_ms") == "acdeb");
    CHECK(order("rays_per_s") == "daceb");  // the most first
    CHECK(order("nodes") == "eabcd");       // those without behind, as they were
    for (const std::string& column : sort_columns()) {
        CAPTURE(column);
        CHECK(order(column.c_str()).size() == 5);
        CHECK(json["structures"][0].contains(column));
    }
}
