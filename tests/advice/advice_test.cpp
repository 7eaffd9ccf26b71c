// Which structure is advised, by models that are made up, by the model that is kept, and by the
// lab as its user sees it.
#include "chapters/ch12_comparison/advice.hpp"

#include "chapters/ch12_comparison/structures.hpp"
#include "common/mesh.hpp"
#include "common/pcg32.hpp"
#include "common/program/error.hpp"
#include "tests/catch.hpp"
#include "tests/lab/process.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace space;

namespace {

const Command lab{.words = {LAB_PROGRAM, "lab"}};

LinearModel constant(double log2) {
    return {log2, std::vector<double>(feature_names.size())};
}

/// Builds in 2^build ns a triangle, traces in 2^ray ns a ray, takes 2^bytes bytes a triangle.
StructureModel made_up(const std::string& name, double build, double ray, double bytes) {
    return {name, constant(build), constant(ray), constant(bytes)};
}

AdviceModel random_model(Pcg32& random) {
    AdviceModel model;
    const std::uint32_t count = 1 + random.below(8);
    for (std::uint32_t i = 0; i < count; ++i) {
        StructureModel structure = made_up("structure " + std::to_string(i), 0, 0, 0);
        for (LinearModel* part : {&structure.build, &structure.ray, &structure.bytes}) {
            part->intercept = 12.0 * random.uniform_double();
            for (double& weight : part->weights) weight = random.uniform_double() - 0.5;
        }
        model.structures.push_back(structure);
    }
    return model;
}

SceneFeatures random_features(Pcg32& random) {
    SceneFeatures f;
    f.count = 21.0 * random.uniform_double();
    f.overlap = 9.0 * random.uniform_double();
    f.emptiness = random.uniform_double();
    return f;
}

/// Three that take turns in being the best, over 2^10 triangles.
AdviceModel three() {
    return {{made_up("none", 0, 14, 0), made_up("quick", 6, 10, 7), made_up("careful", 10, 8, 6)}};
}
const SceneFeatures thousand{.count = 10.0};

}  // namespace

TEST_CASE("a cost is what its logarithms say") {
    StructureModel model = made_up("m", 3, 5, 6);
    model.ray.weights[1] = 0.5;
    const StructureCost cost = model.cost({.count = 10.0, .overlap = 4.0});
    CHECK(cost.build_ns == 8.0 * 1024.0);
    CHECK(cost.ns_per_ray == 128.0);
    CHECK(cost.bytes == 64.0 * 1024.0);
    CHECK(cost.total_ns(10.0) == 8.0 * 1024.0 + 1280.0);
}

TEST_CASE("the advice has the least total of all that fit") {
    Pcg32 random(1);
    for (int i = 0; i < 300; ++i) {
        const AdviceModel model = random_model(random);
        const SceneFeatures features = random_features(random);
        AdviceRequest request{.rays = std::exp2(40.0 * random.uniform_double())};
        if (i % 2) request.memory = std::exp2(28.0 * random.uniform_double());
        const std::vector<Candidate> candidates = advise(model, features, request);
        std::size_t fit = 0;
        for (const StructureModel& structure : model.structures) {
            const StructureCost cost = structure.cost(features);
            if (request.memory && cost.bytes > *request.memory) continue;
            ++fit;
            REQUIRE(candidates.front().total_ns <= cost.total_ns(request.rays));
        }
        REQUIRE(candidates.size() == fit);
        for (const Candidate& candidate : candidates)
            REQUIRE((!request.memory || candidate.cost.bytes <= *request.memory));
        REQUIRE(std::ranges::is_sorted(candidates, {}, &Candidate::total_ns));
    }
}

TEST_CASE("for more rays nothing is advised that is quicker to build") {
    Pcg32 random(2);
    for (int i = 0; i < 200; ++i) {
        const AdviceModel model = random_model(random);
        const SceneFeatures features = random_features(random);
        StructureCost last{.build_ns = 0.0, .ns_per_ray = infinity};
        for (int power = 0; power <= 44; ++power) {
            const StructureCost cost =
                advise(model, features, {.rays = std::ldexp(1.0, power)}).front().cost;
            REQUIRE(cost.build_ns >= last.build_ns);
            REQUIRE(cost.ns_per_ray <= last.ns_per_ray);
            last = cost;
        }
    }
}

