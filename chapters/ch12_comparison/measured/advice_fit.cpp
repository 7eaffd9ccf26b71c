#include "chapters/ch12_comparison/measured/advice_fit.hpp"

#include "chapters/ch12_comparison/machine_probe.hpp"
#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "chapters/ch12_comparison/measured/comparison.hpp"
#include "common/measure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>

namespace space::ch12 {
namespace {

constexpr std::uint64_t size_for_all = 100'000;  ///< up to which a candidate must stand
constexpr int most_power = 10;

using Scenes = std::vector<const KnownScene*>;
/// Costs of structures over a scene that it has not seen.
using Foretold = std::function<std::vector<Candidate>(const KnownScene&, double rays)>;

bool comes_from_file(const std::string& scene) {
    const ComparedScene& compared = compared_scene(scene);
    return compared.specs.size() == 1;
}

/// What it cost in hindsight; infinite for one that was not measured.
double cost_in_hindsight(const KnownScene& scene, std::string_view structure, double rays) {
    double least = std::numeric_limits<double>::infinity();
    for (const CostLine& line : scene.lines)
        if (line.name == structure) least = std::min(least, line.cost(rays));
    return least;
}

std::vector<AdviceCase> ask(const Foretold& foretold, const KnownScene& scene) {
    std::vector<AdviceCase> cases;
    for (int power = 0; power <= most_power; ++power) {
        AdviceCase c{scene.seen.scene,
                     scene.seen.spec,
                     scene.seen.triangles,
                     std::pow(10.0, power),
                     "",
                     "",
                     0.0,
                     0.0};
        const CostLine& best = scene.lines[cheapest(scene.lines, c.rays)];
        c.best = best.name;
        c.best_ns = best.cost(c.rays);
        for (const Candidate& candidate : foretold(scene, c.rays)) {
            c.advised = candidate.structure;
            c.advised_ns = cost_in_hindsight(scene, c.advised, c.rays);
            if (std::isfinite(c.advised_ns)) break;
        }
        if (std::isfinite(c.advised_ns) && c.advised_ns > 0.0) cases.push_back(c);
    }
    return cases;
}

Foretold by_model(AdviceModel model) {
    return [model = std::move(model)](const KnownScene& scene, double rays) {
        return advise(model, scene.features, {.rays = rays});
    };
}

std::set<std::string> candidates_of(std::span<const KnownScene* const> scenes) {
    std::map<std::string, std::size_t> stands;
    std::size_t small = 0;
    for (const KnownScene* scene : scenes) {
        if (scene->seen.triangles > size_for_all) continue;
        ++small;
        for (const auto& [structure, cost] : scene->costs) ++stands[structure];
    }
    std::set<std::string> names;
    for (const auto& [structure, count] : stands)
        if (count == small) names.insert(structure);
    return names;
}

/// The one structure whose total is nearest to the best, over all scenes and numbers of rays.
Foretold always_the_same(const Scenes& scenes) {
    std::string best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::string& name : candidates_of(scenes)) {
        double sum = 0.0;
        for (const KnownScene* scene : scenes)
            for (int power = 0; power <= most_power; ++power) {
                const double rays = std::pow(10.0, power);
                const double cost = cost_in_hindsight(*scene, name, rays);
                if (!std::isfinite(cost)) continue;
                sum += std::log2(cost / scene->lines[cheapest(scene->lines, rays)].cost(rays));
            }
        if (sum < least) least = sum, best = name;
    }
    return [best](const KnownScene&, double) {
        return std::vector<Candidate>{{best, {}, false, 0.0}};
    };
}

/// The mean of the logarithms of the three scenes that look most alike, near ones counting more.
Foretold by_neighbours(const Scenes& scenes) {
    const std::size_t columns = feature_names.size();
    std::vector<double> mean(columns), deviation(columns);
    const auto count = static_cast<double>(scenes.size());
    for (const KnownScene* scene : scenes)
        for (std::size_t j = 0; j < columns; ++j) mean[j] += scene->seen.features[j] / count;
    for (const KnownScene* scene : scenes)
        for (std::size_t j = 0; j < columns; ++j)
            deviation[j] += std::pow(scene->seen.features[j] - mean[j], 2) / count;
    const std::set<std::string> names = candidates_of(scenes);
    return [=](const KnownScene& asked, double rays) {
        std::vector<std::pair<double, const KnownScene*>> near;
        for (const KnownScene* scene : scenes) {
            double square = 1e-6;
            for (std::size_t j = 0; j < columns; ++j)
                if (deviation[j] > 0.0)
                    square += std::pow(scene->seen.features[j] - asked.seen.features[j], 2) /
                              deviation[j];
            near.emplace_back(square, scene);
        }
        std::ranges::sort(near, {}, &std::pair<double, const KnownScene*>::first);
        near.resize(std::min<std::size_t>(near.size(), 3));
        std::vector<Candidate> candidates;
        for (const std::string& name : names) {
            double weights = 0.0, build = 0.0, ray = 0.0;
            for (const auto& [square, scene] : near)
                for (const auto& [structure, cost] : scene->costs)
                    if (structure == name) {
                        weights += 1.0 / square;
                        build +=
                            std::log2(cost.build_ns / std::exp2(scene->features.count)) / square;
                        ray += std::log2(cost.ns_per_ray) / square;
                    }
            if (weights == 0.0) continue;
            Candidate candidate{name, {}, false, 0.0};
            candidate.cost.build_ns = std::exp2(build / weights + asked.features.count);
            candidate.cost.ns_per_ray = std::exp2(ray / weights);
            candidate.total_ns = candidate.cost.total_ns(rays);
            candidates.push_back(candidate);
        }
        std::ranges::stable_sort(candidates, {}, &Candidate::total_ns);
        return candidates;
    };
}

/// A way of foretelling, made from the scenes that it may know.
struct Way {
    std::string name, about;
    std::function<Foretold(const Scenes&)> make;
    std::optional<FitRule> rule = {};  ///< of a regression
};

Way regression(std::string name, std::string about, const FitRule& rule) {
    return {std::move(name), std::move(about),
            [=](const Scenes& scenes) { return by_model(fit_advice(scenes, rule)); }, rule};
}

std::vector<Way> ways() {
    constexpr std::size_t all = feature_names.size();
    return {{"one for all", "always the same structure", always_the_same},
            regression("count", "by the number of triangles alone", {1, 0.0}),
            regression("overlap, 1", "by that and the overlap, with a penalty of 1", {2, 1.0}),
            regression("overlap, 0.3", "of 0.3", {2, 0.3}),
            regression("overlap, 0.1", "of 0.1", {2, 0.1}),
            regression("features, 10", "by all features, with a penalty of 10", {all, 10.0}),
            regression("features, 3", "of 3", {all, 3.0}),
            regression("features, 1", "of 1", {all, 1.0}),
            regression("features, 0.3", "of 0.3", {all, 0.3}),
            regression("features, 0.1", "of 0.1", {all, 0.1}),
            {"neighbours", "by the three scenes that look most alike", by_neighbours}};
}

/// Each kind of scene is asked about by a model that knows only the others.
AdviceMethod cross_validated(const Way& way, const Scenes& scenes) {
    std::set<std::string> kinds;
    for (const KnownScene* scene : scenes) kinds.insert(scene->seen.scene);
    std::vector<AdviceCase> cases;
    for (const std::string& kind : kinds) {
        Scenes others;
        for (const KnownScene* scene : scenes)
            if (scene->seen.scene != kind) others.push_back(scene);
        const Foretold foretold = way.make(others);
        for (const KnownScene* scene : scenes)
            if (scene->seen.scene == kind) {
                const std::vector<AdviceCase> asked = ask(foretold, *scene);
                cases.insert(cases.end(), asked.begin(), asked.end());
            }
    }
    return summary_of_cases(way.name, way.about, cases);
}

}  // namespace

