// The suite itself is tested: it passes what is right, and calls each fault by its name.
#include "tests/suite/accelerator_suite.hpp"
#include "tests/suite/broken_accelerators.hpp"
#include "tests/suite/small_bvh.hpp"

namespace space {
namespace {

template <class A>
A build(std::span<const Triangle> triangles) {
    return A::build(triangles);
}

/// A few rays of every kind are enough to catch these.
SuiteOptions few_rays() {
    SuiteOptions options;
    options.aimed_rays = 200;
    options.other_rays = 30;
    options.exact_rays = 5;
    options.in_child = true;
    return options;
}

template <class A>
SuiteReport examined(const SuiteOptions& options = few_rays()) {
    return examine_accelerator<A>(build<A>, options);
}

/// Examined once, whoever asks.
template <Flaw flaw>
const SuiteReport& report_on() {
    static const SuiteReport report = examined<Broken<flaw>>();
    return report;
}

}  // namespace

TEST_CASE("the suite finds nothing wrong with what is right") {
    const SuiteReport& report = report_on<Flaw::none>();
    INFO(report.text());
    CHECK(report.failures.empty());
    CHECK(report.scenes == adversarial_scenes().size());
    CHECK(report.exact.wrong() + report.exact[Agreement::agree] > 0);
}

TEST_CASE("the suite passes a correct tree with all its rays") {
    check_accelerator<SmallBvh<>>("the smallest tree", build<SmallBvh<>>);
}

#define NAMED(flaw, name)                              \
    TEST_CASE("the suite catches by name: " #flaw) {   \
        const SuiteReport& report = report_on<flaw>(); \
        INFO(report.text());                           \
        CHECK(report.names(name));                     \
    }
NAMED(Flaw::drops_a_triangle, "drops a triangle")
NAMED(Flaw::prunes_too_early, "prunes too early")
NAMED(Flaw::ignores_tmin, "ignores tmin")
NAMED(Flaw::ignores_tmax, "ignores tmax")
NAMED(Flaw::open_interval, "treats the interval as open")
NAMED(Flaw::forgets_ties, "forgets the tie rule")
NAMED(Flaw::stale_uv, "returns stale u, v")
NAMED(Flaw::invents_hits, "reports a hit that is none")
NAMED(Flaw::any_ignores_tmin, "any_hit ignores tmin")
NAMED(Flaw::any_ignores_tmax, "any_hit ignores tmax")
NAMED(Flaw::any_misses, "any_hit misses a hit")
NAMED(Flaw::answers_invalid_rays, "answers an invalid ray")
NAMED(Flaw::counting_matters, "counting changes the answer")
NAMED(Flaw::counts_nothing, "does not count")
NAMED(Flaw::wrong_shape, "shape is inconsistent")
NAMED(Flaw::builds_differ, "the same build gives another tree")
NAMED(Flaw::crashes_on_empty, "crashes on an empty scene")
NAMED(Flaw::throws_on_empty, "throws")
NAMED(Flaw::state_between_rays, "answers depend on other threads or earlier rays")
#undef NAMED

TEST_CASE("the suite catches by name: Flaw::hangs_on_empty") {
    SuiteOptions options = few_rays();
    options.patience = 1;  // of this scene alone: a busy machine may take longer over the others
    options.scenes = {{"empty", {}}};
    const SuiteReport report = examined<Broken<Flaw::hangs_on_empty>>(options);
    INFO(report.text());
    CHECK(report.names("hangs"));
}

TEST_CASE("a fault is called by its name and no other, where the name says it all") {
    const auto only = [](const SuiteReport& report,
                         std::initializer_list<std::string_view> allowed) {
        INFO(report.text());
        for (const Failure& failure : report.failures) {
            INFO(failure.text());
            CHECK(std::find(allowed.begin(), allowed.end(), failure.fault) != allowed.end());
        }
    };
    only(report_on<Flaw::ignores_tmin>(), {fault::ignores_tmin});
    only(report_on<Flaw::ignores_tmax>(), {fault::ignores_tmax});
    only(report_on<Flaw::forgets_ties>(), {fault::forgets_ties});
    only(report_on<Flaw::stale_uv>(), {fault::stale_uv});
    only(report_on<Flaw::open_interval>(), {fault::open_interval, fault::any_misses_a_hit});
    only(report_on<Flaw::any_ignores_tmax>(),
         {fault::any_ignores_tmax, fault::any_ignores_interval});
    only(report_on<Flaw::counts_nothing>(), {fault::counts_nothing});
    only(report_on<Flaw::crashes_on_empty>(), {fault::crashes_on_empty});
}

TEST_CASE("a failure says in which scene, for which ray, what was expected and what came") {
    const SuiteReport& report = report_on<Flaw::drops_a_triangle>();
    const auto dropped = std::find_if(
        report.failures.begin(), report.failures.end(),
        [](const Failure& failure) { return failure.fault == fault::drops_a_triangle; });
    REQUIRE(dropped != report.failures.end());
    for (const char* part :
         {"scene \"", " ray origin (", ") direction (", "expected triangle 2 at t = ", "got "})
        CHECK(dropped->text().find(part) != std::string::npos);
}

TEST_CASE(
    "the suite catches faults of trees: lost ties, first leaves, boxes without numbers, missing "
    "vertices") {
    const SuiteReport ties = examined<SmallBvh<TreeFlaw::box_equals_pruned>>();
    INFO(ties.text());
    CHECK(ties.names(fault::forgets_ties));

    const SuiteReport first = examined<SmallBvh<TreeFlaw::first_leaf_wins>>();
    INFO(first.text());
    CHECK(first.names(fault::prunes_too_early));

    const SuiteReport nan = examined<SmallBvh<TreeFlaw::nan_box_test>>();
    INFO(nan.text());
    CHECK((nan.names(fault::misses_a_hit) || nan.names(fault::prunes_too_early)));

    const SuiteReport vertices = examined<SmallBvh<TreeFlaw::vertices_only>>();
    INFO(vertices.text());
    CHECK((vertices.names(fault::misses_a_hit) || vertices.names(fault::drops_a_triangle)));
}

}  // namespace space