TEST_CASE("each of three has its turn, and the break-even is where the next begins") {
    const auto best = [](double rays) {
        return advise(three(), thousand, {.rays = rays}).front().structure;
    };
    CHECK(best(1) == "none");
    CHECK(best(100) == "quick");
    CHECK(best(1e7) == "careful");
    const StructureCost quick = three().structures[1].cost(thousand),
                        careful = three().structures[2].cost(thousand);
    const double rays = break_even_rays(quick, careful);  // (2^20 - 2^16) / (2^10 - 2^8)
    CHECK(rays == 1280.0);
    CHECK(break_even_rays(careful, quick) == 1280.0);
    CHECK(best(rays * 0.999) == "quick");
    CHECK(best(rays * 1.001) == "careful");
    // Dearer in both: never.
    CHECK(break_even_rays({1, 1, 0}, {2, 2, 0}) == infinity);
    CHECK(break_even_rays({1, 1, 0}, {2, 1, 0}) == infinity);
    CHECK(break_even_rays({1, 1, 0}, {1, 1, 0}) == infinity);
}

TEST_CASE("the reader's machine shifts the turns") {
    // Where rays take a hundred times as long, building is worth it earlier.
    const AdviceRequest request{.rays = 100};
    CHECK(advise(three(), thousand, request).front().structure == "quick");
    CHECK(advise(three(), thousand, request, {.build = 1, .ray = 100}).front().structure ==
          "careful");
    CHECK(advise(three(), thousand, request, {.build = 100, .ray = 1}).front().structure == "none");
}

TEST_CASE("of a moving scene trees are refitted where that is quicker") {
    const AdviceModel model{{made_up("fast", 8, 9, 6), made_up("bvh-sweep", 10, 10, 6)}};
    const Calibration here{.refit_ns_per_triangle = 16.0};
    const AdviceRequest still{.rays = 200}, moving{.rays = 200, .moving = true};
    CHECK(advise(model, thousand, still, here).front().structure == "fast");
    const std::vector<Candidate> candidates = advise(model, thousand, moving, here);
    CHECK(candidates[0].structure == "bvh-sweep");
    CHECK(candidates[0].is_refitted);
    CHECK(candidates[0].cost.build_ns == 16.0 * 1024.0);
    CHECK(!candidates[1].is_refitted);
    // With many rays a frame the better tree is worth building each time.
    CHECK(advise(model, thousand, {.rays = 1e6, .moving = true}, here).front().structure == "fast");
    // Refitting that is slower than building is left alone.
    CHECK(!advise(model, thousand, moving, {.refit_ns_per_triangle = 1e6})[1].is_refitted);
}

TEST_CASE("the reason names the term and the feature that decided") {
    AdviceModel model = three();
    model.seen[0].usual = 10;
    model.seen[1].usual = 2;
    model.structures[1].ray.weights[1] = 0.5;  // overlap hurts the quick one
    const SceneFeatures overlapping{.count = 10.0, .overlap = 5.0};
    const auto candidates = advise(model, overlapping, {.rays = 1e6});
    CHECK(
        reason(model, overlapping, candidates) ==
        "quick takes 0.06 of the time to build, and its rays take 22.63 times as long: it pays "
        "up to 1.8e+02 rays. What speaks most for careful: a random line meets 31 boxes (usually: "
        "a random line meets 3 boxes), by which quick takes 2.83 times as long for its rays.");
    CHECK(reason(model, thousand, std::span(candidates).first(1)) ==
          "No other structure fits in the memory.");
}

TEST_CASE("a model comes back from its file, and a broken file is an error of one line") {
    Pcg32 random(3);
    AdviceModel model = random_model(random);
    model.seen = {{{1, 0, 2}, {2, 1, 3}, {3, 3, 3}, {4, 4, 5}, {5, 2, 7}, {6, -1, 8}}};
    model.probe = {12.5, 250.0};
    model.machine = "a machine";
    model.date = "2026-01-02";
    const std::string text = advice_csv(model);
    const AdviceModel again = read_advice(text);
    CHECK(advice_csv(again) == text);
    CHECK(again.machine == model.machine);
    CHECK(again.date == model.date);
    CHECK(again.probe.per_ray == 250.0);
    CHECK(again.seen == model.seen);
    REQUIRE(again.structures.size() == model.structures.size());
    CHECK(again.structures.back().ray.weights[2] == Approx(model.structures.back().ray.weights[2]));

    const std::string bad[] = {"",
                               "# nothing\n",
                               "fast,build,1\n",
                               "fast,build,1,2,3,4,5,six,7\n",
                               "fast,build,1,2,3,4,5,nan,7\n",
                               "fast\n",
                               ",,\n",
                               text.substr(0, text.rfind('\n', text.size() - 2) + 1)};
    for (const std::string& broken : bad) {
        CAPTURE(broken);
        CHECK_THROWS_AS(read_advice(broken), Error);
    }
}

