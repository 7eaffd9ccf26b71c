// The model is fitted to scenes whose costs are made up, and so finds what made them.
#include "chapters/ch12_comparison/measured/advice_fit.hpp"
#include "chapters/ch12_comparison/measured/compared_scenes.hpp"
#include "common/pcg32.hpp"
#include "common/scene.hpp"
#include "tests/catch.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

using namespace space;
using namespace space::ch12;

namespace {

/// Scenes on which "slow" and "quick" cost what linear models say.
std::vector<KnownScene> made_up_scenes(std::size_t count) {
    const StructureModel quick{
        "quick", {5, {0.1, 0, 0, 0, 0, 0}}, {7, {0.3, 0.5, 0, 0, 0, 0}}, {6, {0, 0, 0, 0, 0, 0}}};
    const StructureModel slow{"slow",
                              {9, {0.2, 0, 0, 0, 0, 0.1}},
                              {6, {0.1, 0.2, 0, 0, 1, 0}},
                              {7, {0, 0.5, 0, 0, 0, 0}}};
    Pcg32 random(9);
    std::vector<KnownScene> scenes(count);
    for (KnownScene& scene : scenes) {
        SceneFeatures& f = scene.features;
        for (double* feature :
             {&f.count, &f.overlap, &f.spread, &f.alignment, &f.emptiness, &f.slenderness})
            *feature = random.uniform_double();
        f.count = 9.0 + 7.0 * f.count;
        f.overlap *= 5.0;
        const auto x = values(f);
        scene.seen = {"soup",
                      "soup:1000",
                      static_cast<std::uint64_t>(std::exp2(f.count)),
                      {x.begin(), x.end()},
                      false,
                      true};
        for (const StructureModel& model : {quick, slow}) {
            const StructureCost cost = model.cost(f);
            scene.costs.emplace_back(model.structure, cost);
            scene.lines.push_back({model.structure, cost.build_ns, cost.ns_per_ray});
        }
    }
    return scenes;
}

std::vector<const KnownScene*> pointers(const std::vector<KnownScene>& scenes) {
    std::vector<const KnownScene*> all;
    for (const KnownScene& scene : scenes) all.push_back(&scene);
    return all;
}

}  // namespace

TEST_CASE("a model without a penalty finds what made the costs, and is right about new scenes") {
    const std::vector<KnownScene> scenes = made_up_scenes(60);
    const std::vector<const KnownScene*> all = pointers(scenes);
    const AdviceModel model = fit_advice(std::span(all).first(30), {});
    REQUIRE(model.structures.size() == 2);
    CHECK(model.structures[0].structure == "quick");
    CHECK(model.structures[0].ray.weights[1] == Approx(0.5));
    CHECK(model.structures[1].build.weights[5] == Approx(0.1));
    CHECK(model.structures[1].bytes.intercept == Approx(7.0));
    for (std::size_t i = 30; i < 60; ++i) {
        CAPTURE(i);
        for (std::size_t k = 0; k < 2; ++k) {
            const StructureCost is = model.structures[k].cost(scenes[i].features),
                                was = scenes[i].costs[k].second;
            REQUIRE(is.build_ns == Approx(was.build_ns));
            REQUIRE(is.ns_per_ray == Approx(was.ns_per_ray));
            REQUIRE(is.bytes == Approx(was.bytes));
        }
        for (const AdviceCase& c : ask(model, scenes[i])) {
            CAPTURE(c.rays);
            REQUIRE(c.ratio() == Approx(1.0));
        }
    }
}

TEST_CASE("a model of one feature knows the number of triangles alone") {
    const std::vector<KnownScene> scenes = made_up_scenes(30);
    const AdviceModel model = fit_advice(pointers(scenes), {.features = 1});
    for (const StructureModel& structure : model.structures)
        for (std::size_t j = 1; j < feature_names.size(); ++j)
            CHECK(structure.ray.weights[j] == 0.0);
    CHECK(model.structures[0].build.weights[0] == Approx(0.1));
}

