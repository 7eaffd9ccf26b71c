#include "chapters/ch12_comparison/lab_advice.hpp"

#include "chapters/ch12_comparison/machine_probe.hpp"
#include "common/measure.hpp"
#include "common/program/error.hpp"
#include "common/program/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace space {
namespace {

/// "1.2 ms", "350 s": three digits.
std::string time_text(double ns) {
    if (ns < 1e3) return fmt::format("{:.3g} ns", ns);
    if (ns < 1e6) return fmt::format("{:.3g} us", ns * 1e-3);
    if (ns < 1e9) return fmt::format("{:.3g} ms", ns * 1e-6);
    return fmt::format("{:.3g} s", ns * 1e-9);
}

std::string bytes_text(double bytes) {
    if (bytes < 1e3) return fmt::format("{:.0f} bytes", bytes);
    if (bytes < 1e6) return fmt::format("{:.3g} kB", bytes * 1e-3);
    return fmt::format("{:.3g} MB", bytes * 1e-6);
}

std::string rays_text(double rays) {
    return rays == 1.0 ? "1 ray" : fmt::format("{:.3g} rays", rays);
}

void print_features(const AdviceModel& model, const SceneFeatures& f, double ms, std::FILE* out) {
    const auto x = values(f);
    Table table({"feature", "here", "usual", "what it says"});
    const std::string what[] = {
        "log2 of the triangles that are finite",
        fmt::format("a random line meets {:.3g} boxes of triangles", std::exp2(f.overlap) - 1.0),
        fmt::format("the largest triangle is {:.3g} times as long as the median",
                    std::exp2(f.spread)),
        fmt::format("{:.0f} % of the triangles lie across an axis", 100.0 * f.alignment),
        fmt::format("{:.0f} % of a grid of as many cells is empty", 100.0 * f.emptiness),
        fmt::format("the median triangle is {:.3g} times as long as high",
                    std::exp2(f.slenderness))};
    for (std::size_t j = 0; j < x.size(); ++j)
        table.row({std::string(feature_names[j]), fixed(x[j], 2), fixed(model.seen[j].usual, 2),
                   what[j]});
    fmt::print(out, "seen in {}\n\n{}\n", time_text(1e6 * ms), table.text());
    for (std::size_t j = 0; j < x.size(); ++j)
        if (const FeatureRange& seen = model.seen[j]; x[j] < seen.least || x[j] > seen.most)
            fmt::print(out,
                       "beware  {} is {:.4g}, and the model knows {:.3g} to {:.3g}: what follows "
                       "may be far off\n",
                       feature_names[j], x[j], seen.least, seen.most);
}

Table candidates_table(std::span<const Candidate> candidates, const AdviceRequest& request) {
    Table table({"structure", request.moving ? "each frame" : "build", "rays/s", "MB",
                 rays_text(request.rays) + " in all", "beside the best"});
    for (const Candidate& c : candidates)
        table.row({c.structure,
                   fmt::format("{}{}", c.is_refitted ? "refit " : "", time_text(c.cost.build_ns)),
                   fmt::format("{:.3g}", 1e9 / c.cost.ns_per_ray),
                   fmt::format("{:.3g}", c.cost.bytes * 1e-6), time_text(c.total_ns),
                   fmt::format("{:.2f}", c.total_ns / candidates.front().total_ns)});
    return table;
}

/// From how many rays on another structure is the cheapest.
std::string other_numbers(const AdviceModel& model, const SceneFeatures& features,
                          AdviceRequest request, const Calibration& here) {
    std::string text, last;
    for (int power = 0; power <= 12; ++power) {
        request.rays = std::pow(10.0, power);
        const std::string best = advise(model, features, request, here).front().structure;
        if (best != last)
            text += fmt::format("{}from 10^{} {}", text.empty() ? "" : ", ", power, best);
        last = best;
    }
    return text;
}

}  // namespace

void print_advice(const std::string& mesh, std::span<const Triangle> triangles,
                  const AdviceRequest& request, unsigned threads, std::FILE* out) {
    const AdviceModel model = kept_advice();
    const MachineProbe probe = probe_machine(threads);
    const Calibration here{probe.times.build_per_triangle / model.probe.build_per_triangle,
                           probe.times.per_ray / model.probe.per_ray, probe.refit_ns_per_triangle};
    Stopwatch stopwatch;
    const SceneFeatures features = features_of(triangles);
    const double seen_ms = stopwatch.lap().count();

    std::vector<Candidate> candidates = advise(model, features, request, here);
    if (candidates.empty()) {
        const auto least = std::ranges::min(
            model.structures, {}, [&](const StructureModel& s) { return s.cost(features).bytes; });
        throw usage_error(fmt::format("--memory {:.6g}: the smallest structure, {}, needs {}",
                                      *request.memory * 1e-6, least.structure,
                                      bytes_text(least.cost(features).bytes)));
    }
    const Candidate& first = candidates.front();
    fmt::print(out, "mesh    {}: {}, ", mesh, counted(triangles.size(), "triangle"));
    print_features(model, features, seen_ms, out);
    fmt::print(out,
               "machine builds take {:.2f} times, rays {:.2f} times as long as on the machine "
               "of the model ({}, {})\n\n",
               here.build, here.ray, model.machine, model.date);
    fmt::print(out, "advice  {}{}: {} {}, {:.3g} rays/s, {}; {} for {}{}\n", first.structure,
               first.is_refitted ? ", refitted" : "", time_text(first.cost.build_ns),
               request.moving ? "each frame" : "to build", 1e9 / first.cost.ns_per_ray,
               bytes_text(first.cost.bytes), time_text(first.total_ns), rays_text(request.rays),
               request.moving ? " a frame" : "");
    fmt::print(out, "why     {}\n", reason(model, features, candidates));
    if (request.moving)
        fmt::print(out,
                   "moving  the triangles are the same in each frame and move a little: a tree "
                   "that is refitted is taken to be as quick as a new one\n");
    fmt::print(out, "else    {}\n\n", other_numbers(model, features, request, here));
    candidates.resize(std::min<std::size_t>(candidates.size(), 4));
    fmt::print(out, "{}", candidates_table(candidates, request).text());
}

}  // namespace space