TEST_CASE("the kept model knows structures that there are, and foretells finite costs") {
    const AdviceModel model = kept_advice();
    const auto is_there = [](std::string_view name) {
        return std::ranges::find(structures(), name, &Structure::name) != structures().end();
    };
    CHECK(model.structures.size() >= 5);
    for (const StructureModel& structure : model.structures) CHECK(is_there(structure.structure));
    for (const Structure& structure : structures())
        if (can_be_refitted(structure.name)) CHECK(structure.home == "chapter 7");
    CHECK(!can_be_refitted("bvh-spatial"));
    Pcg32 random(4);
    for (int i = 0; i < 1000; ++i) {
        const std::array<double, 6> most{25, 25, 24, 1, 1, 24};
        std::array<double, 6> x{};
        for (std::size_t j = 0; j < x.size(); ++j)
            x[j] = most[j] * (i % 2 ? random.uniform_double() : double(random.below(2)));
        const SceneFeatures f{x[0], x[1], x[2], x[3], x[4], x[5]};
        for (const StructureModel& structure : model.structures) {
            const StructureCost cost = structure.cost(f);
            for (const double figure : {cost.build_ns, cost.ns_per_ray, cost.bytes})
                REQUIRE((std::isfinite(figure) && figure > 0.0));
        }
    }
}

TEST_CASE("the lab advises: a structure, a reason, what else, and a table") {
    for (const char* options : {"--rays-to-trace 1", "--rays-to-trace 1e9",
                                "--rays-to-trace 1000000 "
                                "--moving --threads 2",
                                "--rays-to-trace 1e18 --memory 1000"}) {
        CAPTURE(options);
        const Ended ended = run(lab.with("--advise --scene boxes:100").with(options));
        CHECK(ended.code == 0);
        CHECK(ended.err.empty());
        for (const char* part : {"mesh    boxes: 1,", "overlap", "machine ", "\nadvice  ",
                                 "\nwhy     ", "\nelse    from 10^0 ", "beside the best"})
            CHECK(ended.out.find(part) != std::string::npos);
        CHECK((ended.out.find("moving  ") != std::string::npos) ==
              (std::string(options).find("moving") != std::string::npos));
        CHECK(ended.out.find("nan") == std::string::npos);
        CHECK(ended.out.find("inf") == std::string::npos);
    }
    // Nothing but a point, of no size and no area.
    const Workbench bench;
    write_ply(bench / "point.ply", {{{1, 1, 1}}, {{0, 0, 0}}});
    const Ended point =
        run(lab.with("--advise --rays-to-trace 10").with("--mesh", bench / "point.ply"));
    CHECK(point.code == 0);
    CHECK(point.out.find("mesh    point: 1 triangle,") == 0);
}

TEST_CASE("what --advise cannot take is told in one line") {
    const auto is_told = [](const std::string& options, const char* part) {
        CAPTURE(options);
        const Ended ended = run(lab.with(options));
        CHECK(ended.code == 2);
        CHECK(ended.out.empty());
        CHECK(std::ranges::count(ended.err, '\n') == 1);
        CHECK(ended.err.find(part) != std::string::npos);
    };
    const std::string asked = "--scene boxes:36 --advise ";
    is_told(asked, "--rays-to-trace");
    for (const char* rays : {"0", "-1", "1e30", "nan", "inf", "1.5", "many", "0x10", "1e400"})
        is_told(asked + "--rays-to-trace " + rays, "no whole number from 1 to 1e18");
    for (const char* memory : {"0", "-5", "nan", "inf", "1e13", "lots"})
        is_told(asked + "--rays-to-trace 5 --memory " + memory, "no number of megabytes");
    is_told(asked + "--rays-to-trace 5 --memory 1e-9", "the smallest structure");
    is_told("--advise --rays-to-trace 5", "--mesh");
    is_told("--advise --rays-to-trace 5 --instances forest", "--instances");
    is_told("--scene boxes:36 --rays-to-trace 5", "--advise");
    is_told("--scene boxes:36 --moving", "--advise");
    is_told("--scene boxes:36 --memory 5", "--advise");
    for (const char* other : {"--json x", "--hits x", "--rays x", "--check", "--structure fast",
                              "--diffuse 5", "--size 5x5", "--repeat 2"})
        is_told(asked + "--rays-to-trace 5 " + other, "--advise");
}
