// The fragments of every polygon tile it: proved by CGAL in exact arithmetic for the exact grade,
// and by how much not for the others.
#include "chapters/ch03_bsp_trees/tiling.hpp"

#include "common/random.hpp"
#include "tests/catch.hpp"
#include "tests/ch03/cgal_fragments.hpp"
#include "tests/ch03/tiling_scenes.hpp"

#include <fmt/format.h>

namespace space {
namespace {

constexpr std::uint32_t every = 1;

constexpr Grade inexact_grades[] = {Grade::thick_float, Grade::ordered_float,
                                    Grade::ordered_double};
constexpr BspConfig::SplitterChoice choices[] = {
    BspConfig::SplitterChoice::first,    BspConfig::SplitterChoice::random,
    BspConfig::SplitterChoice::balanced, BspConfig::SplitterChoice::fewest_splits,
    BspConfig::SplitterChoice::weighted, BspConfig::SplitterChoice::free};
const char* name(BspConfig::SplitterChoice choice) {
    constexpr const char* names[] = {"first",         "random",   "balanced",
                                     "fewest splits", "weighted", "free"};
    return names[static_cast<int>(choice)];
}

/// Counts the cuts of each polygon.
struct Cuts : NoObserver {
    std::vector<std::uint32_t> of;

    explicit Cuts(std::size_t polygons) : of(polygons) {}
    using NoObserver::observe;
    void observe(const BspBuilder<3>::Cut& event) { ++of[event.whole.polygon]; }
};

/// By how much the areas of fragments can differ from the polygon's in an inexact grade. A cut
/// gives both pieces the same point; so the sum of their areas changes only by the triangle of the
/// edge p q and the cut: the error of s moves the cut along the edge and costs nothing, the
/// rounding of p + s (q - p) moves it off, by at most 2 u |q - p| + u |cut| in each coordinate (a
/// difference, a product and a sum). With M the largest coordinate that is 5 u M, sqrt(3) 5 u M < 9
/// u M in all. Twice per cut half the edge, which is no longer than the polygon's longest (but for
/// rounding), times this distance.
double area_bound(const Triangle& polygon, std::uint32_t cuts, Grade grade, double largest) {
    const double u = grade == Grade::ordered_double ? 0x1p-53 : 0x1p-24;
    double longest = 0.0;
    for (int i = 0; i < 3; ++i)
        longest =
            std::max(longest, glm::distance(Double3(polygon[i]), Double3(polygon[(i + 1) % 3])));
    return cuts * 1.01 * longest * 9.0 * u * largest;
}

double largest_coordinate(const std::vector<Triangle>& polygons) {
    double largest = 0.0;
    for (const auto& polygon : polygons)
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis)
                largest = std::max(largest, std::abs(double{polygon[corner][axis]}));
    return largest;
}

TilingReport examine(const std::vector<Triangle>& triangles, const BspConfig& config) {
    return examine_tiling(BspBuilder<3>::build(triangles, config), config.grade, every);
}

}  // namespace

TEST_CASE(
    "the exact grade tiles every polygon exactly, in every scene and with every choice of "
    "splitters") {
    std::uint64_t polygons = 0, fragments = 0;
    for (const TestScene& scene : scenes::tiling_scenes())
        for (const BspConfig::SplitterChoice choice : choices) {
            // The worst choices cut without measure: smaller scenes show as much.
            std::vector<Triangle> triangles = scene.triangles;
            const bool wild = choice == BspConfig::SplitterChoice::first ||
                              choice == BspConfig::SplitterChoice::random ||
                              choice == BspConfig::SplitterChoice::balanced;
            if (wild && triangles.size() > 200) triangles.resize(200);
            const TilingReport report = examine(triangles, {.splitter = choice});
            INFO(scene.name << ", " << name(choice) << ": " << report.text());
            CHECK(report.is_exact());
            CHECK(report.polygons > 0);
            CHECK(report.worst_area == 0.0);
            polygons += report.polygons;
            fragments += report.fragments;
        }
    fmt::print("  exact: {} polygons in {} fragments, nothing wrong\n", polygons, fragments);
    CHECK(fragments > 2 * polygons);
}

TEST_CASE(
    "the exact grade tiles polygons exactly far from the origin, and when they are huge or tiny") {
    const std::vector<Triangle> soup = scenes::soup(40, 0.6f, 7);
    const auto scaled = [&](float by) {
        return scenes::mapped(soup, [&](const Point3& p) { return p * by; });
    };
    const std::vector<TestScene> list{
        {"huge", scaled(1e38f)},
        {"tiny", scaled(1e-38f)},
        {"denormal", scaled(1e-42f)},
        {"far away",
         scenes::mapped(soup, [](const Point3& p) { return p + Point3(3e4f, -2e4f, 1e4f); })},
        {"on a coarse grid", scenes::mapped(soup, [](const Point3& p) {
             return glm::floor(p * 8.0f) + Point3(0x1p23f);
         })}};
    for (const TestScene& scene : list) {
        const TilingReport report = examine(scene.triangles, {});
        INFO(scene.name << ": " << report.text());
        CHECK(report.is_exact());
        CHECK(report.fragments > report.polygons);
    }
}