TEST_CASE("growth with the number of triangles has no penalty") {
    const std::vector<KnownScene> scenes = made_up_scenes(30);
    const AdviceModel model = fit_advice(pointers(scenes), {.features = 1, .penalty = 100.0});
    CHECK(model.structures[0].build.weights[0] == Approx(0.1));
}

TEST_CASE("costs that the features do not tell apart are foretold by their mean") {
    std::vector<KnownScene> scenes = made_up_scenes(2);
    scenes[1].seen = scenes[0].seen;
    scenes[1].features = scenes[0].features;
    for (std::size_t i = 0; i < 2; ++i)
        for (auto& [structure, cost] : scenes[i].costs) cost.ns_per_ray = i == 0 ? 100.0 : 900.0;
    const AdviceModel model = fit_advice(pointers(scenes), {});
    CHECK(model.structures[0].cost(scenes[0].features).ns_per_ray == Approx(500.0));
    CHECK(model.seen[0].least == scenes[0].features.count);
    CHECK(model.seen[0].most == scenes[0].features.count);
}

TEST_CASE("a structure that fell on a small scene is no candidate, on a large one it may") {
    std::vector<KnownScene> scenes = made_up_scenes(20);
    scenes[3].seen.triangles = 500'000;
    std::erase_if(scenes[3].costs, [](const auto& cost) { return cost.first == "slow"; });
    CHECK(fit_advice(pointers(scenes), {.penalty = 1.0}).structures.size() == 2);
    scenes[3].seen.triangles = 100'000;
    const AdviceModel model = fit_advice(pointers(scenes), {.penalty = 1.0});
    REQUIRE(model.structures.size() == 1);
    CHECK(model.structures[0].structure == "quick");
}

TEST_CASE("what was not measured on a scene is passed over when it is judged") {
    std::vector<KnownScene> scenes = made_up_scenes(20);
    const AdviceModel model = fit_advice(pointers(scenes), {});
    std::erase_if(scenes[0].lines, [](const CostLine& line) { return line.name == "slow"; });
    const std::vector<AdviceCase> cases = ask(model, scenes[0]);
    CHECK(cases.size() == 11);
    for (const AdviceCase& c : cases) CHECK(c.advised == "quick");
}

TEST_CASE("of a structure with several lines the lowest that reaches so far counts") {
    std::vector<KnownScene> scenes = made_up_scenes(20);
    const AdviceModel model = fit_advice(pointers(scenes), {});
    CostLine half = scenes[0].lines.front();
    REQUIRE(half.name == "quick");
    half.fixed_ns *= 0.5;
    half.most_rays = 100.0;
    scenes[0].lines.insert(scenes[0].lines.begin(), half);
    const std::vector<AdviceCase> cases = ask(model, scenes[0]);
    REQUIRE(cases.size() == 11);
    CHECK(cases[1].advised == "quick");
    CHECK(cases[1].advised_ns == half.cost(10.0));
    CHECK(cases[3].advised_ns >= cases[3].best_ns);
    CHECK(std::isfinite(cases[10].advised_ns));
}

TEST_CASE("both halves have every kind that has two sizes, and neither has a file") {
    for (const ComparedScene& scene : compared_scenes()) {
        CAPTURE(scene.name);
        const auto fitted = std::ranges::count_if(scene.specs, [&](const std::string& spec) {
            return is_for_fitting(std::string(scene.name), spec);
        });
        const auto all = static_cast<std::ptrdiff_t>(scene.specs.size());
        if (all == 1)
            CHECK(fitted == 0);
        else
            CHECK((fitted == all / 2 || fitted == all - all / 2));
    }
}

