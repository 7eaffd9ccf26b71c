#include "chapters/ch12_comparison/lab_report.hpp"

#include "common/program/report.hpp"
#include "common/program/results.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace space {
namespace {

constexpr int json_version = 3;  // of the layout of --json

using Json = nlohmann::ordered_json;

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

std::string or_dash(const std::optional<std::size_t>& value) {
    return value ? with_commas(*value) : "-";
}
std::string ratio_text(const std::optional<double>& value) {
    return value ? fmt::format("{:.3f}", *value) : "-";
}

bool any_gave_up(std::span<const Measurement> measurements) {
    return std::any_of(measurements.begin(), measurements.end(),
                       [](const Measurement& m) { return !m.stands(); });
}

/// In all, where the structure tells and has nodes.
std::optional<std::uint64_t> node_visits(const Measurement& m) {
    return m.counts && m.shape.nodes ? std::optional(m.counts->nodes_visited) : std::nullopt;
}
std::optional<std::uint64_t> triangle_tests(const Measurement& m) {
    return m.counts ? std::optional(m.counts->triangles_tested) : std::nullopt;
}

Table work_table(std::span<const Measurement> measurements, const Measurement* against) {
    std::vector<std::string> headings{"structure", "build ms",   "trace ms", "Mrays/s",
                                      "hits",      "visits/ray", "tests/ray"};
    if (against)
        for (const char* what : {"build / ", "trace / "})
            headings.push_back(what + std::string(against->name()));
    const std::size_t figures = headings.size();
    if (any_gave_up(measurements)) headings.push_back("gave up");
    Table table(headings);
    for (const Measurement& m : measurements) {
        std::vector<std::string> cells{std::string(m.name())};
        if (m.stands()) {
            const auto per_ray = [&](const std::optional<std::uint64_t>& total) {
                return total ? fmt::format("{:.2f}", static_cast<double>(*total) /
                                                         static_cast<double>(m.hits.size()))
                             : "-";
            };
            cells.insert(
                cells.end(),
                {fmt::format("{:.3f}", m.build_ms), fmt::format("{:.3f}", m.trace_ms),
                 fmt::format("{:.4f}", m.rays_per_second() * 1e-6), with_commas(m.hit_count()),
                 per_ray(node_visits(m)), per_ray(triangle_tests(m))});
            const auto [build, trace] = ratios(m, against);
            if (against) cells.insert(cells.end(), {ratio_text(build), ratio_text(trace)});
        }
        cells.resize(figures, "-");
        cells.push_back(m.gave_up);
        table.row(cells);
    }
    return table;
}

Table shape_table(std::span<const Measurement> measurements) {
    Table table({"structure", "nodes", "leaves", "depth", "references", "bytes", "SAH cost"});
    for (const Measurement& m : measurements) {
        if (!m.stands()) continue;
        table.row({std::string(m.name()), or_dash(m.shape.nodes), or_dash(m.shape.leaves),
                   or_dash(m.shape.depth), with_commas(m.shape.references),
                   with_commas(m.shape.bytes),
                   m.shape.sah_cost ? fmt::format("{:.2f}", *m.shape.sah_cost) : "-"});
    }
    return table;
}

/// A figure that rows can be ordered by, where smaller is better.
struct Column {
    std::string_view name;
    std::optional<double> (*cost)(const Measurement&);
};

template <class T>
std::optional<double> as_double(const std::optional<T>& value) {
    return value ? std::optional(static_cast<double>(*value)) : std::nullopt;
}
template <auto Field>
std::optional<double> of_shape(const Measurement& m) {
    return as_double(std::optional(m.shape.*Field));
}
template <auto Field>
std::optional<double> of_optional(const Measurement& m) {
    return as_double(m.shape.*Field);
}

constexpr std::array columns{
    Column{"build_ms", [](const Measurement& m) { return std::optional(m.build_ms); }},
    Column{"trace_ms", [](const Measurement& m) { return std::optional(m.trace_ms); }},
    Column{"rays_per_s", [](const Measurement& m) { return std::optional(-m.rays_per_second()); }},
    Column{"hits",
           [](const Measurement& m) { return std::optional(-static_cast<double>(m.hit_count())); }},
    Column{"node_visits", [](const Measurement& m) { return as_double(node_visits(m)); }},
    Column{"triangle_tests", [](const Measurement& m) { return as_double(triangle_tests(m)); }},
    Column{"nodes", of_optional<&TreeShape::nodes>},
    Column{"leaves", of_optional<&TreeShape::leaves>},
    Column{"depth", of_optional<&TreeShape::depth>},
    Column{"references", of_shape<&TreeShape::references>},
    Column{"bytes", of_shape<&TreeShape::bytes>},
    Column{"sah_cost", of_optional<&TreeShape::sah_cost>},
};

Json check_json(const Measurement& m, const Checked& checked) {
    const auto unless_peer = [&](std::size_t count) {
        return m.choice.structure->is_peer ? Json(nullptr) : Json(count);
    };
    return {{"rays", checked.rays},
            {"disagreements", unless_peer(checked.disagreements)},
            {"naive_wrong", unless_peer(checked.naive_wrong)},
            {"right", checked[Relation::right]},
            {"equal_t", checked[Relation::equal_t]},
            {"t_off", checked[Relation::t_off]},
            {"other_triangle", checked[Relation::other_triangle]},
            {"missed", checked[Relation::missed]},
            {"false_hits", checked[Relation::false_hit]}};
}

Json structure_json(const Measurement& m, const Measurement* against, const Checked* checked,
                    const LabOptions& options) {
    const auto [build_ratio, trace_ratio] = ratios(m, against);
    const auto measured = [&](const auto& value) { return m.stands() ? Json(value) : Json(); };
    return {{"structure", m.name()},
            {"home", m.choice.structure->home},
            {"triangle_test", m.choice.variant->triangle_test},
            {"configuration", m.configuration.empty() ? Json() : Json(m.configuration)},
            {"gave_up", m.stands() ? Json() : Json(m.gave_up)},
            {"build_ms", measured(m.build_ms)},
            {"trace_ms", measured(m.trace_ms)},
            {"rays_per_s", measured(m.rays_per_second())},
            {"build_ratio", or_null(build_ratio)},
            {"trace_ratio", or_null(trace_ratio)},
            {"rays", measured(m.hits.size())},
            {"hits", measured(m.hit_count())},
            {"nodes", or_null(m.shape.nodes)},
            {"leaves", or_null(m.shape.leaves)},
            {"depth", or_null(m.shape.depth)},
            {"references", measured(m.shape.references)},
            {"bytes", measured(m.shape.bytes)},
            {"sah_cost", or_null(m.shape.sah_cost)},
            {"node_visits", or_null(node_visits(m))},
            {"triangle_tests", or_null(triangle_tests(m))},
            {"threads", options.common.threads},
            {"build_threads", measured(m.build_threads)},
            {"check", checked && m.stands() ? check_json(m, *checked) : Json()}};
}

Json structures_json(const LabOptions& options, std::span<const Measurement> measurements,
                     const Measurement* against, std::span<const Checked> checked) {
    Json list = Json::array();
    for (std::size_t i = 0; i < measurements.size(); ++i)
        list.push_back(structure_json(measurements[i], against,
                                      checked.empty() ? nullptr : &checked[i], options));
    return list;
}

/// A file's name may not be UTF-8.
std::string text_of(const Json& value, int indent = -1) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// As RFC 4180 has it: quotes around what would end a field, and doubled inside.
std::string csv_field(const Json& value) {
    if (value.is_null()) return "";
    std::string text = value.is_string() ? value.get<std::string>() : text_of(value);
    if (text == "null") return "";  // a number that JSON has no name for
    if (text.find_first_of(",\"\r\n") == text.npos) return text;
    for (std::size_t at = 0; (at = text.find('"', at)) != text.npos; at += 2)
        text.insert(at, 1, '"');
    return '"' + text + '"';
}

}  // namespace