TEST_CASE("the exact grade tiles polygons exactly where planes differ in the last places") {
    // Sheaves of planes nearly through one line, and copies of one polygon moved by a float or two.
    Pcg32 random(8);
    std::vector<Triangle> sheaf, copies;
    for (int i = 0; i < 24; ++i) {
        const auto nudge = [&] { return random_point(random, -1e-7f, 1e-7f); };
        const double angle = 0.13 * i;
        const Point3 axis_a(0.3f, 0.1f, -1), axis_b(0.4f, 0.2f, 1),
            out(std::cos(angle), std::sin(angle), 0.1 * i);
        const Point3 p = axis_a - 0.3f * out + nudge(), q = axis_b - 0.3f * out + nudge();
        sheaf.push_back({p, q, 0.5f * (axis_a + axis_b) + out + nudge()});
        const Point3 a = Point3(-1, -0.9f, 0.1f) + nudge(), b = Point3(1.1f, -1, 0.2f) + nudge();
        copies.push_back({a, b, Point3(0.1f, 1, 0.15f) + nudge()});
    }
    for (const auto& triangles : {sheaf, copies})
        for (const BspConfig::SplitterChoice choice :
             {BspConfig::SplitterChoice::first, BspConfig::SplitterChoice::weighted}) {
            const TilingReport report = examine(triangles, {.splitter = choice});
            INFO(report.text());
            fmt::print("  nearly equal planes, {}: {}\n", name(choice), report.text());
            CHECK(report.is_exact());
        }
}

TEST_CASE("in the plane, the exact grade tiles every segment exactly") {
    Pcg32 random(9);
    std::vector<Segment> segments, whole;
    for (int i = 0; i < 150; ++i) {
        const auto point = [&] { return random_point(random, Aabb2{Point2(-1.0f), Point2(1.0f)}); };
        const auto whole_point = [&] {
            const auto x = static_cast<float>(random.below(7));
            return Point2(x, static_cast<float>(random.below(7)));
        };
        const Point2 a = point(), b = whole_point();
        segments.push_back({a, point()});
        whole.push_back({b, whole_point()});
    }
    for (const auto& scene : {segments, whole})
        for (const BspConfig::SplitterChoice choice : choices) {
            const TilingReport report =
                examine_tiling(BspBuilder<2>::build(scene, {.splitter = choice}), Grade::exact);
            INFO(name(choice) << ": " << report.text());
            CHECK(report.is_exact());
            CHECK(report.fragments > report.polygons);
        }
    const TilingReport inexact = examine_tiling(
        BspBuilder<2>::build(segments, {.grade = Grade::ordered_float}), Grade::ordered_float);
    CHECK_FALSE(inexact.is_exact());
}

TEST_CASE(
    "the inexact grades fail: areas differ, fragments leave their plane and overlap; but areas "
    "stay within the bound") {
    for (const Grade grade : inexact_grades) {
        TilingReport all;
        double worst_of_bound = 0.0;
        std::uint64_t beyond = 0;
        for (const TestScene& scene : scenes::tiling_scenes()) {
            const auto polygons = scene.triangles;
            Cuts cuts(polygons.size());
            const BspConfig config{.grade = grade};
            const BspTree<3> tree = BspBuilder<3>::build(polygons, config, cuts);
            const double largest = largest_coordinate(polygons);
            const std::vector<double> errors = area_errors(view(tree, grade));
            for (std::size_t i = 0; i < polygons.size(); ++i) {
                if (cuts.of[i] == 0) {
                    beyond += errors[i] != 0.0;
                    continue;
                }
                const double bound = area_bound(polygons[i], cuts.of[i], grade, largest);
                beyond += errors[i] > bound;
                worst_of_bound = std::max(worst_of_bound, errors[i] / bound);
            }
            const TilingReport report = examine_tiling(tree, grade, every);
            fmt::print("  {}, {}: worst area error {:.2g}\n", name(grade), scene.name,
                       report.worst_area);
            all += report;
        }
        fmt::print("  {}: {}; at most {:.2g} of the bound\n", name(grade), all.text(),
                   worst_of_bound);
        CHECK(beyond == 0);
        CHECK(worst_of_bound > 1e-3);  // the bound is worth stating
        CHECK(all.wrong_area > 0);
        CHECK(all.too_small > 0);  // holes
        CHECK(all.too_large > 0);
        CHECK(all.off_plane > 0);
        CHECK(all.overlaps > 0);
        CHECK(all.wrong_side > 0);
    }
}

TEST_CASE("the chapter's own measure of areas and cracks agrees with CGAL's") {
    for (const TestScene& scene : {TestScene{"random", scenes::soup(40, 0.6f, 1)},
                                   {"two spheres", scenes::tiling_scenes()[7].triangles}})
        for (const Grade grade :
             {Grade::thick_float, Grade::ordered_float, Grade::ordered_double, Grade::exact}) {
            const BspTree<3> tree = BspBuilder<3>::build(scene.triangles, {.grade = grade});
            const Tiling tiling = measure_tiling(tree, grade);
            const TilingReport report = examine_tiling(tree, grade);
            INFO(scene.name << ", " << name(grade));
            CHECK((tiling.area_error == 0.0) == (report.wrong_area == 0));
            CHECK(tiling.area_error == Approx(report.worst_area).epsilon(1e-9));
            CHECK((grade != Grade::exact || tiling.cracks == 0));
        }
}

TEST_CASE("the bunny is tiled exactly", "[.big]") {
    const std::vector<Triangle> bunny = scenes::bunny();
    if (bunny.empty()) {
        WARN("the bunny is not installed (package glmark2-data)");
        return;
    }
    const BspTree<3> tree = BspBuilder<3>::build(bunny);
    const TilingReport report = examine_tiling(tree, Grade::exact);
    fmt::print("  bunny: {}\n", report.text());
    CHECK(report.is_exact());
    CHECK(report.fragments == tree.fragments.size());
}

}  // namespace space