namespace {

bool has_bunny() {
    return std::filesystem::exists(scene_file("bunny"));
}

/// The made scenes in their smallest size, and one of a file where it is there. On them chance
/// decides which of two structures is ten times as quick; a peer and bvh-instanced are quicker than
/// both.
Comparison decided_by_chance() {
    Comparison comparison;
    Pcg32 random(4);
    for (const ComparedScene& scene : compared_scenes()) {
        if (scene.specs.size() < 2 && !(scene.name == "bunny" && has_bunny())) continue;
        const bool is_one = random.uniform_double() < 0.5;
        for (const char* name : {"one", "other", "bvh-instanced", "embree"}) {
            ComparedRow row{.scene = std::string(scene.name),
                            .spec = scene.specs.front(),
                            .triangles = 1000,
                            .structure = name,
                            .is_peer = name == std::string("embree"),
                            .build_ms = 1.0,
                            .bytes = 1000};
            const bool is_quick = is_one == (row.structure == "one");
            const bool is_ours = row.structure == "one" || row.structure == "other";
            for (TracedKind& kind : row.traced) {
                kind.rays = 1;
                kind.ns_per_ray = is_ours ? (is_quick ? 100.0 : 1000.0) : 1.0;
            }
            if (row.structure == "other") row.made_later = {{1.0, 2.0}, {4.0, 3.0}};
            comparison.rows.push_back(row);
        }
    }
    return comparison;
}

}  // namespace

TEST_CASE("the advice is judged by scenes that it has not seen, and by our structures alone") {
    const JudgedAdvice judged = judge_advice(decided_by_chance(), 1);
    const auto seen = [&](const std::string& spec) {
        return std::ranges::find(judged.scenes, spec, &SeenScene::spec)->is_fitted;
    };
    REQUIRE(judged.fitted.size() == 8 * 11);
    REQUIRE(judged.other_half.size() == 7 * 11);
    CHECK(judged.fetched.size() == (has_bunny() ? 11u : 0u));
    for (const AdviceCase& c : judged.fetched) CHECK(c.spec == "bunny");
    for (const AdviceCase& c : judged.fitted) CHECK(seen(c.spec));
    for (const auto* cases : {&judged.fitted, &judged.other_half})
        for (const AdviceCase& c : *cases) {
            CHECK((c.best == "one" || c.best == "other"));
            CHECK((c.advised == "one" || c.advised == "other"));
        }
    for (const AdviceCase& c : judged.other_half) CHECK_FALSE(seen(c.spec));
    const AdviceModel model = read_advice(judged.model_csv);
    REQUIRE(model.structures.size() == 2);
    CHECK(model.structures[0].structure == "one");
    SceneFeatures any;
    any.count = 10.0;
    CHECK(model.structures[0].cost(any).build_ns == Approx(1e6).epsilon(1e-3));
    CHECK(model.structures[1].cost(any).build_ns ==
          Approx(4e6).epsilon(1e-3));  // until it is ready
}

TEST_CASE("a way that knows each scene by heart is no good on kinds that it has not seen") {
    const JudgedAdvice judged = judge_advice(decided_by_chance(), 1);
    const auto neighbours = std::ranges::find(judged.methods, "neighbours", &AdviceMethod::name);
    REQUIRE(neighbours != judged.methods.end());
    CHECK(neighbours->cases == 8 * 11);
    CHECK(neighbours->share() < 0.9);  // chance is not foretold
    CHECK(neighbours->worst_ratio > 5.0);
    // The way that is kept is a regression, and none of those has a smaller mean.
    const AdviceMethod& chosen = judged.methods[judged.chosen];
    CHECK(chosen.name != "one for all");
    CHECK(chosen.name != "neighbours");
    for (const AdviceMethod& method : judged.methods)
        if (method.name != "one for all" && method.name != "neighbours")
            CHECK(chosen.mean_ratio <= method.mean_ratio);
}

TEST_CASE("a summary counts what is good, and its mean is that of the logarithms") {
    std::vector<AdviceCase> cases(2);
    cases[0].advised_ns = cases[0].best_ns = 5.0;
    cases[1].advised_ns = 20.0;
    cases[1].best_ns = 5.0;
    const AdviceMethod summary = summary_of_cases("", "", cases);
    CHECK(summary.cases == 2);
    CHECK(summary.good == 1);
    CHECK(summary.mean_ratio == 2.0);
    CHECK(summary.worst_ratio == 4.0);
    CHECK(judge_advice({}, 1).model_csv.empty());
}