AdviceMethod summary_of_cases(std::string name, std::string about,
                              std::span<const AdviceCase> cases) {
    AdviceMethod method{std::move(name), std::move(about), cases.size(), 0, 0.0, 1.0};
    for (const AdviceCase& c : cases) {
        method.good += c.is_good();
        method.mean_ratio += std::log2(c.ratio()) / static_cast<double>(cases.size());
        method.worst_ratio = std::max(method.worst_ratio, c.ratio());
    }
    method.mean_ratio = std::exp2(method.mean_ratio);
    return method;
}

bool is_for_fitting(const std::string& scene, const std::string& spec) {
    if (comes_from_file(scene)) return false;
    const auto all = compared_scenes();
    const auto kind = std::ranges::find(all, scene, &ComparedScene::name);
    const auto size = std::ranges::find(kind->specs, spec);
    return ((kind - all.begin()) + (size - kind->specs.begin())) % 2 == 0;
}

std::vector<KnownScene> known_scenes(const Comparison& comparison, std::uint64_t seed) {
    std::vector<KnownScene> known;
    for (const std::span<const ComparedRow> block : blocks(comparison)) {
        KnownScene scene;
        std::vector<ComparedRow> rows;
        for (const ComparedRow& row : block)
            if (row.stands() && !row.is_peer && row.structure != "bvh-instanced" &&
                row.build_ms > 0.0 && row.mean_ns() > 0.0)
                rows.push_back(row);
        if (rows.empty()) continue;
        for (const ComparedRow& row : rows)
            scene.costs.emplace_back(
                row.structure,
                StructureCost{1e6 * row.ready_ms(), row.mean_ns(), static_cast<double>(row.bytes)});
        scene.lines = cost_lines(rows, false);
        const ComparedSubject subject = make_subject(rows[0].scene, rows[0].spec, seed);
        Stopwatch stopwatch;
        scene.features = features_of(subject.triangles);
        scene.look_ms = stopwatch.lap().count();
        const auto x = values(scene.features);
        scene.seen = {rows[0].scene,
                      rows[0].spec,
                      rows[0].triangles,
                      {x.begin(), x.end()},
                      comes_from_file(rows[0].scene),
                      is_for_fitting(rows[0].scene, rows[0].spec)};
        known.push_back(std::move(scene));
    }
    return known;
}