std::vector<std::string> sort_columns() {
    std::vector<std::string> names;
    for (const Column& column : columns) names.emplace_back(column.name);
    return names;
}

void sort_rows(std::vector<Measurement>& measurements, std::string_view name) {
    const auto column = std::ranges::find(columns, name, &Column::name);
    const auto place = [&](const Measurement& m) {
        const std::optional<double> cost = m.stands() ? column->cost(m) : std::nullopt;
        return std::pair(!cost, cost.value_or(0.0));
    };
    std::ranges::stable_sort(measurements, {}, place);
}

Ratios ratios(const Measurement& measurement, const Measurement* against) {
    if (!against || !against->stands() || !measurement.stands()) return {};
    return {measurement.build_ms / against->build_ms, measurement.trace_ms / against->trace_ms};
}

void print_measurements(std::span<const Measurement> measurements, const Measurement* against,
                        const LabOptions& options, std::FILE* out) {
    const auto of_the_book =
        std::find_if(measurements.begin(), measurements.end(),
                     [](const Measurement& m) { return !m.choice.structure->is_peer; });
    fmt::print(out, "query   {}{}; times: medians of {}, threads: {}\n\n",
               query_name(options.query),
               of_the_book == measurements.end()
                   ? ""
                   : fmt::format(" by {}", of_the_book->choice.variant->triangle_test),
               options.repeat, options.common.threads);
    fmt::print(out, "{}\n{}\n", work_table(measurements, against).text(),
               shape_table(measurements).text());
    if (any_gave_up(measurements))
        fmt::print(out, "limits  --max-references {} --max-placements {}\n\n",
                   options.build.limits.references, options.build.limits.placements);
}

