#include "chapters/ch12_comparison/advice.hpp"

#include "chapters/ch12_comparison/comma_parts.hpp"
#include "chapters/ch12_comparison/kept_advice.hpp"  // in the build directory
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

namespace space {
namespace {

/// What a line of the file holds: whose, what, and numbers.
struct ModelLine {
    std::string_view whose, what;
    std::vector<double> numbers;
};

ModelLine parse_line(std::string_view line) {
    const std::vector<std::string_view> fields = comma_parts(line);
    const auto fault = [&] { return input_error(fmt::format("model of advice: '{}'", line)); };
    if (fields.size() < 3) throw fault();
    ModelLine parsed{fields[0], fields[1], {}};
    for (std::size_t i = 2; i < fields.size(); ++i) {
        double number = 0.0;
        const char* const last = fields[i].data() + fields[i].size();
        const auto [end, error] = std::from_chars(fields[i].data(), last, number);
        if (error != std::errc{} || end != last || !std::isfinite(number)) throw fault();
        parsed.numbers.push_back(number);
    }
    const bool is_probe = parsed.whose == "probe";
    if (parsed.numbers.size() != (is_probe ? 1 : 1 + feature_names.size())) throw fault();
    return parsed;
}

void take(AdviceModel& model, const ModelLine& line) {
    if (line.whose == "probe") {
        (line.what == "build" ? model.probe.build_per_triangle : model.probe.per_ray) =
            line.numbers.front();
        return;
    }
    if (line.whose == "features") {
        const auto part = line.what == "least"  ? &FeatureRange::least
                          : line.what == "most" ? &FeatureRange::most
                                                : &FeatureRange::usual;
        for (std::size_t j = 0; j < model.seen.size(); ++j)
            model.seen[j].*part = line.numbers[j + 1];
        return;
    }
    if (model.structures.empty() || model.structures.back().structure != line.whose)
        model.structures.push_back({std::string(line.whose), {}, {}, {}});
    StructureModel& structure = model.structures.back();
    LinearModel& part = line.what == "build" ? structure.build
                        : line.what == "ray" ? structure.ray
                                             : structure.bytes;
    part = {line.numbers.front(), {line.numbers.begin() + 1, line.numbers.end()}};
}

std::string line_of(std::string_view whose, std::string_view what, const LinearModel& part) {
    std::string line = fmt::format("{},{},{:.9g}", whose, what, part.intercept);
    for (const double weight : part.weights) line += fmt::format(",{:.9g}", weight);
    return line + '\n';
}

const StructureModel& model_of(const AdviceModel& model, std::string_view structure) {
    return *std::ranges::find(model.structures, structure, &StructureModel::structure);
}

/// What an unusual value of a feature looks like.
std::string seen(std::size_t feature, double value) {
    const double power = std::exp2(value);
    switch (feature) {
        case 0:
            return fmt::format("{:.3g} triangle{}", power, power == 1.0 ? "" : "s");
        case 1:
            return fmt::format("a random line meets {:.3g} box{}", power - 1.0,
                               power == 2.0 ? "" : "es");
        case 2:
            return fmt::format("the largest triangle is {:.3g} times the median", power);
        case 3:
            return fmt::format("{:.0f} % of the triangles lie across an axis", 100.0 * value);
        case 4:
            return fmt::format("{:.0f} % of the grid is empty", 100.0 * value);
        default:
            return fmt::format("triangles are {:.3g} times as long as high", power);
    }
}

/// A factor from 1 on, with three digits.
std::string times_text(double ratio) {
    return ratio < 100.0 ? fmt::format("{:.2f}", ratio) : fmt::format("{:.3g}", ratio);
}

/// The feature that did most for the first candidate, and by how much.
struct DecidingFeature {
    std::size_t feature;
    double octaves;
    bool is_of_build;
};

/// In the term that decided: that in which the first is ahead, and where it is so in both the one
/// with the larger difference. Nothing where that is a refit, or where no feature did much.
std::optional<DecidingFeature> deciding_feature(const AdviceModel& model,
                                                const SceneFeatures& features,
                                                const Candidate& first, const Candidate& second) {
    const double ahead_in_build = second.cost.build_ns - first.cost.build_ns;
    const double ahead_in_rays = (second.total_ns - first.total_ns) - ahead_in_build;
    const bool by_build = ahead_in_build > ahead_in_rays;
    if (by_build && (first.is_refitted || second.is_refitted)) return std::nullopt;
    const StructureModel &a = model_of(model, first.structure),
                         &b = model_of(model, second.structure);
    const LinearModel &of_a = by_build ? a.build : a.ray, &of_b = by_build ? b.build : b.ray;
    const auto x = values(features);
    DecidingFeature most{0, 0.0, by_build};
    for (std::size_t j = 0; j < x.size(); ++j) {
        const double gain = (of_b.weights[j] - of_a.weights[j]) * (x[j] - model.seen[j].usual);
        if (gain > most.octaves) most = {j, gain, by_build};
    }
    constexpr double worth_telling = 0.05;  // 4 %
    if (most.octaves > worth_telling) return most;
    return std::nullopt;
}

}  // namespace

StructureCost StructureModel::cost(const SceneFeatures& features) const {
    const auto x = values(features);
    const double triangles = std::exp2(features.count);
    return {.build_ns = std::exp2(build(x)) * triangles,
            .ns_per_ray = std::exp2(ray(x)),
            .bytes = std::exp2(bytes(x)) * triangles};
}

bool can_be_refitted(std::string_view structure) {
    constexpr std::string_view trees[] = {"bvh-binned",    "bvh-sweep",  "bvh-optimised",
                                          "bvh-bottom-up", "bvh-morton", "bvh-middle",
                                          "bvh-median"};
    return std::ranges::find(trees, structure) != std::end(trees);
}

// [advise]
std::vector<Candidate> advise(const AdviceModel& model, const SceneFeatures& features,
                              const AdviceRequest& request, const Calibration& here) {
    const double refit_ns = here.refit_ns_per_triangle * std::exp2(features.count);
    std::vector<Candidate> candidates;
    for (const StructureModel& structure : model.structures) {
        Candidate candidate{structure.structure, structure.cost(features)};
        StructureCost& cost = candidate.cost;
        if (request.memory && cost.bytes > *request.memory) continue;
        cost.build_ns *= here.build;
        cost.ns_per_ray *= here.ray;
        candidate.is_refitted =
            request.moving && can_be_refitted(structure.structure) && refit_ns < cost.build_ns;
        if (candidate.is_refitted) cost.build_ns = refit_ns;
        candidate.total_ns = cost.total_ns(request.rays);
        candidates.push_back(std::move(candidate));
    }
    std::ranges::stable_sort(candidates, {}, &Candidate::total_ns);
    return candidates;
}
// [advise]

double break_even_rays(const StructureCost& a, const StructureCost& b) {
    const double saved_ns = a.ns_per_ray - b.ns_per_ray, dearer_ns = b.build_ns - a.build_ns;
    const double rays = dearer_ns / saved_ns;
    return rays > 0.0 ? rays : std::numeric_limits<double>::infinity();
}

std::string reason(const AdviceModel& model, const SceneFeatures& features,
                   std::span<const Candidate> candidates) {
    const Candidate& first = candidates[0];
    if (candidates.size() == 1) return "No other structure fits in the memory.";
    const Candidate& second = candidates[1];
    const double build = second.cost.build_ns / first.cost.build_ns;
    const double ray = second.cost.ns_per_ray / first.cost.ns_per_ray;
    const double rays = break_even_rays(first.cost, second.cost);
    const auto factor = [](double ratio) {
        return ratio >= 1.0 ? fmt::format("{} times as long", times_text(ratio))
                            : fmt::format("{:.2f} of the time", ratio);
    };
    std::string text = fmt::format("{} takes {} to build, and its rays take {}", second.structure,
                                   factor(build), factor(ray));
    if (std::isfinite(rays))
        text += fmt::format(": it pays {} {:.2g} rays.", ray < 1.0 ? "from" : "up to", rays);
    else
        text += ": it never pays.";
    const auto told = deciding_feature(model, features, first, second);
    if (!told) return text;
    const double usual = model.seen[told->feature].usual;
    return text + fmt::format(
                      " What speaks most for {}: {} (usually: {}), by which {} takes {} "
                      "times as long for its {}.",
                      first.structure, seen(told->feature, values(features)[told->feature]),
                      seen(told->feature, usual), second.structure,
                      times_text(std::exp2(told->octaves)), told->is_of_build ? "build" : "rays");
}

AdviceModel read_advice(std::string_view csv) {
    AdviceModel model;
    while (!csv.empty()) {
        const std::size_t end = std::min(csv.find('\n'), csv.size());
        const std::string_view line = csv.substr(0, end);
        csv.remove_prefix(std::min(end + 1, csv.size()));
        constexpr std::string_view machine = "# machine: ", date = "# date: ";
        if (line.starts_with(machine))
            model.machine = line.substr(machine.size());
        else if (line.starts_with(date))
            model.date = line.substr(date.size());
        else if (!line.empty() && !line.starts_with('#') && !line.starts_with("structure,"))
            take(model, parse_line(line));
    }
    if (model.structures.empty()) throw input_error("model of advice: it knows no structure");
    const std::size_t columns = feature_names.size();
    for (const StructureModel& structure : model.structures)
        for (const LinearModel* part : {&structure.build, &structure.ray, &structure.bytes})
            if (part->weights.size() != columns)
                throw input_error(
                    fmt::format("model of advice: a line of {} is missing", structure.structure));
    return model;
}

std::string advice_csv(const AdviceModel& model) {
    std::string csv = fmt::format(
        "# log2 of nanoseconds a triangle (build) and a ray, of bytes a triangle\n"
        "# machine: {}\n# date: {}\nstructure,figure,intercept",
        model.machine, model.date);
    for (const std::string_view name : feature_names) csv += fmt::format(",{}", name);
    csv += fmt::format("\nprobe,build,{:.9g}\nprobe,ray,{:.9g}\n", model.probe.build_per_triangle,
                       model.probe.per_ray);
    for (const auto& [name, part] : {std::pair("usual", &FeatureRange::usual),
                                     {"least", &FeatureRange::least},
                                     {"most", &FeatureRange::most}}) {
        LinearModel line;
        for (const FeatureRange& range : model.seen) line.weights.push_back(range.*part);
        csv += line_of("features", name, line);
    }
    for (const StructureModel& structure : model.structures) {
        csv += line_of(structure.structure, "build", structure.build);
        csv += line_of(structure.structure, "ray", structure.ray);
        csv += line_of(structure.structure, "bytes", structure.bytes);
    }
    return csv;
}

AdviceModel kept_advice() {
    if (kept_advice_csv.empty())
        throw input_error(
            "--advise: this lab was compiled without figures/measured/ch12_advice.csv, "
            "which ./book run 12 --update makes");
    return read_advice(kept_advice_csv);
}

}  // namespace space