AdviceModel fit_advice(std::span<const KnownScene* const> scenes, const FitRule& rule) {
    AdviceModel model;
    std::vector<double> penalties(feature_names.size(), rule.penalty);
    penalties.front() = 0.0;
    for (std::size_t j = 0; j < feature_names.size(); ++j) {
        std::vector<double> values;
        for (const KnownScene* scene : scenes) values.push_back(scene->seen.features[j]);
        const auto [least, most] = std::ranges::minmax(values);
        const double sum = std::accumulate(values.begin(), values.end(), 0.0);
        model.seen[j] = {sum / static_cast<double>(values.size()), least, most};
    }
    for (const std::string& name : candidates_of(scenes)) {
        std::vector<std::vector<double>> x;
        std::vector<double> build, ray, bytes;
        for (const KnownScene* scene : scenes)
            for (const auto& [structure, cost] : scene->costs) {
                if (structure != name) continue;
                x.push_back(scene->seen.features);
                std::fill(x.back().begin() + static_cast<std::ptrdiff_t>(rule.features),
                          x.back().end(), 0.0);
                const double triangles = std::exp2(scene->features.count);
                build.push_back(std::log2(cost.build_ns / triangles));
                ray.push_back(std::log2(cost.ns_per_ray));
                bytes.push_back(std::log2(cost.bytes / triangles));
            }
        const auto fitted = [&](const std::vector<double>& y) {
            return smeared(fit_ridge(x, y, penalties), x, y);
        };
        model.structures.push_back({name, fitted(build), fitted(ray), fitted(bytes)});
    }
    return model;
}

std::vector<AdviceCase> ask(const AdviceModel& model, const KnownScene& scene) {
    return ask(by_model(model), scene);
}

JudgedAdvice judge_advice(const Comparison& comparison, std::uint64_t seed) {
    JudgedAdvice judged;
    const std::vector<KnownScene> known = known_scenes(comparison, seed);
    Scenes fitted;
    for (const KnownScene& scene : known) {
        judged.scenes.push_back(scene.seen);
        const double million = 1e-6 * static_cast<double>(scene.seen.triangles);
        if (million > 0.1) judged.look_ms = std::max(judged.look_ms, scene.look_ms / million);
        if (scene.seen.is_fitted) fitted.push_back(&scene);
    }
    if (fitted.size() < 8) return judged;
    const std::vector<Way> all = ways();
    for (const Way& way : all) judged.methods.push_back(cross_validated(way, fitted));
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].rule &&
            (!all[judged.chosen].rule ||
             judged.methods[i].mean_ratio < judged.methods[judged.chosen].mean_ratio))
            judged.chosen = i;
    const Way& chosen = all[judged.chosen];
    AdviceModel model = fit_advice(fitted, *chosen.rule);
    model.probe = probe_machine(1).times;
    model.machine = comparison.machine;
    model.date = comparison.date;
    judged.model_csv = advice_csv(model);
    for (const KnownScene& scene : known) {
        std::vector<AdviceCase>& cases = scene.seen.is_fitted    ? judged.fitted
                                         : scene.seen.is_fetched ? judged.fetched
                                                                 : judged.other_half;
        const std::vector<AdviceCase> asked = ask(model, scene);
        cases.insert(cases.end(), asked.begin(), asked.end());
    }
    return judged;
}

JudgedAdvice measure_advice(const Options& options) {
    return judge_advice(measured_once<measure_comparison>(options), options.seed);
}

}  // namespace space::ch12