void print_checked(std::span<const Measurement> measurements, std::span<const Checked> checked,
                   std::FILE* out) {
    Table table({"structure", "disagree", "naive wrong", "right", "equal t", "t off",
                 "other triangle", "missed", "false hits"});
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        const Measurement& m = measurements[i];
        const Checked& c = checked[i];
        if (!m.stands()) continue;
        const bool is_peer = m.choice.structure->is_peer;
        std::vector<std::string> cells{std::string(m.name()),
                                       is_peer ? "-" : with_commas(c.disagreements),
                                       is_peer ? "-" : with_commas(c.naive_wrong)};
        for (const std::size_t count : c.relations) cells.push_back(with_commas(count));
        table.row(cells);
    }
    fmt::print(out, "{}\n", table.text());
}

std::string json_text(const LabOptions& options, const MeshFacts& facts,
                      std::span<const Measurement> measurements, const Measurement* against,
                      std::span<const Checked> checked) {
    const Json mesh{{"name", facts.name},
                    {"file", facts.file.empty() ? Json(nullptr) : Json(facts.file)},
                    {"vertices", or_null(facts.vertices)},
                    {"triangles", facts.triangles},
                    {"degenerate", or_null(facts.degenerate)},
                    {"objects", or_null(facts.objects)},
                    {"instances", or_null(facts.instances)}};
    const Json limits{{"references", options.build.limits.references},
                      {"placements", options.build.limits.placements}};
    const Json document{{"version", json_version},
                        {"machine", machine_description()},
                        {"mesh", mesh},
                        {"query", query_name(options.query)},
                        {"against", against ? Json(against->name()) : Json()},
                        {"limits", limits},
                        {"structures", structures_json(options, measurements, against, checked)}};
    return text_of(document, 2) + '\n';
}

std::string csv_text(const LabOptions& options, const MeshFacts& facts,
                     std::span<const Measurement> measurements, const Measurement* against,
                     std::span<const Checked> checked) {
    std::string text;
    for (const Json& structure : structures_json(options, measurements, against, checked)) {
        std::vector<std::string> names, fields;
        const auto add = [&](const std::string& name, const Json& value) {
            names.push_back(name);
            fields.push_back(csv_field(value));
        };
        add("mesh", facts.name);
        add("triangles", facts.triangles);
        add("query", query_name(options.query));
        for (const auto& [name, value] : structure.items())
            if (name != "check") add(name, value);
        const Json checks = options.check ? check_json(measurements.front(), {}) : Json();
        for (const auto& [name, none] : checks.items())
            add("check_" + name, structure["check"].is_null() ? Json() : structure["check"][name]);
        if (text.empty()) text = fmt::format("{}\n", fmt::join(names, ","));
        text += fmt::format("{}\n", fmt::join(fields, ","));
    }
    return text;
}

}  // namespace space
